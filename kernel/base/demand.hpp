// Whether queries are few, so that looking through everything for each costs less than building a structure for them.
// As many as there were before the last change are expected after it.
#pragma once
#include "base/simd.hpp"

struct Demand {
  u32 now = 0, before = 0;  // queries since the last change; between that and the one before it

  void restart() {
    before = now;
    now = 0;
  }

  /// Records a query, or one that takes as long as `work` queries. Whether there are few: `many` are not.
  bool is_low(u32 many, u32 work = 1) {
    bool low = now < many && before <= many;
    now += work;
    return low;
  }
};
