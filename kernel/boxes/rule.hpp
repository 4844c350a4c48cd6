// The rule of a box: which other boxes it meets.
#pragma once
#include "base/simd.hpp"

/// Two boxes meet where each one's layer is in the other's mask and they share no exclusion bit.
struct Rule {
  u32 layer, mask, excluded;

  /// A mark beside the exclusion bits: the box is off, and in no pair and no answer.
  static constexpr u32 off = 2;
  bool is_off() const { return excluded & off; }
  /// Whether it may meet boxes of another space.
  bool meets_some() const { return !is_off() && layer != 0 && mask != 0; }
};

/// The rule of a box that has none of its own.
inline constexpr Rule everybody{0xffffffff, 0xffffffff, 0};

inline bool meet(const Rule& a, const Rule& b) {
  return (a.layer & b.mask) && (b.layer & a.mask) && !(a.excluded & b.excluded);
}
