// What queries see: the boxes of the last update. They are read where the space has them until these change; the index
// copies them before. Large spaces that were never queried skip the copy, and so do those with no memory for it; they
// then cannot answer.
#pragma once
#include "boxes/changes.hpp"
#include "questions/index.hpp"

template <int D> class Seen {
  // The index is updated in place if at most one box in `follow_share` changed, or `follow_least` boxes; with more, a
  // new one costs less.
  static constexpr u32 follow_share = 32, follow_least = 8;

  bool asked_ = false;  // there has been a query
  bool holds_ = true;  // the index has what the last update saw, or reads it: at first, nothing
  bool lost_ = false;  // it has changed, and was not copied

 public:
  // Up to this many boxes, a copy is made even before the first query; fewer if boxes are written in place, when each
  // update makes one.
  static constexpr u32 spared = 16384, spared_in_place = 4096;

  Index<D> index;

  bool lost() const { return lost_; }
  /// Whether `hold` has to be called before a change.
  bool is_open() const { return !lost_ && (!holds_ || index.lent()); }

  /// Sees the present boxes, or where they are now.
  void see(const PresentBoxes& now) {
    if (holds_) return index.find(now);
    index.see(now);
    holds_ = true;
  }

  /// Before the first change since an update: keeps what that update saw. `most`: up to this many boxes are copied even
  /// before the first query. If there is no memory for a copy, there is none: the change itself may make room.
  void hold(const PresentBoxes& now, u32 most) {
    if ((asked_ || now.ids.count() <= most) && index.fits(now)) {
      see(now);
      index.keep(now);
    } else lost_ = true;
  }

  /// An update is about to take changes, and will see them: until it has, nobody can ask.
  void pass() { lost_ |= is_open(); }

  /// An update has seen the present boxes, so an earlier loss no longer matters.
  void end() { lost_ = false; }

  /// Whether the index can be updated in place by these changes; if not, it is out of date.
  bool can_follow(const Changes& changes, u32 boxes) {
    holds_ = holds_ && !changes.all() && changes.count() <= larger(boxes / follow_share, follow_least);
    return holds_;
  }
  void follow(const PresentBoxes& now, const Changes& changes) { holds_ = index.follow(now, changes); }
  /// After an update of boxes that are written in place: a later write is not announced, so they are copied now.
  void see_in_place(const PresentBoxes& now) {
    if (!holds_ && (asked_ || now.ids.count() <= spared_in_place)) see(now);
  }

  /// A query begins.
  void ask() { asked_ = true; }

  /// Forgets what was seen, and the order of boxes in the index.
  SMALL void restart() {
    holds_ = lost_ = false;
    index.forget();
  }
};
