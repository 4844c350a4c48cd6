// Where in a list a pair is: a hash table of positions with linear probing, rebuilt for each list. It holds positions,
// not pairs, so that it fits in the cache; the pair itself is compared in the list.
// Cost: about 5 ns per pair to build, the same for a lookup; 8 to 16 bytes per pair.
#pragma once
#include "pairs/pairs.hpp"

class PairTable {
  Buffer<u32> places_;  // place in the list + 1; 0: free
  u32 log_ = 0;         // 2^log_ of them

  u64 home(u64 pair) const { return (pair * 0x9e3779b97f4a7c15u) >> (64 - log_); }

 public:
  static constexpr u32 none = 0xffffffff;
  bool made = false;

  NOINLINE void make(const Pairs& pairs) {
    u32 log = 6;
    while (u64(1) << log < 2 * pairs.count) log++;
    u32* places = places_.reserve(u64(1) << log);
    __builtin_memset(places, 0, sizeof(u32) << log);
    log_ = log;
    const u64* list = pairs.list.data();
    u64 last = (u64(1) << log) - 1;
    for (u64 p = 0; p < pairs.count; p++) {
      u64 at = home(list[p]);
      while (places[at]) at = (at + 1) & last;
      places[at] = u32(p) + 1;
    }
    made = true;
  }

  /// The place of a pair in the list that the table was made for, or `none`.
  u32 find(const Pairs& pairs, u64 pair) const {
    const u32* places = places_.data();
    const u64* list = pairs.list.data();
    u64 last = (u64(1) << log_) - 1;
    for (u64 at = home(pair); places[at]; at = (at + 1) & last) {
      if (list[places[at] - 1] == pair) return places[at] - 1;
    }
    return none;
  }
};
