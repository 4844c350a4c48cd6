// Which pairs began and ended with an update.
// Idea: from one update to the next most pairs stay, and many in their order, so the old and the new list are read side
// by side. Where they differ, each pair is looked for among the next few of the other list. What is left over of the new
// list is looked up in a table of what is left over of the old one. Pairs that are not there have begun; those of the
// old list that were not found have ended. The pairs of boxes deleted in between have ended, whatever is found now.
// Cost: 2 to 4 ns per pair while most are where they were; about 30 ns if the order is another, 15 if the lists are then
// sorted; 24 bytes per pair, and 9 to 17 for each left over.
#pragma once
#include "pairs/pair_table.hpp"

/// Flags in the pairs of a snapshot: the box of the smaller or larger id was deleted after the pair was found.
inline constexpr u64 smaller_gone = u64(1) << 31, larger_gone = u64(1) << 63;
/// The pair began with that update; or it ended with it, and is no longer a pair: ended ones come after the others.
inline constexpr u64 has_begun = u64(1) << 30, has_ended = u64(1) << 62;
inline constexpr u64 pair_marks = smaller_gone | larger_gone | has_begun | has_ended;

class Events {
  Pairs before_;  // of the last update
  Buffer<u8> met_;  // per pair that is left over of those, whether it is still a pair
  Buffer<u32> gone_;  // a bit per id: deleted since the last update
  u32 gone_words_ = 0;
  bool any_gone_ = false;

 public:
  Pairs began, ended;  // in the order of the new list, and of the old list
  // Most pairs of an update were elsewhere in the list before it. Then it pays to sort the lists that come, at some 10 ns
  // per pair, until candidates are retained: their order is steady.
  bool scattered = false;

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

  /// Compares the new list with the old one. `table`: memory for a table. If memory runs out, the old list stays.
  SMALL void follow(const Pairs& now, PairTable& table) {
    before_.list.grow(larger(now.count, u64(1)), before_.count);
    began.list.reserve(now.count + 1);
    ended.list.reserve(before_.count + 1);
    compare(now);
    u64 left_over = began.count;
    if (began.count > 0 && ended.count > 0) match(table);
    scattered = !now.checked && (scattered || left_over - began.count > now.count / 2);
    if (now.count) __builtin_memcpy(before_.list.data(), now.list.data(), now.count * sizeof(u64));
    before_.count = now.count;
    if (any_gone_) __builtin_memset(gone_.data(), 0, gone_words_ * sizeof(u32));
    any_gone_ = false;
  }

 private:
  static constexpr u64 ahead = 8;  // pairs among which one that is not where it was is looked for

  /// Reads the lists side by side, and collects what is left over of the new list in `began`, of the old one in `ended`.
  NOINLINE void compare(const Pairs& now) {
    const u64 *old = before_.list.data(), *old_end = old + before_.count;
    const u64 *its = now.list.data(), *its_end = its + now.count;
    u64 *fresh = began.list.data(), *left = ended.list.data();
    while (old < old_end && its < its_end) {
      if (*old == *its && !(any_gone_ && is_gone(*its))) {
        old++;
        its++;
        continue;
      }
      bool mixed = 2 * Pairs::between(began.list.data(), fresh) > Pairs::between(now.list.data(), its) + ahead;
      u64 skipped = mixed ? 0 : place(old, old_end, *its), added = mixed || skipped ? 0 : place(its, its_end, *old);
      if (!skipped && !added) skipped = added = 1;
      while (skipped-- > 0) *left++ = *old++;
      while (added-- > 0) *fresh++ = *its++;
    }
    while (old < old_end) *left++ = *old++;
    while (its < its_end) *fresh++ = *its++;
    began.end_at(fresh);
    ended.end_at(left);
  }

  /// Where a pair is among the next few; 0 if it is not there, or the next.
  NOINLINE static u64 place(const u64* from, const u64* end, u64 pair) {
    u64 many = smaller(u64(end - from), ahead);
    ROLLED for (u64 k = 1; k < many; k++) {
      if (from[k] == pair) return k;
    }
    return 0;
  }

  /// Removes from what is left over the pairs that are in both lists.
  NOINLINE void match(PairTable& table) {
    u8* met = met_.reserve(ended.count);
    __builtin_memset(met, 0, ended.count);
    table.make(ended);
    table.made = false;
    u64 left = 0;
    for (u64 p = 0; p < began.count; p++) {
      u64 pair = began.list[p];
      u32 at = any_gone_ && is_gone(pair) ? PairTable::none : table.find(ended, pair);
      if (at == PairTable::none) began.list[left++] = pair;
      else met[at] = 1;
    }
    began.count = left;
    left = 0;
    for (u64 p = 0; p < ended.count; p++) {
      ended.list[left] = ended.list[p];
      left += !met[p];
    }
    ended.count = left;
  }

  bool is_gone(u32 id) const { return id / 32 < gone_words_ && gone_[id / 32] >> id % 32 & 1; }
  bool is_gone(u64 pair) const { return is_gone(u32(pair)) || is_gone(u32(pair >> 32)); }
};
