// What comes after the items of `Lanes`, since sweeps read it.
#include "boxes/box.hpp"
#include "check.hpp"

TEST("after the items of lanes there is padding that overlaps nothing, whatever was there before") {
  Lanes<2> lanes;
  Items<2> store;
  store.grow(100, 0);
  ItemsAt<2> items(store, 0);
  for (u32 k = 0; k < 100; k++) items.put(k, {f32x4{0, 0, 1, 1}, k});
  lanes.reserve(100);
  for (u32 count = 60; count < 80; count++) {
    lanes.fill(items, 100);
    lanes.fill(items, count);
    for (u32 k = 0; k < count + Lanes<2>::spare_lanes; k++) CHECK((lanes.lo(0)[k] == lanes.lo(0)[k]) == (k < count));
  }
  lanes.release();
  store.release();
}
