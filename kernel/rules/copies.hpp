// Queries in a world that wraps around.
// Idea: the index has each box once, moved by whole worlds so that its minimum is inside, and so up to two worlds wide.
// The query is shifted by whole worlds, one turn each, and repeated: by one world back and forth along each axis, and
// along the path of a ray or sweep for as long as it may hit boxes. A box found in several turns is taken from the turn
// of its first or nearest hit: so nothing comes twice, and nothing has to be remembered. Exact: touching is decided as
// for pairs. Distances and times are those to the copy of a box with the numbers min + k * world and max + k * world,
// computed in doubles.
// Cost: up to 9 (2D) or 27 (3D) searches, less those in which an area, a ray or a sweep is beside all boxes; 50 to 80
// ns for each box in an area.
// One copy for 2D and 3D, since it is small code that counts here.
#pragma once
#include "rules/wrap.hpp"

class Copies {
  static constexpr f64 rounding_share = 0x1p-48;  // relative to all numbers: bounds the rounding errors

  const f64 *world_, *lo_, *hi_;
  int axes_ = 0;
  Span span_[3];
  f64 worlds_[3];  // how many worlds the query is away from `span_`
  f64 turn_[3];  // how many worlds it is shifted in this turn
  f64 least_[3], most_[3];  // where the query may meet boxes; never beyond two worlds

 public:
  /// A box: how many worlds it is away from where the index has it, along each axis, and whether it covers that.
  struct Home {
    f64 worlds[3];
    bool full[3];
  };

  /// The number of turns for areas and nearest boxes.
  static constexpr u32 turns(int axes) { return axes == 2 ? 9 : 27; }

  /// A query as long as the world along an axis covers the axis, and moving along it has no effect. `endless`: it is on
  /// all axes.
  SMALL static void reach_around(const f64* world, int axes, f64* lo, f64* hi, f64* along, bool endless) {
    for (int a = 0; a < axes; a++) {
      if (!endless && !Span::of(lo[a], hi[a], world[a]).full) continue;
      lo[a] = -__builtin_inf();
      hi[a] = __builtin_inf();
      along[a] = 0;
    }
  }

  /// Where a box stands in the index, rounded outward.
  SMALL static void place(const f64* world, int axes, const f64* box, f32* to) {
    for (int a = 0; a < axes; a++) {
      f64 lo = box[a], hi = box[axes + a];
      if (lo >= 0 && hi < world[a]) {
        to[a] = round_down(lo);
        to[axes + a] = round_up(hi);
        continue;
      }
      Span span = Span::of(lo, hi, world[a]);
      f64 at = span.low + span.shift, more = at == lo ? 0 : slack_of(lo, hi, world[a]);
      to[a] = span.full ? -__builtin_inff() : round_down(at - more);
      to[axes + a] = span.full ? __builtin_inff() : round_up(at == lo ? hi : at + span.size + more);
    }
  }

  SMALL void begin(const f64* world, int axes, const f64* lo, const f64* hi) {
    world_ = world;
    axes_ = axes;
    lo_ = lo;
    hi_ = hi;
    for (int a = 0; a < axes; a++) {
      span_[a] = Span::of(lo[a], hi[a], world[a]);
      worlds_[a] = worlds_of(lo[a], span_[a], world[a]);
      turn_[a] = 0;
      least_[a] = 0;
      most_[a] = 2 * world[a];
    }
  }

  /// Leaves out turns in which the query, `further` in all directions, meets none of the eight boxes of the root.
  SMALL void limit(const f32* root, f64 further) {
    for (int a = 0; a < axes_; a++) {
      f64 lo = __builtin_inf(), hi = -lo;
      for (int k = 8 * a; k < 8 * a + 8; k++) {
        lo = smaller(lo, f64(root[k]));  // NaN is ignored
        hi = larger(hi, f64(root[8 * axes_ + k]));
      }
      f64 more = further + (further + world_[a]) * 1e-9 + slack_of(lo_[a], hi_[a], 2 * world_[a]);
      least_[a] = larger(least_[a], lo) - more;
      most_[a] = smaller(most_[a], hi) + more;
    }
  }

  /// Takes the n-th turn; false if it would shift along an axis that the query covers.
  SMALL bool take(u32 n) {
    for (int a = 0; a < axes_; a++, n /= 3) {
      turn_[a] = number_of(n % 3);
      if (turn_[a] != 0 && span_[a].full) return false;
    }
    return true;
  }

  /// Whether the query may meet boxes in this turn, if it does not move.
  SMALL bool may_meet() const {
    bool may = true;
    for (int a = 0; a < axes_; a++) {
      f64 low = span_[a].low + span_[a].shift + turn_[a] * world_[a];
      may &= span_[a].full || (low <= most_[a] && low + span_[a].size >= least_[a]);
    }
    return may;
  }

  /// Takes each turn in which a query that moves by `way` may meet boxes, and calls `at`.
  SMALL void pass(const f64* way, void (*at)(void*), void* given, int a = 0, f64 from = 0, f64 until = 1) {
    if (a == axes_) return at(given);
    if (span_[a].full) return pass(way, at, given, a + 1, from, until);
    constexpr f64 more = 1e-9;
    f64 world = world_[a], lo = span_[a].low + span_[a].shift, hi = lo + span_[a].size;
    f64 first = way[a] * from, last = way[a] * until;
    f64 least = __builtin_ceil((least_[a] - (hi + larger(first, last))) / world - more);
    f64 most = __builtin_floor((most_[a] - (lo + smaller(first, last))) / world + more);
    for (f64 n = 0; n <= most - least; n++) {
      f64 turn = way[a] > 0 ? most - n : least + n;  // in the order in which it enters the world
      f64 enter = from, leave = until;
      if (way[a] != 0) {
        f64 one = (least_[a] - hi - turn * world) / way[a], other = (most_[a] - lo - turn * world) / way[a];
        f64 some = more * (1 + __builtin_fabs(one) + __builtin_fabs(other));
        enter = larger(enter, smaller(one, other) - some);
        leave = smaller(leave, larger(one, other) + some);
      }
      turn_[a] = turn;
      if (enter <= leave) pass(way, at, given, a + 1, enter, leave);
    }
  }

  /// By how many worlds the query is shifted along an axis.
  f64 turn(int a) const { return turn_[a]; }

  SMALL bool same_turn(const Copies& other) const {
    bool same = true;
    for (int a = 0; a < axes_; a++) same &= turn_[a] == other.turn_[a];
    return same;
  }

  /// The lower or upper bound of the query in this turn, rounded outward.
  SMALL f64 end(int a, bool upper) const {
    if (span_[a].full) return upper ? __builtin_inf() : -__builtin_inf();
    f64 moved = span_[a].low + span_[a].shift + turn_[a] * world_[a];
    f64 more = slack_of(lo_[a], hi_[a], world_[a] * (2 + __builtin_fabs(turn_[a])));
    return upper ? moved + span_[a].size + more : moved - more;
  }

  /// What is the same in all turns for a box.
  SMALL Home home_of(const f64* box) const {
    Home home;
    for (int a = 0; a < axes_; a++) {
      Span its = Span::of(box[a], box[axes_ + a], world_[a]);
      home.worlds[a] = worlds_of(box[a], its, world_[a]);
      home.full[a] = its.full;
    }
    return home;
  }

  /// Shifts a box that was met in this turn to where the query was asked.
  SMALL void copy(const Home& home, const f64* box, f64* to) const {
    for (int a = 0; a < axes_; a++) copy(a, turn_[a], home, box, to[a], to[axes_ + a]);
  }

  /// Whether the query overlaps a box, or contains it, in this turn and in no earlier one. `touching`: touching is
  /// enough.
  SMALL bool touches(const f64* box, bool holds, bool touching) const {
    for (int a = 0; a < axes_; a++) {
      Span its = Span::of(box[a], box[axes_ + a], world_[a]);
      u32 n = 0;
      while (n < 3 && !touches(a, its, number_of(n), holds, touching)) n++;
      if (n == 3 || number_of(n) != turn_[a]) return false;
    }
    return true;
  }

  /// Whether the query overlaps a box in any turn.
  SMALL bool meets(const f64* box, bool touching) const {
    bool all = true;
    for (int a = 0; a < axes_; a++) {
      Span its = Span::of(box[a], box[axes_ + a], world_[a]);
      bool some = false;
      for (u32 n = 0; n < 3; n++) some |= touches(a, its, number_of(n), false, touching);
      all &= some;
    }
    return all;
  }

  /// The distance of a box along each axis; false if it is nearer in another turn.
  SMALL bool away(const f64* box, f64* to) const {
    Home home = home_of(box);
    for (int a = 0; a < axes_; a++) {
      u32 best = 0;
      for (u32 n = 0; n < 3; n++) {
        f64 lo, hi;
        copy(a, number_of(n), home, box, lo, hi);
        f64 apart = larger(0.0, larger(lo - hi_[a], lo_[a] - hi));
        if (n > 0 && apart >= to[a]) continue;
        to[a] = apart;
        best = n;
      }
      if (number_of(best) != turn_[a]) return false;
    }
    return true;
  }

 private:
  /// By how many worlds the n-th turn shifts along an axis.
  static f64 number_of(u32 n) { return n == 2 ? -1.0 : f64(n); }

  /// At most a world: so far away that it would be more, nothing is exact, but a path must not take turns without end.
  static f64 slack_of(f64 lo, f64 hi, f64 world) {
    return smaller(world, rounding_share * (world + __builtin_fabs(lo) + __builtin_fabs(hi)));
  }

  SMALL static f64 worlds_of(f64 lo, const Span& span, f64 world) {
    if (span.full) return 0;
    return __builtin_floor((lo - span.low) / world + 0.5) - (span.shift > 0 ? 1 : 0);
  }

  void copy(int a, f64 turn, const Home& home, const f64* box, f64& lo, f64& hi) const {
    f64 moved = (worlds_[a] - home.worlds[a] - turn) * world_[a];
    bool countable = moved - moved == 0;  // else a world is less than a rounding error: the box may be anywhere
    lo = home.full[a] ? -__builtin_inf() : countable ? box[a] + moved : lo_[a];
    hi = home.full[a] ? __builtin_inf() : countable ? box[axes_ + a] + moved : hi_[a];
  }

  SMALL bool touches(int a, const Span& its, f64 turn, bool holds, bool touching) const {
    const Span& own = span_[a];
    f64 further = turn * world_[a];
    if (own.full) return true;
    if (holds) return !its.full && its.is_within(own, further, touching);
    return its.full || (its.reaches(own, further, touching) && own.reaches(its, -further, touching));
  }
};
