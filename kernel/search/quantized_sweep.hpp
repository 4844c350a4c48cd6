// Sweeps in which each item meets many that start before it ends, few of which overlap it.
// Idea: on the axes that are not swept, the items' bounds are also stored as cells of a 254th of the world, in 8 bits.
// Items whose cells do not touch cannot overlap, so sixteen are rejected at a time, with two subtractions per axis that
// are above 0 where they miss.
// Items that may overlap are collected without a branch, and tested exactly in batches.
// Cost: about 2.2 (2D) or 2.5 (3D) ns for sixteen tests; 2 (2D) or 4 (3D) bytes an item.
#pragma once
#include "boxes/cell_map.hpp"
#include "boxes/scene_sample.hpp"
#include "search/sweep.hpp"

template <int D> class QuantizedSweep {
  static constexpr u32 block = 16, cells = 254;
  static_assert(Lanes<D>::spare_lanes >= block);
  // Blocks are tested exactly when this many have been collected.
  static constexpr u32 enough = 512;

  /// Items from `at` on that may overlap `item`, a bit for each.
  struct Near {
    u32 item, at, which;
  };

  Buffer<u8> cells_;  // per axis but the first: the minima of the items, then the maxima
  Buffer<Near> near_;

 public:
  /// Tests each item of [first, last), which is the end of the list, against those after it and before its `end`, and
  /// appends the pairs. If `sorted`, items are in ascending order of their minima along axis 0, and no `end` is needed:
  /// an item is tested against those that start before it ends. Only then, returns the number of tests.
  template <bool sorted = true>
  NOINLINE u64 find(const Lanes<D>& from, const SceneSample<D>& world, u32 first, u32 last, Pairs& pairs,
                    const u32* end = nullptr) {
    u32 count = last - first, stride = count + 2 * block;
    u8* row = cells_.reserve(u64(stride) * 2 * (D - 1));
    const u8* least[D - 1];
    const u8* most[D - 1];
    for (int a = 1; a < D; a++) {
      Axis axis = Axis::make(world.low[a], world.high[a], cells);
      round(axis, from.lo(a) + first, row, count);
      store(row + count, splat(u8(cells)));  // past the last item: above all maxima
      least[a - 1] = row - first;
      row += stride;
      round(axis, from.hi(a) + first, row, count);
      most[a - 1] = row - first;
      row += stride;
    }

    const LaneView<D> lanes = from.view();
    Near* near = near_.reserve(enough + count / block + 2);
    Near* out = near;
    u64 tests = 0;
    i32x4 counted = {};
    for (u32 i = first; i < last; i++) {
      f32 reach = lanes.hi[0][i];
      u8x16 low[D - 1], high[D - 1];
      for (int a = 0; a < D - 1; a++) {
        low[a] = splat(least[a][i]);
        high[a] = splat(most[a][i]);
      }
      u32 j = i + 1;
      do {
        u8x16 misses = {};
        for (int a = 0; a < D - 1; a++)
          misses |= excess(load<u8x16>(least[a] + j), high[a]) | excess(low[a], load<u8x16>(most[a] + j));
        u32 which = zeros(misses);
        *out = {i, j, which};
        out += which != 0;
        j += block;
      } while (sorted ? lanes.lo[0][j - 1] <= reach : j < end[i]);
      if constexpr (sorted) {
        for (u32 k = j - block; k < j; k += 4) counted -= load<f32x4>(lanes.lo[0] + k) <= splat(reach);
        tests += j - block - i - 1;
      }
      if (out < near + enough) continue;
      test(lanes, near, out, pairs);
      out = near;
    }
    test(lanes, near, out, pairs);
    for (int lane = 0; lane < 4; lane++) tests += u32(counted[lane]);
    return tests;
  }

  SMALL void release() {
    cells_.release();
    near_.release();
  }

 private:
  /// Computes the cells of `count` coordinates.
  NOINLINE static void round(const Axis& axis, const f32* from, u8* to, u32 count) {
    Axes axes(axis, axis, axis, axis);
    for (u32 k = 0; k < count; k += block) {
      u32x4 four[4];
      for (u32 n = 0; n < 4; n++) four[n] = axes(load<f32x4>(from + k + 4 * n));
      store(to + k, bytes(four[0], four[1], four[2], four[3]));
    }
  }

  /// Appends those that overlap.
  template <bool watch>
  NOINLINE static void test_as(const LaneView<D>& lanes, const Near* from, const Near* end, Pairs& pairs) {
    u64* out = pairs.room(pairs.list.data() + pairs.count, u64(end - from) * block);
    for (; from < end; from++) {
      Probe<D> probe(lanes, from->item);
      const u64* begin = out;
      i32x4 touching = {};
      u32 four;
      for (u32 which = from->which; which; which &= ~0xfu << four) {
        four = u32(__builtin_ctz(which)) & ~3u;
        u32x4 tags = load<u32x4>(lanes.tag + from->at + four);
        out = append(out, probe.slot, tags & splat(slot_mask),
                     bitmask(probe.template hits<watch>(lanes, from->at + four, tags, touching)));
      }
      if (watch && any(touching)) pairs.doubt(begin, out);
    }
    pairs.end_at(out);
  }
  static void test(const LaneView<D>& lanes, const Near* from, const Near* end, Pairs& pairs) {
    if (pairs.watch) test_as<true>(lanes, from, end, pairs);
    else test_as<false>(lanes, from, end, pairs);
  }
};
