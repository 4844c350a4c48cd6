// A number for each of a few ids, 0 for all others: a hash table with linear probing, at most half full. Ids may be near
// 2^24, and a table by id would then grow memory, which detaches JavaScript's views.
#pragma once
#include "base/heap.hpp"

class IdMarks {
  Buffer<u64> places_;  // the id + 1, above its number; 0: free
  u32 log_ = 0;  // 2^log_ of them; 0: none

  u32 home(u32 id) const { return (id * 0x9e3779b9u) >> (32 - log_); }
  u32 next(u32 at) const { return (at + 1) & ((1u << log_) - 1); }

 public:
  bool has_room(u64 ids) const { return log_ > 0 && 2 * ids <= u64(1) << log_; }
  /// Forgets all, and makes room for this many ids.
  SMALL void begin(u64 ids) {
    u32 log = 6;
    while (u64(1) << log < 2 * ids) log++;
    log_ = 0;  // while there is no memory
    __builtin_memset(places_.reserve(u64(1) << log), 0, sizeof(u64) << log);
    log_ = log;
  }
  SMALL void forget() { log_ = 0; }

  u32 operator[](u32 id) const {
    if (log_ == 0) return 0;
    for (u32 at = home(id); places_[at]; at = next(at)) {
      if (places_[at] >> 32 == id + 1) return u32(places_[at]);
    }
    return 0;
  }
  /// Adds an id that has no number. There must be room for it.
  SMALL void add(u32 id, u32 number) {
    u32 at = home(id);
    while (places_[at]) at = next(at);
    places_[at] = u64(id + 1) << 32 | number;
  }
  SMALL void release() {
    places_.release();
    log_ = 0;
  }
};
