// Which pairs began and ended with an update.
// Idea: from one update to the next most pairs stay, and many in their order, so the old and the new list are read side
// by side. Where they differ, a table finds the pair in the old list, and reading continues from there. Pairs that are
// not in the old list have begun; pairs of the old list that were not found have ended. The pairs of boxes deleted in
// between have ended, whatever is found now.
// Cost: 2 ns per pair while nothing changes, otherwise about 10 ns; 25 to 33 bytes per pair.
#pragma once
#include "pairs/pair_table.hpp"

/// Flags in the pairs of a snapshot: the box of the smaller or larger id was deleted after the pair was found.
inline constexpr u64 smaller_gone = u64(1) << 31, larger_gone = u64(1) << 63;
/// The pair began with that update; or it ended with it, and is no longer a pair: ended ones come after the others.
inline constexpr u64 has_begun = u64(1) << 30, has_ended = u64(1) << 62;
inline constexpr u64 pair_marks = smaller_gone | larger_gone | has_begun | has_ended;

class Events {
  Pairs before_;  // of the last update
  Buffer<u8> met_;  // per pair of those, whether it is still a pair
  Buffer<u32> gone_;  // a bit per id: deleted since the last update
  u32 gone_words_ = 0;
  bool any_gone_ = false;

 public:
  Pairs began, ended;  // in the order of the new list, and of the old list

  /// Room to record the deletion of ids up to this one.
  SMALL void make_room(u32 id) {
    u32 words = id / 32 + 1;
    if (words <= gone_words_) return;
    gone_.grow(words, gone_words_);
    words = u32(gone_.capacity());
    __builtin_memset(gone_.data() + gone_words_, 0, (words - gone_words_) * sizeof(u32));
    gone_words_ = words;
  }

  /// Records that an id was deleted; there is room for it.
  void forget(u32 id) {
    gone_[id / 32] |= 1u << id % 32;
    any_gone_ = true;
  }

  /// The pairs of the last update, and which of their boxes were deleted since, for a snapshot.
  u64 count() const { return before_.count + ended.count; }
  SMALL void save(u64* to) const {
    u64 next = 0;  // index in `began`, which is in the same order
    for (u64 p = 0; p < ended.count; p++) to[before_.count + p] = ended.list[p] | has_ended;
    for (u64 p = 0; p < before_.count; p++) {
      u64 pair = before_.list[p];
      bool fresh = next < began.count && began.list[next] == pair;
      next += fresh;
      to[p] = pair | (fresh ? has_begun : 0) | (is_gone(u32(pair)) ? smaller_gone : 0) |
              (is_gone(u32(pair >> 32)) ? larger_gone : 0);
    }
  }

  /// Room to restore this many pairs, whose ids are all below `ids`.
  SMALL void stage(u64 pairs, u32 ids) {
    before_.list.grow(larger(pairs, u64(1)), before_.count);
    began.list.grow(larger(pairs, u64(1)), began.count);
    ended.list.grow(larger(pairs, u64(1)), ended.count);
    make_room(ids);
  }
  SMALL void restore(const u64* from, u64 count) {
    if (any_gone_) __builtin_memset(gone_.data(), 0, gone_words_ * sizeof(u32));
    any_gone_ = false;
    before_.count = began.count = ended.count = 0;
    for (u64 p = 0; p < count; p++) {
      u64 pair = from[p] & ~pair_marks;
      if (from[p] & has_ended) {
        ended.list[ended.count++] = pair;
        continue;
      }
      before_.list[before_.count++] = pair;
      if (from[p] & has_begun) began.list[began.count++] = pair;
      if (from[p] & smaller_gone) forget(u32(pair));
      if (from[p] & larger_gone) forget(u32(pair >> 32));
    }
  }

  /// Compares the new list with the old one. `table` finds pairs of the old list, once it is built. If memory runs out,
  /// nothing has changed.
  __attribute__((noinline)) void follow(const Pairs& now, PairTable& table) {
    u64 old_count = before_.count;
    before_.list.grow(larger(now.count, u64(1)), old_count);
    u64* fresh_end = began.list.reserve(now.count + 1);
    u64* ended_end = ended.list.reserve(old_count + 1);
    u8* met = met_.reserve(old_count + 1);
    __builtin_memset(met, 0, old_count);
    const u64* old = before_.list.data();
    began.count = ended.count = 0;
    u64 next = 0;  // in the old list
    for (u64 p = 0; p < now.count; p++) {
      u64 pair = now.list[p];
      u64 at = next;
      if (any_gone_ && is_gone(pair)) {
        at = PairTable::none;
      } else if (at + 1 < old_count && old[at + 1] == pair) {
        at++;  // often it is the next but one: tried before the table
      } else if (at >= old_count || old[at] != pair) {
        if (!table.made) table.make(before_);
        at = table.find(before_, pair);
      }
      if (at == PairTable::none) {
        *fresh_end++ = pair;
      } else {
        met[at] = 1;
        next = at + 1;
      }
    }
    for (u64 p = 0; p < old_count; p++) {
      *ended_end = old[p];
      ended_end += !met[p];
    }
    began.count = u64(fresh_end - began.list.data());
    ended.count = u64(ended_end - ended.list.data());
    if (now.count) __builtin_memcpy(before_.list.data(), now.list.data(), now.count * sizeof(u64));
    before_.count = now.count;
    table.made = false;
    if (any_gone_) __builtin_memset(gone_.data(), 0, gone_words_ * sizeof(u32));
    any_gone_ = false;
  }

 private:
  bool is_gone(u32 id) const { return id / 32 < gone_words_ && gone_[id / 32] >> id % 32 & 1; }
  bool is_gone(u64 pair) const { return is_gone(u32(pair)) || is_gone(u32(pair >> 32)); }
};
