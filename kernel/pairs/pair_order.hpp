// Sorts pairs by their slots, for techniques that retain something between updates.
// Idea: what they retain depends on earlier updates, and so would the order of what they find. Sorted, it depends on
// the boxes alone, and a restored space continues like the uninterrupted one. Some keep their pairs sorted too, so that
// only new ones are sorted, and merged with the old.
// Cost: a few pairs are inserted; more are radix-sorted, at about 4 ns per pair and digit, of which there are two unless
// there are far more boxes than pairs; as much memory as the sorted pairs, and two to four counters for each.
#pragma once
#include "pairs/pairs.hpp"

class PairOrder {
  static constexpr u32 few = 24;  // up to this many pairs are sorted by insertion
  static constexpr u32 shortest = 8, longest = 24;  // bits of a digit: few pairs are not worth many counters
  static constexpr u32 most_passes = 2 * ((24 + shortest - 1) / shortest);
  Buffer<u64> spare_;
  Buffer<u32> counts_;

 public:
  /// Pairs as numbers that compare by their smaller slot, then by their larger.
  static u64 key(u64 pair) { return pair << 32 | pair >> 32; }

  /// Sorts pairs of the slots 0 … slots - 1.
  SMALL void sort(u64* list, u64 count, u32 slots) {
    if (count <= few) return insert(list, u32(count));
    u32 bits = 32 - u32(__builtin_clz(slots - 1)), digit = shortest;
    while (digit < longest && count >> (digit - 1)) digit++;
    u32 per_slot = (bits + digit - 1) / digit;
    digit = (bits + per_slot - 1) / per_slot;
    u32 values = 1u << digit, passes = 2 * per_slot, shifts[most_passes];
    for (u32 p = 0; p < passes; p++)
      shifts[p] = (p < per_slot ? 32 : 0) + p % per_slot * digit;  // the larger slot first
    u64* from = list;
    u64* to = spare_.reserve(count);
    u32* counts = counts_.reserve(values);
    for (u32 p = 0; p < passes; p++) {  // an even number of passes, so that the result is in `list`
      __builtin_memset(counts, 0, values * sizeof(u32));
      for (u64 k = 0; k < count; k++) counts[from[k] >> shifts[p] & (values - 1)]++;
      u32 at = 0;
      ROLLED
      for (u32 v = 0; v < values; v++) {
        u32 here = counts[v];
        counts[v] = at;
        at += here;
      }
      for (u64 k = 0; k < count; k++) to[counts[from[k] >> shifts[p] & (values - 1)]++] = from[k];
      u64* done = from;
      from = to;
      to = done;
    }
  }

  SMALL void release() {
    spare_.release();
    counts_.release();
  }

 private:
  static void insert(u64* list, u32 count) {
    for (u32 k = 1; k < count; k++) {
      u64 pair = list[k];
      u32 at = k;
      for (; at > 0 && key(list[at - 1]) > key(pair); at--) list[at] = list[at - 1];
      list[at] = pair;
    }
  }
};
