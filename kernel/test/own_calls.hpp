// Calls that give a box what is its own beside a filter, as bytes say: part of calls.hpp.
#pragma once
#include "model.hpp"

/// What these calls give: few kinds of it, so that boxes share them.
struct Own {
  u32 group;

  template <class Bytes> static Own from(Bytes& bytes) {
    static const u32 groups[] = {0, 1, 1, 2, 3, ~0u};
    return {groups[bytes.below(u32(std::size(groups)))]};
  }

  template <int D> void give(Space<D>& space, u32 slot) const { space.put_in_group(slot, group); }
};
