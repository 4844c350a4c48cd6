// Fat boxes in rows, for techniques that keep a few of them together, which come and go.
// Idea: a row for each coordinate, four boxes of which are tested at a time; the last one takes the place of one that
// goes. Cost: a quarter of a nanosecond a box to test; finding one by its slot looks at all.
#pragma once
#include "sweep.hpp"

/// Calls `what` with the place of each of the boxes in rows that overlaps this one and may meet its tag. Hits are few: so
/// this exists once, whatever is done with them.
template <int D>
NOINLINE void each_overlapping(
    const f32* rows, u32 stride, u32 count, const f32* fat, u32 tag, void (*what)(void*, u32), void* to) {
  f32x4 lo[D], hi[D];
  for (int a = 0; a < D; a++) {
    lo[a] = splat(fat[a]);
    hi[a] = splat(fat[D + a]);
  }
  u32x4 excluded = splat(tag & ~slot_mask);
  for (u32 j = 0; j < count; j += 4) {
    const f32* at = rows + j;
    i32x4 all = ~i32x4{};
    for (int a = 0; a < D; a++, at += stride) all &= load<f32x4>(at) <= hi[a];
    for (int a = 0; a < D; a++, at += stride) all &= load<f32x4>(at) >= lo[a];
    all &= bits<i32x4>((load<u32x4>(at) & excluded) == u32x4{});
    for (u32 hits = bitmask(all); hits; hits &= hits - 1) what(to, j + u32(__builtin_ctz(hits)));
  }
}

/// Fat boxes as structure of arrays that grow: minima, maxima, tags, then `more` rows of the owner's.
/// Behind the last box the first row is NaN, which overlaps nothing, and no tag names a slot.
template <int D, u32 more> struct FatRows {
  static constexpr u32 width = 2 * D, height = width + 1 + more;
  // So many are tested at a time, at most, which is what is read behind the last box: eight of those that rest, of which a
  // cell has many and whose owners keep nothing more; four of those that move.
  static constexpr u32 padding = more ? 4 : 8;
  static constexpr u32 nowhere = 0xffffffff;
  Buffer<f32> values;
  u32 stride = 0, count = 0;

  f32* row(u32 k) const { return values.data() + u64(k) * stride; }
  u32* tags() const { return reinterpret_cast<u32*>(row(width)); }

  LaneView<D> view() const {
    LaneView<D> view;
    for (int a = 0; a < D; a++) {
      view.lo[a] = row(a);
      view.hi[a] = row(D + a);
    }
    view.tag = tags();
    return view;
  }

  void write(u32 at, const f32* box) const {
    for (u32 k = 0; k < width; k++) row(k)[at] = box[k];
  }

  COLD void release() {
    values.release();
    stride = count = 0;
  }

  /// Reads all boxes: see read_lines.
  COLD u32 fetch() const {
    u32 read = 0;
    for (u32 r = 0; r < height; r++) read ^= read_lines(row(r), count * sizeof(f32));
    return read;
  }

  /// Adds a box; gives its place.
  u32 put(const f32* box, u32 tag) {
    if (count + padding >= stride) grow();
    write(count, box);
    tags()[count] = tag;
    return count++;
  }

  /// Takes the box at a place away; the last one comes there.
  void take(u32 at) {
    u32 last = --count;
    ROLLED
    for (u32 k = 0; k < height; k++) row(k)[at] = row(k)[last];
    row(0)[last] = __builtin_nanf("");
    tags()[last] = slot_mask;
  }

  /// The place of a slot, or `nowhere`.
  u32 find(u32 slot) const {
    const u32* tag = tags();
    for (u32 k = 0; k < count; k += 4) {
      u32 same = bitmask(bits<i32x4>((load<u32x4>(tag + k) & splat(slot_mask)) == splat(slot)));
      if (same) return k + u32(__builtin_ctz(same));
    }
    return nowhere;
  }

  /// Calls `what` with the place of each whose fat box overlaps this one and may meet this tag.
  template <class What> void each_hit(const f32* fat, u32 tag, What what) const {
    each_overlapping<D>(values.data(), stride, count, fat, tag, [](void* to, u32 at) { (*static_cast<What*>(to))(at); }, &what);
  }

 private:
  COLD void grow() {
    u32 wider = (count + count / 2 + 2 * padding + 3) & ~3u;
    Buffer<f32> rows;
    rows.reserve(u64(wider) * height);
    for (u32 k = 0; k < height && count > 0; k++) {
      __builtin_memcpy(rows.data() + u64(k) * wider, row(k), count * sizeof(f32));
    }
    for (u32 k = count; k < wider; k++) {
      rows[k] = __builtin_nanf("");
      rows[u64(width) * wider + k] = bits<f32>(slot_mask);  // no box has this slot
    }
    values.swap(rows);
    rows.release();
    stride = wider;
  }
};
