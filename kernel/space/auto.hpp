// Which technique `auto` runs in an update, and why. The choices (their wording for users is that of Reason in
// search/stats.hpp):
//   - A handful of boxes: brute force, which costs less than measuring them first.
//   - Otherwise incremental, which uses its candidates while that costs less, and strip sweep while it does not.
//     It decides by counting work, not time.
#pragma once
#include "search/stats.hpp"
#include "space/snapshot.hpp"
#include "space/techniques.hpp"

/// The technique of a new space.
inline constexpr Technique by_default = Technique::automatic;

/// Up to this many boxes, all are tested against all: docs/decisions/0008-small-counts.md has the figures.
inline constexpr u32 handful = 32;

static_assert(!is_built(Technique::automatic) || (is_built(Technique::brute_force) &&
                                                  is_built(Technique::strip_sweep) && is_built(Technique::incremental)),
              "auto stands for brute force, strip sweep and incremental: a build with it has all three");

/// The technique to run for the one asked for.
inline Technique auto_choice(Technique asked, u32 boxes) {
  if (asked != Technique::automatic) return asked;
  return boxes <= handful ? Technique::brute_force : Technique::incremental;
}

/// Records which technique has answered, and why; `incremental` has recorded its own reason.
SMALL inline void say_choice(Technique asked, Technique ran, Stats& stats) {
  stats.technique = f64(u32(ran));
  if (asked != Technique::automatic) stats.reason = f64(u32(Reason::asked_for));
  else if (ran == Technique::brute_force) stats.reason = f64(u32(Reason::handful));
  else if (stats.reason != f64(u32(Reason::kept))) stats.technique = f64(u32(Technique::strip_sweep));
}

/// From a technique to its number in a snapshot, and back.
inline u8 saved_number(Technique name) { return name == Technique::automatic ? SnapshotHeader::automatic : u8(name); }
inline Technique saved_technique(u8 number) {
  return number == SnapshotHeader::automatic ? Technique::automatic : Technique(number);
}
