// Turns the pairs of slots that a technique found in float32 into the pairs to report. Only pairs with two bounds equal
// in float32 are in doubt: they are tested again with the numbers given.
#pragma once
#include "space/store.hpp"

namespace detail {

/// Writes those pairs that overlap, contiguously; returns the end.
template <int D, bool touching, class T>
NOINLINE u64* retest(const Filters& filters, const T* boxes, const u64* from, const u64* until, u64* to) {
  for (; from < until; from++) {
    u64 pair = *from;
    const T* first = boxes + u64(filters.slot(u32(pair))) * 2 * D;
    const T* second = boxes + u64(filters.slot(u32(pair >> 32))) * 2 * D;
    bool overlap = true;
    for (int k = 0; k < D; k++) {
      overlap &= touching ? first[k] <= second[D + k] && second[k] <= first[D + k]
                          : first[k] < second[D + k] && second[k] < first[D + k];
    }
    *to = pair;
    to += overlap;
  }
  return to;
}

}  // namespace detail

/// Keeps, of the pairs in doubt, those that overlap in the numbers given, enlarged by the reaches. `noted`: whether the
/// technique has recorded which are in doubt; else all are.
template <int D>
SMALL void decide_doubts(Pairs& pairs, const Store<D>& store, const f64* doubles, bool noted, bool touching) {
  const Filters& filters = store.own.filters;
  const f32* boxes = store.numbers.boxes();
  u64* list = pairs.list.data();
  u64 at = pairs.stable, kept = at;  // what is stable is not in doubt
  auto keep = [&](u64 until) {
    if (kept != at && until > at) __builtin_memmove(list + kept, list + at, (until - at) * sizeof(u64));
    kept += until - at;
    at = until;
  };
  bool all = !noted;
  u32 n = store.ids.count();
  if (!touching) all |= some_nowhere<D>(boxes, n);
  for (u32 k = 0; k < (all ? 1 : pairs.doubt_count); k++) {
    if (!all) keep(pairs.doubts[2 * k]);
    u64 until = all ? pairs.count : pairs.doubts[2 * k + 1];
    const u64 *from = list + at, *end = list + until;
    u64* to = list + kept;
    if (!doubles) to = detail::retest<D, false>(filters, boxes, from, end, to);
    else if (touching) to = detail::retest<D, true>(filters, doubles, from, end, to);
    else to = detail::retest<D, false>(filters, doubles, from, end, to);
    kept = Pairs::between(list, to);
    at = until;
  }
  keep(pairs.count);
  pairs.count = kept;
}

/// Removes pairs within a group.
inline void part_groups(Pairs& pairs, const u32* groups) {
  u64 had = pairs.count;
  pairs.filter([&](u32 a, u32 b) { return !one_group(groups[a], groups[b]); });
  if (pairs.count < had) pairs.stable = 0;
}

/// Replaces slots by ids, the smaller first. What is kept has been named before.
NOINLINE inline void name_pairs(Pairs& pairs, const Ids& ids) {
  u64* list = pairs.list.data();
  const u32* names = ids.names();
  for (u64 p = pairs.kept; p < pairs.count; p++) list[p] = pair_of(names[u32(list[p])], names[list[p] >> 32]);
}
