// The radix sort against the standard library's stable sort.
#include "base/radix_sort.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "check.hpp"
#include "random.hpp"

namespace {

using Limits = std::numeric_limits<f32>;

/// Ranks are those of a stable sort: equal keys, both zeros among them, keep their order.
void check_sorted(RadixSort& sort, const std::vector<f32>& keys) {
  u32 n = u32(keys.size());
  sort.begin(n);
  for (u32 k = 0; k < n; k++) sort.put(k, keys[k]);
  sort.sort(n);
  std::vector<u32> order(n);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](u32 a, u32 b) { return keys[a] < keys[b]; });
  bool same = true;
  for (u32 k = 0; k < n; k++) same &= sort.index(k) == order[k];
  CHECK(same);
}

}  // namespace

TEST("radix sort orders all kinds of floats") {
  const f32 special[] = {0.0f,
                         -0.0f,
                         1.0f,
                         -1.0f,
                         Limits::infinity(),
                         -Limits::infinity(),
                         Limits::max(),
                         Limits::lowest(),
                         Limits::min(),
                         -Limits::min(),
                         Limits::denorm_min(),
                         -Limits::denorm_min(),
                         1e-40f,
                         -1e-40f,
                         8388608.0f,
                         16777216.0f};
  RadixSort sort;
  Random random(3);
  for (u32 n : {1u, 2u, 3u, 7u, 16u, 17u, 255u, 1000u, 5000u, 20000u}) {
    std::vector<f32> keys(n);
    for (auto& key : keys) key = special[random.below(std::size(special))];
    check_sorted(sort, keys);
    for (auto& key : keys) {
      do key = bits<f32>(u32(random.bits64()));
      while (key != key);
    }
    check_sorted(sort, keys);
    for (auto& key : keys) key = f32(random.below(50)) - 25;
    check_sorted(sort, keys);
    for (auto& key : keys) key = bits<f32>(0x3f800000 + random.below(4));  // passes with a single value are skipped
    check_sorted(sort, keys);
    std::fill(keys.begin(), keys.end(), -2.5f);
    check_sorted(sort, keys);
  }
}
