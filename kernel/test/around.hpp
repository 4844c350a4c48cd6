// What a query finds in a world, decided naively, box by box: in one that wraps around, by all copies of a box that the
// query may get to.
#pragma once
#include "model.hpp"

template <int D> class Around {
  using Whole = __int128;  // in units of 2^-unit
  static constexpr int unit = 70;
  static constexpr f64 far = 0x1p40;

  const Question<D>& asks_;
  const f64* world_;  // its size along each axis; 0: it does not wrap around
  bool endless_[D];  // the query is as long as the world

  static Whole whole(f64 x) { return Whole(std::ldexp(x, unit)); }
  static Whole floor(Whole a, Whole b) { return a / b - (a % b < 0); }
  /// Whether x is exact in these units.
  static bool is_exact(f64 x) {
    f64 scaled = std::ldexp(x, unit);
    return std::fabs(x) < far && scaled == std::floor(scaled);
  }
  static bool is_endless(f64 lo, f64 hi, f64 world) {
    if (world == 0) return false;
    if (is_exact(lo) && is_exact(hi)) return whole(hi) - whole(lo) >= whole(world);
    return !(hi - lo < 2 * world);
  }

  bool wraps() const { return world_[0] > 0; }

  /// Whether it touches a box along an axis, or has it within.
  UNWATCHED bool touches(u32 a, f64 from, f64 to, bool holds) const {
    f64 lo = asks_.lo[a], hi = asks_.hi[a];
    const bool open = !asks_.touching;
    if (!wraps()) {
      f64 one = holds ? to : from, other = holds ? from : to;
      return open ? one < hi && lo < other : one <= hi && lo <= other;
    }
    if (endless_[a]) return true;
    if (is_endless(from, to, world_[a])) return !holds;
    // Of whole numbers, x < y is x <= y - 1.
    Whole size = whole(world_[a]);
    Whole most = floor(whole(hi) - whole(holds ? to : from) - open, size);
    Whole least = -floor(whole(holds ? from : to) - whole(lo) - open, size);
    return least <= most;
  }

  /// The copies of a box along an axis that the query, which moves by `way`, may get to; perhaps some more.
  std::vector<std::array<f64, 2>> copies(u32 a, f64 from, f64 to, f64 way) const {
    f64 world = world_[a], lo = asks_.lo[a] + smaller(0.0, way), hi = asks_.hi[a] + larger(0.0, way);
    if (!wraps() || endless_[a]) return {{from, to}};
    if (is_endless(from, to, world)) return {{-INFINITY, INFINITY}};
    std::vector<std::array<f64, 2>> all;
    for (f64 n = std::ceil((lo - to) / world) - 1; n <= (hi - from) / world + 1; n++)
      all.push_back({from + n * world, to + n * world});
    return all;
  }

 public:
  Around(const Question<D>& asks, const f64* world) : asks_(asks), world_(world) {
    for (u32 a = 0; a < D; a++) endless_[a] = is_endless(asks.lo[a], asks.hi[a], world[a]);
  }

  /// Whether the numbers of a box allow this model to decide: in a world that does not wrap around all do.
  bool can_decide(const f64* box) const {
    bool good = true;
    for (u32 a = 0; a < D && wraps(); a++)
      good &= (is_exact(box[a]) && is_exact(box[D + a])) || is_endless(box[a], box[D + a], world_[a]);
    return good;
  }
  bool can_decide() const {
    f64 box[2 * D];
    std::copy_n(asks_.lo, D, box);
    std::copy_n(asks_.hi, D, box + D);
    return can_decide(box);
  }

  bool touches(const f64* box, bool holds) const {
    bool all = true;
    for (u32 a = 0; a < D; a++) all &= touches(a, box[a], box[D + a], holds);
    return all;
  }

  /// The distance to the nearest copy of a box, along each axis.
  std::array<f64, D> away(const f64* box) const {
    std::array<f64, D> least;
    for (u32 a = 0; a < D; a++) {
      least[a] = INFINITY;
      if (endless_[a]) least[a] = 0;
      f64 reach = wraps() ? world_[a] : 0;
      for (f64 way : {-reach, reach}) {
        for (auto [from, to] : copies(a, box[a], box[D + a], way))
          least[a] = smaller(least[a], larger(0.0, larger(from - asks_.hi[a], asks_.lo[a] - to)));
      }
    }
    return least;
  }
  /// Without overflow.
  f64 distance(const f64* box) const {
    f64 all = 0;
    for (f64 apart : away(box)) all = std::hypot(all, apart);
    return all;
  }
  f64 squared_distance(const f64* box) const {
    f64 sum = 0;
    for (f64 apart : away(box)) sum += apart * apart;
    return sum;
  }

  /// The first hits of the moving query on a box: several if it meets several copies at once.
  std::vector<Hit> hits(const Box<D>& box, u32 id) const {
    Question<D> moving = asks_;
    f64 limit = asks_.limit, once = INFINITY;
    std::vector<Box<D>> all{box};
    for (u32 a = 0; a < D && wraps(); a++) {
      if (endless_[a]) {
        moving.lo[a] = -INFINITY;
        moving.hi[a] = INFINITY;
        moving.along[a] = 0;
      }
      once = smaller(once, world_[a] / std::fabs(moving.along[a]));
    }
    if (wraps() && !asks_.stops && limit == INFINITY) limit = once * asks_.length;
    for (u32 a = 0; a < D && wraps(); a++) {
      std::vector<Box<D>> before = std::move(all);
      all.clear();
      for (auto [from, to] : copies(a, box[a], box[D + a], moving.along[a] * (limit / asks_.length))) {
        for (Box<D> copy : before) {
          copy[a] = from;
          copy[D + a] = to;
          all.push_back(copy);
        }
      }
    }
    std::vector<Hit> first;
    for (const Box<D>& copy : all) {
      Hit hit;
      if (!moving.hits(copy.data(), id, hit) || !(hit.rank <= limit)) continue;
      if (!first.empty() && first[0] < hit) continue;
      if (!first.empty() && hit < first[0]) first.clear();
      first.push_back(hit);
    }
    return first;
  }
};
