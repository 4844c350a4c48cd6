// Ids and slots against a map.
#include "boxes/ids.hpp"

#include <map>
#include <memory>
#include <vector>

#include "check.hpp"
#include "random.hpp"

namespace {

constexpr u32 most = (1u << 24) - 1;

/// The same ids twice: as the kernel keeps them, and as a map and a list of slots.
struct Both {
  std::unique_ptr<Ids> ids = std::make_unique<Ids>();
  std::map<u32, u32> slot_of;
  std::vector<u32> id_of;

  void insert(u32 id) {
    CHECK(ids->insert(id) == id_of.size());
    slot_of[id] = u32(id_of.size());
    id_of.push_back(id);
  }
  void erase(u32 id) {
    ids->erase(id);
    u32 gap = slot_of[id];
    id_of[gap] = id_of.back();
    slot_of[id_of[gap]] = gap;
    id_of.pop_back();
    slot_of.erase(id);
  }
  void compare() const {
    CHECK(ids->valid());
    CHECK(ids->count() == id_of.size());
    for (u32 slot = 0; slot < id_of.size(); slot++) CHECK(ids->id(slot) == id_of[slot]);
    for (auto [id, slot] : slot_of) CHECK(ids->slot(id) == slot);
  }
};

}  // namespace

TEST("ids come and go in any order") {
  for (u32 round = 0; round < 8; round++) {
    Random random(round);
    Both both;
    // Dense ids, few gaps, and gaps up to the last id there is.
    u32 range = round < 2 ? 40 : round < 4 ? 5000 : round < 6 ? 200000 : most + 1;
    for (u32 call = 0; call < 4000; call++) {
      bool crowded = both.id_of.size() > 300;
      if (random.below(100) < (crowded ? 60u : 40u) && !both.id_of.empty()) {
        both.erase(both.id_of[random.below(u32(both.id_of.size()))]);
      } else {
        u32 id = random.below(20) == 0 ? most - random.below(3) : random.below(range);
        CHECK((both.ids->slot(id) == Ids::none) == (both.slot_of.count(id) == 0));
        if (!both.slot_of.count(id)) both.insert(id);
      }
      if (call % 500 == 0) both.compare();
    }
    both.compare();
    while (!both.id_of.empty()) both.erase(both.id_of.front());
    both.compare();
  }
}

TEST("ids in order are not stored") {
  size_t before = heap::used;
  auto ids = std::make_unique<Ids>();
  for (u32 id = 0; id < 5000; id++) CHECK(ids->insert(id) == id);
  while (ids->count() > 4000) ids->erase(ids->count() - 1);
  CHECK(ids->same());
  CHECK(heap::used == before);
  CHECK(ids->slot(3999) == 3999 && ids->slot(4000) == Ids::none && ids->slot(most) == Ids::none);

  ids->erase(17);
  CHECK(!ids->same());
  CHECK(ids->slot(17) == Ids::none && ids->slot(3999) == 17 && ids->slot(3998) == 3998);
  CHECK(ids->valid());

  ids->reset(10);
  CHECK(ids->same() && ids->count() == 10 && ids->slot(9) == 9 && ids->slot(10) == Ids::none);
  CHECK(heap::used == before);
}

TEST("ids are unchanged when memory runs out") {
  u64 limit = heap::limit;
  auto ids = std::make_unique<Ids>();
  for (u32 id = 0; id < 9000; id++) ids->insert(id);
  u32 failures = 0;
  for (u64 room = 0;; room += 4096) {
    heap::limit = heap::used + room;
    try {
      ids->insert(most);
      break;
    } catch (const Failure&) {
      failures++;
      CHECK(ids->count() == 9000 && ids->same() && ids->valid());
      CHECK(ids->slot(most) == Ids::none && ids->slot(8999) == 8999);
    }
    heap::limit = limit;
  }
  heap::limit = limit;
  CHECK(failures > 3);
  CHECK(ids->count() == 9001 && ids->slot(most) == 9000 && ids->valid());
}
