// The partners of each id: the pairs of the last update, by id.
// Idea: each pair is stored twice, once under each of its ids, in buckets by a hash of the id that keeps neighbouring
// ids apart. One counting sort fills them, once there are more than a few queries after an update.
// Cost: about 10 ns per pair to build, 16 bytes per pair and 4 to 8 per bucket; an answer reads one bucket.
#pragma once
#include "pairs/pairs.hpp"

class Partners {
  Buffer<u32> ends_;   // per bucket
  Buffer<u64> pairs_;  // by bucket: an id, and in the high half its partner
  u32 log_ = 0;

  /// Ids below the number of buckets each have their own bucket.
  u32 bucket(u32 id) const { return (id ^ (id >> log_) * 0x9e3779b1u) & ((1u << log_) - 1); }

 public:
  SMALL void build(const Pairs& pairs) {
    log_ = 6;
    while (log_ < 24 && (u64(1) << log_) < 2 * pairs.count) log_++;
    u32 buckets = 1u << log_;
    u32* ends = ends_.reserve(u64(buckets) + 1);
    pairs_.reserve(2 * pairs.count);
    __builtin_memset(ends, 0, (u64(buckets) + 1) * sizeof(u32));
    for (u64 p = 0; p < pairs.count; p++) {
      ends[bucket(u32(pairs.list[p])) + 1]++;
      ends[bucket(u32(pairs.list[p] >> 32)) + 1]++;
    }
    // ends[b] is first where bucket b begins; filling the bucket moves it to the end.
    for (u32 b = 0; b < buckets; b++) ends[b + 1] += ends[b];
    for (u64 p = 0; p < pairs.count; p++) {
      u64 pair = pairs.list[p], swapped = pair >> 32 | pair << 32;
      pairs_[ends[bucket(u32(pair))]++] = pair;
      pairs_[ends[bucket(u32(swapped))]++] = swapped;
    }
  }

  /// Writes the partners of an id, in the order of the pairs; returns how many.
  SMALL u32 of(u32 id, Buffer<u32>& answers) const {
    u32 b = bucket(id), count = 0;
    u32 from = b ? ends_[b - 1] : 0, to = ends_[b];
    answers.reserve(to - from);
    for (u32 k = from; k < to; k++) {
      if (u32(pairs_[k]) == id) answers[count++] = u32(pairs_[k] >> 32);
    }
    return count;
  }
};
