// Calls that give a box what is its own beside a filter, as bytes say: part of calls.hpp.
#pragma once
#include "model.hpp"

/// What these calls give: few kinds of it, so that boxes share them.
struct Own {
  u32 group;
  f64 reach;

  template <class Bytes> static Own from(Bytes& bytes) {
    static const u32 groups[] = {0, 1, 1, 2, 3, ~0u};
    static const f64 reaches[] = {0, 0, 1, 0.5, 0.1, 1e-12, 1e300};
    u32 group = groups[bytes.below(u32(std::size(groups)))];
    return {group, bytes.below(3) ? 0 : reaches[bytes.below(u32(std::size(reaches)))]};
  }

  template <int D> void give(Space<D>& space, u32 slot) const { space.put_in_group(slot, group); }
  template <int D> void give_reach(Space<D>& space, u32 slot) const { space.set_reach(slot, reach); }
};
