// BSP tree: the world cut in two again and again along its axes (a k-d tree), rebuilt each update.
//
// Idea: each cut is at the median of a sample, across the axis along which the boxes are spread furthest, measured in
// boxes. A box that a cut crosses goes to both sides and is marked as continuing on the right one; two boxes with a
// common mark have met further left, so every pair is found once, in the leaf that contains the larger of the two
// minimum corners. Two stacks of items are the only storage: a cut pushes its left side onto the other stack and closes
// the gaps of the right one in place, without a branch. Cuts continue while they save more tests in the sweep of the
// leaves than their copies cost.
// Cost: build O(n log(n / leaf)), about 3 ns an item and level; pairs O(n + candidates); about 100 (2D) or 160 (3D)
// bytes a box. Nothing is updated.
// Wins on clusters within clusters, where no one grid or strip width is right. Otherwise loses to strip sweep: it
// passes over the items once per level, strip sweep twice in all.
// From: J. L. Bentley, "Multidimensional Binary Search Trees Used for Associative Searching", 1975; cuts and
// leaves as in Serpa & Rodrigues, "Broadmark: A Testing Framework for Broad-Phase Collision Detection", 2019.
#pragma once
#include "search/options.hpp"
#include "search/stats.hpp"
#include "search/sweep_list.hpp"

template <int D> class BspTree {
  // Costs relative to a tested candidate: a copy of an item, and one more pass over it.
  static constexpr f32 copy_cost = D == 2 ? 32 : 80, pass_cost = 12;
  static constexpr u32 fewest = 32;  // items of a node that is cut
  // Limits the copies in a crowd: all cuts below a node together may make this many for each of its items.
  static constexpr f32 copies_each = 3;
  static constexpr u32 deepest_cut = 40;
  static constexpr u32 samples = 15;

  struct Region {
    f32 low[D], high[D];
  };

  Items<D> stacks_[2];
  SweepList<D> swept_;
  Buffer<Region> leaves_;
  Stats* stats_ = nullptr;

 public:
  void update(const Scene<D>& scene, const Options&, Pairs& pairs, Stats& stats) {
    stats_ = &stats;
    if (scene.count < 2) return;
    stacks_[0].grow(scene.count, 0);
    SceneItems<D> items{scene, AxisOrder<D>::make(0)};
    ItemsAt<D> root(stacks_[0], 0);
    for (u32 k = 0; k < scene.count; k++) root.put(k, items[k]);
    Region everywhere;
    for (int a = 0; a < D; a++) {
      everywhere.low[a] = -__builtin_inff();
      everywhere.high[a] = __builtin_inff();
    }
    node(0, 0, 0, scene.count, copies_each * f32(scene.count), everywhere, 0, pairs);
  }

  /// The leaves of the last update; unbounded sides are infinite.
  SMALL void structure(Buffer<f32>& boxes, u32& count, const Stats& stats) const {
    count = u32(stats.cells);
    boxes.reserve(u64(count) * 2 * D);
    if (count) __builtin_memcpy(boxes.data(), leaves_.data(), count * sizeof(Region));
  }

  SMALL void release() {
    for (auto& stack : stacks_) stack.release();
    swept_.release();
    leaves_.release();
  }

 private:
  struct Cut {
    int axis;  // -1: none
    f32 at;
  };

  /// Cuts the top `count` items of a stack, which begin at `first`. On the other stack, `free` is the first free place.
  void node(u32 stack, u32 first, u32 free, u32 count, f32 spare, const Region& region, u32 depth, Pairs& pairs) {
    ItemsAt<D> items(stacks_[stack], first);
    Cut cut = depth < deepest_cut && count > fewest ? choose(items, count, spare) : Cut{-1, 0};
    u32 left = 0, right = 0;
    if (cut.axis >= 0) {
      stacks_[1 - stack].grow(u64(free) + count, free);
      ItemsAt<D> other(stacks_[1 - stack], free);
      const f32* lo = reinterpret_cast<const f32*>(items.boxes) + cut.axis;
      u32 mark = continues_1 >> cut.axis;
      for (u32 k = 0; k < count; k++) {
        bool starts_left = lo[k * 4 * (D - 1)] < cut.at;
        bool ends_right = lo[k * 4 * (D - 1) + 2 * (D - 1)] >= cut.at;
        Item<D> item = items[k];
        other.put(left, item);
        items.put(right, with_tag(item, starts_left ? mark : 0));
        left += starts_left;
        right += ends_right;
      }
    }
    if (left == 0) {
      leaf(items, count, region, pairs);
      return;
    }
    f32 share = (spare - f32(left + right - count)) / f32(left + right);
    // Items that extend in from outside may place the cut outside the region: one side of it is then empty.
    f32 border = larger(region.low[cut.axis], smaller(region.high[cut.axis], cut.at));
    Region part = region;
    part.high[cut.axis] = border;
    node(1 - stack, free, first + right, left, share * f32(left), part, depth + 1, pairs);
    part = region;
    part.low[cut.axis] = border;
    node(stack, first, free, right, share * f32(right), part, depth + 1, pairs);
  }

  void leaf(const ItemsAt<D>& items, u32 count, const Region& region, Pairs& pairs) {
    u64 at = u64(stats_->cells);
    leaves_.grow(at + 1, at);
    leaves_[at] = region;
    stats_->cells++;
    stats_->entries += count;
    stats_->tests += f64(swept_.order(items, count));
    swept_.find(count, pairs);
  }

  /// Chooses a cut by a sample of the items.
  SMALL static Cut choose(const ItemsAt<D>& items, u32 count, f32 spare) {
    static f32 starts[D][samples];
    static f32 sizes[D][samples];
    Sampling sampling(count, samples);
    for (u32 k = 0; k < samples; k++) {
      Item<D> item = items[sampling.next()];
      for (int a = 0; a < D; a++) {
        starts[a][k] = item.lo(a);
        sizes[a][k] = item.hi(a) - item.lo(a);
      }
    }
    f32 relative[D];  // mean size as a share of the spread
    int best = 0;
    for (int a = 0; a < D; a++) {
      f32 least = starts[a][0], most = least;
      for (u32 k = 1; k < samples; k++) {
        least = smaller(least, starts[a][k]);
        most = larger(most, starts[a][k]);
      }
      // Half the spread, since the whole could overflow. At least the smallest normal number, since it is a divisor.
      f32 half = larger(smaller(most / 2 - least / 2, 1e38f), 1e-37f);
      f32 sum = 0;
      for (u32 k = 0; k < samples; k++) sum += smaller(sizes[a][k] / half, 2.0f);
      relative[a] = most > least ? sum / (2 * samples) : 1;
      if (relative[a] < relative[best]) best = a;
    }
    f32 copies = relative[best] * f32(count);
    f32 saved = relative[0] * f32(count) / 2;
    if (copies > spare || saved < copy_cost * relative[best] + pass_cost) return {-1, 0};
    return {best, kth_smallest(starts[best], samples, samples / 2)};
  }
};
