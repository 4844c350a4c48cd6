// Space cut in halves: which cells a box touches, and which one it begins in.
#include "halves.hpp"

#include <algorithm>
#include <cmath>

#include "check.hpp"
#include "random.hpp"

namespace {

struct Bounds {
  f32 low[4], high[4];
};

template <int D> void check_cells() {
  constexpr u32 width = 2 * D, count = 600, levels = 5, cells = 1 << levels;
  Random random(5);
  std::vector<f32> boxes(count * width + 4);
  for (u32 k = 0; k < count; k++) {
    for (u32 a = 0; a < D; a++) {
      f32& low = boxes[k * width + a];
      low = f32(std::floor(100 * random.fraction()));  // many begin at a cut
      boxes[k * width + D + a] = low + f32(std::floor(20 * random.fraction()));
      if (k % 50 == a) low = -INFINITY;
      if (k % 70 == a) boxes[k * width + D + a] = INFINITY;
    }
  }
  Scene<D> scene{boxes.data(), count, nullptr};
  std::vector<Bounds> bounds(cells);
  Halves<D> halves;
  halves.cut(scene, levels, count, [&](u32 k, const f32* low, const f32* high) {
    std::copy(low, low + 4, bounds[k].low);
    std::copy(high, high + 4, bounds[k].high);
  });
  u32 most = 0;
  for (u32 k = 0; k < count; k++) {
    const f32* box = scene.box(k);
    u32 found[cells + 1], many = halves.touched(box, found, cells), home = halves.home(box);
    std::sort(found, found + many);
    most = larger(most, many);
    for (u32 c = 0, at = 0; c < cells; c++) {
      bool touches = true, begins = true;
      for (u32 a = 0; a < D; a++) {
        f32 low = bounds[c].low[a], high = bounds[c].high[a];  // NaN: no end
        touches &= box[D + a] >= low && !(box[a] >= high);
        begins &= box[a] >= low && !(box[a] >= high);
      }
      CHECK(touches == (at < many && found[at] == c));
      CHECK(begins == (c == home));
      at += touches;
    }
  }
  CHECK(most > 4);
  halves.release();
}

}  // namespace

TEST("halves: a box touches the cells that it reaches into, and its home is that of its lower corner") {
  check_cells<2>();
  check_cells<3>();
}
