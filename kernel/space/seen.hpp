// What queries see: the boxes of the last update. While nothing has changed since, these are the boxes themselves; the
// index takes a copy before the first change. Large spaces that were never queried skip the copy, and then cannot
// answer.
#pragma once
#include "boxes/changes.hpp"
#include "questions/index.hpp"

/// What stands in a space, to be copied.
template <int D> struct Standing {
  const f32* boxes;
  const f64* exact;  // null: float32 holds all boxes
  const Ids& ids;
  const Rule* rules;  // null: none
  const f64* reaches;  // null: none
  const f64* world;  // its size, where it wraps around; else null
};

template <int D> class Seen {
  // The index follows one changed box in so many, or as few boxes; more cost more than a new index.
  static constexpr u32 follow_share = 32, follow_least = 8;

  bool asked_ = false;  // ever
  bool holds_ = true;  // the index has what the last update saw: at first, nothing
  bool lost_ = false;  // nobody has

 public:
  // Boxes up to which a copy is made though nobody has asked; and where boxes are written in place, so that it would be
  // made in each update.
  static constexpr u32 spared = 16384, spared_in_place = 4096;

  Index<D> index;

  bool holds() const { return holds_; }
  bool lost() const { return lost_; }

  /// The index takes over what stands in the space.
  void see(const Standing<D>& now) {
    index.see(now.boxes, now.exact, now.ids, now.rules, now.reaches, now.world);
    holds_ = true;
  }

  /// Before a change: what the last update saw is kept, once. `most`: boxes of which a copy is made unasked.
  void hold(const Standing<D>& now, u32 most) {
    if (asked_ || now.ids.count() <= most) see(now);
    else lost_ = holds_ = true;  // holds_: so that it is not asked for again
  }

  /// An update sees what stands in the space, whatever was lost before.
  void begin() {
    if (lost_) holds_ = lost_ = false;
  }

  /// Whether it can follow an update of so many boxes with these changes; if not, it holds nothing any more.
  bool can_follow(const Changes& changes, u32 boxes) {
    holds_ = holds_ && !changes.all() && changes.count() <= larger(boxes / follow_share, follow_least);
    return holds_;
  }
  SMALL void follow(const Standing<D>& now, const Changes& changes) {
    holds_ = index.follow(now.boxes, now.exact, now.ids, now.rules, now.reaches, changes.list(), changes.count(),
                          now.world);
  }
  /// After an update of boxes that are written in place: whoever does so does not say when.
  void see_in_place(const Standing<D>& now) {
    if (!holds_ && (asked_ || now.ids.count() <= spared_in_place)) see(now);
  }

  /// Somebody asks; false where what stands in the space has to be seen first.
  bool ask() {
    asked_ = true;
    return holds_;
  }

  /// What was seen is no more, and of the order of boxes before nothing is to be seen.
  SMALL void restart() {
    holds_ = lost_ = false;
    index.forget();
  }
};
