// Worlds that wrap around: what leaves on one side comes in on the other.
// Idea: each box is moved by whole worlds until its minimum is inside, and where it then reaches across the border, a
// ghost of it, of what reaches across, is put at the other side: up to 2^D - 1 ghosts a box. Techniques search boxes
// and ghosts alike. A pair may be found several times, also by its ghosts. It is kept only when found by the first of
// these, per axis: the two boxes; the first and the other's ghost; the first's ghost and the other.
// Along each axis the world begins at 0, or at minus half its size where that leaves more boxes as they were given.
// Most boxes are at home: inside the world on all axes. Two of these meet as in any other world.
// Exact: a box is its minimum modulo the world, which is exact, and its size as the sum of two doubles, which is too;
// where rounding could matter, whether two of them touch is the sign of a sum of five doubles, found exactly.
// One copy for 2D and 3D, since it is small code that counts here.
// Cost: about 2 ns a box, for a copy of 17 (2D) or 25 (3D) bytes each, and as much for each pair; about 100 ns for each
// box that is not at home, and for each pair of one.
#pragma once
#include "base/rounding.hpp"
#include "rules/filters.hpp"

/// A box along one axis of a world that wraps around: from low + shift to low + shift + size + rest.
struct Span {
  f64 low, size, rest;  // low: in ]-world, world[, or in [-world / 2, world / 2[ if the world begins there
  f64 shift;  // 0, or the world where low is below its beginning
  bool full;  // it covers the whole axis

  /// `from`: where the world begins, 0 or -world / 2.
  SMALL static Span of(f64 lo, f64 hi, f64 world, f64 from = 0) {
    f64 size = hi - lo;
    f64 back = size - hi;  // -lo, as far as size holds it
    f64 rest = (hi - (size - back)) - (lo + back);
    // A box that is infinite, or as long as the world, covers the whole axis.
    if (!(size < world || (size == world && rest < 0))) return {0, world, 0, 0, true};
    f64 low = lo >= from && lo < from + world ? lo : remainder(lo, world);
    if (from < 0 && low >= from + world) low -= world;  // exact, as the sum below
    if (from < 0 && low < from) low += world;
    return {low, size, rest, low < from ? world : 0, false};
  }

  /// Whether it ends behind where another one begins that is shifted by `further`, a whole number of worlds; or just
  /// there, if `touching` counts.
  SMALL bool reaches(const Span& other, f64 further, bool touching) const {
    f64 shifted = other.shift - shift + further, about = other.low - low - size + shifted;
    f64 all = __builtin_fabs(other.low) + __builtin_fabs(low) + size + __builtin_fabs(shifted);
    // As `is_below` begins, without its loop, which takes an area a fifth longer.
    if (__builtin_fabs(about) > all * 0x1p-48) return about < 0;
    return is_below({other.low, -low, -size, -rest, shifted}, touching);
  }

  /// Whether it lies within another one that is shifted by `further`.
  SMALL bool is_within(const Span& other, f64 further, bool touching) const {
    f64 shifted = other.shift - shift + further;
    return is_below({other.low, -low, shifted}, touching) &&
           is_below({low, -other.low, size, -other.size, rest, -other.rest, -shifted}, touching);
  }

 private:
  struct Sum {
    f64 terms[7];
  };

  /// x modulo world, with the sign of x: exact, like fmod.
  SMALL static f64 remainder(f64 x, f64 world) {
    f64 rest = __builtin_fabs(x), step = world;
    while (step <= rest / 2) step *= 2;
    for (; step >= world; step /= 2) {
      if (rest >= step) rest -= step;
    }
    return x < 0 ? -rest : rest;
  }

  /// Whether a sum is below 0, or equal to it.
  SMALL static bool is_below(const Sum& all, bool just) {
    f64 sum = 0, largest = 0;
    for (f64 term : all.terms) {
      sum += term;
      largest = larger(largest, __builtin_fabs(term));
    }
    if (__builtin_fabs(sum) > largest * 0x1p-48) return sum < 0;
    f64 exact = sign(all);
    return just ? exact <= 0 : exact < 0;
  }

  /// The sign of a sum, by Shewchuk's expansions: doubles with the same sum that do not overlap, the largest last.
  SMALL static f64 sign(const Sum& all) {
    constexpr int most = sizeof(all.terms) / sizeof(f64);
    f64 parts[most] = {};
    for (int n = 0; n < most; n++) {
      f64 sum = all.terms[n];
      for (int k = 0; k < n; k++) {
        f64 part = parts[k], total = sum + part, back = total - sum;
        parts[k] = (sum - (total - back)) + (part - back);
        sum = total;
      }
      parts[n] = sum;
    }
    for (int k = most - 1; k >= 0; k--) {
      if (parts[k] != 0) return parts[k];
    }
    return 0;
  }
};

class Wrap {
  Buffer<f32> boxes_;  // the boxes, then the ghosts: rounded to the nearest if at home, else outward
  Buffer<u32> excluded_;  // of both
  Buffer<u32> owners_;  // per ghost: its box in 24 bits, above them the axes along which it is shifted
  Buffer<u8> across_;  // per box: the axes along which it crosses the border; whether it is at home
  const Filters* filters_ = nullptr;  // maps the boxes searched to slots
  const f32* given_ = nullptr;
  const f64* doubles_ = nullptr;
  const f64* world_ = nullptr;
  f64 from_[3] = {};  // where the world begins
  u32 dimensions_ = 0, count_ = 0, ghosts_ = 0;
  bool changed_ = false;  // some box may have lost a ghost
  bool touching_ = true;

 public:
  /// The boxes that are to be searched, and how many there are, with their ghosts. `given`: the boxes by slot, as
  /// float32 and, unless null, as doubles. Also puts the exclusion bits of the ghosts behind those of the boxes.
  /// `in_order`: ghosts have to be in the order of their boxes.
  SMALL const f32* unfold(u32& count, const u32*& excluded, const Filters& filters, const f32* given,
                          const f64* doubles, const f64* world, u32 dimensions, bool in_order) {
    dimensions_ = dimensions;
    filters_ = &filters;
    given_ = given;
    doubles_ = doubles;
    world_ = world;
    u32 had = count_;
    count_ = count;
    across_.grow(u64(count) + 1, smaller(had, count));
    if (in_order) had = ghosts_ = 0;
    if (count > had) __builtin_memset(across_.data() + had, 0, count - had);
    boxes_.grow(u64(count) * 2 * dimensions + 4, 0);
    changed_ = had != count;
    choose_beginning();
    place_all();
    if (changed_) keep_ghosts();
    write_ghosts();
    count += ghosts_;
    if (excluded) {
      u32* bits = excluded_.reserve(count);
      for (u32 k = 0; k < count; k++) bits[k] = excluded[k < count_ ? k : owners_[k - count_] & slot_mask];
      excluded = bits;
    }
    return boxes_.data();
  }

  /// Ghosts to boxes; keeps each overlapping pair once, and those that only touch if that counts.
  NOINLINE void fold(Pairs& pairs, bool touching) {
    touching_ = touching;
    const bool exact = touching && !doubles_;
    const u32 width = 2 * dimensions_, all = (1u << dimensions_) - 1;
    const u8* across = across_.data();
    const f32* boxes = boxes_.data();
    u8x16 maxima;  // of the last four numbers of a box
    for (u32 n = 0; n < 16; n++) maxima[n] = u8(dimensions_ == 2 ? 8 + n % 8 : smaller(4 + n, 15u));
    u64* list = pairs.list.data();
    u64 kept = 0;
    for (u64 p = 0; p < pairs.count; p++) {
      u32 a = u32(list[p]), b = u32(list[p] >> 32);
      bool keep;
      if (b < count_ && (across[a] & across[b] & at_home)) {
        keep = exact;
        if (!keep) {
          const f32 *one = boxes + u64(a) * width, *other = boxes + u64(b) * width;
          f32x4 ends = bits<f32x4>(swizzle(load<u8x16>(one + width - 4), maxima)),
                its = bits<f32x4>(swizzle(load<u8x16>(other + width - 4), maxima));
          u32 apart = bitmask((load<f32x4>(one) >= its) | (load<f32x4>(other) >= ends)) & all;
          keep = !apart || overlap(a, b);
        }
      } else {
        u32 ghost_a = take_owner(a), ghost_b = take_owner(b);
        keep = a != b && is_first(a, ghost_a, b, ghost_b);
      }
      list[kept] = pair_of(a, b);
      kept += keep;
    }
    pairs.count = kept;
  }

  SMALL void release() {
    boxes_.release();
    excluded_.release();
    owners_.release();
    across_.release();
    count_ = ghosts_ = 0;
  }

 private:
  static constexpr u32 most_looked_at = 64;  // boxes
  static constexpr u32 at_home = 8;  // beside the bits of up to three axes

  /// Chooses where the world begins along each axis: at minus half its size if many more boxes are inside then.
  SMALL void choose_beginning() {
    for (u32 a = 0; a < dimensions_; a++) {
      f64 world = world_[a];
      i32 more = 0, looked = 0;
      for (u32 k = 0; k < count_; k += 1 + count_ / most_looked_at, looked++) {
        f64 lo = number(k, a), hi = number(k, dimensions_ + a);
        more += (lo >= -world / 2 && hi < world / 2) - (lo >= 0 && hi < world);
      }
      from_[a] = 4 * more > looked ? -world / 2 : 0;
    }
  }

  /// Copies the boxes into the world, and notes which of them cross its border.
  NOINLINE void place_all() {
    const u32 width = 2 * dimensions_;
    f32x4 above_first, above_last, below_first, below_last;
    for (u32 n = 0; n < 4; n++) {
      u32 one = n % dimensions_, other = (width - 4 + n) % dimensions_;
      above_first[n] = round_up(from_[one]);
      above_last[n] = round_up(from_[other]);
      below_first[n] = round_down(from_[one] + world_[one]);
      below_last[n] = round_down(from_[other] + world_[other]);
    }
    f32* box = boxes_.data();
    for (u32 k = 0; k < count_; k++, box += width) {
      const f32* its = given_ + u64(filters_->slot(k)) * width;
      f32x4 first = load<f32x4>(its), last = load<f32x4>(its + width - 4);
      store(box, first);
      store(box + width - 4, last);
      i32x4 inside = (first > above_first) & (first < below_first) & (last > above_last) & (last < below_last);
      u32 now = bitmask(inside) == 15 ? at_home : place(k, box), was = across_[k];
      if (now == was) continue;
      across_[k] = u8(now);
      for (u32 some = now & 7; some; some = (some - 1) & now & 7) {  // a ghost for each subset of the axes
        if (!(some & ~was)) continue;
        owners_.grow(u64(ghosts_) + 1, ghosts_);
        owners_[ghosts_++] = k | some << 24;
      }
      changed_ |= (was & ~now & 7) != 0;
    }
  }

  /// Moves a box into the world; returns the axes along which it crosses the border.
  SMALL u32 place(u32 k, f32* box) const {
    u32 across = 0;
    for (u32 a = 0; a < dimensions_; a++) {
      f64 lo = number(k, a), hi = number(k, dimensions_ + a), from = from_[a], until = from + world_[a];
      f32 low = doubles_ ? round_down(lo) : f32(lo), high = doubles_ ? round_up(hi) : f32(hi);
      if (!(lo >= from && hi < until)) across |= u32(place(span(k, a), world_[a], until, low, high)) << a;
      box[a] = low;
      box[dimensions_ + a] = high;
    }
    return across;
  }

  /// Removes the ghosts that boxes no longer have; the last one takes the place of each.
  SMALL void keep_ghosts() {
    for (u32 g = ghosts_; g-- > 0;) {
      u32 owner = owners_[g] & slot_mask, axes = owners_[g] >> 24;
      if (owner >= count_ || (axes & ~u32(across_[owner]))) owners_[g] = owners_[--ghosts_];
    }
  }

  /// Puts the ghosts behind the boxes.
  SMALL void write_ghosts() {
    const u32 width = 2 * dimensions_;
    u64 all = u64(count_) + ghosts_;
    if (all > max_slots) fail(Fault::out_of_memory, f64(all) * width * sizeof(f32));
    boxes_.grow(all * width + 4, u64(count_) * width);
    for (u32 g = 0; g < ghosts_; g++) {
      u32 k = owners_[g] & slot_mask, some = owners_[g] >> 24;
      const f32* of = boxes_.data() + u64(k) * width;
      f32* ghost = boxes_.data() + (u64(count_) + g) * width;
      for (u32 a = 0; a < dimensions_; a++) {
        bool moved = some >> a & 1;
        ghost[a] = moved ? round_down(from_[a]) : of[a];
        ghost[dimensions_ + a] = moved ? beyond(span(k, a), world_[a], from_[a]) : of[dimensions_ + a];
      }
    }
  }

  f64 number(u32 k, u32 n) const {
    u64 at = u64(filters_->slot(k)) * 2 * dimensions_ + n;
    return doubles_ ? doubles_[at] : f64(given_[at]);
  }

  /// From a ghost to its box; returns the axes along which it is shifted.
  u32 take_owner(u32& k) const {
    if (k < count_) return 0;
    u32 owner = owners_[k - count_];
    k = owner & slot_mask;
    return owner >> 24;
  }

  /// Whether two boxes at home overlap in the numbers given.
  SMALL bool overlap(u32 a, u32 b) const {
    bool overlap = true;
    for (u32 n = 0; n < dimensions_; n++) {
      f64 first = number(a, dimensions_ + n) - number(b, n), second = number(b, dimensions_ + n) - number(a, n);
      overlap &= touching_ ? first >= 0 && second >= 0 : first > 0 && second > 0;
    }
    return overlap;
  }

  SMALL Span span(u32 k, u32 axis) const {
    return Span::of(number(k, axis), number(k, dimensions_ + axis), world_[axis], from_[axis]);
  }

  /// A bound for the rounding errors.
  static f64 slack(f64 world) { return world * 0x1p-50; }

  /// The box moved into the world, which ends at `until`, rounded outward; returns whether it may cross the border.
  SMALL static bool place(const Span& span, f64 world, f64 until, f32& low, f32& high) {
    if (span.full) {
      low = -__builtin_inff();
      high = __builtin_inff();
      return false;
    }
    f64 more = slack(world), lo = span.low + span.shift, hi = lo + span.size;
    low = round_down(lo - more);
    high = round_up(hi + more);
    return hi + more >= until;
  }

  /// The upper end of the ghost, rounded up.
  static f32 beyond(const Span& span, f64 world, f64 from) {
    return round_up(larger(from, span.low + span.shift + span.size - world + 2 * slack(world)));
  }

  /// Whether these are the boxes or ghosts by which the pair is to be reported.
  SMALL bool is_first(u32 a, u32 ghost_a, u32 b, u32 ghost_b) const {
    for (u32 axis = 0; axis < dimensions_; axis++) {
      Span first = span(a, axis), second = span(b, axis);
      bool one = ghost_a >> axis & 1, other = ghost_b >> axis & 1;
      bool met = first.full || second.full ||
                 (first.reaches(second, 0, touching_) && second.reaches(first, 0, touching_));
      if (met) {
        if (one || other) return false;
      } else if (second.reaches(first, world_[axis], touching_)) {
        if (one || !other) return false;
      } else if (!one || other || !first.reaches(second, world_[axis], touching_)) {
        return false;
      }
    }
    return true;
  }
};
