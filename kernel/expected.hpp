// Which boxes are not where a technique expects them that keeps what it has found.
// Idea: one that moves is expected in its fat box, one at rest where it was. Four are looked at together, and give a bit
// each; where some rest, those that move are gone through afterwards, by their bits, since who does nobody could guess.
// Where most rest it is not even read who does: one that is exactly where it is expected to be is so in either case.
// Cost: about a nanosecond a box; where there are more than the caches hold, what it takes to read them and the fat ones.
#pragma once
#include "motion.hpp"

template <int D> struct Expected {
  static constexpr u32 width = 2 * D;
  static constexpr u32 rests = 1;  // in a tag; with another bit above it, and below the exclusion bits, it rests too
  const f32* boxes;  // per slot: its fat one, or itself
  const u32* tags;   // per slot: exclusion bits, and whether it rests
  bool filtered;     // some may have or have had exclusion bits

  /// Whether it is a box, where it is expected, and has the exclusion bits it had.
  bool holds(const Scene<D>& scene, u32 slot) const {
    const f32 *box = scene.box(slot), *its = boxes + u64(slot) * width;
    u32 tag = tags[slot] ^ scene.excluded_of(slot);
    if (tag == 0) return bitmask(in(box, its)) == 15;
    return (tag & rests) && tag <= slot_mask && bitmask(alike<D>(box, its)) == 15;
  }

  /// Writes the slots below `until` for which it does not hold, of those that may have changed or of all; gives how many.
  /// Of all they are ascending.
  NOINLINE u32 look(const Scene<D>& scene, u32 until, bool all, Buffer<u32>& out) const {
    u32* odd = out.reserve(u64(until) + 1);
    u32 found = 0;
    auto look_at = [&](u32 slot) {
      if (!holds(scene, slot)) odd[found++] = slot;
    };
    if (!all && scene.listed()) {
      for (u32 k = 0; k < scene.changes->count(); k++) {
        if (scene.changes->list()[k] < until) look_at(scene.changes->list()[k]);
      }
      return found;
    }
    for (u32 slot = 0; slot < until; slot += 64) {
      u64 good = 0;  // a bit each
      u32 many = smaller(until - slot, 64u);
      bool still = many == 64 && !filtered && most_rest(slot);
      for (u32 k = 0; k + 4 <= many; k += 4) {
        const f32 *box = scene.box(slot + k), *its = boxes + u64(slot + k) * width;
        i32x4 four;
        if (still) {
          four = each(box, its, alike<D>);
        } else {
          u32x4 tag = load<u32x4>(tags + slot + k);
          if (scene.excluded) tag ^= load<u32x4>(scene.excluded + slot + k);
          if (any(bits<i32x4>(tag))) four = each(box, its, alike<D>) & bits<i32x4>(tag == splat(rests));
          else four = each(box, its, in);
        }
        good |= u64(bitmask(four)) << k;
      }
      for (u64 left = ~good & ~u64(0) >> (64 - many); left; left &= left - 1) look_at(slot + u32(__builtin_ctzll(left)));
    }
    return found;
  }

 private:
  /// Whether most of the four from a slot on do.
  bool most_rest(u32 slot) const {
    u32x4 four = load<u32x4>(tags + slot) & splat(rests);
    return four[0] + four[1] + four[2] + four[3] > 2;
  }

  /// In each lane, whether a test of the box of that number holds in all of its lanes.
  template <class Test> static i32x4 each(const f32* box, const f32* its, Test test) {
    return all_lanes(test(box, its), test(box + width, its + width), test(box + 2 * width, its + 2 * width),
                     test(box + 3 * width, its + 3 * width));
  }

  static i32x4 in(const f32* box, const f32* fat) { return sides_inside<D>(box, fat) & axes_in_order<D>(box); }
};
