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
  Buffer<f64> exact_, staged_exact_;  // the doubles given, while `rounding_`
  bool rounding_ = false;
  MapChoice<D> choice_;  // from doubles to float32, while `rounding_`

 public:
  static constexpr u64 padding = 4;  // vector loads may read this many floats past the last box

  Written<D> written;

  f32* boxes() { return boxes_.data(); }
  const f32* boxes() const { return boxes_.data(); }
  /// Null where float32 holds all boxes.
  const f64* exact() const { return rounding_ ? exact_.data() : nullptr; }
  const GapMap<D>& map() const { return choice_.map(); }

  // Room.
  u64 capacity() const { return boxes_.capacity() / width; }
  u64 room() const {
    u64 all = (boxes_.capacity() - padding) / width;
    return rounding_ ? smaller(all, exact_.capacity() / width) : all;
  }
  /// Room for `count` boxes, of which the first `keep` stay.
  SMALL void make_room(u64 count, u32 keep) {
    if (written.in_place() && written.shown() == 0 && count * width + padding > boxes_.capacity()) {
      written.move(boxes_, larger(count * width + padding, boxes_.capacity() + boxes_.capacity() / 2), keep);
    }
    boxes_.grow(count * width + padding, u64(keep) * width);
    if (rounding_) exact_.grow(capacity() * width, u64(keep) * width);
  }
  /// Whether memory may be had for the first double.
  SMALL bool may_round() const { return rounding_ || heap::reach(2 * capacity() * width * sizeof(f64)); }

  // One box.

  /// Takes the last box to another slot.
  SMALL void move(u32 last, u32 slot) {
    written.changes.note(slot);
    __builtin_memcpy(boxes_.data() + u64(slot) * width, boxes_.data() + u64(last) * width, width * sizeof(f32));
    if (rounding_) {
      __builtin_memcpy(exact_.data() + u64(slot) * width, exact_.data() + u64(last) * width, width * sizeof(f64));
    }
    written.show(boxes_.data(), slot);
  }

  /// A number as it was given, or written in place since.
  f64 number(u32 slot, u32 k) const {
    u64 at = u64(slot) * width + k;
    if (!rounding_) return boxes_[at];
    if (!written.in_place()) return exact_[at];
    f64 box[width];
    as_written(slot, box);
    return box[k];
  }

  /// Reads these boxes beforehand, all that are taken together.
  void read_ahead(const u32* slots, u32 many) const {
    read_rows(boxes_.data(), width * sizeof(f32), slots, many, 1);
    if (rounding_) read_rows(exact_.data(), width * sizeof(f64), slots, many, 1);
  }

  /// Puts boxes, each so many numbers behind the one before, in their slots, and notes which are not what stood there.
  template <u32 step> void put(const f64* box, const u32* slots, u32 count) {
    if (rounding_) put<step, true>(box, slots, count);
    else put<step, false>(box, slots, count);
  }

  // All boxes.

  /// Memory into which boxes are written that are to stand in place of all, as float32 or as doubles.
  f32* stage(u32 count) { return staged_.reserve(u64(count) * width + padding); }
  f64* stage_exact(u32 count) {
    stage(count);
    return staged_exact_.reserve(u64(count) * width);
  }
  f64 staged_number(u32 index, bool doubles) const { return doubles ? staged_exact_[index] : f64(staged_[index]); }

  /// The first bad box among what was staged, or -1. `rounded`: whether float32 cannot hold all of them.
  SMALL i32 check_staged(u32 count, bool doubles, bool& rounded) {
    rounded = false;
    return doubles ? round_staged(count, rounded) : first_bad(staged_.data(), count);
  }

  /// What was staged is now what stands in the space; `rounded`: with doubles that float32 cannot hold.
  void take_staged(bool rounded) {
    boxes_.swap(staged_);
    if (rounded) exact_.swap(staged_exact_);
    else hold_floats();
    rounding_ = rounded;
    written.end();
  }

  /// Room for so many boxes where they stand, the new ones at the origin.
  SMALL void resize(u32 count, u32 had) {
    boxes_.grow(u64(count) * width + padding, u64(had) * width);
    if (count > had) {
      __builtin_memset(boxes_.data() + u64(had) * width, 0, u64(count - had) * width * sizeof(f32));
    }
  }

  /// What was staged stands in the place of the boxes, to be written in place.
  void swap_staged() { boxes_.swap(staged_); }

  /// From now on these boxes are float32, each number to the nearest.
  SMALL void round_in_place(u32 count) {
    for (u32 k = 0; k < count * width; k++) boxes_[k] = f32(exact_[k]);
  }

  /// From now on the doubles are kept too, of so many boxes.
  SMALL void keep_doubles(u32 n) {
    written.see(boxes_.data(), n);
    exact_.reserve(larger(boxes_.capacity(), u64(width)));
    for (u64 k = 0; k < u64(n) * width; k++) exact_[k] = boxes_[k];
    rounding_ = true;
    round_all(n);
  }

  /// From now on the boxes are float32.
  SMALL void hold_floats() {
    rounding_ = false;
    choice_.reset();
  }

  /// Looks whether the doubles of so many boxes would better be searched by other numbers.
  SMALL void look_for_map(u32 n, bool ordered) {
    if (rounding_ && !written.in_place() && choice_.look(boxes_.data(), exact_.data(), n, ordered)) round_all(n);
  }

  /// Takes over what was written in place, none of it bad, over boxes that were given as doubles.
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

  /// The first of so many boxes that is not what it is to be searched by, or -1.
  SMALL i32 first_unrounded(u32 n) const {
    for (u32 s = 0; rounding_ && !written.in_place() && s < n; s++) {
      f32 image[width];
      map().round(exact_.data() + u64(s) * width, image);
      if (differ<width * sizeof(f32)>(image, boxes_.data() + u64(s) * width)) return i32(s);
    }
    return -1;
  }

  /// The first of so many boxes that is bad, or -1.
  i32 first_bad(u32 n) const { return first_bad(boxes_.data(), n); }

  /// Whether float32 holds all numbers of these boxes, so many numbers apart.
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
    const GapMap<D>& map = this->map();
    const bool notes = !changes.all();
    typename GapMap<D>::Sizes sizes;
    Changes::Notes changed = changes.begin();
    const f64* from = box;
    for (u32 k = 0; k < count; k++, from += step) {
      u32 slot = slots[k];
      f32* to = boxes + u64(slot) * width;
      f32x4 first, last;
      GapMap<D>::narrowed(from, first, last);
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
    if (rounding && !(map.plain() && sizes.all_are_sized())) choice_.count_more(round_again(box, step, slots, count));
    for (u32 k = 0; written.shown() && k < count; k++) written.show(boxes, slots[k]);
  }

  /// Rounds boxes, some of which the quick way may not have got right; returns how many collapse. All of them, since the
  /// last of two in the same slot counts.
  NOINLINE u32 round_again(const f64* box, u32 step, const u32* slots, u32 count) {
    const bool plain = map().plain();
    f32* boxes = boxes_.data();
    u32 collapsed = 0;
    for (u32 k = 0; k < count; k++, box += step) collapsed += map().round(plain, box, boxes + u64(slots[k]) * width);
    return collapsed;
  }

  SMALL void round_all(u32 n) {
    for (u32 s = 0; s < n; s++) {
      map().round(exact_.data() + u64(s) * width, boxes_.data() + u64(s) * width);
      written.show(boxes_.data(), s);
    }
    written.changes.note_all();
  }

  /// A box of which some numbers may have been written in place since it was given: those that are not what was shown.
  SMALL void as_written(u32 slot, f64* to) const {
    const f64* given = exact_.data() + u64(slot) * width;
    const f32* now = boxes_.data() + u64(slot) * width;
    f32 shown[width];
    map().round(given, shown);
    for (u32 k = 0; k < width; k++) to[k] = shown[k] == now[k] ? given[k] : f64(now[k]);
    for (u32 a = 0; a < D; a++) {
      // One side as it was given, the other as it was written: rounding may have put them in this order.
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

  /// Rounds the staged doubles into the staged float32; says whether float32 cannot hold all of them. Returns the first
  /// bad box, or -1.
  i32 round_staged(u32 count, bool& rounded) {
    auto all = map().round_all(staged_exact_.data(), count, staged_.data());
    if (all.bad >= 0) return all.bad;
    rounded = all.inexact;
    choice_.count(all.collapsed);
    return -1;
  }
};
