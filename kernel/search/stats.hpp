// Counters of the last update. JavaScript reads them as one array of doubles, in this order.
#pragma once
#include "base/simd.hpp"

/// Why a technique ran. The comments are the words of `stats.reason`: scripts/abi.mjs takes them from here.
enum class Reason : u32 {
  asked_for,  // asked for
  handful,    // a handful of boxes
  kept,       // candidates are retained: boxes are at rest or move little
  watching,   // full rebuild: how boxes move is being observed
  moving,     // full rebuild: boxes move too far, or there are few
};

struct Stats {
  f64 tests = 0;       // boxes tested against boxes
  f64 candidates = 0;  // pairs found in float32, before the exact test in double
  f64 pairs = 0;       // pairs reported
  f64 cells = 0;       // cells, strips or nodes in use
  f64 entries = 0;     // boxes in all of these: a box may be in several
  f64 bytes = 0;       // of memory in use by the whole space
  f64 technique = 0;   // index of the technique that ran: tells what `auto` chose
  f64 reason = 0;      // and why: a Reason
  f64 address = 0;     // of the list of pairs
};
