// Which boxes have changed since the last update.
// Idea: a list of slots and a mark for each slot, so that it enters once. If memory was written without a call, all may
// have changed. A slot that is not in the list is unchanged, so an update of a world at rest costs nothing. A mark is a
// byte: neighbouring bits would form a dependency chain of reads and writes.
// Cost: about 1 ns for each recorded change; 5 bytes for each box.
#pragma once
#include "base/heap.hpp"

/// Whether two blocks of `bytes` bytes (at least 16) differ.
template <u32 bytes> bool differ(const void* one, const void* other) {
  const u8* a = static_cast<const u8*>(one);
  const u8* b = static_cast<const u8*>(other);
  i32x4 different = {};
  for (u32 k = 0; k < bytes; k += 16) {
    u32 at = smaller(k, bytes - 16);
    different |= load<i32x4>(a + at) ^ load<i32x4>(b + at);
  }
  return any(different);
}

class Changes {
  Buffer<u32> list_;
  Buffer<u8> marks_;
  u32 count_ = 0, room_ = 0;
  bool some_ = false;  // false: all may have changed

 public:
  /// Notes many changes in a row, with the state in registers. `end` writes it back.
  struct Notes {
    u32* list;
    u8* marks;
    u32 count;

    void note(u32 slot) {
      list[count] = slot;
      count += 1 - marks[slot];
      marks[slot] = 1;
    }
  };
  Notes begin() const { return {list_.data(), marks_.data(), count_}; }
  void end(const Notes& notes) { count_ = notes.count; }

  /// Makes room for this many slots; nothing is lost if memory runs out.
  void make_room(u64 slots) {
    if (slots <= room_) return;
    list_.grow(slots + 1, count_);  // one more: a slot that is already listed is written, but not counted
    marks_.grow(slots, room_);
    __builtin_memset(marks_.data() + room_, 0, slots - room_);
    room_ = u32(slots);
  }
  u32 room() const { return room_; }

  SMALL void note(u32 slot) {
    if (!some_) return;
    Notes notes = begin();
    notes.note(slot);
    end(notes);
  }

  void note_all() { some_ = false; }

  /// Empties the list: nothing has changed.
  void clear(u32 slots) {
    make_room(slots);
    if (count_ > room_ / 16) __builtin_memset(marks_.data(), 0, room_);
    else
      for (u32 k = 0; k < count_; k++) marks_[list_[k]] = 0;
    count_ = 0;
    some_ = true;
  }

  bool all() const { return !some_; }
  /// Whether more than half of `slots` slots have changed: then the list is not worth its cost.
  bool most(u32 slots) const { return !some_ || count_ > slots / 2; }
  bool none() const { return some_ && count_ == 0; }
  /// Whether this slot, for which there is room, may have changed.
  bool has(u32 slot) const { return !some_ || marks_[slot]; }
  u32 count() const { return count_; }
  const u32* list() const { return list_.data(); }
};
