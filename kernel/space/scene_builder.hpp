// Builds the scene to search from a space: boxes enlarged by their reaches, without those that can meet nobody, and
// with ghosts if the world wraps around.
// Cost: nothing if no box has a reach or a rule and the world does not wrap around; otherwise a copy of the boxes for
// each. Only boxes that have changed are copied, if it is known which.
#pragma once
#include "rules/wrap.hpp"
#include "space/store.hpp"

template <int D> class SceneBuilder {
  static constexpr u32 width = 2 * D;

  Buffer<f32> picked_;  // the boxes searched, if not all are
  u32 picked_count_ = 0;  // as of the last update; 0: not held
  Changes moved_;  // places of boxes searched that have changed, if not all are searched or the world wraps around
  Buffer<u32> groups_;  // of these
  Buffer<f32> grown_;  // the boxes enlarged by their reaches, if some box has one
  Buffer<f64> grown_exact_;  // the same as doubles, from which they are rounded
  u32 grown_count_ = 0;  // as of the last update; 0: not held

 public:
  Wrap wrap;
  const f64* doubles = nullptr;  // the numbers to test pairs in doubt with; null if all are exact in float32

  /// Builds the scene of an update. `follows`: whether the technique uses the list of changes; `in_order`: whether boxes
  /// have to be in the order of their slots.
  SMALL Scene<D> build(Store<D>& store, bool follows, bool in_order) {
    Numbers<D>& numbers = store.numbers;
    Filters& filters = store.own.filters;
    auto& groups = store.own.groups;
    const f32* boxes = numbers.boxes();
    doubles = numbers.exact();
    const bool grows = store.own.reaches.some(), did_grow = grown_count_ > 0;
    if (grows) boxes = grow(store, store.changes());
    else grown_count_ = 0;
    // Where the first box gets a reach, all are copied, and infinite ones are rounded to other numbers.
    Scene<D> scene{boxes, store.ids.count(), nullptr, follows && grows == did_grow ? &store.changes() : nullptr};
    if (filters.active()) {
      filters.update(scene.count, in_order);
      scene.filtered = !filters.moved().none();
      scene.rules = filters.tags();
      scene.classes = filters.classes();
      if (filters.moved().all()) scene.changes = nullptr;
    }
    bool picks = filters.some();
    if (groups.some() && !store.world()) {  // ghosts have no groups: then `part_groups` removes the pairs
      scene.groups = filters.pick(groups.data(), groups_);
      scene.filtered |= groups.changed();
    }
    groups.updated();
    if (store.world()) {
      find_moved(scene, filters);
      if (picks) scene.count = filters.searched();
      scene.filtered |= scene.rules != nullptr;  // those of ghosts may change too
      scene.boxes = wrap.unfold(scene.count, scene.rules, moved_, filters, boxes, doubles, store.world(), D, in_order);
      scene.homes = wrap.homes();
      if (scene.changes) scene.changes = &moved_;
    } else if (picks) {
      pick(scene, filters);
    }
    if (!picks) picked_count_ = 0;
    return scene;
  }

  /// Releases all memory; nothing is held.
  SMALL void release() {
    picked_.release();
    picked_count_ = 0;
    groups_.release();
    grown_.release();
    grown_count_ = 0;
    grown_exact_.release();
    wrap.release();
  }

 private:
  /// Finds the places of the boxes that have changed.
  SMALL void find_moved(const Scene<D>& scene, const Filters& filters) {
    u32 n = filters.some() ? filters.searched() : scene.count;
    moved_.clear(n);
    if (!scene.listed()) return moved_.note_all();
    for (u32 k = 0; k < scene.changes->count(); k++) {
      u32 slot = scene.changes->list()[k];
      if (slot >= scene.count) continue;
      u32 place = filters.some() ? filters.place(slot) : slot;
      if (place < n) moved_.note(place);
    }
    for (u32 k = 0; filters.some() && k < filters.moved().count(); k++) {
      if (filters.moved().list()[k] < n) moved_.note(filters.moved().list()[k]);
    }
  }

  /// Leaves only the boxes that are searched, in their places.
  SMALL void pick(Scene<D>& scene, const Filters& filters) {
    u32 n = filters.searched();
    f32* to = picked_.grow(u64(n) * width + Numbers<D>::padding, u64(picked_count_) * width);
    find_moved(scene, filters);
    if (picked_count_ == 0) moved_.note_all();
    if (moved_.all()) copy_all(scene, filters.slots(), n, to);
    for (u32 k = 0; !moved_.all() && k < moved_.count(); k++) {
      u32 place = moved_.list()[k];
      copy_box(scene.box(filters.slots()[place]), to + u64(place) * width);
    }
    if (scene.changes) scene.changes = &moved_;
    scene.boxes = to;
    scene.count = picked_count_ = n;
  }

  NOINLINE static void copy_all(const Scene<D>& scene, const u32* slots, u32 count, f32* to) {
    for (u32 k = 0; k < count; k++, to += width) copy_box(scene.box(slots[k]), to);
  }

  static void copy_box(const f32* box, f32* to) { store_box<D>(to, load<f32x4>(box), load<f32x4>(box + width - 4)); }

  /// Enlarges the boxes by their reaches. If it is known which have changed, only these.
  SMALL const f32* grow(const Store<D>& store, const Changes& changes) {
    u32 n = store.ids.count();
    f32* to = grown_.grow(u64(n) * width + Numbers<D>::padding, u64(grown_count_) * width);
    grown_exact_.grow(larger(u64(n) * width, u64(1)), u64(grown_count_) * width);
    bool some = grown_count_ > 0 && !changes.most(n);
    grow_each(store, some ? changes.list() : nullptr, some ? changes.count() : n, n);
    doubles = grown_exact_.data();
    grown_count_ = n;
    return to;
  }

  /// `slots`: of the boxes; null for all.
  NOINLINE void grow_each(const Store<D>& store, const u32* slots, u32 many, u32 count) {
    const f32* boxes = store.numbers.boxes();
    const GapMap<D>& map = store.numbers.map();
    for (u32 k = 0; k < many; k++) {
      u32 slot = slots ? slots[k] : k;
      if (slot >= count) continue;
      u64 at = u64(slot) * width;
      f64 reach = store.own.reaches.of(slot);
      f64* box = grown_exact_.data() + at;
      for (u32 n = 0; n < width; n += 2) {
        f64x2 given = doubles ? load<f64x2>(doubles + at + n) : f64x2{boxes[at + n], boxes[at + n + 1]};
        ::store(box + n, given + f64x2{n < D ? -reach : reach, n + 1 < D ? -reach : reach});
      }
      map.round(box, grown_.data() + at);
    }
  }
};
