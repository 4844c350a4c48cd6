// Runs the techniques of a space; knows which one ran last, and its cells as boxes.
#pragma once
#include "space/scene_builder.hpp"
#include "space/techniques.hpp"

template <int D> class Finder {
  static constexpr u32 width = 2 * D;

  Techniques<D> techniques_;
  Technique ran_ = {};

 public:
  Buffer<f32> cells;  // the result of structure()
  u32 cell_count = 0;

  Technique ran() const { return ran_; }
  Traits traits(Technique name) { return techniques_.traits(name); }

  /// Lets a technique find the pairs of slots.
  NOINLINE void run(Technique chosen, const Scene<D>& scene, const Options& options, Pairs& pairs, Stats& stats) {
    if (chosen != ran_) {
      release();
      pairs.stable = 0;
    }
    ran_ = chosen;
    pairs.same = pairs.checked = false;
    pairs.kept = 0;
    techniques_.with(ran_, [&](auto& technique) { technique.update(scene, options, pairs, stats); });
  }

  /// Writes the boxes of the cells of the last update to `cells`. Unbounded sides are clipped to the bounds of all
  /// finite boxes.
  SMALL void structure(const Store<D>& store, Stats& stats) {
    techniques_.with(ran_, [&](auto& used) { used.structure(cells, cell_count, stats); });
    const f32* boxes = store.numbers.boxes();
    const GapMap<D>& map = store.numbers.map();
    f32 least[D], most[D];
    for (int a = 0; a < D; a++) {
      least[a] = __builtin_inff();
      most[a] = -__builtin_inff();
      for (u32 s = 0; s < store.ids.count(); s++) {
        f32 lo = boxes[u64(s) * width + a], hi = boxes[u64(s) * width + D + a];
        if (is_finite(lo)) least[a] = smaller(least[a], lo);
        if (is_finite(hi)) most[a] = larger(most[a], hi);
      }
    }
    for (u64 c = 0; c < cell_count; c++) {
      for (int a = 0; a < D; a++) {
        f32& lo = cells[c * width + a];
        f32& hi = cells[c * width + D + a];
        if (!is_finite(lo)) lo = smaller(least[a], hi);
        if (!is_finite(hi)) hi = larger(most[a], lo);
        lo = f32(map.unmap(lo, u32(a)));
        hi = f32(map.unmap(hi, u32(a)));
      }
    }
  }

  /// Releases the memory of the techniques: on a switch to another, and after memory ran out in one.
  SMALL void release() {
    techniques_.with(ran_, [](auto& used) { used.release(); });
    cells.release();
    cell_count = 0;
  }
};
