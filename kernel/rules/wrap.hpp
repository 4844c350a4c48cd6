// Worlds that wrap around: what leaves on one side comes in on the other.
// Idea: each box is moved by whole worlds until its minimum is inside, and where it then reaches across the border, a
// ghost of it is put one world back, at the other side: up to 2^D - 1 ghosts a box. Techniques search boxes
// and ghosts alike. A pair may be found several times, also by its ghosts. It is kept only when found by the first of
// these, per axis: the two boxes; the first and the other's ghost; the first's ghost and the other.
// Along each axis the world begins at 0, or at minus half its size where that leaves more boxes as they were given.
// Most boxes are at home: inside the world on all axes. Two of these meet as in any other world.
// Exact: a box is its minimum modulo the world, which is exact, and its size as the sum of two doubles, which is too;
// where rounding could matter, whether two of them touch is the sign of a sum of five doubles, found exactly.
// One copy for 2D and 3D, since it is small code that counts here.
// If it is known which boxes have changed, only these and their ghosts are moved again. A ghost that its box no longer
// has stays where it is, without an owner, until another box needs one, so that the number of boxes searched is steady.
// Cost: 1 to 2 ns for each box that has changed, and for each pair that is not settled; some 80 ns for each box that is
// not at home, and some 20 for each pair of one; a copy of 21 (2D) or 29 (3D) bytes a box.
#pragma once
#include "base/rounding.hpp"
#include "rules/filters.hpp"

/// A box along one axis of a world that wraps around: from low + shift to low + shift + size + rest.
struct Span {
  f64 low, size, rest;  // low: less than a world below where the world begins, or less than a world above that
  f64 shift;  // 0, or the world where low is below its beginning
  bool full;  // it covers the whole axis

  /// `from`: where the world begins, 0 or -world / 2.
  SMALL static Span of(f64 lo, f64 hi, f64 world, f64 from = 0) {
    f64 size = hi - lo, rest = rest_of(lo, hi, size);
    // A box that is infinite, or as long as the world, covers the whole axis.
    if (!(size < world || (size == world && rest < 0))) return {0, world, 0, 0, true};
    f64 low = lo >= from && lo < from + world ? lo : remainder(lo, world);
    if (from < 0 && low >= from + world) low -= world;  // exact, as the sum below
    if (from < 0 && low < from) low += world;
    return {low, size, rest, low < from ? world : 0, false};
  }

  /// By how much hi - lo exceeds its rounded result.
  static f64 rest_of(f64 lo, f64 hi, f64 size) {
    f64 back = size - hi;  // -lo, as far as size holds it
    return (hi - (size - back)) - (lo + back);
  }

  /// Whether it ends behind where another one begins that is shifted by `further`, a whole number of worlds; or just
  /// there, if `touching` counts.
  NOINLINE bool reaches(const Span& other, f64 further, bool touching) const {
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
  Buffer<u32> rules_;  // of both
  Buffer<u32> owners_;  // per place of a ghost: its box or `unowned`; above 24 bits, the axes along which it is shifted
  Buffer<u8> across_;  // per place: the axes along which a box crosses the border, or `at_home`; 0 of ghosts
  const Filters* filters_ = nullptr;  // maps the boxes searched to slots
  const f32* given_ = nullptr;
  const f64* doubles_ = nullptr;
  const f64* world_ = nullptr;
  f64 from_[3] = {};  // where the world begins
  f32 sizes_[4] = {};  // of the world
  u32 dimensions_ = 0, count_ = 0, ghosts_ = 0;
  u32 unused_ = 0, next_unused_ = 0;  // ghosts without a box; none of them is before that place
  bool lost_ = false;  // some box may have lost a ghost
  bool touching_ = true;

 public:
  /// The boxes that are to be searched, and how many there are, with their ghosts. `given`: the boxes by slot, as
  /// float32 and, unless null, as doubles. Also puts the rules of the ghosts behind those of the boxes.
  /// `moved`: the boxes that have changed; adds the ghosts that have. `in_order`: ghosts have to be in the order of their
  /// boxes.
  SMALL const f32* unfold(u32& count, const u32*& rules, Changes& moved, const Filters& filters, const f32* given,
                          const f64* doubles, const f64* world, u32 dimensions, bool in_order) {
    dimensions_ = dimensions;
    filters_ = &filters;
    given_ = given;
    doubles_ = doubles;
    world_ = world;
    for (u32 a = 0; a < dimensions; a++) sizes_[a] = f32(world[a]);
    if (in_order) count_ = ghosts_ = unused_ = 0;
    u32 had = count_;
    if (had == 0) moved.note_all();
    lost_ = count < had;
    make_room(larger(count, had), u64(had) + ghosts_, moved);
    make_way(count, moved);
    count_ = next_unused_ = count;
    choose_beginning(moved);
    u64 held = u64(count) + ghosts_;
    place_boxes(moved);
    make_room(count, held, moved);
    if (lost_) keep_ghosts(moved);
    write_ghosts(moved);
    count += ghosts_;
    if (rules) {
      u32* all = rules_.reserve(count);
      for (u32 k = 0; k < count; k++) all[k] = rule_of(k, rules);
      rules = all;
    }
    return boxes_.data();
  }

  /// Which of these are at home.
  const u8* homes() const { return across_.data(); }

  /// Ghosts to boxes; keeps each overlapping pair once, and those that only touch if that counts. Stable pairs are
  /// of boxes at home, and not in doubt. `noted`: whether the technique has recorded which pairs are in doubt.
  SMALL void fold(Pairs& pairs, bool touching, bool noted) {
    touching_ = touching;
    const bool exact = touching && !doubles_;
    Fold at{pairs.list.data(), pairs.stable, pairs.stable};
    for (u32 k = 0; noted && !exact && k < pairs.doubt_count; k++) {
      fold(at, pairs.doubts[2 * k], false);
      fold(at, pairs.doubts[2 * k + 1], true);
    }
    fold(at, pairs.count, !exact && !noted);
    pairs.count = at.kept;
  }

  SMALL void release() {
    boxes_.release();
    rules_.release();
    owners_.release();
    across_.release();
    count_ = ghosts_ = unused_ = 0;
  }

 private:
  static constexpr u32 most_looked_at = 64;  // boxes
  static constexpr u32 unowned = slot_mask;  // the owner of a ghost that is not used

  struct Fold {
    u64* list;
    u64 next, kept;
  };

  /// Folds the pairs up to this one. `doubt`: two boxes at home may not overlap in the numbers given.
  NOINLINE void fold(Fold& at, u64 until, bool doubt) const {
    const u8* across = across_.data();
    u64* list = at.list;
    u64 next = at.next, kept = at.kept;
    for (; next < until; next++) {
      u64 pair = list[next];
      u32 a = u32(pair), b = u32(pair >> 32);
      if (across[a] & across[b] & at_home) {
        list[kept] = pair;
        kept += !doubt || overlap(a, b);
        continue;
      }
      u32 ghost_a = take_owner(a), ghost_b = take_owner(b);
      list[kept] = pair_of(a, b);
      kept += a != b && larger(a, b) != unowned && is_first(a, ghost_a, b, ghost_b);
    }
    at.next = next;
    at.kept = kept;
  }

  /// Makes room for these boxes and the ghosts. `held`: how many of both are preserved.
  SMALL void make_room(u32 count, u64 held, Changes& moved) {
    const u32 width = 2 * dimensions_;
    u64 all = u64(count) + ghosts_;
    if (all > max_slots) fail(Fault::out_of_memory, f64(all) * width * sizeof(f32));
    boxes_.grow(all * width + 4, held * width);
    moved.make_room(all);
  }

  /// Ghosts leave the places of new boxes, and take those of boxes that are gone: as few of them as possible.
  SMALL void make_way(u32 count, Changes& moved) {
    const u32 width = 2 * dimensions_;
    bool more = count > count_;
    u64 had = u64(count_) + ghosts_, most = u64(larger(count, count_)) + ghosts_;
    owners_.grow(most + 1, had);
    across_.grow(most + 1, had);
    if (most > had) __builtin_memset(across_.data() + had, 0, most - had);
    u32 some = smaller(more ? count - count_ : count_ - count, ghosts_);
    u32 from = more ? count_ : count_ + ghosts_ - some, to = more ? count + ghosts_ - some : count;
    for (u32 k = 0; k < some; k++) {
      owners_[to + k] = owners_[from + k];
      across_[to + k] = 0;
      __builtin_memcpy(&boxes_[u64(to + k) * width], &boxes_[u64(from + k) * width], width * sizeof(f32));
      moved.note(to + k);
    }
  }

  /// Chooses where the world begins along each axis: at minus half its size if many more boxes are inside then.
  SMALL void choose_beginning(Changes& moved) {
    for (u32 a = 0; a < dimensions_; a++) {
      f64 world = world_[a];
      i32 more = 0, looked = 0;
      for (u32 k = 0; k < count_; k += 1 + count_ / most_looked_at, looked++) {
        f64 lo = number(k, a), hi = number(k, dimensions_ + a);
        more += (lo >= -world / 2 && hi < world / 2) - (lo >= 0 && hi < world);
      }
      f64 from = 4 * more > looked ? -world / 2 : 0;
      if (from != from_[a]) moved.note_all();
      from_[a] = from;
    }
  }

  /// Copies the boxes that have changed into the world, and notes which of them cross its border.
  NOINLINE void place_boxes(const Changes& moved) {
    const u32 width = 2 * dimensions_;
    f32x4 above_first, above_last, below_first, below_last;
    ROLLED for (u32 n = 0; n < 4; n++) {
      u32 one = n % dimensions_, other = (width - 4 + n) % dimensions_;
      above_first[n] = round_up(from_[one]);
      above_last[n] = round_up(from_[other]);
      below_first[n] = round_down(from_[one] + world_[one]);
      below_last[n] = round_down(from_[other] + world_[other]);
    }
    const u32* slots = filters_->some() ? filters_->slots() : nullptr;
    f32* boxes = boxes_.data();
    auto inside = [&](u32 k) {
      f32x4 first = load<f32x4>(boxes + u64(k) * width), last = load<f32x4>(boxes + u64(k) * width + width - 4);
      return (first > above_first) & (first < below_first) & (last > above_last) & (last < below_last);
    };
    auto copy = [&](u32 k) {
      const f32* its = given_ + u64(slots ? slots[k] : k) * width;
      f32* box = boxes + u64(k) * width;
      store(box, load<f32x4>(its));
      store(box + width - 4, load<f32x4>(its + width - 4));
    };
    auto look = [&](u32 k) NOINLINE {
      u32 now = bitmask(inside(k)) == 15 ? at_home : place(k, boxes + u64(k) * width), was = across_[k];
      across_[k] = u8(now);
      if ((now | was) & ~at_home) cross(k, was, now);
    };
    for (u32 n = 0; n < moved.count() && !moved.all(); n++) {
      u32 k = moved.list()[n];
      if (k >= count_) continue;
      copy(k);
      look(k);
    }
    if (!moved.all()) return;
    if (!slots) __builtin_memcpy(boxes, given_, u64(count_) * width * sizeof(f32));
    for (u32 k = 0; slots && k < count_; k++) copy(k);
    u32 k = 0;
    for (; k + 4 <= count_; k += 4) {
      i32x4 all = inside(k) & inside(k + 1) & inside(k + 2) & inside(k + 3);
      u8* four = across_.data() + k;
      if (bitmask(all) == 15 && !(load<u32>(four) & 0x07070707)) store(four, at_home * 0x01010101u);
      else
        for (u32 n = k; n < k + 4; n++) look(n);
    }
    for (; k < count_; k++) look(k);
  }

  /// Gives a box the ghosts that it lacks, and notes whether it has too many.
  SMALL void cross(u32 k, u32 was, u32 now) {
    for (u32 some = now & 7; some; some = (some - 1) & now & 7) {  // a ghost for each subset of the axes
      if (!(some & ~was)) continue;
      u32 at = new_ghost();
      owners_[at] = k | some << 24;
      across_[at] = 0;
    }
    lost_ |= (was & ~now & 7) != 0;
  }

  /// The place of a new ghost.
  SMALL u32 new_ghost() {
    if (unused_ == 0) {
      u64 at = u64(count_) + ghosts_++;
      owners_.grow(at + 1, at);
      across_.grow(at + 1, at);
      return u32(at);
    }
    unused_--;
    while (owners_[next_unused_] != unowned) next_unused_++;
    return next_unused_;
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

  /// Takes away the ghosts that boxes no longer have. They stay where they are until another box needs one: a technique
  /// that retains candidates then has no fewer boxes. If more than a quarter are unused, these are removed; the last one
  /// takes the place of each.
  SMALL void keep_ghosts(Changes& moved) {
    for (u32 at = count_; at < count_ + ghosts_; at++) {
      u32 owner = owners_[at] & slot_mask, axes = owners_[at] >> 24;
      if (owner == unowned || (owner < count_ && !(axes & ~u32(across_[owner])))) continue;
      owners_[at] = unowned;
      unused_++;
    }
    if (4 * unused_ <= ghosts_) return;
    for (u32 at = count_ + ghosts_; at-- > count_;) {
      if (owners_[at] != unowned) continue;
      owners_[at] = owners_[count_ + --ghosts_];
      moved.note(at);
    }
    unused_ = 0;
  }

  /// Puts the ghosts behind the boxes, if they have changed.
  SMALL void write_ghosts(Changes& moved) {
    const u32 width = 2 * dimensions_;
    for (u32 at = count_; at < count_ + ghosts_; at++) {
      u32 k = owners_[at] & slot_mask, some = owners_[at] >> 24;
      if (k == unowned || (!moved.has(k) && !moved.has(at))) continue;
      moved.note(at);
      const f32* of = boxes_.data() + u64(k) * width;
      f32* ghost = boxes_.data() + u64(at) * width;
      for (u32 a = 0; a < dimensions_; a++) {
        if (some >> a & 1) {
          shift_back(span(k, a), world_[a], ghost[a], ghost[dimensions_ + a]);
        } else {
          ghost[a] = of[a];
          ghost[dimensions_ + a] = of[dimensions_ + a];
        }
      }
    }
  }

  f64 number(u32 k, u32 n) const {
    u64 at = u64(filters_->slot(k)) * 2 * dimensions_ + n;
    return doubles_ ? doubles_[at] : f64(given_[at]);
  }

  u32 rule_of(u32 k, const u32* rules) const {
    take_owner(k);
    return k == unowned ? 0 : rules[k];
  }

  /// From a ghost to its box; returns the axes along which it is shifted.
  u32 take_owner(u32& k) const {
    if (k < count_) return 0;
    u32 owner = owners_[k];
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

  Span span(u32 k, u32 axis) const {
    f64 lo = number(k, axis), hi = number(k, dimensions_ + axis), world = world_[axis], from = from_[axis];
    f64 size = hi - lo;
    if (size < world && lo > from - world && lo < from + world)
      return {lo, size, Span::rest_of(lo, hi, size), lo < from ? world : 0, false};
    return Span::of(lo, hi, world, from);
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

  /// The box moved into the world, less one world, rounded outward.
  static void shift_back(const Span& span, f64 world, f32& low, f32& high) {
    f64 at = span.low + span.shift - world, more = 2 * slack(world);
    low = round_down(at - more);
    high = round_up(at + span.size + more);
  }

  enum class Rough { no, yes, unclear };

  /// What `is_first` returns, as far as the boxes tell as they stand in the world, rounded.
  Rough is_first_roughly(u32 a, u32 ghost_a, u32 b, u32 ghost_b) const {
    const f32 *first = boxes_.data() + u64(a) * 2 * dimensions_, *second = boxes_.data() + u64(b) * 2 * dimensions_;
    f32x4 past = load<f32x4>(first + dimensions_) - load<f32x4>(second);
    f32x4 back = load<f32x4>(second + dimensions_) - load<f32x4>(first), least = min(past, back);
    f32x4 world = load<f32x4>(sizes_), more = world * splat(0x1p-20f) + splat(1e-30f);  // than may have been rounded
    auto beyond = [&](f32x4 length) { return bitmask(length > world); };
    auto differs = [&](f32x4 length) { return bitmask((length > world + more) | (length < world - more)); };
    // Bits of axes. They do not meet where they stand; then a ghost that was found does reach across: whose?
    u32 apart = bitmask(least < -more), theirs = beyond(back);
    u32 clear = (apart & differs(back) & (theirs | differs(past))) | (~apart & bitmask(least > more));
    u32 wanted_a = apart & ~theirs, wanted_b = apart & theirs, axes = (1u << dimensions_) - 1;
    if (clear & ((ghost_a ^ wanted_a) | (ghost_b ^ wanted_b)) & axes) return Rough::no;
    return ~clear & axes ? Rough::unclear : Rough::yes;
  }

  /// Whether these are the boxes or ghosts by which the pair is to be reported.
  NOINLINE bool is_first(u32 a, u32 ghost_a, u32 b, u32 ghost_b) const {
    Rough rough = is_first_roughly(a, ghost_a, b, ghost_b);
    if (rough != Rough::unclear) return rough == Rough::yes;
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
