// Which boxes have changed since the last update.
// Idea: a list of slots and a bit for each, so that a slot enters once; or, where memory was written past our eyes,
// "all may have". What is not in it is what it was, so an update of a world at rest costs nothing.
// Cost: about 1 ns a call of `set`; 4 bytes and a bit for each box.
#pragma once
#include "heap.hpp"

class Changes {
  Buffer<u32> list_, bits_;
  u32 count_ = 0, words_ = 0;
  bool some_ = false;  // false: all may have changed

 public:
  /// Room for that many slots; nothing is lost where memory ends.
  void make_room(u64 slots) {
    if (slots <= u64(words_) * 32) return;
    u64 words = (slots + 31) / 32;
    list_.grow(words * 32 + 1, count_);  // one more: a slot that is known already is written and not counted
    bits_.grow(words, words_);
    __builtin_memset(bits_.data() + words_, 0, (words - words_) * sizeof(u32));
    words_ = u32(words);
  }

  void note(u32 slot) {
    if (!some_) return;
    u32& word = bits_[slot / 32];
    list_[count_] = slot;
    count_ += ~word >> slot % 32 & 1;
    word |= 1u << slot % 32;
  }

  void note_all() { some_ = false; }

  /// From now on nothing has changed.
  void clear(u32 slots) {
    make_room(slots);
    for (u32 k = 0; k < count_; k++) bits_[list_[k] / 32] = 0;
    count_ = 0;
    some_ = true;
  }

  bool all() const { return !some_; }
  bool none() const { return some_ && count_ == 0; }
  u32 count() const { return count_; }
  const u32* list() const { return list_.data(); }
};
