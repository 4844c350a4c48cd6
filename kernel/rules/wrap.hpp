// Worlds that wrap around: what leaves on one side comes in on the other.
// Idea: each box is moved by whole worlds until its minimum is inside, and where it then reaches across the border, a
// ghost of it, of what reaches across, is put at the other side: up to 2^D - 1 ghosts a box. Techniques search boxes
// and ghosts alike. A pair may be found several times, also by its ghosts. It is kept only when found by the first of
// these, per axis: the two boxes; the first and the other's ghost; the first's ghost and the other.
// Exact: a box is its minimum modulo the world, which is exact, and its size as the sum of two doubles, which is too;
// where rounding could matter, whether two of them touch is the sign of a sum of five doubles, found exactly.
// One copy for 2D and 3D, since it is small code that counts here.
// Cost: about 13 ns a box, for a copy of 17 (2D) or 25 (3D) bytes each; about 100 ns for each box that is given outside
// the world or crosses its border, and for each pair of such boxes, or of ones that are not exact in float32.
#pragma once
#include "base/rounding.hpp"
#include "rules/filters.hpp"

/// A box along one axis of a world that wraps around: from low + shift to low + shift + size + rest.
struct Span {
  f64 low, size, rest;  // low: in ]-world, world[
  f64 shift;  // 0, or the world where low is negative
  bool full;  // it covers the whole axis

  SMALL static Span of(f64 lo, f64 hi, f64 world) {
    f64 size = hi - lo;
    f64 back = size - hi;  // -lo, as far as size holds it
    f64 rest = (hi - (size - back)) - (lo + back);
    // A box that is infinite, or as long as the world, covers the whole axis.
    if (!(size < world || (size == world && rest < 0))) return {0, world, 0, 0, true};
    f64 low = lo >= 0 && lo < world ? lo : remainder(lo, world);
    return {low, size, rest, low < 0 ? world : 0, false};
  }

  /// Whether it ends behind where another one begins that is shifted by `further`, a whole number of worlds; or just
  /// there, if `touching` counts.
  SMALL bool reaches(const Span& other, f64 further, bool touching) const {
    return is_below({other.low, -low, -size, -rest, other.shift - shift + further}, touching);
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
  Buffer<f32> boxes_;  // rounded outward: the boxes, then the ghosts
  Buffer<u32> excluded_;  // of both
  Buffer<u32> owners_;  // per ghost: its box in 24 bits, above them the axes along which it is shifted
  Buffer<u8> plain_;  // per box, whether it is exact in float32, not moved and without ghosts
  const Filters* filters_ = nullptr;  // maps the boxes searched to slots
  const f32* given_ = nullptr;
  const f64* doubles_ = nullptr;
  const f64* world_ = nullptr;
  u32 dimensions_ = 0, count_ = 0;
  bool touching_ = true;

 public:
  /// The boxes that are to be searched, and how many there are, with their ghosts. `given`: the boxes by slot, as
  /// float32 and, unless null, as doubles. Also puts the exclusion bits of the ghosts behind those of the boxes.
  NOINLINE const f32* unfold(u32& count, const u32*& excluded, const Filters& filters, const f32* given,
                             const f64* doubles, const f64* world, u32 dimensions) {
    u32 width = 2 * dimensions;
    dimensions_ = dimensions;
    filters_ = &filters;
    given_ = given;
    doubles_ = doubles;
    world_ = world;
    count_ = count;
    boxes_.grow(u64(count_) * width + 4, 0);
    plain_.reserve(count_ + 1);
    u32 ghosts = 0;
    for (u32 k = 0; k < count_; k++) {
      f32* box = boxes_.data() + u64(k) * width;
      u32 across = 0;
      bool plain = true;
      for (u32 a = 0; a < dimensions; a++) {
        f64 lo = number(k, a), hi = number(k, dimensions + a);
        f32 low = doubles_ ? round_down(lo) : f32(lo), high = doubles_ ? round_up(hi) : f32(hi);
        if (!(lo >= 0 && hi < world[a])) across |= u32(place(Span::of(lo, hi, world[a]), world[a], low, high)) << a;
        plain &= f64(low) == lo && f64(high) == hi;
        box[a] = low;
        box[dimensions + a] = high;
      }
      plain &= across == 0;
      plain_[k] = plain;
      // One ghost for each subset of the axes along which it crosses the border.
      for (u32 some = across; some; some = (some - 1) & across) {
        u32 next = count_ + ghosts;
        if (next >= max_slots) fail(Fault::out_of_memory, f64(next) * width * sizeof(f32));
        boxes_.grow((u64(next) + 1) * width + 4, u64(next) * width);
        owners_.grow(u64(ghosts) + 1, ghosts);
        const f32* of = boxes_.data() + u64(k) * width;
        f32* ghost = boxes_.data() + u64(next) * width;
        for (u32 a = 0; a < dimensions; a++) {
          bool moved = some >> a & 1;
          ghost[a] = moved ? 0 : of[a];
          ghost[dimensions + a] = moved ? beyond(span(k, a), world[a]) : of[dimensions + a];
        }
        owners_[ghosts++] = k | some << 24;
      }
    }
    count = count_ + ghosts;
    if (excluded) {
      u32* bits = excluded_.reserve(count);
      for (u32 k = 0; k < count; k++) bits[k] = excluded[k < count_ ? k : owners_[k - count_] & slot_mask];
      excluded = bits;
    }
    return boxes_.data();
  }

  /// Ghosts to boxes; keeps each overlapping pair once, and those that only touch if that counts.
  SMALL void fold(Pairs& pairs, bool touching) {
    touching_ = touching;
    u64* list = pairs.list.data();
    u64 kept = 0;
    for (u64 p = 0; p < pairs.count; p++) {
      u32 a = u32(list[p]), b = u32(list[p] >> 32), ghost_a = 0, ghost_b = 0;
      if (a >= count_) {
        ghost_a = owners_[a - count_] >> 24;
        a = owners_[a - count_] & slot_mask;
      }
      if (b >= count_) {
        ghost_b = owners_[b - count_] >> 24;
        b = owners_[b - count_] & slot_mask;
      }
      if (a == b) continue;
      bool keep = plain_[a] & plain_[b] & touching;
      if (!keep) keep = is_first(a, ghost_a, b, ghost_b);
      list[kept] = pair_of(a, b);
      kept += keep;
    }
    pairs.count = kept;
  }

  SMALL void release() {
    boxes_.release();
    excluded_.release();
    owners_.release();
    plain_.release();
  }

 private:
  f64 number(u32 k, u32 n) const {
    u64 at = u64(filters_->slot(k)) * 2 * dimensions_ + n;
    return doubles_ ? doubles_[at] : f64(given_[at]);
  }

  SMALL Span span(u32 k, u32 axis) const {
    return Span::of(number(k, axis), number(k, dimensions_ + axis), world_[axis]);
  }

  /// A bound for the rounding errors.
  static f64 slack(f64 world) { return world * 0x1p-50; }

  /// The box moved into the world, rounded outward; returns whether it may cross the border.
  SMALL static bool place(const Span& span, f64 world, f32& low, f32& high) {
    if (span.full) {
      low = -__builtin_inff();
      high = __builtin_inff();
      return false;
    }
    f64 more = slack(world), lo = span.low + span.shift, hi = lo + span.size;
    low = round_down(lo - more);
    high = round_up(hi + more);
    return hi + more >= world;
  }

  /// The upper end of the ghost, rounded up.
  static f32 beyond(const Span& span, f64 world) {
    return round_up(larger(0.0, span.low + span.shift + span.size - world + 2 * slack(world)));
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
