// The list of hits: the smallest of all that are offered, in order, whether it keeps them in order or in a heap.
#include <algorithm>

#include "check.hpp"
#include "questions/hits.hpp"
#include "random.hpp"

TEST("hits are the smallest that were offered, up to a limit and after a given one") {
  Random random(51);
  Hits hits;
  for (u32 most : {1u, 2u, 255u, 256u, 257u, 300u, 1000u, ~0u}) {
    testing::Where where(std::to_string(most) + " hits");
    for (u32 count : {0u, 1u, 200u, 256u, 257u, 700u, 3000u, 3001u}) {
      std::vector<Hit> all;
      for (u32 id = 0; id < count; id++) all.push_back({f64(random.below(count / 2 + 1)), id, 0});
      std::vector<Hit> sorted = all;
      std::sort(sorted.begin(), sorted.end());
      const f64 limit = random.below(3) ? count : random.below(count + 1);
      Hit last = count ? all[random.below(count)] : Hit{};
      for (const Hit* after : {static_cast<const Hit*>(nullptr), static_cast<const Hit*>(&last)}) {
        hits.begin(most, limit, after);
        for (const Hit& hit : all) hits.offer(hit);
        std::vector<Hit> expected = sorted;
        std::erase_if(expected, [&](const Hit& hit) { return hit.rank > limit || (after && !(*after < hit)); });
        if (expected.size() > most) expected.resize(most);
        u32 found = hits.finish();
        CHECK(found == expected.size());
        CHECK(std::equal(expected.begin(), expected.end(), hits.data(), [](const Hit& one, const Hit& other) {
          return one.rank == other.rank && one.id == other.id;
        }));
      }
    }
  }
  hits.release();
}
