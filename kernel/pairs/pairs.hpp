// The list of pairs: two slots each, the smaller first.
// Four candidates are written at once without a branch: the lanes that hit are swizzled to the front by a table
// of 16 entries, all four are stored, and the end moves on by the number of hits.
#pragma once
#include "boxes/box.hpp"

/// A pair as it is reported: the smaller slot in the low half.
inline u64 pair_of(u32 a, u32 b) { return u64(smaller(a, b)) | u64(larger(a, b)) << 32; }

struct Pairs {
  Buffer<u64> list;  // in memory: slot a, slot b, slot a, …
  u64 count = 0;
  // The head of the list, as a technique reported it, may stay if all of it is in the next report.
  u64 stable = 0;  // its length
  u64 kept = 0;  // set by a technique: how much of it is as it was after the last update, in ids
  bool same = false;  // set by a technique: the pairs are those of the last update
  bool checked = false;  // set by a technique: no pair is forbidden by what the scene tells of rules and groups

  // A pair is in doubt if two of its bounds are equal in float32: in the numbers given they may be apart.
  bool watch = false;   // whether to record them
  Buffer<u64> doubts;   // ranges that contain pairs in doubt: begin and end of each
  u32 doubt_count = 0;  // ranges

  static constexpr u64 slack = 4;  // the compress-store writes up to four pairs past the end

  /// The number of pairs between two pointers. A pointer difference is signed, and in 32 bits overflows at 2 GiB.
  static u64 between(const u64* from, const u64* to) {
    return (reinterpret_cast<size_t>(to) - reinterpret_cast<size_t>(from)) / sizeof(u64);
  }

  /// Ends the list here.
  void end_at(const u64* out) { count = between(list.data(), out); }

  /// Makes room for `more` pairs after `out`; returns where to continue writing.
  u64* room(u64* out, u64 more) {
    u64 have = between(list.data(), out);
    if (have + more + slack > list.capacity()) return list.grow(have + more + slack, have) + have;
    return out;
  }

  /// Removes the pairs for whose slots `stays` is false.
  template <class Stays> NOINLINE void filter(Stays stays) {
    u64 left = 0;
    u64* pairs = list.data();
    for (u64 k = 0; k < count; k++) {
      u64 pair = pairs[k];
      pairs[left] = pair;
      left += stays(u32(pair), u32(pair >> 32));
    }
    count = left;
  }

  /// Some of the pairs between two places are in doubt.
  NOINLINE void doubt(const u64* from, const u64* until) {
    u64 begin = between(list.data(), from), end = between(list.data(), until);
    if (begin == end) return;
    u64* last = doubts.grow(2 * u64(doubt_count) + 2, 2 * u64(doubt_count)) + 2 * doubt_count;
    if (doubt_count > 0 && last[-1] == begin) {
      last[-1] = end;
      return;
    }
    last[0] = begin;
    last[1] = end;
    doubt_count++;
  }
};

namespace detail {
struct Swizzles {
  u8 of[16][16];
  constexpr Swizzles() : of{} {
    for (int mask = 0; mask < 16; mask++) {
      int to = 0;
      for (int lane = 0; lane < 4; lane++) {
        if (mask >> lane & 1) {
          for (int byte = 0; byte < 4; byte++) of[mask][to * 4 + byte] = u8(lane * 4 + byte);
          to++;
        }
      }
    }
  }
};
alignas(16) inline constexpr Swizzles swizzles;
}  // namespace detail

/// How many lanes there are in a mask of four.
alignas(16) inline constexpr u8 bits_set[16] = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};

/// Those of four numbers whose bit is set in `mask`, in the first lanes.
inline u32x4 packed(u32x4 numbers, u32 mask) {
  return bits<u32x4>(swizzle(bits<u8x16>(numbers), load<u8x16>(detail::swizzles.of[mask])));
}

/// Writes the pairs of four slots with four larger ones; returns the end of as many as there are bits in `mask`.
inline u64* write_pairs(u64* out, u32x4 low, u32x4 high, u32 mask) {
  store(out, __builtin_shufflevector(low, high, 0, 4, 1, 5));
  store(out + 2, __builtin_shufflevector(low, high, 2, 6, 3, 7));
  return out + bits_set[mask];
}

/// Appends the pairs of four slots with four others, lane by lane, if the lane's bit is set in `mask`.
inline u64* append_each(u64* out, u32x4 some, u32x4 others, u32 mask) {
  return write_pairs(out, packed(min(some, others), mask), packed(max(some, others), mask), mask);
}

/// Appends the pairs of slot `mine` with those of the four `others` whose bit is set in `mask`.
inline u64* append(u64* out, u32x4 mine, u32x4 others, u32 mask) {
  u32x4 its = packed(others, mask);
  return write_pairs(out, min(mine, its), max(mine, its), mask);
}
