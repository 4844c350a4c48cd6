// Lookups in the pairs of the last update: whether two ids are a pair, and which ids are in a pair with one. Built at
// the first query after an update.
#pragma once
#include "pairs/pair_table.hpp"
#include "pairs/partners.hpp"

class Lookups {
  Partners partners_;
  bool partners_made_ = false;

 public:
  PairTable table;

  /// The pairs have changed.
  void forget() { table.made = partners_made_ = false; }

  SMALL bool is_pair(const Pairs& pairs, u32 a, u32 b) {
    if (pairs.count == 0) return false;
    if (!table.made) table.make(pairs);
    return table.find(pairs, pair_of(a, b)) != PairTable::none;
  }

  /// Writes the partners of an id to `answers`; returns how many.
  SMALL u32 partners(const Pairs& pairs, u32 id, Buffer<u32>& answers) {
    if (!partners_made_) partners_.build(pairs);
    partners_made_ = true;
    return partners_.of(id, answers);
  }
};
