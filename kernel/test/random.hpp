// Seeded random numbers for the tests (splitmix64): the same on every machine.
#pragma once
#include "base/simd.hpp"

class Random {
  u64 state_;

 public:
  explicit Random(u64 seed) : state_(seed) {}

  u64 bits64() {
    u64 x = state_ += 0x9e3779b97f4a7c15;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    return x ^ (x >> 31);
  }
  /// In [0, 1).
  f64 fraction() { return f64(bits64() >> 11) * 0x1p-53; }
  /// In [0, end).
  u32 below(u32 end) { return u32(bits64() % end); }
};
