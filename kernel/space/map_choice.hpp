// Chooses the map from doubles to the float32 that are searched, and decides when another would serve better.
// Idea: gap_map.hpp has the map. A box that rounding collapses into a point along an axis is a needless candidate for
// all boxes there: if there are many such boxes, another map is tried at once, otherwise every 16th update.
#pragma once
#include "boxes/gap_map.hpp"

template <int D> class MapChoice {
  static constexpr u32 width = 2 * D;
  // This many points, even all in one place, add few candidates to an update.
  static constexpr u32 usual_collapsed = 256;
  // Updates between two searches for a better map, and the number of boxes from which on it is worth one.
  static constexpr u32 look_every = 16, worth_a_look = 64;

  GapMap<D> map_;      // plain while boxes are written in place or the world wraps around
  u32 collapsed_ = 0;  // boxes set since the last update that rounding has collapsed along some axis
  u32 bearable_ = usual_collapsed;  // if there are more, another map is tried at once
  u32 look_in_ = 0;  // updates until another map is tried in any case

 public:
  const GapMap<D>& map() const { return map_; }

  SMALL void reset() {
    map_.reset();
    collapsed_ = look_in_ = 0;
    bearable_ = usual_collapsed;
  }

  /// Records how many boxes have collapsed: further ones, or in all.
  void count_more(u32 collapsed) { collapsed_ += collapsed; }
  void count(u32 collapsed) { collapsed_ = collapsed; }

  /// Tries another map, every few updates, or at once if many boxes have collapsed. True if the map was replaced, and
  /// all boxes have to be rounded again. `ordered`: the choice must depend on the present boxes alone; `plain`: then it
  /// must be the plain one.
  SMALL bool look(const f32* boxes, const f64* exact, u32 n, bool ordered, bool plain) {
    u32 collapsed = collapsed_;
    collapsed_ = 0;
    if (ordered) {
      GapMap<D> other;
      if (n >= worth_a_look && !plain) other.choose(exact, n, nullptr, 0);
      if (other == map_) return false;
      map_ = other;
      return true;
    }
    if (n < worth_a_look || (collapsed <= bearable_ && look_in_-- > 0)) return false;
    look_in_ = look_every;
    u32 some[usual_collapsed], many = 0;
    if (collapsed > bearable_) {
      u32 step = collapsed / usual_collapsed + 1, seen = 0;
      for (u32 s = 0; s < n && many < usual_collapsed; s++) {
        if (!map_.collapses(exact + u64(s) * width, boxes + u64(s) * width)) continue;
        if (seen++ % step == 0) some[many++] = s;
      }
    }
    bool better = map_.choose(exact, n, some, many);
    if (better) bearable_ = usual_collapsed;
    else if (collapsed > bearable_) bearable_ = 2 * collapsed;
    return better;
  }
};
