// Boxes as the techniques see them.
// A scene is a dense array of float32 boxes; a box's place in it is its slot. Inside a technique a box is an item: its
// bounds, with the axes reordered so that the sweep axis comes first, and a tag: the slot in 24 bits and 8 exclusion
// bits. Two items that share an exclusion bit are never reported as a pair. So one AND rejects a pair for any of three
// reasons: both continue into this cell from an earlier one (where they have met), both are static, or both have one
// colour (bipartite search).
#pragma once
#include "boxes/changes.hpp"
#include "boxes/rule.hpp"

inline constexpr u32 slot_mask = 0x00ffffff;
inline constexpr u32 max_slots = 1u << 24;
enum : u32 {
  continues_1 = 1u << 31,  // the item began in an earlier cell along the first binned axis
  continues_2 = 1u << 30,  // ... the second
  continues_3 = 1u << 29,  // ... the third
  is_static = 1u << 28,
  is_red = 1u << 27,
  is_blue = 1u << 26,
};

/// Beside the exclusion bits of a box, below them, may be the class of its rule. Marks of a technique fit below that.
inline constexpr u32 class_bit = 1 << 4, class_mask = 0x7ff * class_bit;

/// In a world that wraps around, of a box strictly inside it: its pairs with others like it are those of any other world.
inline constexpr u8 at_home = 8;

/// Whether two boxes of these groups are never a pair.
inline bool one_group(u32 a, u32 b) { return (a == b) & (a != 0); }

template <int D> struct Scene {
  const f32* boxes;  // D minima, then D maxima, per slot
  u32 count;
  const u32* rules;  // per slot, exclusion bits and class; null if no slot has either
  const Changes* changes = nullptr;  // what may have changed since the last update; null: anything, classes too
  bool filtered = false;  // since the last update, rules or groups of changed boxes may have changed
  const Rule* classes = nullptr;  // the rule of each class; null if exclusion bits tell all that is known here
  const u32* groups = nullptr;  // per slot, null if no slot has one: pairs within a group are not reported

  const u8* homes = nullptr;  // per slot, null if the world does not wrap around: `at_home` or not

  const f32* box(u32 slot) const { return boxes + u64(slot) * 2 * D; }
  u32 rule_of(u32 slot) const { return rules ? rules[slot] : 0; }
  u32 excluded_of(u32 slot) const { return rule_of(slot) & ~slot_mask; }
  u32 group_of(u32 slot) const { return groups ? groups[slot] : 0; }
  bool is_at_home(u32 slot) const { return !homes || (homes[slot] & at_home); }
  /// Whether it is known which boxes may have changed, and these are not most.
  bool listed() const { return changes && !changes->most(count); }
};

/// The order of the axes in an item: axis[0] is swept, the others are binned.
template <int D> struct AxisOrder {
  int axis[D];
  u8x16 pick;  // byte swizzle that puts the minima (3D) or the whole box (2D) in that order

  static AxisOrder make(int sweep) {
    AxisOrder order;
    order.axis[0] = sweep;
    order.axis[1] = sweep == 0;
    if constexpr (D == 3) order.axis[2] = 2 - (sweep == 2);
    auto bytes_of = [](int number) { return 0x03020100u + 0x04040404u * u32(number); };
    u32x4 pick = {bytes_of(order.axis[0]), bytes_of(order.axis[1])};
    if constexpr (D == 2) pick = u32x4{pick[0], pick[1], bytes_of(2 + order.axis[0]), bytes_of(2 + order.axis[1])};
    else pick = u32x4{pick[0], pick[1], bytes_of(order.axis[2]), 0x80808080u};
    order.pick = bits<u8x16>(pick);
    return order;
  }
};

template <int D> struct Item;

template <> struct Item<2> {
  f32x4 box;  // min sweep, min binned, max sweep, max binned
  u32 tag;

  f32x4 first() const { return box; }  // the vector whose lane 0 is the minimum along the sweep axis
  f32x4 size() const { return __builtin_shufflevector(box, box, 2, 3, 2, 3) - box; }
  f32 lo(int axis) const { return box[axis]; }
  f32 hi(int axis) const { return box[2 + axis]; }
};

template <> struct Item<3> {
  f32x4 low;  // min sweep, min binned 1, min binned 2, the tag's bits
  f32x4 high;  // max sweep, max binned 1, max binned 2, unused

  /// The minima without the tag: read as a number it is denormal, which slows many processors down tenfold.
  f32x4 first() const { return bits<f32x4>(bits<u32x4>(low) & u32x4{~0u, ~0u, ~0u, 0}); }
  f32x4 size() const { return high - first(); }
  f32 lo(int axis) const { return low[axis]; }
  f32 hi(int axis) const { return high[axis]; }
};

inline Item<2> with_tag(Item<2> item, u32 bits) { return {item.box, item.tag | bits}; }
inline Item<3> with_tag(Item<3> item, u32 more) {
  return {bits<f32x4>(bits<u32x4>(item.low) | u32x4{0, 0, 0, more}), item.high};
}

inline u32 tag_of(const Item<2>& item) { return item.tag; }
inline u32 tag_of(const Item<3>& item) { return bits<u32x4>(item.low)[3]; }

/// Whether two items are the same, bit by bit.
inline bool same(const Item<2>& a, const Item<2>& b) {
  return a.tag == b.tag && !any(bits<i32x4>(a.box) ^ bits<i32x4>(b.box));
}
inline bool same(const Item<3>& a, const Item<3>& b) {
  return !any((bits<i32x4>(a.low) ^ bits<i32x4>(b.low)) | (bits<i32x4>(a.high) ^ bits<i32x4>(b.high)));
}

/// Items read straight from the scene.
template <int D> struct SceneItems {
  Scene<D> scene;
  AxisOrder<D> order;

  Item<D> operator[](u32 slot) const {
    u32 tag = slot | scene.excluded_of(slot);
    if constexpr (D == 2) {
      return {bits<f32x4>(swizzle(load<u8x16>(scene.boxes + 4 * size_t(slot)), order.pick)), tag};
    } else {
      const f32* box = scene.boxes + 6 * size_t(slot);
      f32x4 low = bits<f32x4>(swizzle(load<u8x16>(box), order.pick));
      f32x4 tail = load<f32x4>(box + 2);
      f32x4 high = bits<f32x4>(swizzle(bits<u8x16>(f32x4{tail[1], tail[2], tail[3], 0}), order.pick));
      return {bits<f32x4>(bits<u32x4>(low) | u32x4{0, 0, 0, tag}), high};
    }
  }
};

/// Items of the scene in another order, given as slots, whose upper bits may have exclusion bits to add.
template <int D> struct PickedItems {
  SceneItems<D> items;
  const u32* slots;

  Item<D> operator[](size_t k) const { return with_tag(items[slots[k] & slot_mask], slots[k] & ~slot_mask); }
};

/// Items stored contiguously, in the order chosen by a technique.
template <int D> struct Items {
  Buffer<f32x4> boxes;
  Buffer<u32> tags;  // in 2D; in 3D the tag is in the box's spare lane

  void grow(u64 n, u64 keep) {
    boxes.grow(n * (D - 1), keep * (D - 1));
    if constexpr (D == 2) tags.grow(n, keep);
  }
  void release() {
    boxes.release();
    tags.release();
  }
};

/// A pointer to items stored in `Items`.
template <int D> struct ItemsAt {
  f32x4* boxes;
  u32* tags;

  ItemsAt(const Items<D>& items, size_t first)
      : boxes(items.boxes.data() + first * (D - 1)), tags(D == 2 ? items.tags.data() + first : nullptr) {}

  Item<D> operator[](size_t k) const {
    if constexpr (D == 2) return {boxes[k], tags[k]};
    else return {boxes[2 * k], boxes[2 * k + 1]};
  }
  void put(size_t k, Item<D> item) const {
    if constexpr (D == 2) {
      boxes[k] = item.box;
      tags[k] = item.tag;
    } else {
      boxes[2 * k] = item.low;
      boxes[2 * k + 1] = item.high;
    }
  }
};

/// Pointers into `Lanes` for the inner loop: local copies, so that the compiler knows that stores do not change them.
template <int D> struct LaneView {
  const f32* lo[D];
  const f32* hi[D];
  const u32* tag;
};

/// Transposes four rows of four.
inline void transpose(f32x4 (&row)[4]) {
  f32x4 ab_low = __builtin_shufflevector(row[0], row[1], 0, 4, 1, 5);
  f32x4 ab_high = __builtin_shufflevector(row[0], row[1], 2, 6, 3, 7);
  f32x4 cd_low = __builtin_shufflevector(row[2], row[3], 0, 4, 1, 5);
  f32x4 cd_high = __builtin_shufflevector(row[2], row[3], 2, 6, 3, 7);
  row[0] = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  row[1] = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
  row[2] = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  row[3] = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

/// Items as structure of arrays, for tests of one against four: lo and hi per axis, and the tags.
/// Followed by `spare_lanes` NaN boxes, which overlap nothing: reading past the end is harmless.
template <int D> class Lanes {
  Buffer<f32> values_;
  size_t stride_ = 0;

 public:
  static constexpr u32 spare_lanes = 16;

  f32* lo(int axis) const { return values_.data() + size_t(axis) * stride_; }
  f32* hi(int axis) const { return values_.data() + size_t(D + axis) * stride_; }
  u32* tag() const { return reinterpret_cast<u32*>(values_.data() + size_t(2 * D) * stride_); }

  LaneView<D> view() const {
    LaneView<D> view;
    for (int a = 0; a < D; a++) {
      view.lo[a] = lo(a);
      view.hi[a] = hi(a);
    }
    view.tag = tag();
    return view;
  }

  void reserve(u32 n) {
    size_t stride = (size_t(n) + spare_lanes + 3) & ~size_t(3);
    if (stride <= stride_) return;
    values_.reserve(stride * (2 * D + 1));
    stride_ = values_.capacity() / (2 * D + 1) & ~size_t(3);
  }
  void release() {
    values_.release();
    stride_ = 0;
  }

  /// Transposes n items, four at a time. Instead of items past the end, the last one: then NaN boxes are put there.
  template <class Source> NOINLINE void fill(const Source& items, u32 n) const {
    const u32 step = u32(stride_);
    f32* to = values_.data();
    for (u32 k = 0, last = n - 1; k < n; k += 4)
      put4(to + k, step,
           {items[k], items[smaller(k + 1, last)], items[smaller(k + 2, last)], items[smaller(k + 3, last)]});
    for (u32 k = n; k < n + spare_lanes; k += 4) put4(to + k, step, {nothing(), nothing(), nothing(), nothing()});
  }

 private:
  static Item<D> nothing() {
    f32x4 nan = splat(__builtin_nanf(""));
    if constexpr (D == 2) return {nan, 0};
    else return {nan, nan};
  }

  /// Writes four items in a row, each number `step` from the one before.
  static void put4(f32* to, u32 step, const Item<D> (&item)[4]) {
    if constexpr (D == 2) {
      f32x4 row[4] = {item[0].box, item[1].box, item[2].box, item[3].box};
      transpose(row);
      for (u32 k = 0; k < 4; k++) store(to + k * step, row[k]);
      store(to + 4 * step, u32x4{item[0].tag, item[1].tag, item[2].tag, item[3].tag});
    } else {
      f32x4 row[4] = {item[0].low, item[1].low, item[2].low, item[3].low};
      transpose(row);
      for (u32 k = 0; k < 3; k++) store(to + k * step, row[k]);
      store(to + 6 * step, row[3]);
      f32x4 top[4] = {item[0].high, item[1].high, item[2].high, item[3].high};
      transpose(top);
      for (u32 k = 0; k < 3; k++) store(to + (3 + k) * step, top[k]);
    }
  }
};
