// Items in the order of their centres along the Hilbert curve.
// The curve visits the cells of a quadtree (octree) one after the other, so neighbours are close together in the order,
// and the first digits of a place on it name the cell of a tree. On request, boxes that are larger than a cell come
// before all those in it: ordered by cell, then from large to small.
// Cost: about 20 ns an item: a radix sort and a copy.
// From: J. Skilling, "Programming the Hilbert curve", 2004.
#pragma once
#include "base/radix_sort.hpp"
#include "boxes/cell_map.hpp"
#include "boxes/scene_sample.hpp"

/// Where an item stands on the Hilbert curve, for four items at once.
template <int D> class HilbertCurve {
  Axes along_[D];

 public:
  // Two digits of the radix sort. Cells much finer than one per item would not improve the order.
  static constexpr u32 levels = D == 2 ? 11 : 7, level_bits = 4;

  SMALL explicit HilbertCurve(const SceneSample<D>& world) {
    for (int a = 0; a < D; a++) {
      f64 middle = world.size[a] / 2;
      Axis axis = Axis::make(world.low[a] + middle, world.high[a] + middle, 1 << levels);
      along_[a] = {axis, axis, axis, axis};
    }
  }

  /// From centres to cells, and from cells to the curve.
  NOINLINE u32x4 operator()(const SceneItems<D>& items, const u32 (&index)[4]) const {
    f32x4 centres[4];
    for (int k = 0; k < 4; k++) {
      Item<D> item = items[index[k]];
      if constexpr (D == 2)
        centres[k] = item.box * 0.5f + __builtin_shufflevector(item.box, item.box, 2, 3, 0, 1) * 0.5f;
      else centres[k] = item.first() * 0.5f + item.high * 0.5f;
    }
    transpose(centres);
    u32x4 at[D];
    for (int a = 0; a < D; a++) at[a] = along_[a](centres[a]);
    // From the coarsest cells down, each quarter (eighth) is turned and mirrored so that the curve goes on.
    ROLLED for (u32 bit = 1u << (levels - 1); bit > 1; bit >>= 1) {
      u32x4 lower = splat(bit - 1);
      for (int a = 0; a < D; a++) {
        u32x4 is_set = bits<u32x4>((at[a] & splat(bit)) != u32x4{});
        u32x4 swapped = (at[0] ^ at[a]) & lower & ~is_set;
        at[0] ^= swapped | (lower & is_set);
        at[a] ^= swapped;
      }
    }
    for (int a = 1; a < D; a++) at[a] ^= at[a - 1];
    u32x4 turns = at[D - 1] >> 1;  // the parity of all higher bits
    ROLLED for (u32 step = 1; step < 16; step *= 2) turns ^= turns >> step;
    u32x4 key = {};
    for (int a = 0; a < D; a++) key |= spread(at[a] ^ turns) << u32(D - 1 - a);
    return key;
  }

  /// Sorts the first n items, at least one, by the keys that `key_of` makes of their places on the curve.
  template <class KeyOf> void sort(const SceneItems<D>& items, u32 n, RadixSort& sort, KeyOf key_of) const {
    sort.begin(n);
    for (u32 k = 0; k < n; k += 4) {
      u32 places[4], last = n - 1;
      store(places, (*this)(items, {k, smaller(k + 1, last), smaller(k + 2, last), smaller(k + 3, last)}));
      ROLLED for (u32 lane = 0; lane < smaller(n - k, 4u); lane++) {
        sort.put_bits(k + lane, key_of(k + lane, places[lane]));
      }
    }
    sort.sort(n);
  }

  /// A place, truncated to its cell on a level.
  static u32 at_level(u32 place, u32 level) {
    u32 finer = D * (levels - level);
    return place >> finer << finer << level_bits | level;
  }

 private:
  /// Puts D - 1 zeros before each bit.
  static u32x4 spread(u32x4 x) {
    if constexpr (D == 2) {
      x = (x | x << 8) & splat(0x00ff00ffu);
      x = (x | x << 4) & splat(0x0f0f0f0fu);
      x = (x | x << 2) & splat(0x33333333u);
      return (x | x << 1) & splat(0x55555555u);
    } else {
      x = (x | x << 8) & splat(0x0300f00fu);
      x = (x | x << 4) & splat(0x030c30c3u);
      return (x | x << 2) & splat(0x09249249u);
    }
  }
};

template <int D> class HilbertOrder {
  using Curve = HilbertCurve<D>;

  RadixSort sort_;
  Items<D> ordered_;

 public:
  /// Orders the boxes of a scene, which is not empty, into lanes that have room for them.
  NOINLINE void make(const Scene<D>& scene, bool by_size, const Lanes<D>& lanes) {
    u32 n = scene.count;
    SceneItems<D> items{scene, AxisOrder<D>::make(0)};
    SceneSample<D> world = measure<D>(items, n);
    Curve(world).sort(items, n, sort_, [&](u32 k, u32 place) {
      return by_size ? Curve::at_level(place, level_of(items[k], world)) : place;
    });
    ordered_.grow(n, 0);
    ItemsAt<D> ordered(ordered_, 0);
    for (u32 k = 0; k < n; k++) ordered.put(k, items[sort_.index(k)]);
    lanes.fill(ordered, n);
  }

  ItemsAt<D> items() const { return {ordered_, 0}; }
  u32 slot(u32 k) const { return sort_.index(k); }
  u32 key(u32 k) const { return sort_.key(k); }

  SMALL void release() {
    sort_.release();
    ordered_.release();
  }

 private:
  /// The finest level whose cells are no smaller than the box.
  static u32 level_of(const Item<D>& item, const SceneSample<D>& world) {
    f32 share = 0;
    for (int a = 0; a < D; a++) {
      f32 size = item.hi(a) - item.lo(a), extent = f32(world.high[a] - world.low[a]);
      f32 mine = size > 0 ? size / extent : 0;
      share = mine < share ? share : mine;  // also true for NaN, when both are infinite
    }
    // One level for each time that it can be doubled without exceeding 1.
    if (!(share <= 0.5f)) return 0;
    u32 doublings = 127 - ((bits<u32>(share) + 0x7fffff) >> 23);
    return smaller(doublings, Curve::levels);
  }
};
