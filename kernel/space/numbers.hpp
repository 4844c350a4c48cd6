// The numbers of the boxes, by slot. Boxes are stored as float32, which every technique searches, and, from the first
// box on that does not fit float32, also as the doubles given. Rounding is monotone (see gap_map.hpp), so only pairs
// with two bounds equal in float32 are in doubt. Boxes that fit float32 cost nothing extra. Every change allocates
// before it writes.
#pragma once
#include "space/map_choice.hpp"
#include "space/written.hpp"

template <int D> class Numbers {
  static constexpr u32 width = 2 * D;  // numbers in a box

  Buffer<f32> boxes_, staged_;
  Buffer<f64> exact_, staged_exact_;  // the numbers given, while `rounding_`
  bool rounding_ = false;
  MapChoice<D> choice_;  // the map from doubles to float32, while `rounding_`

 public:
  static constexpr u64 padding = 4;  // vector loads may read this many floats past the last box

  Written<D> written;

  f32* boxes() { return boxes_.data(); }
  const f32* boxes() const { return boxes_.data(); }
  /// Null if all numbers are exact in float32.
  const f64* exact() const { return rounding_ ? exact_.data() : nullptr; }
  const GapMap<D>& map() const { return choice_.map(); }
  /// The boxes that are searched, if these are the numbers given, rounded to the nearest; else null.
  const f32* nearest() const { return map().is_plain() && !written.in_place() ? boxes_.data() : nullptr; }

  // Room.
  u64 capacity() const { return boxes_.capacity() / width; }
  u64 room() const {
    u64 all = (boxes_.capacity() - padding) / width;
    return rounding_ ? smaller(all, exact_.capacity() / width) : all;
  }
  /// Room for `count` boxes; the first `keep` are preserved.
  SMALL void make_room(u64 count, u32 keep) {
    if (written.in_place() && written.shown() == 0 && count * width + padding > boxes_.capacity()) {
      written.move(boxes_, larger(count * width + padding, boxes_.capacity() + boxes_.capacity() / 2), keep);
    }
    boxes_.grow(count * width + padding, u64(keep) * width);
    if (rounding_) exact_.grow(capacity() * width, u64(keep) * width);
  }
  /// Bytes needed to start storing doubles.
  u64 bytes_to_round() const { return rounding_ ? 0 : exact_.missing(boxes_.capacity()); }

  // One box.

  /// Moves the last box to another slot.
  SMALL void move(u32 last, u32 slot) {
    written.changes.note(slot);
    __builtin_memcpy(boxes_.data() + u64(slot) * width, boxes_.data() + u64(last) * width, width * sizeof(f32));
    if (rounding_) {
      __builtin_memcpy(exact_.data() + u64(slot) * width, exact_.data() + u64(last) * width, width * sizeof(f64));
    }
    written.show(boxes_.data(), slot);
  }

  /// A number as it was given, or as it was written in place since.
  f64 number(u32 slot, u32 k) const {
    u64 at = u64(slot) * width + k;
    if (!rounding_) return boxes_[at];
    if (!written.in_place()) return exact_[at];
    f64 box[width];
    as_written(slot, box);
    return box[k];
  }

  /// Prefetches a batch of boxes.
  void read_ahead(const u32* slots, u32 many) const {
    read_rows(boxes_.data(), width * sizeof(f32), slots, many);
    if (rounding_) read_rows(exact_.data(), width * sizeof(f64), slots, many);
  }

  /// Writes boxes, `step` numbers apart, to their slots, and records which of them have changed.
  template <u32 step> void put(const f64* box, const u32* slots, u32 count) {
    if (rounding_) put<step, true>(box, slots, count);
    else put<step, false>(box, slots, count);
  }

  // All boxes.

  /// Memory for boxes that are going to replace all, as float32 or as doubles.
  f32* stage(u32 count) { return staged_.reserve(u64(count) * width + padding); }
  f64* stage_exact(u32 count) {
    stage(count);
    return staged_exact_.reserve(u64(count) * width);
  }

  /// The first bad one of the staged boxes, or -1. `rounded`: whether some are not exact in float32.
  SMALL i32 check_staged(u32 count, bool doubles, bool& rounded) {
    rounded = false;
    return doubles ? round_staged(count, rounded) : first_bad(staged_.data(), count);
  }

  /// Before all boxes are replaced: exchanges their memory for that of others.
  void give(Buffer<f32>& boxes, Buffer<f64>& exact) {
    if (rounding_) exact_.swap(exact);
    else boxes_.swap(boxes);
  }

  /// Replaces all boxes by the staged ones. `rounded`: some of these are not exact in float32.
  void take_staged(bool rounded) {
    boxes_.swap(staged_);
    if (rounded) exact_.swap(staged_exact_);
    else hold_floats();
    rounding_ = rounded;
    written.end();
  }

  /// Changes the number of boxes in place; new ones are at the origin.
  SMALL void resize(u32 count, u32 had) {
    boxes_.grow(u64(count) * width + padding, u64(had) * width);
    if (count > had) {
      __builtin_memset(boxes_.data() + u64(had) * width, 0, u64(count - had) * width * sizeof(f32));
    }
  }

  /// Replaces the boxes by the staged ones, which will be written in place.
  void swap_staged() { boxes_.swap(staged_); }

  /// Writes each number, rounded to the nearest float32. Those that are searched are mapped while there are doubles.
  SMALL void write_floats(u32 count, f32* to) const {
    for (u32 k = 0; k < count * width; k++) to[k] = rounding_ ? f32(exact_[k]) : boxes_[k];
  }

  /// Starts to store the doubles of `n` boxes too.
  SMALL void keep_doubles(u32 n) {
    written.see(boxes_.data(), n);
    heap::kept = 0;
    exact_.reserve(larger(boxes_.capacity(), u64(width)));
    for (u64 k = 0; k < u64(n) * width; k++) exact_[k] = boxes_[k];
    rounding_ = true;
    round_all(n);
  }

  /// Drops the doubles: boxes are stored as float32 only.
  SMALL void hold_floats() {
    rounding_ = false;
    choice_.reset();
  }

  /// Rounds all boxes as while they may be written in place, since they could be in the space that was saved.
  SMALL void write_in_place(u32 n) {
    written.begin();
    choice_.reset();
    if (rounding_) round_all(n);
  }

  /// Tries another map, and rounds the boxes again if it is better.
  SMALL void look_for_map(u32 n, bool ordered) {
    if (!rounding_ || written.in_place()) return;
    // A snapshot does not tell that boxes which are all exact in float32 were not before.
    // Nearly always the first few tell.
    bool plain = ordered && are_floats(exact_.data(), smaller(n, 16u), width) && are_floats(exact_.data(), n, width);
    if (choice_.look(boxes_.data(), exact_.data(), n, ordered, plain)) round_all(n);
  }

  /// Updates the stored doubles by what was written in place, which has no bad boxes.
  SMALL void take_written(u32 n) {
    written.see(boxes_.data(), n);
    for (u32 s = 0; written.in_place() && rounding_ && s < n; s++) {
      f64 box[width];
      as_written(s, box);
      __builtin_memcpy(exact_.data() + u64(s) * width, box, sizeof(box));
      map().round(box, boxes_.data() + u64(s) * width);
      written.show(boxes_.data(), s);
    }
  }

  /// The first box whose float32 numbers are not what its doubles are rounded to, or -1.
  SMALL i32 first_unrounded(u32 n) const {
    for (u32 s = 0; rounding_ && !written.in_place() && s < n; s++) {
      f32 image[width];
      map().round(exact_.data() + u64(s) * width, image);
      if (differ<width * sizeof(f32)>(image, boxes_.data() + u64(s) * width)) return i32(s);
    }
    return -1;
  }

  /// The first bad one of `count` boxes, or -1.
  i32 first_bad(u32 n) const { return first_bad(boxes_.data(), n); }

  /// Whether all numbers of these boxes, which are `step` numbers apart, are exact in float32.
  NOINLINE static bool are_floats(const f64* box, u32 count, u32 step) {
    i32x4 rounded = {};
    for (; count > 0; count--, box += step) rounded |= GapMap<D>::rounded(box);
    return !any(rounded);
  }

 private:
  template <u32 step, bool rounding> NOINLINE void put(const f64* box, const u32* slots, u32 count) {
    f32* boxes = boxes_.data();
    f64* exact = exact_.data();
    Changes& changes = written.changes;
    typename GapMap<D>::Less less = {};  // floats are not mapped
    if constexpr (rounding) less = map().less();
    const bool notes = !changes.all();
    typename GapMap<D>::Sizes sizes;
    Changes::Notes changed = changes.begin();
    const f64* from = box;
    for (u32 k = 0; k < count; k++, from += step) {
      u32 slot = slots[k];
      f32* to = boxes + u64(slot) * width;
      f32x4 first, last;
      GapMap<D>::narrowed(less, from, first, last);
      if constexpr (rounding) {
        sizes.see(first, last);
        f64* its = exact + u64(slot) * width;
        if (notes && differ<width * sizeof(f64)>(its, from)) changed.note(slot);
        __builtin_memcpy(its, from, width * sizeof(f64));
      } else {
        i32x4 other = bits<i32x4>(first) ^ load<i32x4>(to);
        if constexpr (D == 3) other |= bits<i32x4>(last) ^ load<i32x4>(to + width - 4);
        if (notes && any(other)) changed.note(slot);
      }
      store_box<D>(to, first, last);
    }
    if (notes) changes.end(changed);
    if (rounding && !(less.alone && sizes.all_are_sized())) choice_.count_more(round_again(box, step, slots, count));
    for (u32 k = 0; written.shown() && k < count; k++) written.show(boxes, slots[k]);
  }

  /// Rounds boxes, some of which the quick way may not have got right; returns how many collapse. All of them, since the
  /// last of two in the same slot counts.
  NOINLINE u32 round_again(const f64* box, u32 step, const u32* slots, u32 count) {
    f32* boxes = boxes_.data();
    u32 collapsed = 0;
    for (u32 k = 0; k < count; k++, box += step) collapsed += map().round(box, boxes + u64(slots[k]) * width);
    return collapsed;
  }

  SMALL void round_all(u32 n) {
    for (u32 s = 0; s < n; s++) {
      map().round(exact_.data() + u64(s) * width, boxes_.data() + u64(s) * width);
      written.show(boxes_.data(), s);
    }
    written.changes.note_all();
  }

  /// A box of which some numbers may have been written in place since it was given: those that differ from its rounded
  /// ones.
  SMALL void as_written(u32 slot, f64* to) const {
    const f64* given = exact_.data() + u64(slot) * width;
    const f32* now = boxes_.data() + u64(slot) * width;
    f32 shown[width];
    map().round(given, shown);
    for (u32 k = 0; k < width; k++) to[k] = shown[k] == now[k] ? given[k] : f64(now[k]);
    for (u32 a = 0; a < D; a++) {
      // One side is as given and the other as written; rounding may have swapped their order.
      if (to[a] <= to[D + a]) continue;
      to[a] = now[a];
      to[D + a] = now[D + a];
    }
  }

  /// The first of `count` boxes with a NaN or with a minimum above its maximum, or -1.
  NOINLINE static i32 first_bad(const f32* boxes, u32 count) {
    constexpr u32 all = D == 2 ? 3 : 7;
    for (u32 s = 0; s < count; s++) {
      const f32* box = boxes + u64(s) * width;
      f32x4 low = load<f32x4>(box), high = maxima<D>(low, load<f32x4>(box + width - 4));
      if ((bitmask(low <= high) & all) != all) return i32(s);
    }
    return -1;
  }

  /// Rounds the staged doubles into the staged float32; `rounded`: whether some are not exact in float32. Returns the
  /// first bad box, or -1.
  i32 round_staged(u32 count, bool& rounded) {
    auto all = map().round_all(staged_exact_.data(), count, staged_.data());
    if (all.bad >= 0) return all.bad;
    rounded = all.inexact;
    choice_.count(all.collapsed);
    return -1;
  }
};
