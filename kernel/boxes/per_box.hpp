// A number per box that most spaces never use. It belongs to the id, and is 0 by default.
// Idea: nothing is stored until the first box has one; then one is stored for each slot.
// Cost: then one number for each slot, free ones included.
#pragma once
#include "boxes/ids.hpp"

template <class T> class PerBox {
  bool some_ = false;     // some box may have a number
  bool changed_ = false;  // since the last update
  Buffer<T> values_;      // per slot
  Buffer<T> staged_;      // the values that `replace` puts in their place

 public:
  bool some() const { return some_; }
  bool changed() const { return some_ && changed_; }
  void updated() { changed_ = false; }
  /// Per slot; null if no box has one.
  const T* data() const { return some_ ? values_.data() : nullptr; }
  T of(u32 slot) const { return some_ ? values_[slot] : T(0); }

  SMALL void clear() { some_ = false; }

  /// Gives a slot a number, with room for `capacity` of them.
  SMALL void set(u32 slot, T value, u64 capacity) {
    if (!some_) values_.reserve(capacity);
    for (u64 s = 0; !some_ && s < capacity; s++) values_[s] = 0;
    some_ = changed_ = true;
    values_[slot] = value;
  }

  /// Room for the values that `replace` puts in place of all.
  SMALL T* stage(u32 count) { return staged_.reserve(larger(count, 1u)); }
  SMALL void replace() {
    values_.swap(staged_);
    some_ = changed_ = true;
  }

  // What happens to slots, as in Store.
  SMALL void make_room(u64 count, u32 keep) {
    if (some_) values_.grow(count, keep);
  }
  u64 room() const { return values_.capacity(); }
  SMALL void insert(u32 slot) { move_in(slot, 0); }
  SMALL void move(u32 from, u32 to) { move_in(to, of(from)); }
  /// After `stage(count)`.
  SMALL void renumber(const Ids& ids, u32 count) {
    if (!some_) return;
    for (u32 id = 0; id < count; id++) {
      u32 slot = ids.slot(id);
      staged_[id] = slot == Ids::none ? T(0) : values_[slot];
    }
    replace();
  }

 private:
  void move_in(u32 slot, T value) {
    if (!some_) return;
    values_[slot] = value;
    changed_ = true;
  }
};
