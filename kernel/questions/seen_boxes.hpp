// A copy of what an update saw, by slot: boxes, ids, rules and reaches, for queries made after changes. Most copies are
// never queried, so doubles are rounded only when an index is built over them, and reaches measured when they are needed.
#pragma once
#include "base/rounding.hpp"
#include "boxes/ids.hpp"
#include "rules/copies.hpp"
#include "rules/filters.hpp"

/// The present contents of a space.
template <int D> struct PresentBoxes {
  const f32* boxes;  // null: the copy gets their memory, see Index::take
  const f64* exact;  // null: all numbers are exact in float32
  const Ids& ids;
  const Rule* rules;  // null: none
  const f64* reaches;  // null: none
  const f64* world;  // its size if it wraps around; else null

  bool rounded() const { return exact || world; }
};

template <int D> struct SeenBoxes {
  static constexpr u32 width = 2 * D;

  Buffer<f32> boxes;  // if `rounded`: rounded outward, once `round_all` was called
  Buffer<f64> exact;
  Buffer<u32> ids;
  Buffer<Rule> rules;
  Buffer<f64> reaches;
  u32 count = 0;
  const f64* world = nullptr;  // if it wraps around: boxes are then in `exact`, and moved into it when rounded
  bool rounded = false, named = false, filtered = false, reached = false;

  /// Whether there is memory for a copy.
  SMALL bool fits(const PresentBoxes<D>& now) const {
    u64 n = now.ids.count(), more = now.rounded() ? exact.missing(n * width) : boxes.missing(n * width + 4);
    if (now.rules) more += rules.missing(n);
    if (now.reaches) more += reaches.missing(n);
    if (!now.ids.same()) more += ids.missing(n);
    return more == 0 || heap::can_spare(more);
  }

  /// Copies the boxes of a space.
  SMALL void see(const PresentBoxes<D>& now) {
    u32 n = now.ids.count();
    world = now.world;
    rounded = now.rounded();
    if (!now.boxes) {
      // The numbers are swapped in.
    } else if (world && !now.exact) {
      exact.reserve(u64(n) * width);
      for (u64 k = 0; k < u64(n) * width; k++) exact[k] = now.boxes[k];
    } else if (rounded) copy(exact, now.exact, u64(n) * width, 0);
    else copy(boxes, now.boxes, u64(n) * width, 4);
    filtered = now.rules;
    if (filtered) copy(rules, now.rules, n, 0);
    reached = now.reaches;
    if (reached) copy(reaches, now.reaches, n, 0);
    most_reach_ = unmeasured;
    named = !now.ids.same();
    if (named) copy(ids, now.ids.names(), n, 0);
    count = n;
  }

  /// Whether a space has the same kinds of data as this copy.
  bool is_like(const PresentBoxes<D>& now) const {
    return reached == !!now.reaches && world == now.world && rounded == now.rounded() && named == !now.ids.same() &&
           filtered == !!now.rules;
  }

  /// Room for n boxes. `both`: in float32 too if they are rounded.
  SMALL void grow(u32 n, bool both) {
    if (both || !rounded) boxes.grow(u64(n) * width + 4, u64(count) * width);
    if (rounded) exact.grow(u64(n) * width, u64(count) * width);
    if (named) ids.grow(n, count);
    if (filtered) rules.grow(n, count);
    if (reached) reaches.grow(n, count);
  }

  /// Copies one slot.
  SMALL void take(u32 s, const PresentBoxes<D>& now) {
    u64 from = u64(s) * width;
    if (rounded) {
      for (u64 k = from; k < from + width; k++) exact[k] = now.exact ? now.exact[k] : f64(now.boxes[k]);
    } else {
      __builtin_memcpy(&boxes[from], now.boxes + from, width * sizeof(f32));
    }
    if (named) ids[s] = now.ids.id(s);
    if (filtered) rules[s] = now.rules[s];
    if (!reached) return;
    reaches[s] = now.reaches[s];
    if (most_reach_ != unmeasured) most_reach_ = larger(most_reach_, reach_of(s));
  }

  /// How far the bounds of a box, with its reach, are at most from its own, rounding included.
  SMALL f64 most_reach() {
    if (!reached) return 0;
    if (most_reach_ != unmeasured) return most_reach_;
    most_reach_ = 0;
    for (u32 s = 0; s < count; s++) most_reach_ = larger(most_reach_, reach_of(s));
    return most_reach_;
  }

  /// Rounds boxes outward; if the world wraps around, moves them into the world first.
  NOINLINE void round(u32 from, u32 end) {
    for (u32 s = from; s < end; s++) {
      const f64* box = &exact[u64(s) * width];
      f32* to = &boxes[u64(s) * width];
      if (world) Copies::place(world, D, box, to);
      else round_outward<D>(box, to);
    }
  }
  /// All of them. `nearest`: they have been rounded to the nearest there, which takes less time to read; null if not.
  NOINLINE void round_all(const f32* nearest) {
    if (!rounded) return;
    f32* to = boxes.reserve(u64(count) * width + 4);
    if (!nearest || world) return round(0, count);
    for (const f32* end = to + u64(count) * width; to < end; to += width, nearest += width)
      loosen<D>(load<f32x4>(nearest), load<f32x4>(nearest + width - 4), to);
  }

  bool is_off(u32 slot) const { return filtered && rules[slot].is_off(); }

 private:
  static constexpr f64 unmeasured = -1;

  f64 most_reach_ = unmeasured;

  /// Adding the reach to a bound rounds the sum, so that it may end up further away than the reach.
  SMALL f64 reach_of(u32 slot) const {
    f64 reach = reaches[slot], most = reach;
    if (reach == 0) return 0;
    for (u64 k = u64(slot) * width; k < (u64(slot) + 1) * width; k++) {
      f64 bound = __builtin_fabs(rounded ? exact[k] : f64(boxes[k]));
      if (bound < __builtin_inf()) most = larger(most, bound);
    }
    return reach + 2 * most * sum_rounding;
  }

  template <class T> static void copy(Buffer<T>& to, const T* from, u64 n, u64 padding) {
    to.reserve(n + padding);
    if (n) __builtin_memcpy(to.data(), from, n * sizeof(T));
  }
};
