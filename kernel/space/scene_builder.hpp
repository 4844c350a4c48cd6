// Builds the scene to search from a space: boxes enlarged by their reaches, without those that can meet nobody, and
// with ghosts if the world wraps around.
// Cost: nothing if no box has a reach or a rule and the world does not wrap around; otherwise a copy of the boxes for
// each.
#pragma once
#include "rules/wrap.hpp"
#include "space/store.hpp"

template <int D> class SceneBuilder {
  static constexpr u32 width = 2 * D;

  Buffer<u32> groups_;  // of the boxes searched, if not all are
  Buffer<f32> grown_;  // the boxes enlarged by their reaches, if some box has one
  Buffer<f64> grown_exact_;  // the same as doubles, from which they are rounded

 public:
  Wrap wrap;
  const f64* doubles = nullptr;  // the numbers to test pairs in doubt with; null if all are exact in float32

  /// Builds the scene of an update. `follows`: whether the technique uses the list of changes.
  SMALL Scene<D> build(Store<D>& store, bool follows, bool ordered) {
    Numbers<D>& numbers = store.numbers;
    Filters& filters = store.own.filters;
    auto& groups = store.own.groups;
    const f32* boxes = numbers.boxes();
    doubles = numbers.exact();
    if (store.own.reaches.some()) boxes = grow(store);
    Scene<D> scene{boxes, store.ids.count(), nullptr, follows ? &store.changes() : nullptr, ordered};
    if (filters.active()) {
      scene.filtered = filters.changed();
      scene.boxes = filters.select(scene.boxes, scene.count, width);
      scene.excluded = filters.excluded();
      if (scene.filtered || scene.boxes != boxes) scene.changes = nullptr;
    }
    if (groups.some() && !store.world()) {  // ghosts have no groups: then `part_groups` removes the pairs
      scene.groups = filters.select(groups.data(), scene.count, groups_);
      scene.filtered |= groups.changed();
    }
    groups.updated();
    if (store.world()) {
      scene.changes = nullptr;
      scene.filtered |= scene.excluded != nullptr;  // exclusion bits of ghosts may change too
      scene.boxes = wrap.unfold(scene.count, scene.excluded, filters, boxes, doubles, store.world(), D);
    }
    return scene;
  }

 private:
  /// Enlarges the boxes by their reaches.
  SMALL const f32* grow(const Store<D>& store) {
    u32 n = store.ids.count();
    f32* to = grown_.reserve(u64(n) * width + Numbers<D>::padding);
    f64* exact = grown_exact_.reserve(larger(u64(n) * width, u64(1)));
    const f32* boxes = store.numbers.boxes();
    for (u32 s = 0; s < n; s++) {
      f64* box = exact + u64(s) * width;
      for (u32 k = 0; k < width; k++) {
        f64 given = doubles ? doubles[u64(s) * width + k] : f64(boxes[u64(s) * width + k]),
            reach = store.own.reaches.of(s);
        box[k] = k < D ? given - reach : given + reach;
      }
      store.numbers.map().round(box, to + u64(s) * width);
    }
    doubles = exact;
    return to;
  }
};
