// What an update saw, by slot: boxes, ids, rules and reaches.
// Idea: these are read where the space has them, until it is about to change; only then are they copied. There is no
// copy if the space gives up their memory, as when it replaces all boxes, or if an update takes all changes at once.
// Doubles are rounded only when an index is built over them, and reaches measured when they are needed.
#pragma once
#include "base/rounding.hpp"
#include "boxes/ids.hpp"
#include "rules/copies.hpp"
#include "rules/filters.hpp"

/// The present contents of a space.
struct PresentBoxes {
  const f32* boxes;  // null: the copy gets their memory, see SeenArrays::take
  const f64* exact;  // null: all numbers are exact in float32
  const Ids& ids;
  const Rule* rules;  // null: none
  const f64* reaches;  // null: none
  const f64* world;  // its size if it wraps around; else null
  bool in_place;  // boxes may be written without notice

  bool rounded() const { return exact || world; }
};

/// An array that is read where a space has it, or a copy of it.
template <class T> struct Lent {
  const T* at = nullptr;
  Buffer<T> own;

  const T& operator[](size_t k) const { return at[k]; }
  /// Copies n values; there is room for `padding` more.
  void keep(u64 n, u64 padding = 0) {
    own.reserve(n + padding);
    if (n) __builtin_memcpy(own.data(), at, n * sizeof(T));
    at = own.data();
  }
  /// Room for n values in the copy, of which it has `had`.
  void grow(u64 n, u64 had) { at = own.grow(n, had); }
};

/// What does not depend on the dimension, except for the numbers per box: one copy of this code serves both.
struct SeenArrays {
  const u32 width;

  Lent<f32> boxes;  // if `rounded`: what an index is built from; then room to round boxes outward that change
  Lent<f64> exact;
  Lent<u32> ids;
  Lent<Rule> rules;
  Lent<f64> reaches;
  u32 count = 0;
  const f64* world = nullptr;  // if it wraps around: boxes are then in `exact`, and moved into it when rounded
  bool rounded = false, named = false, filtered = false, reached = false;
  bool lent = false;  // all but rounded boxes are read where the space has it

  constexpr explicit SeenArrays(u32 numbers) : width(numbers) {}

  /// Whether there is memory for a copy.
  SMALL bool fits(const PresentBoxes& now) const {
    u64 n = now.ids.count(), more = now.rounded() ? exact.own.missing(n * width) : boxes.own.missing(n * width + 4);
    if (now.rules) more += rules.own.missing(n);
    if (now.reaches) more += reaches.own.missing(n);
    if (!now.ids.same()) more += ids.own.missing(n);
    return more == 0 || heap::can_spare(more);
  }

  /// Reads the boxes of a space where they are. If they may change without notice, or have to be converted to doubles,
  /// they are copied.
  SMALL void see(const PresentBoxes& now) {
    count = 0;
    world = now.world;
    rounded = now.rounded();
    named = !now.ids.same();
    filtered = now.rules;
    reached = now.reaches;
    most_reach_ = unmeasured;
    lent = true;
    find(now);
    if (now.in_place || (rounded && !now.exact)) keep(now);
    count = now.ids.count();
  }

  /// Finds what is lent again, which may have moved in memory.
  SMALL void find(const PresentBoxes& now) {
    if (!lent) return;
    if (!rounded) boxes.at = now.boxes;
    exact.at = now.exact;
    ids.at = now.ids.names();
    rules.at = now.rules;
    reaches.at = now.reaches;
  }

  /// Copies what is lent, before it changes.
  SMALL void keep(const PresentBoxes& now) {
    if (!lent) return;
    find(now);
    u64 n = now.ids.count();
    if (!now.boxes) {
      // The numbers are swapped in.
    } else if (rounded && !now.exact) {
      exact.at = exact.own.reserve(n * width);
      for (u64 k = 0; k < n * width; k++) exact.own[k] = now.boxes[k];
    } else if (rounded) exact.keep(n * width);
    else boxes.keep(n * width, 4);
    if (filtered) rules.keep(n);
    if (reached) reaches.keep(n);
    if (named) ids.keep(n);
    lent = false;
  }

  /// After `keep` without boxes: takes the memory that they are in.
  template <class Numbers> void take(Numbers& numbers) {
    numbers.give(boxes.own, exact.own);
    if (rounded) exact.at = exact.own.data();
    else boxes.at = boxes.own.data();
  }

  /// Whether a space has the same kinds of data as this copy.
  bool is_like(const PresentBoxes& now) const {
    return reached == !!now.reaches && world == now.world && rounded == now.rounded() && named == !now.ids.same() &&
           filtered == !!now.rules;
  }

  /// Makes room for the boxes that a space has now. `both`: in float32 too if they are rounded.
  SMALL void grow(const PresentBoxes& now, bool both) {
    u64 n = now.ids.count();
    if (rounded && both) boxes.grow(n * width + 4, u64(count) * width);
    if (lent) return find(now);
    if (rounded) exact.grow(n * width, u64(count) * width);
    else boxes.grow(n * width + 4, u64(count) * width);
    if (named) ids.grow(n, count);
    if (filtered) rules.grow(n, count);
    if (reached) reaches.grow(n, count);
  }

  /// Copies one slot, unless it is lent.
  SMALL void take(u32 s, const PresentBoxes& now) {
    for (u64 k = u64(s) * width; !lent && k < (u64(s) + 1) * width; k++) {
      if (!rounded) boxes.own[k] = now.boxes[k];
      else exact.own[k] = now.exact ? now.exact[k] : f64(now.boxes[k]);
    }
    if (named && !lent) ids.own[s] = now.ids.id(s);
    if (filtered && !lent) rules.own[s] = now.rules[s];
    if (reached && !lent) reaches.own[s] = now.reaches[s];
    if (reached && most_reach_ != unmeasured) most_reach_ = larger(most_reach_, reach_of(s));
  }

  /// How far the bounds of a box, with its reach, are at most from its own, rounding included.
  SMALL f64 most_reach() {
    if (!reached) return 0;
    if (most_reach_ != unmeasured) return most_reach_;
    most_reach_ = 0;
    for (u32 s = 0; s < count; s++) most_reach_ = larger(most_reach_, reach_of(s));
    return most_reach_;
  }

  bool is_off(u32 slot) const { return filtered && rules[slot].is_off(); }

  /// Reads what another has, boxes rounded to the nearest.
  SMALL void share(const SeenArrays& other, const f32* nearest) {
    boxes.at = nearest;
    exact.at = other.exact.at;
    ids.at = other.ids.at;
    rules.at = other.rules.at;
    count = other.count;
    rounded = other.rounded;
    named = other.named;
    filtered = other.filtered;
  }

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
};

template <int D> struct SeenBoxes : SeenArrays {
  static constexpr u32 width = 2 * D;

  constexpr SeenBoxes() : SeenArrays(width) {}

  /// Rounds boxes outward; if the world wraps around, moves them into the world first.
  NOINLINE void round(u32 from, u32 end) {
    for (u32 s = from; s < end; s++) {
      const f64* box = &exact[u64(s) * width];
      f32* to = &boxes.own[u64(s) * width];
      if (world) Copies::place(world, D, box, to);
      else round_outward<D>(box, to);
    }
  }
  /// Room for rounded boxes.
  SMALL f32* begin_rounding() {
    f32* to = boxes.own.reserve(u64(count) * width + 4);
    boxes.at = to;
    return to;
  }
};
