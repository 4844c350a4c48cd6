// The one inner loop that every technique ends in.
// Idea: a technique puts items in an order and gives, for each, the end of the range after it that can still overlap it
// (`end`). Everything up to there is tested, four at a time, on all axes, both ways, so the order need not be sorted:
// four items in a row against the four that are one further, then two, and so on; or one item against four, if one of
// the four has a much longer range than the others. Reading past `end` is harmless as long as the items there cannot
// overlap. If boxes are rounded, bounds may be equal that were not: `watch`. Then the loop computes the depth of the
// overlap instead of a yes or no, at the same cost: above 0 on all sides is certain, 0 on some side is recorded as in
// doubt. Bounds are such that their difference is a number: see GapMap::round.
// Cost: one test of four against four for each candidate of that of four items with the most, about 2 (2D) or 3 (3D)
// ns, pairs included; no branch depends on the hits, and the loop ends once for four items.
#pragma once
#include "pairs/pairs.hpp"

/// Which of the items j … j + 3 overlap `one`, which is one item, or four for a lane-by-lane test.
template <int D, class One> i32x4 overlaps(const One& one, const LaneView<D>& lanes, u32 j) {
  i32x4 all = bits<i32x4>(splat(~0u));
  for (int axis = 0; axis < D; axis++) {
    all &= load<f32x4>(lanes.lo[axis] + j) <= one.hi[axis];
    all &= load<f32x4>(lanes.hi[axis] + j) >= one.lo[axis];
  }
  return all;
}

/// The same; also sets in `touching` the items with a bound equal to one of `one`.
template <int D, class One> i32x4 overlaps(const One& one, const LaneView<D>& lanes, u32 j, i32x4& touching) {
  f32x4 depth = min(one.hi[0] - load<f32x4>(lanes.lo[0] + j), load<f32x4>(lanes.hi[0] + j) - one.lo[0]);
  for (int axis = 1; axis < D; axis++) {
    f32x4 its = min(one.hi[axis] - load<f32x4>(lanes.lo[axis] + j), load<f32x4>(lanes.hi[axis] + j) - one.lo[axis]);
    depth = min(its, depth);
  }
  touching |= bits<i32x4>(depth == f32x4{});
  return bits<i32x4>(depth >= f32x4{});
}

/// One item, ready to be tested against four.
template <int D> struct Probe {
  f32x4 lo[D], hi[D];
  u32x4 slot, excluded;

  /// A box whose numbers are `apart` floats from each other in memory.
  Probe(const f32* box, u32 apart, u32 tag) : slot(splat(tag & slot_mask)), excluded(splat(tag & ~slot_mask)) {
    for (u32 axis = 0; axis < D; axis++) {
      lo[axis] = splat(box[axis * apart]);
      hi[axis] = splat(box[(D + axis) * apart]);
    }
  }
  Probe(const LaneView<D>& lanes, u32 i) {
    for (int axis = 0; axis < D; axis++) {
      lo[axis] = splat(lanes.lo[axis][i]);
      hi[axis] = splat(lanes.hi[axis][i]);
    }
    u32 tag = lanes.tag[i];
    slot = splat(tag & slot_mask);
    excluded = splat(tag & ~slot_mask);
  }

  /// Which of the items j … j + 3, with these tags, overlap this one and share no exclusion bit with it.
  i32x4 hits(const LaneView<D>& lanes, u32 j, u32x4 tags) const {
    return overlaps(*this, lanes, j) & bits<i32x4>((tags & excluded) == u32x4{});
  }
  /// The same; if `watch`, also sets those that touch in `touching`.
  template <bool watch> i32x4 hits(const LaneView<D>& lanes, u32 j, u32x4 tags, i32x4& touching) const {
    if constexpr (!watch) return hits(lanes, j, tags);
    else return overlaps(*this, lanes, j, touching) & bits<i32x4>((tags & excluded) == u32x4{});
  }
};

/// Four items in a row, ready to be tested against four others, each against one.
template <int D> struct Four {
  f32x4 lo[D], hi[D];
  u32x4 tags;

  Four(const LaneView<D>& lanes, u32 i) : tags(load<u32x4>(lanes.tag + i)) {
    for (int axis = 0; axis < D; axis++) {
      lo[axis] = load<f32x4>(lanes.lo[axis] + i);
      hi[axis] = load<f32x4>(lanes.hi[axis] + i);
    }
  }

  template <bool watch> i32x4 hits(const LaneView<D>& lanes, u32 j, u32x4 others, i32x4& touching) const {
    i32x4 meet = bits<i32x4>((tags & others & splat(~slot_mask)) == u32x4{});
    if constexpr (watch) return overlaps(*this, lanes, j, touching) & meet;
    else return overlaps(*this, lanes, j) & meet;
  }
};

/// Four items are tested together if none of them has more candidates than their average and this many.
inline constexpr u32 together = 6;

/// Tests each item i of the `count` items of `from` against the items i + 1 … end[i] - 1, and appends the pairs.
/// `exact_end`: items past `end` may overlap, so their lanes are masked out. `end` has four more entries.
template <int D, bool exact_end, bool watch>
NOINLINE void sweep_as(const Lanes<D>& from, const u32* end, u32 count, Pairs& pairs) {
  const LaneView<D> lanes = from.view();  // a local copy, which nothing aliases
  u64* out = pairs.list.data() + pairs.count;
  u64* limit = pairs.list.data() + pairs.list.capacity();
  for (u32 i = 0; i < count; i += 4) {
    u32x4 place = u32x4{0, 1, 2, 3} + splat(i);
    // The number of candidates of each of four items; 0 past the last item.
    i32x4 reach = bits<i32x4>(load<u32x4>(end + i) - place) & (bits<i32x4>(place) < bits<i32x4>(splat(count)));
    u32x4 pair = bits<u32x4>(reach);
    pair = max(pair, __builtin_shufflevector(pair, pair, 2, 3, 0, 1));
    u32 most = larger(pair[0], pair[1]), sum = u32(reach[0] + reach[1] + reach[2] + reach[3]);
    u64 hits_at_most = u64(sum) + 4 * together;
    if (Pairs::between(out, limit) < hits_at_most + Pairs::slack) {
      out = pairs.room(out, hits_at_most);
      limit = pairs.list.data() + pairs.list.capacity();
    }
    const u64* begin = out;
    i32x4 touching = {};
    if (most <= sum / 4 + together) {
      Four<D> four(lanes, i);
      for (u32 d = 1; d < most; d++) {
        u32x4 tags = load<u32x4>(lanes.tag + i + d);
        i32x4 hits = four.template hits<watch>(lanes, i + d, tags, touching);
        if constexpr (exact_end) hits &= bits<i32x4>(splat(d)) < reach;
        out = append_each(out, four.tags & splat(slot_mask), tags & splat(slot_mask), bitmask(hits));
      }
      if (watch && any(touching)) pairs.doubt(begin, out);
      continue;
    }
    for (u32 k = i; k < smaller(i + 4, count); k++) {
      u32 until = end[k];
      Probe<D> probe(lanes, k);
      for (u32 j = k + 1; j < until; j += 4) {
        u32x4 tags = load<u32x4>(lanes.tag + j);
        i32x4 hits = probe.template hits<watch>(lanes, j, tags, touching);
        if constexpr (exact_end) hits &= bits<i32x4>(u32x4{0, 1, 2, 3} + splat(j) < splat(until));
        out = append(out, probe.slot, tags & splat(slot_mask), bitmask(hits));
      }
    }
    if (watch && any(touching)) pairs.doubt(begin, out);
  }
  pairs.end_at(out);
}

template <int D, bool exact_end = false> void sweep(const Lanes<D>& from, const u32* end, u32 count, Pairs& pairs) {
  if (!exact_end && pairs.watch) sweep_as<D, exact_end, !exact_end>(from, end, count, pairs);
  else sweep_as<D, exact_end, false>(from, end, count, pairs);
}

/// A run of contiguous items, to be tested against one item outside it or before it.
struct Run {
  u32 item, from, until;
};

/// Appends a run, unless it is empty.
inline Run* add(Run* out, u32 item, u32 from, u32 until) {
  *out = {item, from, until};
  return out + (from < until);
}

/// Tests the items of a run against its one and appends the pairs, for which there must be room; returns the end.
template <int D> u64* sweep_run(const LaneView<D>& lanes, const Run& run, u64* out) {
  Probe<D> probe(lanes, run.item);
  for (u32 j = run.from; j < run.until; j += 4) {
    u32x4 tags = load<u32x4>(lanes.tag + j);
    i32x4 hits = probe.hits(lanes, j, tags) & bits<i32x4>(u32x4{0, 1, 2, 3} + splat(j) < splat(run.until));
    out = append(out, probe.slot, tags & splat(slot_mask), bitmask(hits));
  }
  return out;
}

/// Tests all items of each run against its one and appends the pairs. Returns the number of tests.
template <int D> NOINLINE f64 sweep_runs(const Lanes<D>& from, const Run* runs, const Run* end, Pairs& pairs) {
  const LaneView<D> lanes = from.view();
  u64* out = pairs.list.data() + pairs.count;
  u64* limit = pairs.list.data() + pairs.list.capacity();
  u64 tests = 0;
  for (; runs < end; runs++) {
    Run run = *runs;
    u32 length = run.until - run.from;
    tests += length;
    if (Pairs::between(out, limit) < length + Pairs::slack) {
      out = pairs.room(out, length);
      limit = pairs.list.data() + pairs.list.capacity();
    }
    out = sweep_run(lanes, run, out);
  }
  pairs.end_at(out);
  return f64(tests);
}
