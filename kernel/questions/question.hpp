// A query, and which boxes it is about.
#pragma once
#include "questions/hits.hpp"
#include "questions/index.hpp"
#include "questions/meeting.hpp"

/// The arguments of a query.
template <int D> struct Question {
  f64 lo[D] = {}, hi[D] = {};  // the box, which may be a point
  f64 along[D] = {};  // the displacement of a moving box
  f64 radius = 0;  // of a circle; or one of the codes below
  f64 limit = 0;  // the largest rank
  f64 length = 0;  // of the path, if hits are ranked by distance; 1 if by time
  bool stops = false;  // the caller stops the box at the time of a hit: see meeting.hpp
  bool touching = true;  // for areas: whether touching counts
  u32 mask = 0;  // layers; all bits: every box, even one without a layer
  u32 ignored = 0;  // an id
  u32 layer = 0;  // if a box of another space asks: that box's own layer; else 0

  // Instead of a radius: the query is for a box, or only for boxes wholly within it.
  static constexpr f64 no_circle = -1, within = -2;

  /// Sets `length`. A ray ranks by distance, and its direction is scaled by a power of two, which is exact, so that no
  /// time overflows.
  SMALL void measure_way(bool is_ray) {
    f64 most, sum = 0;
    // The second time for the smallest doubles, which no double could scale up to 1.
    ROLLED for (int n = 0; n < 2; n++) {
      most = 0;
      for (int a = 0; a < D; a++) most = larger(most, __builtin_fabs(along[a]));
      u64 exponent = smaller(bits<u64>(most) >> 52, u64(2045));
      f64 scale = is_ray ? bits<f64>((2046 - exponent) << 52) : 1;
      for (int a = 0; a < D; a++) along[a] *= scale;
      most *= scale;
    }
    for (int a = 0; a < D && most > 0; a++) sum += (along[a] / most) * (along[a] / most);
    length = is_ray ? most * __builtin_sqrt(sum) : 1;
    stops = !is_ray;
  }

  /// From ranks to times estimated in float32.
  f64 scale() const { return (1 + 1e-6) / length; }

  /// How far it moves along an axis up to the limit, and a little further for rounding errors; 0 if it does not.
  f64 reach(int axis) const {
    f64 far = along[axis] * (limit / length) * (1 + 1e-9);
    return far == far ? far : 0;
  }

  /// Writes the bounds of all that it may meet up to the limit, as a box.
  SMALL void path(f64* box) const {
    ROLLED for (int a = 0; a < D; a++) {
      box[a] = lo[a] + smaller(0.0, reach(a));
      box[D + a] = hi[a] + larger(0.0, reach(a));
    }
  }

  /// Writes the bounds of all that is no further from its box than this, as a box.
  SMALL void around(f64 distance, f64* box) const {
    ROLLED for (int a = 0; a < D; a++) {
      box[a] = widened(lo[a], -distance);
      box[D + a] = widened(hi[a], distance);
    }
  }
  /// A bound moved by a distance, and a little further, since differences to it may have been rounded.
  static f64 widened(f64 bound, f64 by) {
    return by == 0 ? bound : bound + by + (by + __builtin_copysign(bound, by)) * 0x1p-49;
  }

  /// How the moving box meets a box; false where it does not.
  NOINLINE bool hits(const f64* box, u32 id, Hit& hit) const {
    Meeting met;
    if (!meets<D>(lo, hi, along, box, stops, met)) return false;
    hit = {met.time * length, id | (met.corner ? Hit::corner : 0), met.side};
    return true;
  }

  /// Whether its box touches another; `whole`: has it within.
  SMALL bool touches(const f64* box, bool whole) const {
    bool touch = true;
    ROLLED for (int a = 0; a < D; a++) {
      f64 one = box[whole ? D + a : a], other = box[whole ? a : D + a];
      touch &= touching ? one <= hi[a] && lo[a] <= other : one < hi[a] && lo[a] < other;
    }
    return touch;
  }

  /// In a world that wraps around, after `measure_way`. A ray without a limit ends after going around once. An infinite
  /// circle is an infinite box, which needs no copies: far away, their numbers overflow.
  SMALL void wrap(const f64* world) {
    bool endless = radius == __builtin_inf();
    if (endless) radius = no_circle;
    Copies::reach_around(world, D, lo, hi, along, endless);
    f64 once = __builtin_inf();
    for (int a = 0; a < D; a++) once = smaller(once, world[a] / __builtin_fabs(along[a]));
    if (!stops && limit == __builtin_inf() && once < limit) limit = once * length;
  }
};

/// Which boxes a query asks for, by its mask and the id it ignores.
template <int D> class Wanted {
  const Index<D>& index_;
  const u32 mask_, ignored_, own_;

 public:
  Wanted(const Index<D>& index, const Question<D>& asked)
      : index_(index), mask_(asked.mask), ignored_(asked.ignored), own_(asked.layer) {}

  /// Whether no box is excluded by its layer or id.
  bool all() const { return ignored_ > slot_mask && (own_ ? !index_.filtered() : mask_ == 0xffffffff); }
  NOINLINE bool operator()(u32 place) const {
    if (own_) return meets(index_.rule(index_.slot(place)));
    return (mask_ == 0xffffffff || (index_.layer(place) & mask_)) && index_.id(place) != ignored_;
  }

 private:
  SMALL bool meets(const Rule& its) const { return (own_ & its.mask) && (its.layer & mask_); }
};
