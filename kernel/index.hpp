// What the last update saw, packed so that it can be asked where things are.
// Idea: boxes in Morton order of their centres, eight to a block, and blocks of eight blocks above them, to one root:
// an R-tree without pointers. A block is read as vectors, eight boxes at a time. The order is laid over the extents
// without outliers, so that one far box does not spoil it.
// Cost: about 15 ns a box to build, at the first question after an update; 24 (2D) or 34 (3D) bytes a box, and as
// much as the boxes themselves for the copy that keeps answers to what the update saw.
// From: packed R-trees, Kamel & Faloutsos 1993; Morton 1966.
#pragma once
#include "filters.hpp"
#include "radix_sort.hpp"
#include "statistics.hpp"

template <int D> class Index {
  static constexpr u32 width = 2 * D;
  static constexpr u32 most_levels = 8;  // 8^8 boxes
  static constexpr u32 order_bits = D == 2 ? 16 : 10;  // of the Morton order, per axis

  // As the update saw them, by slot.
  Buffer<f32> boxes_;
  Buffer<f64> exact_;
  Buffer<u32> ids_;
  Buffer<Rule> rules_;
  u32 count_ = 0;
  bool rounded_ = false, named_ = false, filtered_ = false;

  bool built_ = false;
  Buffer<u32> slots_;  // per place in the order
  RadixSort sort_;

 public:
  /// Eight boxes; NaN where there is none.
  struct Block {
    f32 lo[D][8], hi[D][8];
  };

 private:
  Buffer<Block> blocks_;  // the boxes, then the blocks of each level above
  u32 first_[most_levels] = {};  // of each level
  u32 levels_ = 0;

 public:
  u32 count() const { return count_; }
  /// The level of the root, which is one block; level 0 are the boxes.
  u32 top() const { return levels_ - 1; }
  const Block& block(u32 level, u32 number) const { return blocks_[first_[level] + number]; }

  /// Whether float32 does not hold all boxes.
  bool rounded() const { return rounded_; }
  u32 id(u32 place) const { return named_ ? ids_[slots_[place]] : slots_[place]; }
  u32 layer(u32 place) const { return filtered_ ? rules_[slots_[place]].layer : 0xffffffff; }
  /// The numbers the box was given with.
  void box(u32 place, f64* to) const {
    u64 at = u64(slots_[place]) * width;
    for (u32 k = 0; k < width; k++) to[k] = rounded_ ? exact_[at + k] : f64(boxes_[at + k]);
  }

  /// Copies the boxes of a space.
  COLD void see(const f32* boxes, const f64* exact, const Ids& ids, const Rule* rules) {
    u32 n = ids.count();
    count_ = 0;
    built_ = false;
    copy(boxes_, boxes, u64(n) * width, 4);
    rounded_ = exact;
    if (exact) copy(exact_, exact, u64(n) * width, 0);
    filtered_ = rules;
    if (rules) copy(rules_, rules, n, 0);
    named_ = !ids.same();
    if (named_) {
      ids_.reserve(n);
      for (u32 s = 0; s < n; s++) ids_[s] = ids.id(s);
    }
    count_ = n;
  }

  /// Makes the index, if it is not.
  COLD void build() {
    if (built_) return;
    put_in_order();
    u32 total = 0;
    levels_ = 0;
    for (u32 n = count_;; n = (n + 7) / 8) {
      first_[levels_++] = total;
      total += (n + 7) / 8;
      if (n <= 8) break;
    }
    blocks_.reserve(total);
    __builtin_memset(blocks_.data(), 0xff, u64(total) * sizeof(Block));  // NaN
    for (u32 k = 0; k < count_; k++) {
      Block& to = blocks_[k / 8];
      const f32* box = boxes_.data() + u64(slots_[k]) * width;
      for (int a = 0; a < D; a++) {
        to.lo[a][k % 8] = box[a];
        to.hi[a][k % 8] = box[D + a];
      }
    }
    for (u32 level = 1; level < levels_; level++) {
      u32 below = first_[level] - first_[level - 1];
      for (u32 k = 0; k < below; k++) {
        const Block& from = block(level - 1, k);
        Block& to = blocks_[first_[level] + k / 8];
        for (int a = 0; a < D; a++) {
          f32 lo = from.lo[a][0], hi = from.hi[a][0];
          for (u32 lane = 1; lane < 8; lane++) {  // comparisons with NaN are false
            lo = smaller(lo, from.lo[a][lane]);
            hi = larger(hi, from.hi[a][lane]);
          }
          to.lo[a][k % 8] = lo;
          to.hi[a][k % 8] = hi;
        }
      }
    }
    built_ = true;
  }

  COLD void release() {
    boxes_.release();
    exact_.release();
    ids_.release();
    rules_.release();
    slots_.release();
    sort_.release();
    blocks_.release();
    count_ = 0;
    built_ = false;
  }

 private:
  template <class T> static void copy(Buffer<T>& to, const T* from, u64 n, u64 padding) {
    to.reserve(n + padding);
    if (n) __builtin_memcpy(to.data(), from, n * sizeof(T));
  }

  /// Fills slots_.
  COLD void put_in_order() {
    u32 n = count_;
    u32* slots = slots_.reserve(larger(n, 1u));
    if (n == 0) return;
    SceneItems<D> items{{boxes_.data(), n, nullptr}, AxisOrder<D>::make(0)};
    Statistics<D> world = measure<D>(items, n);
    Axis axis[D];
    for (int a = 0; a < D; a++) {
      // Centres, twice: lo + hi needs no halving.
      f64 low = 2 * world.low[a], high = 2 * world.high[a] + world.size[a];
      axis[a] = Axis::make(low, high, 1u << order_bits);
    }
    sort_.begin(n);
    for (u32 s = 0; s < n; s++) {
      const f32* box = boxes_.data() + u64(s) * width;
      u32 key = 0;
      for (int a = 0; a < D; a++) key |= spread(axis[a](box[a] + box[D + a])) << a;
      sort_.put_bits(s, key);
    }
    sort_.sort(n);
    ROLLED
    for (u32 k = 0; k < n; k++) slots[k] = sort_.index(k);
  }

  /// The bits of a cell index, D - 1 zeros between each two.
  static u32 spread(u32 x) {
    if constexpr (D == 2) {
      x = (x | x << 8) & 0x00ff00ff;
      x = (x | x << 4) & 0x0f0f0f0f;
      x = (x | x << 2) & 0x33333333;
      return (x | x << 1) & 0x55555555;
    } else {
      x = (x | x << 16) & 0x030000ff;
      x = (x | x << 8) & 0x0300f00f;
      x = (x | x << 4) & 0x030c30c3;
      return (x | x << 2) & 0x09249249;
    }
  }
};
