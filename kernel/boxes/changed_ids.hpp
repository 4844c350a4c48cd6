// The ids changed by recent updates, for readers that poll.
// Idea: each update appends the ids it changed, with the slots of their boxes. If more than half may have changed, or the
// list gets longer than the number of boxes, a new epoch begins with an empty list. Each reader remembers the epoch and how
// much of the list it has read.
// Cost: about 1 ns for each box that an update has changed, once there is a reader.
#pragma once
#include "base/heap.hpp"

class ChangedIds {
  Buffer<u32> list_;  // per change the id, and its slot, or `gone`
  Buffer<u32> gone_;  // deleted since the last update
  u32 count_ = 0, gone_count_ = 0, epoch_ = 1;
  bool kept_ = false;
  bool missed_ = false;  // boxes may have been deleted since the last update, before the list was kept

  void add(u32 id, u32 slot) {
    list_.grow(2 * u64(count_) + 2, 2 * count_);
    list_[2 * count_] = id;
    list_[2 * count_++ + 1] = slot;
  }

 public:
  static constexpr u32 gone = 0xffffffff;

  /// Starts to keep a list. Returns the epoch.
  u32 keep() {
    missed_ |= !kept_;
    kept_ = true;
    return epoch_;
  }
  u32 count() const { return count_; }
  const u32* list() const { return list_.data(); }

  /// Records a deleted box.
  SMALL void remove(u32 id) {
    if (!kept_) return;
    gone_.grow(u64(gone_count_) + 1, gone_count_);
    gone_[gone_count_++] = id;
  }

  /// Records the slots that an update of `boxes` boxes has seen change.
  template <class IdOf> SMALL void note(bool all, const u32* slots, u32 many, u32 boxes, IdOf id_of) {
    if (!kept_) return;
    if (all || missed_ || many > boxes / 2 || count_ + gone_count_ + many > boxes) return note_all();
    for (u32 k = 0; k < gone_count_; k++) add(gone_[k], gone);
    for (u32 k = 0; k < many; k++) {
      if (slots[k] < boxes) add(id_of(slots[k]), slots[k]);
    }
    gone_count_ = 0;
  }

  SMALL void note_all() {
    epoch_++;
    count_ = gone_count_ = 0;
    missed_ = false;
  }
};
