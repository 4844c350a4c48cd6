// Endless cells in a finite table: each box stands in the cell of its minimum corner.
// Idea: cells are counted modulo a power of two along each axis, so the world has no border. Different cells may share
// an entry of the table; testing their boxes tells them apart. A box that is smaller than a cell overlaps only boxes
// that start in its cell or in one beside it. Cells of a row are contiguous: neighbours along it are one run.
#pragma once
#include "boxes/scene_sample.hpp"
#include "search/sweep.hpp"

template <int D> struct CellTable {
  /// The cells of a box: the first one, and how many more it extends over along each axis.
  struct Place {
    u32x4 at, reach;
  };

  u32x4 mask;    // per lane of an item's vectors: the number of cells, a power of two but not 2, less 1
  f32x4 scale;   // cells per unit; 0: one cell for all
  u32 first;     // cell
  u32 shift[D];  // of a cell's number along each axis

  /// Sets the number of cells along each axis, reduced if there would be more than `most`. Returns how many there are.
  SMALL u32 shape(const f64* wanted, u32 first_cell, u64 most) {
    u32 log[D], sum = 0;
    for (int a = 0; a < D; a++) {
      log[a] = 0;
      while (log[a] < 20 && f64(1u << log[a]) < wanted[a]) log[a]++;
      // With two cells, each would be on both sides of the other.
      if (log[a] == 1) log[a] = 2;
      sum += log[a];
    }
    while (u64(1) << sum > most) {
      int widest = 0;
      for (int a = 1; a < D; a++) widest = log[a] > log[widest] ? a : widest;
      u32 less = log[widest] > 2 ? 1 : 2;
      log[widest] -= less;
      sum -= less;
    }
    first = first_cell;
    u32 shifted = 0;
    mask = u32x4{};
    for (int a = 0; a < D; a++) {
      mask[a] = (1u << log[a]) - 1;
      if (D == 2) mask[2 + a] = mask[a];
      shift[a] = shifted;
      shifted += log[a];
    }
    return 1u << sum;
  }

  /// Numbers of cells before the modulo: coordinates rounded to the nearest integer, as floats of the exponent
  /// `counted`.
  static constexpr f32 magic = 12582912;  // 1.5 * 2^23 leaves integers below 2^22 in the low bits, two's complement
  static constexpr u32 counted = 0x4b000000, exponent = 0xff800000;
  u32x4 number(f32x4 x) const { return bits<u32x4>(x * scale + splat(magic)); }

  /// Whether the cells of an item's corners have such numbers: false if they are too far away.
  bool is_counted(const Item<D>& item) const {
    u32x4 wrong = (number(item.first()) ^ splat(counted)) & splat(exponent);
    if constexpr (D == 3) {
      wrong |= (number(item.high) ^ splat(counted)) & splat(exponent);
      wrong[3] = 0;
    }
    return !any(bits<i32x4>(wrong));
  }

  /// In 2D: what belongs to the maxima, in the lanes of the minima.
  static u32x4 upper(u32x4 v) { return __builtin_shufflevector(v, v, 2, 3, 2, 3); }

  Place place(const Item<D>& item) const {
    u32x4 low = number(item.first());
    if constexpr (D == 2) return {low & mask, upper(low) - low};
    else return {low & mask, number(item.high) - low};
  }

  u32 index(const Place& place) const {
    u32 cell = first + place.at[0];
    for (int a = 1; a < D; a++) cell += place.at[a] << shift[a];
    return cell;
  }

  /// The items of `count` cells of a row, from cell x on, but none before `from`. `starts` has the first item of each
  /// cell.
  Run* run(Run* out, const u32* starts, u32 item, u32 from, u32 row, u32 x, u32 count) const {
    u32 width = mask[0] + 1, behind = x + count;
    out = add(out, item, from, starts[row + smaller(behind, width)]);
    return add(out, item, starts[row], starts[row + larger(behind, width) - width]);
  }

  /// Cells around a place along an axis: from the one before it to the last one it extends to, none twice.
  u32 before(const Place& place, int axis) const { return (place.at[axis] - 1) & mask[axis]; }
  u32 around(const Place& place, int axis) const { return smaller(place.reach[axis] + 2, mask[axis] + 1); }

  /// All items around a place in a layer of rows.
  Run* layer(Run* out, const u32* starts, const Place& place, u32 item, u32 first_row) const {
    u32 x = before(place, 0), count = around(place, 0);
    u32 y = before(place, 1);
    for (u32 high = around(place, 1); high > 0; high--) {
      u32 row = first_row + (y << shift[1]);
      out = run(out, starts, item, starts[row + x], row, x, count);
      y = (y + 1) & mask[1];
    }
    return out;
  }

  /// All items around a place: those a box there can overlap.
  NOINLINE Run* block(Run* out, const u32* starts, const Place& place, u32 item) const {
    if constexpr (D == 2) return layer(out, starts, place, item, first);
    u32 z = before(place, D - 1);
    for (u32 deep = around(place, D - 1); deep > 0; deep--) {
      out = layer(out, starts, place, item, first + (z << shift[D - 1]));
      z = (z + 1) & mask[D - 1];
    }
    return out;
  }

  /// The items to test an item against: those after it in its cell, and those of the cells that it extends into or that
  /// lie beside these. Every pair is met from one side only.
  NOINLINE Run* peers(Run* out, const u32* starts, const Item<D>& item, u32 i) const {
    Place at = place(item);
    u32x4 reach = at.reach & mask;
    u32 rows = first;
    if constexpr (D == 3) rows += at.at[2] << shift[2];
    out = run(out, starts, i, i + 1, rows + (at.at[1] << shift[1]), at.at[0], reach[0] + 1);
    if (reach[1]) {
      u32 row = rows + (((at.at[1] + 1) & mask[1]) << shift[1]);
      u32 left = before(at, 0);
      out = run(out, starts, i, starts[row + left], row, left, around(at, 0));
    }
    if constexpr (D == 3) {
      if (reach[2]) out = layer(out, starts, at, i, first + (((at.at[2] + 1) & mask[2]) << shift[2]));
    }
    return out;
  }

  /// Writes the cells of some items, without consecutive duplicates. Returns the end.
  SMALL f32* draw(f32* to, ItemsAt<D> items, u32 from, u32 until) const {
    for (u32 i = from; i < until; i++) {
      bool another = i == from;
      for (int a = 0; a < D; a++) {
        f32 cell = scale[a] > 0 ? items[i].lo(a) * scale[a] + magic - magic : 0;
        to[a] = (cell - 0.5f) / scale[a];
        to[D + a] = (cell + 0.5f) / scale[a];
        another = another || to[a] != to[a - 2 * D];
      }
      if (another) to += 2 * D;
    }
    return to;
  }
};
