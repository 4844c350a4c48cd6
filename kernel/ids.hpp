// The user's ids and the kernel's slots.
// Boxes stand densely in slots 0 … count - 1; deleting moves the last one into the gap. As long as the ids are
// just 0 … count - 1 in order (an array's indices), slot and id are the same and nothing is stored. From the
// first gap on, the id of each slot is kept, and the slot of each id in pages of 4,096, so that an id near the
// limit of 2^24 costs a page, not a table of 2^24.
#pragma once
#include "heap.hpp"

class Ids {
  static constexpr u32 page_size = 4096, page_count = 4096;
  bool named_ = false;  // ids are kept; else slot == id for all (all zero, so that it takes no room in the wasm)
  u32 count_ = 0;
  Buffer<u32> id_of_;              // per slot
  Buffer<u32> next_;               // what `replace` puts in its place
  Buffer<u32> pages_[page_count];  // per 4,096 ids: slot + 1 of each, 0 where the id is free

  u32* page(u32 id) {
    Buffer<u32>& found = pages_[id / page_size];
    if (!found.data()) {
      found.reserve(page_size);
      __builtin_memset(found.data(), 0, page_size * sizeof(u32));
    }
    return found.data();
  }

  /// Writes down what was implied so far. Allocates first: when that fails, nothing has changed.
  void spell_out() {
    id_of_.grow(larger(count_, 1u), 0);
    for (u32 id = 0; id < count_; id += page_size) page(id);
    for (u32 id = 0; id < count_; id++) {
      id_of_[id] = id;
      page(id)[id % page_size] = id + 1;
    }
    named_ = true;
  }

  /// Writes to the pages, which are there, in which slots these ids stand, or that they are free.
  COLD void mark(const u32* ids, u32 count, bool on) {
    for (u32 s = 0; s < count; s++) page(ids[s])[ids[s] % page_size] = on ? s + 1 : 0;
  }

 public:
  static constexpr u32 none = 0xffffffff;

  u32 count() const { return count_; }
  bool same() const { return !named_; }
  /// The id of each slot, or null where slot and id are the same.
  const u32* names() const { return named_ ? id_of_.data() : nullptr; }
  /// Of each 4,096 ids: where the slots + 1 of these stand, 0 where none of them was ever used.
  const Buffer<u32>* pages() const { return pages_; }
  u32 id(u32 slot) const { return !named_ ? slot : id_of_[slot]; }

  u32 slot(u32 id) const {
    if (!named_) return id < count_ ? id : none;
    const u32* page = pages_[id / page_size].data();
    return page ? page[id % page_size] - 1 : none;
  }

  /// Gives an id that is not there yet the next slot.
  u32 insert(u32 id) {
    if (!named_ && id != count_) spell_out();
    if (named_) {
      u32* of = page(id);
      id_of_.grow(u64(count_) + 1, count_);
      id_of_[count_] = id;
      of[id % page_size] = count_ + 1;
    }
    return count_++;
  }

  /// Takes an id away. Its slot goes to the id of the last slot, whose content the caller moves.
  void erase(u32 id) {
    if (!named_ && id != count_ - 1) spell_out();
    count_--;
    if (!named_) return;
    u32& gap = pages_[id / page_size][id % page_size];
    u32 moved = id_of_[count_];
    id_of_[gap - 1] = moved;
    pages_[moved / page_size][moved % page_size] = gap;
    gap = 0;
  }

  /// From now on the ids are 0 … count - 1, in this order.
  void reset(u32 count) {
    if (named_) {
      for (auto& page : pages_) page.release();
      id_of_.release();
      next_.release();
    }
    named_ = false;
    count_ = count;
  }

  /// From now on the ids are these, in this order; false, and nothing has changed, where they are not ids or one of
  /// them comes twice.
  COLD bool replace(const u32* ids, u32 count) {
    for (u32 s = 0; s < count; s++) {
      if (ids[s] >= page_size * page_count) return false;
    }
    next_.reserve(larger(count, 1u));
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
    return true;
  }

  /// Whether slots and ids name each other.
  bool valid() const {
    for (u32 s = 0; s < count_; s++) {
      if (slot(id(s)) != s) return false;
    }
    return true;
  }
};
