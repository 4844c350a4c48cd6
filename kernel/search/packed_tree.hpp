// A packed tree of boxes: nodes of four, level by level in one array, and its join with itself.
//
// Idea: items are ordered along the Hilbert curve, which keeps neighbours together; each four in that order have
// a parent, each four parents one of their own, up to a last four. Nodes store no references: the children of the k-th
// node of a level are items 4k … 4k + 3 of the level below. All levels are lanes, so that one node is tested against
// four with the same few instructions as an item.
// The join meets every two items once: as siblings in one node, or below two sibling nodes that overlap. Lists of
// overlapping pairs go down the levels in chunks that fit the cache: first the children of one node, then those of the
// other. A node's tag has the exclusion bits that all its items share, so subtrees without pairs are skipped.
// Cost: about 25 ns an item to build, 30 (2D) or 40 (3D) bytes.
// From: I. Kamel and C. Faloutsos, "On Packing R-trees", CIKM 1993.
#pragma once
#include "search/hilbert.hpp"
#include "search/stats.hpp"
#include "search/sweep.hpp"

namespace detail {

// If one of the two is empty (NaN), the result is the other.
struct Least {
  f32x4 operator()(f32x4 x, f32x4 y) const { return choose(x, min(y, x), y); }
  static f32x4 choose(f32x4 x, f32x4 both, f32x4 y) {
    i32x4 some = x == x;
    return bits<f32x4>((bits<i32x4>(both) & some) | (bits<i32x4>(y) & ~some));
  }
};
struct Most {
  f32x4 operator()(f32x4 x, f32x4 y) const { return Least::choose(x, max(y, x), y); }
};
struct Common {
  f32x4 operator()(f32x4 x, f32x4 y) const { return bits<f32x4>(bits<u32x4>(x) & bits<u32x4>(y)); }
};

/// Computes one number of each node of a level from those of its four children. After the last node come empty ones.
template <class Unite> NOINLINE void unite(const f32* from, u32 size, f32* to, u32 room, Unite both) {
  u32 k = 0;
  for (; 4 * k < size; k += 4) {
    f32x4 row[4];
    for (u32 r = 0; r < 4; r++) row[r] = load<f32x4>(from + 4 * k + 4 * r);
    transpose(row);
    store(to + k, both(both(row[0], row[1]), both(row[2], row[3])));
  }
  for (; k < room; k += 4) store(to + k, splat(__builtin_nanf("")));
}

}  // namespace detail

template <int D> class PackedTree {
  static constexpr u32 most_depth = 13;
  static constexpr u32 chunk = 128;                             // pairs that go down a level together, per chunk
  static constexpr u32 list_size = 4 * chunk + 2 * Pairs::slack;

  HilbertOrder<D> order_;
  Lanes<D> lanes_;
  Buffer<u64> lists_;             // two per level: pairs of its nodes, and of its nodes with those below
  u32 first_[most_depth] = {};   // per level, its first lane
  u32 sizes_[most_depth] = {};   // and how many
  u32 levels_ = 0;

 public:
  /// Orders the boxes of a scene that is not empty, and builds all levels over them. After the last box, `spare` places
  /// are left for others.
  NOINLINE void build(const Scene<D>& scene, u32 spare) {
    u32 n = scene.count;
    u32 total = 0;
    levels_ = 0;
    for (u32 size = n + spare;; size = (size + 3) / 4) {
      first_[levels_] = total;
      sizes_[levels_++] = size;
      total += padded(size);
      if (size <= 4) break;
    }
    lanes_.reserve(total);
    lists_.reserve(2 * levels_ * list_size);
    order_.make(scene, false, lanes_);
    for (u32 k = n; k < padded(n + spare); k++) clear(k);
    refit();
  }

  /// The slot of the k-th item, as of the last `build`.
  u32 slot(u32 k) const { return order_.slot(k); }
  SMALL u32 nodes() const {
    u32 sum = 0;
    for (u32 l = 1; l < levels_; l++) sum += sizes_[l];
    return sum;
  }

  /// Puts an item into a place, or empties it. Call `refit` afterwards.
  NOINLINE void put(u32 place, const f32* box, u32 tag) {
    for (int a = 0; a < D; a++) {
      lanes_.lo(a)[place] = box[a];
      lanes_.hi(a)[place] = box[D + a];
    }
    lanes_.tag()[place] = tag;
  }
  SMALL void clear(u32 place) {
    f32 nothing[2 * D];
    for (f32& x : nothing) x = __builtin_nanf("");
    put(place, nothing, 0xffffffff);
  }
  /// Gives all items an exclusion bit.
  void mark(u32 bit) {
    for (u32 k = 0; k < sizes_[0]; k++) lanes_.tag()[k] |= bit;
  }

  /// Bounds and tags of all nodes, from the items up.
  NOINLINE void refit() {
    for (u32 l = 1; l < levels_; l++) {
      u32 from = first_[l - 1], to = first_[l], size = padded(sizes_[l - 1]), room = padded(sizes_[l]);
      for (int a = 0; a < D; a++) {
        detail::unite(lanes_.lo(a) + from, size, lanes_.lo(a) + to, room, detail::Least{});
        detail::unite(lanes_.hi(a) + from, size, lanes_.hi(a) + to, room, detail::Most{});
      }
      f32* tags = reinterpret_cast<f32*>(lanes_.tag());
      detail::unite(tags + from, size, tags + to, room, detail::Common{});
    }
  }

  /// Finds all pairs of items that overlap and share no exclusion bit.
  NOINLINE void join(Pairs& pairs, Stats& stats) {
    for (u32 l = levels_; l-- > 0;) siblings(l, pairs, stats);
  }

  /// The nodes.
  SMALL void structure(Buffer<f32>& boxes, u32& count) const {
    count = 0;
    for (u32 l = 1; l < levels_; l++) {
      boxes.grow(u64(count + sizes_[l]) * 2 * D, u64(count) * 2 * D);
      for (u32 k = 0; k < sizes_[l]; k++) {
        if (!(lanes_.lo(0)[first_[l] + k] <= lanes_.hi(0)[first_[l] + k])) continue;  // of spare places alone
        for (int a = 0; a < D; a++) {
          boxes[u64(count) * 2 * D + a] = lanes_.lo(a)[first_[l] + k];
          boxes[u64(count) * 2 * D + D + a] = lanes_.hi(a)[first_[l] + k];
        }
        count++;
      }
    }
  }

  SMALL void release() {
    order_.release();
    lanes_.release();
    lists_.release();
    levels_ = 0;
  }

 private:
  static u32 padded(u32 size) { return (size + 15) & ~15u; }

  u64* list(u32 which) const { return lists_.data() + which * list_size; }

  /// The contents of a pair: slots if the lanes are items, else the lanes themselves. Uses masks so that the compiler
  /// does not split the loop in two.
  struct Names {
    u32x4 items;
    explicit Names(bool are_items) : items(splat(are_items ? slot_mask : 0)) {}
    u32x4 operator()(u32x4 tags, u32x4 lanes) const { return (tags & items) | (lanes & (items == u32x4{})); }
  };

  /// Tests the smaller node of each pair against the four children of the larger, a node of `level`. Appends the
  /// overlapping pairs: of slots if `last`, when all are items, else of lanes.
  NOINLINE u64* expand(const u64* from, u32 count, u32 level, bool last, u64* out, Stats& stats) const {
    const LaneView<D> lanes = lanes_.view();
    const Names names(last);
    u32 parents = first_[level], children = first_[level - 1];
    u32 partial = (sizes_[level - 1] - 1) & ~3u, missing = partial + 4 - sizes_[level - 1], misses = 0;
    for (u32 k = 0; k < count; k++) {
      u32 one = u32(from[k]), four = 4 * (u32(from[k] >> 32) - parents);
      misses += four == partial ? missing : 0;
      four += children;
      Probe<D> probe(lanes, one);
      u32x4 tags = load<u32x4>(lanes.tag + four);
      u32 hits = bitmask(probe.hits(lanes, four, tags));
      out = append(out, names(probe.slot, splat(one)), names(tags, splat(four) + u32x4{0, 1, 2, 3}), hits);
    }
    if (last) stats.tests += 4 * count - misses;
    return out;
  }

  /// Follows pairs of nodes of a level, which is not that of the items, down to the items.
  NOINLINE void descend(u32 level, u32 count, Pairs& pairs, Stats& stats) const {
    const u64* nodes = list(2 * level);
    u64* halves = list(2 * level + 1);
    for (u32 k = 0; k < count; k += chunk) {
      u32 half = u32(expand(nodes + k, smaller(chunk, count - k), level, false, halves, stats) - halves);
      for (u32 h = 0; h < half; h += chunk) {
        u32 n = smaller(chunk, half - h);
        if (level > 1) {
          u64* below = list(2 * level - 2);
          descend(level - 1, u32(expand(halves + h, n, level, false, below, stats) - below), pairs, stats);
        } else {
          u64* out = pairs.room(pairs.list.data() + pairs.count, 4 * n);
          pairs.end_at(expand(halves + h, n, level, true, out, stats));
        }
      }
    }
  }

  /// The pairs of siblings on one level, and below them.
  void siblings(u32 level, Pairs& pairs, Stats& stats) const {
    const LaneView<D> lanes = lanes_.view();
    const Names names(level == 0);
    u32 first = first_[level], end = first + sizes_[level];
    const u32* parents = level + 1 < levels_ ? lanes.tag + first_[level + 1] : nullptr;
    u64* out = list(2 * level);
    u64* limit = out + chunk;
    u32 tests = 0;
    for (u32 j = first; j < end; j += 4) {
      if (parents && (*parents++ & ~slot_mask)) continue;  // all four share a bit
      if (out > limit) out = pass_on(level, out, pairs, stats);
      u32x4 tags = load<u32x4>(lanes.tag + j);
      u32x4 four = splat(j) + u32x4{0, 1, 2, 3};
      u32 among = smaller(end - j, 4u);
      tests += among * (among - 1) / 2;
      ROLLED for (u32 i = 0; i < 3; i++) {
        Probe<D> probe(lanes, j + i);
        u32 hits = bitmask(probe.hits(lanes, j, tags)) & 0xe << i & 0xf;
        out = append(out, names(probe.slot, splat(j + i)), names(tags, four), hits);
      }
    }
    pass_on(level, out, pairs, stats);
    if (level == 0) stats.tests += tests;
  }

  /// Empties the list of siblings up to `end`.
  NOINLINE u64* pass_on(u32 level, const u64* end, Pairs& pairs, Stats& stats) const {
    u64* from = list(2 * level);
    u32 count = u32(end - from);
    if (level) {
      descend(level, count, pairs, stats);
    } else {
      u64* to = pairs.room(pairs.list.data() + pairs.count, count);
      __builtin_memcpy(to, from, count * sizeof(u64));
      pairs.count += count;
    }
    return from;
  }
};
