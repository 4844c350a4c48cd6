// Memory for many arrays that are made anew in turns, and are read one after the other.
// Idea: an array that is made comes behind the one that was made before it, in chunks; where one has gone nothing comes,
// until its whole chunk is empty and goes back to the heap. So they stand in the order in which they were made, without
// gaps, and who reads them in this order reads memory in one stream, which takes a third to a sixth of reading each where
// the heap happened to have room.
// Cost: a few nanoseconds an array; about twice the memory in use, where all are made anew in turns.
#pragma once
#include "heap.hpp"

class Arena {
  /// Its arrays follow.
  struct alignas(16) Chunk {
    u32 arrays, size_class;
  };

  static constexpr u32 step = 256;  // bytes: what grows by a little need not ask each time

  Chunk* open_ = nullptr;                 // the one that arrays are put into
  u8 *end_ = nullptr, *until_ = nullptr;  // where it is free

 public:
  u32 chunk_bytes = 0;  // but for an array that is larger

  /// Where an array stands; zeros: nowhere.
  struct Place {
    u8* at;
    u32 bytes;
    Chunk* chunk;
  };

  /// Room for so many bytes, of which the first `keep` stay what they are.
  void grow(Place& place, u64 bytes, u64 keep) {
    if (bytes > place.bytes) move(place, bytes, keep);
  }

  /// An array that nobody needs any more.
  COLD void release(Place& place) {
    Chunk* chunk = place.chunk;
    place = {};
    if (!chunk || --chunk->arrays > 0) return;
    if (chunk == open_) end_ = until_ = nullptr;
    heap::give(chunk, chunk->size_class);
  }

 private:
  NOINLINE void move(Place& place, u64 bytes, u64 keep) {
    u8 *from = place.at, *to = end_;
    if (from && from + place.bytes == end_) to = from;  // the last one can grow where it stands
    else if (from) bytes *= 2;                          // one that moves may have to grow again
    bytes = (bytes + step - 1) & ~u64(step - 1);
    if (bytes > u64(until_ - to)) to = open(bytes);
    if (to != from) {
      if (keep) __builtin_memcpy(to, from, keep);
      open_->arrays++;
      release(place);
    }
    place = {to, u32(bytes), open_};
    end_ = to + bytes;
  }

  /// A new chunk, for at least so many bytes.
  u8* open(u64 bytes) {
    u32 c = heap::checked_class(larger(bytes + sizeof(Chunk), u64(chunk_bytes)));
    open_ = static_cast<Chunk*>(heap::take(c));
    *open_ = {0, c};
    until_ = reinterpret_cast<u8*>(open_) + heap::class_bytes(c);
    return reinterpret_cast<u8*>(open_ + 1);
  }
};
