// Which boxes have changed, as the space is told.
#include "changes.hpp"

#include "check.hpp"

TEST("changes have room for as many as they say, and name each once") {
  Changes changes;
  changes.make_room(33);
  changes.clear(33);
  changes.make_room(60);
  for (u32 round = 0; round < 2; round++) {
    for (u32 slot = 0; slot < 60; slot++) changes.note(slot);
  }
  CHECK(changes.count() == 60);
  for (u32 k = 0; k < 60; k++) CHECK(changes.list()[k] == k);
}

TEST("whether a box is as before is asked of all where many are, else of some") {
  Changes changes;
  changes.make_room(1000);
  CHECK(!changes.asks());  // all may have changed
  changes.clear(1000);
  /// Boxes that are given, of which every so many is as before; gives of how many it was asked.
  auto give = [&](u32 every) {
    u32 asked = 0;
    for (u32 slot = 0; slot < 1000; slot++) {
      if (changes.asks()) {
        asked++;
        if (changes.tell(slot % every == 0)) continue;
      }
      changes.note(slot);
    }
    changes.clear(1000);
    return asked;
  };
  CHECK(give(1) == 1000);  // nobody has moved: it is known of each
  CHECK(give(1000) == 1000);
  CHECK(give(1000) < 100);
  CHECK(give(1000) < 100);
}
