// Space cut in halves again and again, so that all cells hold about as many boxes.
// Idea: each cut is at the median of the lower corners of a sample, along the axis on which cells are longest, measured
// in boxes. All cells are as deep as one another, so the tree is two arrays, as in a heap: node k has the children 2 k and
// 2 k + 1.
// Cost: cutting, O(samples * levels); finding the cells of a box, O(levels) for each.
// From: k-d tree, J. Bentley, 1975.
#pragma once
#include "statistics.hpp"

template <int D> class Halves {
  Buffer<f32> cuts_;   // inner nodes
  u8 axis_[32] = {};   // per level, along which axis it cuts
  u32 leaves_ = 0;
  Buffer<f32> sample_;

 public:
  /// Cuts space into 2 to the power of `levels` cells, and calls `each` with the number of each and its bounds: the least
  /// corner in it, and the least beyond it, or NaN where there is none.
  template <class Each> COLD void cut(const Scene<D>& scene, u32 levels, u32 samples, Each each) {
    u32 n = scene.count;
    Statistics<D> world = measure<D>(SceneItems<D>{scene, AxisOrder<D>::make(0)}, n);
    f64 length[D];
    for (int a = 0; a < D; a++) {
      f64 extent = world.high[a] - world.low[a];
      length[a] = extent > 0 ? extent / larger(world.size[a], extent * 1e-7) : 0;
    }
    for (u32 l = 0; l < levels; l++) {
      int longest = 0;
      for (int a = 1; a < D; a++) {
        if (length[a] > length[longest]) longest = a;
      }
      axis_[l] = u8(longest);
      length[longest] /= 2;
    }
    samples = smaller(n, samples);
    f32* sample = sample_.reserve(u64(samples) * D);
    detail::Sampling sampling(n, samples);
    for (u32 k = 0; k < samples; k++) __builtin_memcpy(sample + k * D, scene.box(sampling.next()), D * sizeof(f32));
    leaves_ = 1u << levels;
    cuts_.reserve(leaves_);
    f32 low[4], high[4];
    for (int a = 0; a < 4; a++) {
      low[a] = -__builtin_inff();
      high[a] = __builtin_nanf("");
    }
    halve(sample, samples, 1, 0, low, high, each);
  }

  /// Writes the cells that a box touches, up to one more than `most`; gives how many.
  NOINLINE u32 touched(const f32* box, u32* out, u32 most) const {
    u32 open[33], depth = 0, found = 0;
    open[depth++] = 1;
    while (depth > 0) {
      u32 node = open[--depth];
      while (node < leaves_) {
        int a = axis_[31 - u32(__builtin_clz(node))];
        f32 at = cuts_[node];
        u32 starts = beyond(box[a], at), reaches = beyond(box[D + a], at);
        open[depth] = 2 * node + 1;
        depth += reaches & ~starts;
        node = 2 * node + starts;
      }
      out[found++] = node - leaves_;
      if (found > most) break;
    }
    return found;
  }

  /// The cell that a box's lower corner is in.
  u32 home(const f32* box) const {
    u32 node = 1;
    for (int level = 0; node < leaves_; level++) node = 2 * node + beyond(box[axis_[level]], cuts_[node]);
    return node - leaves_;
  }

  COLD void release() {
    cuts_.release();
    sample_.release();
    leaves_ = 0;
  }

 private:
  /// Without a branch on which side it is: nobody could guess that.
  static u32 beyond(f32 x, f32 at) { return u32(bits<i32x4>(splat(x) >= splat(at))[0]) & 1; }

  template <class Each>
  COLD void halve(f32* sample, u32 count, u32 node, u32 level, const f32* low, const f32* high, Each each) {
    if (node >= leaves_) return each(node - leaves_, low, high);
    int a = axis_[level];
    u32 half = count / 2;
    f32 at = count > 0 ? detail::select<D>(sample, i32(count), i32(half), a) : low[a];
    cuts_[node] = at;
    f32 border[4];
    __builtin_memcpy(border, high, sizeof(border));
    border[a] = at;
    halve(sample, half, 2 * node, level + 1, low, border, each);
    __builtin_memcpy(border, low, sizeof(border));
    border[a] = at;
    halve(sample + u64(half) * D, count - half, 2 * node + 1, level + 1, border, high, each);
  }
};
