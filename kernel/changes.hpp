// Which boxes have changed since the last update.
// Idea: a list of slots and a bit for each, so that a slot enters once; or, where memory was written past our eyes,
// "all may have". What is not in it is what it was, so an update of a world at rest costs nothing.
// Boxes that come all at once are compared with those of before.
// Cost: about 1 ns a call of `set`, half a nanosecond to compare a box; 4 bytes and a bit for each box.
#pragma once
#include "heap.hpp"

/// Whether so many bytes differ, at least 16.
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

/// The place of the first 8 bytes that differ, from `from` on; `until` where none do. All are multiples of 8.
NOINLINE inline u64 first_difference(const void* one, const void* other, u64 from, u64 until) {
  const u8* a = static_cast<const u8*>(one);
  const u8* b = static_cast<const u8*>(other);
  for (; from + 64 <= until && !differ<64>(a + from, b + from); from += 64) {}
  for (; from < until && load<u64>(a + from) == load<u64>(b + from); from += 8) {}
  return from;
}

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
  /// Whether more than half of so many have: then a list of them is of no use.
  bool most(u32 slots) const { return !some_ || count_ > slots / 2; }
  bool none() const { return some_ && count_ == 0; }
  u32 count() const { return count_; }
  const u32* list() const { return list_.data(); }
};
