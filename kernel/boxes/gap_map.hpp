// A monotone map from the doubles given to numbers that float32 can hold, without the wide gaps between them.
// Idea: a monotone map along each axis keeps the order of bounds. So the search may use mapped numbers, rounded to
// float32: boxes that overlap still overlap in them, and boxes that are strictly apart, or strictly overlap, in them do
// so in the numbers given. Only if two bounds are equal in float32 do the numbers given decide. The map subtracts a
// constant from each piece of an axis, and removes the wide gaps between pieces. So a world far from the origin, or in
// distant clusters, has the full precision of float32. It is chosen from a sample, and any choice is correct: a box in
// a gap that no sample saw is put at the gap's end.
// Cost: 0.3 ns per box without pieces, then a comparison for each piece; 64 samples per axis when it is chosen.
// From: coordinate compression; monotone rounding as in interval arithmetic.
#pragma once
#include "base/box_tests.hpp"
#include "boxes/scene_sample.hpp"

template <int D> class GapMap {
  static constexpr u32 width = 2 * D, most_cuts = 7;
  static constexpr u32 regular = 64, most_others = 512;
  // Another map, or another gap, must make float32's steps this many times as fine to be worth it.
  static constexpr f64 worth = 16;
  // Gaps stay if no more than a sixth of the samples is far from the others, and at most one so far from 0 that float32's
  // steps are more than this share of an ordinary box: searches can do with that.
  static constexpr f64 coarse = 1.0 / 256;
  // A gap that is removed keeps the width of this many boxes of ordinary size, or this share of what is left.
  static constexpr f64 gap_boxes = 4, gap_share = 4;
  static constexpr f32 largest = __FLT_MAX__;

  // Piece p of an axis begins at from[p]; less[p] is subtracted in it; its results are clamped to where the next one
  // begins. For each number of a box, so axes are repeated.
  struct Pieces {
    f64 from[most_cuts + 1][width], less[most_cuts + 1][width], until[most_cuts + 1][width];

    void set(u32 p, u32 axis, f64 begins, f64 subtracts, f64 ends) {
      from[p][axis] = from[p][axis + D] = begins;
      less[p][axis] = less[p][axis + D] = subtracts;
      until[p][axis] = until[p][axis + D] = ends;
    }
  };
  Pieces pieces_ = {};
  u32 piece_count_ = 1;  // largest number on any axis
  bool plain_ = true;  // one piece, and nothing is subtracted

 public:
  SMALL void reset() {
    piece_count_ = 1;
    plain_ = true;
  }

  bool is_plain() const { return plain_; }

  /// What the first piece subtracts from the numbers of a box, for use in a loop; `alone`: there is no other piece.
  struct Less {
    f64x2 of[D];
    bool alone;
  };
  Less less() const {
    Less all;
    for (u32 k = 0; k < D; k++) all.of[k] = plain_ ? f64x2{} : load<f64x2>(pieces_.less[0] + 2 * k);
    all.alone = piece_count_ == 1;
    return all;
  }

  /// A box in float32 as the first piece maps it: its first and its last four numbers.
  static void narrowed(const Less& less, const f64* box, f32x4& first, f32x4& last) {
    f32x4 pairs[D];
    for (u32 k = 0; k < D; k++) pairs[k] = narrow(load<f64x2>(box + 2 * k) - less.of[k]);
    join(pairs, first, last);
  }

  /// Which numbers of a box are not exact in float32.
  static i32x4 rounded(const f64* box) {
    i32x4 which = {};
    for (u32 k = 0; k < D; k++) {
      f64x2 numbers = load<f64x2>(box + 2 * k);
      which |= bits<i32x4>(widen(narrow(numbers)) != numbers);
    }
    return which;
  }

  /// Maps a box and writes it as float32, rounded to the nearest; returns whether it collapses.
  NOINLINE bool round(const f64* box, f32* to) const {
    f32x4 pairs[D], first, last;
    for (u32 k = 0; k < D; k++) {
      f64x2 numbers = load<f64x2>(box + 2 * k);
      pairs[k] = narrow(plain_ ? numbers : shifted(numbers, 2 * k));
    }
    join(pairs, first, last);
    // A finite box with a size in float32 needs no further test.
    if (!is_sized(first, last)) return round_odd(box, first, last, to);
    store_box<D>(to, first, last);
    return false;
  }

  /// Checks many results of `narrowed`: if all boxes are finite and have a size, no further test is needed.
  class Sizes {
    // Compared as integers, so NaN and negative numbers are above all others.
    u32x4 least_ = splat(0xffffffffu), most_ = splat(0u);

   public:
    void see(f32x4 first, f32x4 last) {
      u32x4 size = bits<u32x4>(maxima<D>(first, last) - first);
      least_ = min(least_, size);
      most_ = max(most_, size);
    }
    bool all_are_sized() const {
      for (u32 a = 0; a < D; a++)
        if (least_[a] == 0 || most_[a] > bits<u32>(largest)) return false;
      return true;
    }
  };

  /// The result of rounding many boxes.
  struct Rounded {
    i32 bad = -1;  // the first bad box; those after it are not rounded
    bool inexact = false;  // some numbers are not exact in float32
    u32 collapsed = 0;  // boxes that rounding collapsed along an axis
  };

  /// Writes many boxes as float32: unchanged if all their numbers are exact in float32, otherwise as `round` does.
  NOINLINE Rounded round_all(const f64* from, u32 count, f32* to) const {
    const Less less = this->less();
    bool inexact = false;
    u32 collapsed = 0;
    Sizes sizes;
    for (u32 s = 0; s < count; s++) {
      f32x4 first, last;
      narrowed(less, from + u64(s) * width, first, last);
      inexact = inexact || any(rounded(from + u64(s) * width));
      sizes.see(first, last);
      store_box<D>(to + u64(s) * width, first, last);
    }
    bool quick = less.alone && sizes.all_are_sized();
    for (u32 s = 0; !quick && s < count; s++) {
      if (!is_box(from + u64(s) * width)) return {i32(s), inexact, collapsed};
      collapsed += round(from + u64(s) * width, to + u64(s) * width);
    }
    if (inexact) return {-1, true, collapsed};
    for (u64 k = 0; !(quick && plain_) && k < u64(count) * width; k++) to[k] = f32(from[k]);
    return {};
  }

  /// Whether rounding has collapsed a box along an axis.
  static bool collapses(const f64* box, const f32* rounded) {
    bool is = false;
    for (u32 a = 0; a < D; a++) is |= rounded[a] == rounded[D + a] && box[a] < box[D + a];
    return is;
  }

  /// Maps a number that was given to the one that is searched, not yet rounded.
  f64 map(f64 x, u32 axis) const {
    if (plain_) return x;
    u32 p = 0;
    while (p + 1 < piece_count_ && x >= pieces_.from[p + 1][axis]) p++;
    return smaller(pieces_.until[p][axis], x - pieces_.less[p][axis]);
  }

  /// The inverse: from a number that is searched to the one that was given.
  f64 unmap(f64 x, u32 axis) const {
    if (plain_) return x;
    u32 p = 0;
    while (p + 1 < piece_count_ && x >= pieces_.until[p][axis]) p++;
    return x + pieces_.less[p][axis];
  }

  /// Chooses a map for these boxes, from a sample that includes those in `more`; false if the present one will do.
  SMALL bool choose(const f64* boxes, u32 count, const u32* more, u32 more_count) {
    GapMap other;
    bool better = false;
    for (u32 a = 0; a < D; a++) {
      f64 low[most_others + regular], size[most_others + regular];
      u32 n = 0;
      auto look_at = [&](u32 slot) {
        f64 lo = boxes[u64(slot) * width + a], hi = boxes[u64(slot) * width + D + a];
        if (lo - lo != 0) return;
        low[n] = lo;
        size[n++] = smaller(hi - lo, 1e300);
      };
      Sampling sampling(count, smaller(count, regular));
      for (u32 k = 0; k < smaller(count, regular); k++) look_at(sampling.next());
      for (u32 k = 0; k < smaller(more_count, most_others); k++) look_at(more[k]);
      sort(low, n);
      f64 now = n ? larger(__builtin_fabs(map(low[0], a)), __builtin_fabs(map(low[n - 1], a))) : 0;
      bool is_better = n && now > worth * least_left(low, n);
      if (is_better) {
        sort(size, n);
        bool stay = are_few_far(low, n, size[n / 2] * coarse * 0x1p23, a);
        is_better = now > worth * other.cut(low, n, stay ? 0 : most_cuts, size[n / 2], a);
      }
      better |= is_better;
      if (!is_better) other.take(*this, a);
    }
    if (better) *this = other;
    return better;
  }

  bool operator==(const GapMap& other) const {
    if (plain_ || other.plain_) return plain_ == other.plain_;
    return !differ<sizeof(Pieces)>(&pieces_, &other.pieces_);
  }

 private:
  /// Whether the box has a size along each axis that is neither 0 nor infinite.
  static bool is_sized(f32x4 first, f32x4 last) {
    constexpr u32 axes = (1 << D) - 1;
    f32x4 size = maxima<D>(first, last) - first;
    return (bitmask((size > splat(0.0f)) & (size <= splat(largest))) & axes) == axes;
  }

  static bool is_box(const f64* box) {
    bool good = at_most(load<f64x2>(box), load<f64x2>(box + D)) == 3;
    if constexpr (D == 3) good &= box[2] <= box[5];
    return good;
  }

  SMALL bool round_odd(const f64* box, f32x4 first, f32x4 last, f32* to) const {
    if (any(are_infinite(first) | are_infinite(last))) bound(box, to);
    else store_box<D>(to, first, last);
    return collapses(box, to);
  }

  /// Two numbers of a box, mapped; `number`: the first of them.
  f64x2 shifted(f64x2 x, u32 number) const {
    f64x2 less = load<f64x2>(pieces_.less[0] + number), until = load<f64x2>(pieces_.until[0] + number);
    for (u32 p = 1; p < piece_count_; p++) {
      auto here = x >= load<f64x2>(pieces_.from[p] + number);
      less = here ? load<f64x2>(pieces_.less[p] + number) : less;
      until = here ? load<f64x2>(pieces_.until[p] + number) : until;
    }
    return min(until, x - less);
  }

  static i32x4 are_infinite(f32x4 x) {
    return bits<i32x4>((bits<u32x4>(x) & splat(0x7fffffffu)) == splat(0x7f800000u));
  }

  /// Finite numbers beyond float32 become its largest number. They may then be equal to others, so their pairs are in
  /// doubt. Only infinite ones stay infinite, so differences of bounds are not NaN.
  SMALL void bound(const f64* box, f32* to) const {
    for (u32 n = 0; n < width; n++) {
      bool is_low = n < D;
      f64 given = box[n];
      f32 x = f32(map(given, n % D));
      bool endless = is_low ? given == -__builtin_inf() : given == __builtin_inf();
      to[n] = endless || x != x ? f32(given) : smaller(largest, larger(-largest, x));
    }
  }

  /// Copies an axis from another map.
  SMALL void take(const GapMap& other, u32 axis) {
    for (u32 p = 0; p <= most_cuts; p++) {
      bool is = !other.plain_ && p < other.piece_count_;
      const Pieces& its = other.pieces_;
      if (is) pieces_.set(p, axis, its.from[p][axis], its.less[p][axis], its.until[p][axis]);
      else pieces_.set(p, axis, __builtin_nan(""), 0, __builtin_inf());
    }
    piece_count_ = larger(piece_count_, other.piece_count_);
    plain_ = false;
  }

  /// Whether most of these ascending numbers are close together, and at most one is mapped further than `near` from 0.
  SMALL bool are_few_far(const f64* low, u32 n, f64 near, u32 axis) const {
    u32 few = n / 6, far = 0;
    f64 extent = __builtin_inf();
    for (u32 k = 0; k <= few; k++) extent = smaller(low[k + n - 1 - few] - low[k], extent);
    for (u32 k = 0; k < n; k++) far += __builtin_fabs(map(low[k], axis)) > near;
    return far <= 1 && extent * worth < low[n - 1] - low[0];
  }

  /// A lower bound for what `cut` returns, in less time.
  static f64 least_left(const f64* low, u32 n) {
    f64 widest = 0;
    for (u32 k = 1; k < n; k++) widest = larger(widest, low[k] - low[k - 1]);
    return (low[n - 1] - low[0] - most_cuts * widest) / 2;
  }

  /// Removes up to `most` wide gaps between these ascending numbers from an axis; returns how far from 0 the rest extends.
  SMALL f64 cut(const f64* low, u32 n, u32 most, f64 size, u32 axis) {
    u32 cuts[most_cuts], best = 0;  // indices of numbers with a gap before them, the widest first
    f64 left[most_cuts + 1];  // the extent left after removing that many gaps
    left[0] = low[n - 1] - low[0];
    u32 found = 0;
    for (; found < smaller(most, n - 1); found++) {
      u32 widest = 0;
      for (u32 k = 1; k < n; k++) {
        bool taken = false;
        for (u32 c = 0; c < found; c++) taken |= cuts[c] == k;
        if (!taken && (widest == 0 || low[k] - low[k - 1] > low[widest] - low[widest - 1])) widest = k;
      }
      cuts[found] = widest;
      left[found + 1] = larger(0.0, left[found] - (low[widest] - low[widest - 1]));
    }
    f64 room = gap_boxes * size;
    while (best < found && left[best] > worth * (left[found] + room)) best++;
    for (u32 c = 1; c < best; c++) {  // in ascending order
      for (u32 k = c; k > 0 && cuts[k - 1] > cuts[k]; k--) {
        u32 other = cuts[k];
        cuts[k] = cuts[k - 1];
        cuts[k - 1] = other;
      }
    }
    f64 gap = larger(left[best] / gap_share, room), all = left[best] + 2 * f64(best) * gap, half = all / 2;
    // A multiple of a power of two: coordinates on a grid stay on it.
    f64 grid = bits<f64>(bits<u64>(larger(half, 1e-290)) >> 52 << 52) / 16;
    f64 at = -half;  // where the next piece begins
    for (u32 p = 0; p <= most_cuts; p++) {
      bool is = p <= best;
      f64 from = p == 0 ? low[0] : is ? low[cuts[p - 1]] - gap : __builtin_nan("");
      f64 less = is ? from - at : 0;
      f64 steps = less / grid;
      if (__builtin_fabs(steps) < 0x1p52) less = __builtin_floor(steps + 0.5) * grid;
      pieces_.set(p, axis, from, less, __builtin_inf());
      if (is && p > 0) pieces_.until[p - 1][axis] = pieces_.until[p - 1][axis + D] = from - less;
      if (is && p > 1 && !(pieces_.until[p - 2][axis] <= from - less)) return __builtin_inf();  // not monotone
      if (is && p < best) at = low[cuts[p] - 1] - less + gap;
    }
    piece_count_ = larger(piece_count_, best + 1);
    plain_ = false;
    return half;
  }

  /// Shell sort: short code, few numbers.
  SMALL static void sort(f64* x, u32 n) {
    for (u32 gap = 301; gap > 0; gap = gap / 9 * 4 + gap % 9 / 3) {
      for (u32 k = gap; k < n; k++) {
        f64 mine = x[k];
        u32 to = k;
        for (; to >= gap && x[to - gap] > mine; to -= gap) x[to] = x[to - gap];
        x[to] = mine;
      }
    }
  }
};
