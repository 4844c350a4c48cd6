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
