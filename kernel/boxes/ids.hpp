// The user's ids and the kernel's slots. Boxes are stored densely in slots 0 … count - 1; deleting moves the last one
// into the gap. As long as the ids are just 0 … count - 1 in order (an array's indices), slot and id are the same and
// nothing is stored. From the first gap on, the id of each slot is kept, and the slot of each id in pages of 4,096, so
// that an id near the limit of 2^24 costs a page, not a table of 2^24. Slots are in the order in which boxes were
// added, until one takes the place of another. From then on each has a sequence number; a sort by these gives the ids
// in the order of a Map.
#pragma once
#include "base/radix_sort.hpp"

class Ids {
  static constexpr u32 page_size = 4096, page_count = 4096;
  bool named_ = false;  // ids are stored; else slot == id for all (all zero, so that it takes no room in the wasm)
  u32 count_ = 0;
  Buffer<u32> id_of_;              // per slot
  Buffer<u32> next_;               // the ids that `replace` puts in its place
  Buffer<u32> pages_[page_count];  // per 4,096 ids: slot + 1 of each, 0 where the id is free
  u32 clock_ = 0;                  // the next sequence number; 0: slots are in order
  Buffer<u32> since_;              // per slot, if they are not in order: its sequence number
  RadixSort sort_;

  SMALL u32* page(u32 id) {
    Buffer<u32>& found = pages_[id / page_size];
    if (!found.data()) {
      found.reserve(page_size);
      __builtin_memset(found.data(), 0, page_size * sizeof(u32));
    }
    return found.data();
  }

  /// Stores the ids that were implicit so far. Allocates first: if that fails, nothing has changed.
  SMALL void spell_out() {
    id_of_.grow(larger(count_, 1u), 0);
    for (u32 id = 0; id < count_; id += page_size) page(id);
    for (u32 id = 0; id < count_; id++) {
      id_of_[id] = id;
      page(id)[id % page_size] = id + 1;
    }
    named_ = true;
  }

  /// Gives the slots sequence numbers, for the first time, or again from 0 before they overflow.
  SMALL void number_slots() {
    if (clock_ == 0) {
      since_.reserve(larger(count_, 1u));
      for (u32 s = 0; s < count_; s++) since_[s] = s;
    } else {
      if (count_) sort_slots();
      for (u32 k = 0; k < count_; k++) since_[sort_.index(k)] = k;
      sort_.release();
    }
    clock_ = count_;
  }

  SMALL void sort_slots() {
    sort_.begin(count_);
    for (u32 s = 0; s < count_; s++) sort_.put_bits(s, since_[s]);
    sort_.sort(count_);
  }

  /// Writes the slots of these ids to their pages, which exist, or marks the ids as free.
  SMALL void mark(const u32* ids, u32 count, bool on) {
    for (u32 s = 0; s < count; s++) page(ids[s])[ids[s] % page_size] = on ? s + 1 : 0;
  }

 public:
  static constexpr u32 none = 0xffffffff;
  static constexpr u32 last_number = 0xffffffff;

  u32 count() const { return count_; }
  bool same() const { return !named_; }
  /// The id of each slot, or null if slots and ids are the same.
  const u32* names() const { return named_ ? id_of_.data() : nullptr; }
  /// Per 4,096 ids: the address of their page, which holds slots + 1; 0 if none of these ids was ever used.
  const Buffer<u32>* pages() const { return pages_; }
  u32 id(u32 slot) const { return !named_ ? slot : id_of_[slot]; }

  NOINLINE u32 slot(u32 id) const {
    if (!named_) return id < count_ ? id : none;
    return on_page(id);
  }
  /// The same while ids are stored.
  u32 on_page(u32 id) const {
    const u32* page = pages_[id / page_size].data();
    return page ? page[id % page_size] - 1 : none;
  }

  /// Room for `count` ids, as far as their pages exist.
  SMALL void make_room(u64 count) {
    if (named_) id_of_.grow(count, count_);
    if (clock_) since_.grow(count, count_);
  }
  u64 room() const {
    u64 all = named_ ? id_of_.capacity() : page_size * page_count;
    return clock_ ? smaller(all, since_.capacity()) : all;
  }

  /// Adds an id that is not in use; it gets the next slot.
  u32 insert(u32 id) {
    if (!named_ && id != count_) spell_out();
    if (named_) {
      u32* of = page(id);
      id_of_.grow(u64(count_) + 1, count_);
      if (clock_) {
        since_.grow(u64(count_) + 1, count_);
        if (clock_ == last_number) number_slots();
        since_[count_] = clock_++;
      }
      id_of_[count_] = id;
      of[id % page_size] = count_ + 1;
    }
    return count_++;
  }

  /// Removes an id. Its slot goes to the id of the last slot, whose contents the caller moves.
  SMALL void erase(u32 id) {
    if (!named_ && id != count_ - 1) spell_out();
    if (!clock_ && slot(id) != count_ - 1) number_slots();
    count_--;
    if (!named_) return;
    u32& gap = pages_[id / page_size][id % page_size];
    if (clock_) since_[gap - 1] = since_[count_];
    u32 moved = id_of_[count_];
    id_of_[gap - 1] = moved;
    pages_[moved / page_size][moved % page_size] = gap;
    gap = 0;
  }

  /// Makes the ids 0 … count - 1, in this order.
  void reset(u32 count) {
    if (named_) {
      for (auto& page : pages_) page.release();
      id_of_.release();
      next_.release();
      since_.release();
    }
    named_ = false;
    clock_ = 0;
    count_ = count;
  }

  /// The sequence number of each slot, and the next one; null if slots are in order.
  const u32* since() const { return clock_ ? since_.data() : nullptr; }
  u32 clock() const { return clock_; }

  /// The ids in the order in which they were added.
  SMALL void in_order(Buffer<u32>& to) {
    to.reserve(larger(count_, 1u));
    if (clock_ && count_) sort_slots();
    for (u32 k = 0; k < count_; k++) to[k] = id(clock_ ? sort_.index(k) : k);
    sort_.release();
  }

  /// Replaces the ids by these, added in this order, or as the sequence numbers in `since` say. Returns
  /// false, and changes nothing, if some are not ids or are there twice.
  SMALL bool replace(const u32* ids, u32 count, const u32* since, u32 clock) {
    for (u32 s = 0; s < count; s++) {
      if (ids[s] >= page_size * page_count) return false;
    }
    next_.reserve(larger(count, 1u));
    if (since) since_.grow(larger(count, 1u), clock_ ? count_ : 0);
    for (u32 s = 0; s < count; s++) page(ids[s]);
    mark(names(), names() ? count_ : 0, false);
    for (u32 s = 0; s < count; s++) {
      u32& entry = page(ids[s])[ids[s] % page_size];
      if (entry) {
        mark(ids, s, false);
        mark(names(), names() ? count_ : 0, true);
        return false;
      }
      entry = s + 1;
      next_[s] = ids[s];
    }
    id_of_.swap(next_);
    named_ = true;
    count_ = count;
    clock_ = clock;
    for (u32 s = 0; since && s < count; s++) since_[s] = since[s];
    return true;
  }

  /// Whether slots and ids refer to each other.
  bool valid() const {
    for (u32 s = 0; s < count_; s++) {
      if (slot(id(s)) != s) return false;
    }
    return true;
  }
};
