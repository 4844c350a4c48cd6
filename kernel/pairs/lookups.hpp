// Lookups in the pairs of the last update: whether two ids are a pair, and which ids are in a pair with one. The first
// few after an update look through all pairs; if there are more, tables are built.
#pragma once
#include "base/demand.hpp"
#include "pairs/pair_table.hpp"
#include "pairs/partners.hpp"

class Lookups {
  static constexpr u32 scans_per_table = 8;  // building one takes as long

  Partners partners_;
  bool partners_made_ = false;
  Demand for_pair_, for_partners_;

 public:
  PairTable table;

  /// The pairs have changed.
  void forget() {
    table.made = partners_made_ = false;
    for_pair_.restart();
    for_partners_.restart();
  }

  SMALL bool is_pair(const Pairs& pairs, u32 a, u32 b) {
    u64 pair = pair_of(a, b);
    if (for_pair_.is_low(scans_per_table) && !table.made) {
      const u64* list = pairs.list.data();
      u64 at = 0;
      while (at < pairs.count && list[at] != pair) at++;
      return at < pairs.count;
    }
    if (pairs.count == 0) return false;
    if (!table.made) table.make(pairs);
    return table.find(pairs, pair) != PairTable::none;
  }

  /// Writes the partners of an id to `answers`; returns how many.
  NOINLINE u32 partners(const Pairs& pairs, u32 id, Buffer<u32>& answers) {
    if (!for_partners_.is_low(scans_per_table) || partners_made_) {
      if (!partners_made_) partners_.build(pairs);
      partners_made_ = true;
      return partners_.of(id, answers);
    }
    const u64* list = pairs.list.data();
    u32 count = 0;
    for (u64 p = 0; p < pairs.count; p += 2) {
      i32x4 has = load<u32x4>(list + p) == splat(id);  // there is room for an even number of pairs
      if (!any(has)) continue;
      for (u64 k = p; k < smaller(p + 2, pairs.count); k++) {
        u32 one = u32(list[k]), other = u32(list[k] >> 32);
        if (one != id && other != id) continue;
        answers.grow(u64(count) + 1, count);
        answers[count++] = one == id ? other : one;
      }
    }
    return count;
  }
};
