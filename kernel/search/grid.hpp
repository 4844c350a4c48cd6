// A grid of uniform cells: which size they have, and which of them a box overlaps.
// Boxes outside are put into the border cells. If no cell size is given, it follows from the mean size and the crowding
// of the boxes.
#pragma once
#include "boxes/cell_map.hpp"
#include "boxes/scene_sample.hpp"
#include "search/options.hpp"

template <int D> struct Grid {
  static constexpr f64 boxes_per_cell = 3;  // aimed at; measured to be nearly flat from 2 to 5
  // If boxes would have more entries than this, the cell size is doubled until they do not: 64 per box plus a constant
  // for few boxes, 16 per box for very many.
  static constexpr u64 entries_each = 64, entries_more = 1 << 16, few_entries = 1 << 22, entries_of_many = 16;
  static u64 most_entries(u64 count) {
    return larger(entries_of_many * count, smaller(entries_each * count + entries_more, few_entries));
  }

  Axis axis[D];
  u32 cells[D] = {};
  f64 low[D] = {}, size[D] = {};

  u32 total() const {
    u32 total = 1;
    for (int a = 0; a < D; a++) total *= cells[a];
    return total;
  }

  /// Sets up a grid of at most `most_cells` cells; returns the number of entries the boxes will have in it.
  NOINLINE u64 choose(const SceneItems<D>& items, u32 count, const Options& options, u32 most_cells) {
    SceneSample<D> world = measure<D>(items, count);
    f64 extent[D], chosen[D];
    bool bounded = false;
    for (int a = 0; a < D; a++) bounded |= options.bounds[a] < options.bounds[D + a];
    f64 share = world.crowding * count;  // boxes in a cell as large as the mean box
    for (int a = 0; a < D; a++) {
      low[a] = bounded ? options.bounds[a] : world.low[a];
      extent[a] = bounded ? options.bounds[D + a] - low[a] : world.high[a] - low[a];
      f64 spread = world.high[a] - world.low[a];
      chosen[a] = larger(world.size[a], spread * 1e-3 / count);
      if (spread > 0) share *= chosen[a] / spread;
    }
    f64 factor = share > 0 ? boxes_per_cell / share : 1;
    factor = larger(1.0, D == 2 ? __builtin_sqrt(factor) : cube_root(factor));
    for (int a = 0; a < D; a++) {
      bool given = options.cell_size[a] > 0;
      size[a] = given ? options.cell_size[a] : chosen[a] * factor;
      f64 wanted = size[a] > 0 ? extent[a] / size[a] : 1;
      cells[a] = u32(larger(1.0, smaller(f64(most_cells), __builtin_ceil(wanted))));
      if (!given) size[a] = extent[a] / cells[a];
    }
    for (;;) {
      f64 product = 1;
      for (int a = 0; a < D; a++) {
        // Axis rounds to the nearest cell, so cell 0 is centred half a cell inside the border.
        f64 first = low[a] + size[a] / 2;
        axis[a] = Axis::make(first, first + (cells[a] - 1) * size[a], cells[a]);
        product *= cells[a];
      }
      if (product <= most_cells) {
        Axes lanes = axes();
        u64 limit = most_entries(count), entries = 0;
        for (u32 k = 0; k < count && entries <= limit; k++) {
          Range covered = range(lanes, items[k]);
          u64 some = 1;
          for (int a = 0; a < D; a++) some *= covered.last[a] - covered.first[a] + 1;
          entries += some;
        }
        if (entries <= limit || product == 1) return entries;
      }
      for (int a = 0; a < D; a++) {
        if (cells[a] == 1) continue;
        cells[a] = (cells[a] + 1) / 2;
        size[a] *= 2;
      }
    }
  }

  /// The cells that an item overlaps, from first to last along each axis.
  struct Range {
    u32x4 first, last;
  };

  Axes axes() const { return {axis[0], axis[1], axis[D == 2 ? 0 : 2], axis[1]}; }

  static Range range(const Axes& axes, const Item<D>& item) {
    if constexpr (D == 2) {
      u32x4 cells = axes(item.box);
      return {cells, __builtin_shufflevector(cells, cells, 2, 3, 2, 3)};
    } else {
      return {axes(item.first()), axes(item.high)};
    }
  }

  /// Calls `at(cell, continues)` for every cell of a range.
  template <class At> void visit(const Range& range, At at) const {
    u32 from = range.first[0], until = range.last[0];
    for (u32 x = from; x <= until; x++) {
      u32 marks_x = x > from ? u32(continues_1) : 0;
      for (u32 y = range.first[1]; y <= range.last[1]; y++) {
        u32 cell = x * cells[1] + y;
        u32 marks = marks_x | (y > range.first[1] ? u32(continues_2) : 0);
        if constexpr (D == 2) {
          at(cell, marks);
        } else {
          for (u32 z = range.first[2]; z <= range.last[2]; z++) {
            at(cell * cells[2] + z, marks | (z > range.first[2] ? u32(continues_3) : 0));
          }
        }
      }
    }
  }

  /// Writes the box of a cell.
  SMALL void draw(u32 cell, f32* box) const {
    for (int a = D - 1; a >= 0; a--) {
      f64 from = low[a] + cell % cells[a] * size[a];
      cell /= cells[a];
      box[a] = f32(from);
      box[D + a] = f32(from + size[a]);
    }
  }
};
