// The index for queries: the boxes of the last update in a packed tree.
// Idea: boxes in the order of their centres along the Hilbert curve, eight to a block, and blocks of eight blocks above
// them, to one root: an R-tree without pointers. A block is read as vectors, eight boxes at a time. The order is laid
// over the extents without outliers, so that one far box does not spoil it. Boxes that are off are not in it. If an
// update knows that few boxes changed, the index is updated in place: a box that stays within the bounds of its block
// is written there, and one that leaves them, or is new, goes to the spare blocks at the end. It leaves a hole. When
// there is no spare place left, or many boxes changed, the index is rebuilt, unless queries are few and each scans all
// boxes instead (scan.hpp). It retains the previous order while boxes in one block are still close together, and
// while queries visit few more blocks than right after boxes were sorted (wear.hpp).
// Cost: about 27 (2D) or 30 (3D) ns per box to build, less than half of it with the previous order; 0.1 us for each box
// updated in place; 28 (2D) or 38 (3D) bytes per box, and 16 or 24 more for boxes in doubles. If boxes change after the
// update, also a copy of them, so that queries see those of the last update.
// From: I. Kamel and C. Faloutsos, "On Packing R-trees", CIKM 1993.
#pragma once
#include "base/demand.hpp"
#include "questions/seen_boxes.hpp"
#include "questions/wear.hpp"
#include "search/hilbert.hpp"

template <int D> class Index {
  static constexpr u32 width = 2 * D;
  static constexpr u32 most_levels = 9;  // 8^8 boxes, and spare places
  static constexpr f32 nothing = __builtin_nanf("");
  static constexpr u32 sampled = 256;  // groups of eight, sampled to judge an order
  // Building it takes as long as this many scans of all boxes, with the previous order.
  static constexpr u32 scans_per_build = 3;
  static constexpr f32 most_wider = 2;  // how many times as wide they may become before boxes are sorted again

  SeenBoxes<D> seen_;
  bool built_ = false;
  Buffer<u32> slots_;  // per place in the order
  Buffer<u32> placed_ids_;  // the same as ids, while `seen_.named`
  Buffer<u32> places_;  // per slot, its place
  u32 sorted_ = 0, used_ = 0, room_ = 0;  // ends of places: of sorted boxes, of those added after them, of spare ones
  bool holes_ = false;
  u32 known_ = 0;  // slots that have an entry in `places_`
  Wear wear_;
  f32 width_ = 0;  // mean width of groups when boxes were sorted
  Demand demand_;
  RadixSort sort_;

 public:
  /// Numbers in a row: see `write_row`.
  static constexpr u32 row = width + 3;
  /// The place of a box that is off.
  static constexpr u32 nowhere = 0xffffffff;
  /// Eight boxes; NaN for unused lanes.
  struct Block {
    f32 lo[D][8], hi[D][8];
  };

 private:
  Buffer<Block> blocks_;  // the boxes, then the blocks of each level above
  u32 first_[most_levels] = {};  // of each level
  u32 levels_ = 0;

 public:
  u32 count() const { return seen_.count; }
  /// The number of places that may hold boxes, and whether some of them are empty.
  u32 places() const { return used_; }
  bool holes() const { return holes_; }
  /// The level of the root, which is one block; level 0 has the boxes.
  u32 top() const { return levels_ - 1; }
  const Block& block(u32 level, u32 number) const { return blocks_[first_[level] + number]; }

  /// The size of the world if it wraps around; else null.
  const f64* world() const { return seen_.world; }
  /// Whether some numbers are not exact in float32.
  bool rounded() const { return seen_.rounded; }
  u32 id(u32 place) const { return ids()[place]; }
  u32 place(u32 slot) const { return places_[slot]; }
  u32 id_of_slot(u32 slot) const { return seen_.named ? seen_.ids[slot] : slot; }
  /// Of all places.
  const u32* ids() const { return seen_.named ? placed_ids_.data() : slots_.data(); }
  /// By slot: the rule of a box.
  Rule rule(u32 slot) const { return seen_.filtered ? seen_.rules[slot] : everybody; }
  /// Writes the box in a slot, enlarged by its reach and with its maxima negated, two numbers at a time.
  void turned_box(u32 slot, f64x2* to) const {
    f64 reach = seen_.reached ? seen_.reaches[slot] : 0;
    for (u32 k = 0; k < D; k++) {
      u64 from = u64(slot) * width + 2 * k;
      f64x2 bounds = seen_.rounded ? load<f64x2>(&seen_.exact[from])
                                   : widen(bits<f32x4>(f64x2{load<f64>(&seen_.boxes[from]), 0}));
      f64x2 sign = {2 * k < D ? 0.0 : -0.0, 2 * k + 1 < D ? 0.0 : -0.0};
      to[k] = bits<f64x2>(bits<u64x2>(bounds) ^ bits<u64x2>(sign)) - splat(reach);
    }
  }
  /// Writes a row: the id, or -1 if the box meets nobody, this box, its layer and its mask.
  SMALL void write_row(u32 slot, f64* to) const {
    to[0] = -1;
    if (slot >= count()) return;
    Rule its = rule(slot);
    if (!its.meets_some()) return;
    f64x2 box[D];
    turned_box(slot, box);
    __builtin_memcpy(to + 1, box, sizeof(box));
    to[0] = id_of_slot(slot);
    to[width + 1] = its.layer;
    to[width + 2] = its.mask;
  }
  bool filtered() const { return seen_.filtered; }
  /// An upper bound for how far boxes reach.
  f64 most_reach() { return seen_.most_reach(); }
  u32 slot(u32 place) const { return slots_[place]; }
  const u32* slots() const { return slots_.data(); }
  u32 layer(u32 place) const { return seen_.filtered ? seen_.rules[slots_[place]].layer : 0xffffffff; }
  /// The numbers the box was given with.
  NOINLINE void box(u32 place, f64* to) const {
    if (seen_.rounded) {
      __builtin_memcpy(to, seen_.exact.at + u64(slots_[place]) * width, width * sizeof(f64));
      return;
    }
    const Block& block = blocks_[place / 8];
    for (int a = 0; a < D; a++) {
      to[a] = block.lo[a][place % 8];
      to[D + a] = block.hi[a][place % 8];
    }
  }

  /// Whether there is memory for a copy of the boxes of a space.
  bool fits(const PresentBoxes& now) const { return seen_.fits(now); }

  /// Whether the boxes are read where the space has them: it must call `keep` before they change, and `find` after they
  /// may have moved in memory.
  bool lent() const { return seen_.lent; }
  void find(const PresentBoxes& now) { seen_.find(now); }

  /// Reads the boxes of a space where they are.
  SMALL void see(const PresentBoxes& now) {
    know(now.ids.count());
    built_ = false;
    demand_.restart();
    seen_.see(now);
  }

  /// Copies them.
  void keep(const PresentBoxes& now) { seen_.keep(now); }
  /// After `keep` without boxes: takes the memory that they are in.
  template <class Numbers> void take(Numbers& numbers) { seen_.take(numbers); }

  /// Follows the slots that have changed, new ones included; false if everything has to be seen again.
  SMALL bool follow(const PresentBoxes& now, const Changes& changes) {
    if (!seen_.is_like(now)) return false;
    u32 n = now.ids.count(), had = seen_.count;
    seen_.grow(now, built_);
    if (built_) {
      places_.grow(larger(n, 1u), had);
      for (u32 s = n; s < had; s++) vacate(places_[s]);
      for (u32 s = had; s < n; s++) places_[s] = nowhere;
      known_ = n;
    }
    know(n);
    seen_.count = n;
    for (u32 k = 0; k < changes.count(); k++) {
      u32 s = changes.list()[k];
      if (s >= n) continue;
      seen_.take(s, now);
      if (!built_) continue;
      if (seen_.rounded) seen_.round(s, s + 1);
      if (!seen_.is_off(s)) {
        move(s);
      } else {
        vacate(places_[s]);
        places_[s] = nowhere;
      }
    }
    return true;
  }

  /// Records that queries have visited this many blocks.
  void looked_at(u64 blocks, u32 queries = 1) { wear_.looked_at(blocks, queries); }

  /// Records a query, which takes as long as `work` scans of all boxes. If scans cost less than building the index, as
  /// for the first few queries after an update, returns the boxes, rounded to the nearest; else null. `nearest`: see
  /// `build`.
  SMALL const f32* to_scan(const f32* nearest, u32 work) {
    bool low = demand_.is_low(scans_per_build, work);
    return built_ || world() || !low ? nullptr : rounded() ? nearest : seen_.boxes.at;
  }

  /// Records a query that searches the index, whatever others do: after the next update, a scan would be wasted.
  void note_search() { demand_.now += scans_per_build + 1; }

  /// Builds the index, if necessary. It stays the same until the next update, since answers may be read in parts.
  /// `nearest`: its boxes, rounded to the nearest, which takes less time to read than doubles; null if there are none.
  NOINLINE void build(const f32* nearest) {
    if (built_) return;
    const bool reads_nearest = rounded() && nearest && !world();
    // Boxes that change later are rounded there.
    const f32* to = rounded() ? seen_.begin_rounding() : nullptr;
    if (reads_nearest) seen_.boxes.at = nearest;
    else if (rounded()) seen_.round(0, seen_.count);
    room_ = seen_.count + seen_.count / 32 + 64;
    if (known_ == 0 || wear_.is_worn(seen_.count) || !keep_order()) put_in_order();
    make_blocks(reads_nearest);
    if (reads_nearest) seen_.boxes.at = to;
    built_ = true;
  }

  /// Becomes the index of some of the boxes of another, in the order of these slots. `nearest`: all of them, rounded to
  /// the nearest.
  SMALL void take(const Index& other, const f32* nearest, const u32* slots, u32 many) {
    seen_.share(other.seen_, nearest);
    room_ = many + 8;
    known_ = sorted_ = used_ = 0;
    make_room(0);
    for (u32 k = 0; k < many; k++) {
      slots_[sorted_] = slots[k];
      sorted_ += !seen_.is_off(slots[k]);
    }
    if (sorted_) make_blocks(seen_.rounded);
  }

  /// Writes the slots of all boxes that overlap this one; returns how many. `boxes`: those that the index has seen,
  /// rounded to the nearest.
  NOINLINE u32 overlapping(const f64* box, const f32* boxes, Buffer<u32>& slots) const {
    f32 bounds[width + 2];
    round_outward<D>(box, bounds);
    slots.reserve(u64(count()) + 1);
    u32 many = 0;
    ROLLED for (u32 s = 0; s < count(); s++, boxes += width) {
      slots[many] = s;
      many += boxes_touch<D>(boxes, bounds);
    }
    return many;
  }

  /// After memory has run out: keeps the copy of the boxes, and drops the index built over it.
  SMALL void forget() {
    slots_.release();
    placed_ids_.release();
    places_.release();
    sort_.release();
    blocks_.release();
    known_ = 0;
    built_ = false;
  }

 private:
  /// There are n slots now: those from there on have no place any more.
  void know(u32 n) {
    if (n >= known_) return;
    known_ = n;
    holes_ = true;
  }

  /// Makes the blocks of all levels for the places up to `sorted_`. `nearest`: boxes are rounded to the nearest, not
  /// outward.
  NOINLINE void make_blocks(bool nearest) {
    used_ = sorted_;
    holes_ = false;
    u32 total = 0;
    levels_ = 0;
    for (u32 n = room_;; n = (n + 7) / 8) {
      first_[levels_++] = total;
      total += (n + 7) / 8;
      if (n <= 8) break;
    }
    blocks_.reserve(total);
    __builtin_memset(&blocks_[sorted_ / 8], 0xff, (first_[1] - sorted_ / 8) * sizeof(Block));
    fill(nearest);
    for (u32 level = 1; level < levels_; level++) {
      u32 below = first_[level] - first_[level - 1];
      __builtin_memset(&blocks_[first_[level] + (below - 1) / 8], 0xff, sizeof(Block));
      for (u32 k = 0; k < below; k++) bound(level, k);
    }
    for (u32 k = 0; seen_.named && k < sorted_; k++) placed_ids_[k] = seen_.ids[slots_[k]];
  }

  /// Writes the bounds of block k of the level below into its lane of its parent. Empty blocks have NaN bounds.
  NOINLINE void bound(u32 level, u32 k) {
    const Block& from = block(level - 1, k);
    Block& to = blocks_[first_[level] + k / 8];
    for (int a = 0; a < D; a++) {
      f32x4 lo = splat(__builtin_inff()), hi = -lo;
      for (u32 half = 0; half < 8; half += 4) {
        lo = min(load<f32x4>(from.lo[a] + half), lo);  // NaN is ignored
        hi = max(load<f32x4>(from.hi[a] + half), hi);
      }
      f32 least = -largest(-lo), most = largest(hi);
      bool some = least <= most;
      to.lo[a][k % 8] = some ? least : nothing;
      to.hi[a][k % 8] = some ? most : nothing;
    }
  }

  /// Bounds of all blocks above a place.
  void bound_above(u32 place) {
    for (u32 level = 1; level < levels_; level++) bound(level, place >> (3 * level));
  }

  void vacate(u32 place) {
    if (place == nowhere) return;
    Block& block = blocks_[place / 8];
    for (int a = 0; a < D; a++) block.lo[a][place % 8] = block.hi[a][place % 8] = nothing;
    holes_ = true;
  }

  void write(u32 slot, u32 place) {
    Block& block = blocks_[place / 8];
    for (int a = 0; a < D; a++) {
      block.lo[a][place % 8] = seen_.boxes[u64(slot) * width + a];
      block.hi[a][place % 8] = seen_.boxes[u64(slot) * width + D + a];
    }
    slots_[place] = slot;
    if (seen_.named) placed_ids_[place] = seen_.ids[slot];
    places_[slot] = place;
  }

  /// Whether a box is within the bounds of the block of this place.
  bool within_block(u32 slot, u32 place) const {
    const Block& above = block(1, place >> 6);
    u32 lane = place >> 3 & 7;
    bool within = true;
    for (int a = 0; a < D; a++) {
      within &= above.lo[a][lane] <= seen_.boxes[u64(slot) * width + a];
      within &= seen_.boxes[u64(slot) * width + D + a] <= above.hi[a][lane];
    }
    return within;
  }

  /// Puts a box into its place, or into a spare one.
  SMALL void move(u32 slot) {
    u32 place = places_[slot];
    if (place != nowhere && (place >= sorted_ || within_block(slot, place))) {
      write(slot, place);
      if (place >= sorted_) bound_above(place);
      return;
    }
    if (used_ == room_) {
      built_ = false;
      return;
    }
    vacate(place);
    write(slot, used_);
    bound_above(used_++);
  }

  /// The blocks of boxes.
  NOINLINE void fill(bool nearest) {
    const f32x4 signs[] = {{0.0f, 0.0f, D == 2 ? -0.0f : 0.0f, -0.0f}, {0.0f, -0.0f, -0.0f, -0.0f}};
    const f32* boxes = seen_.boxes.at;
    for (u32 k = 0; k < sorted_; k += 4) {
      // Boxes as rows; in 3D the second half begins with the last minimum.
      f32x4 rows[D - 1][4];
      ROLLED for (u32 lane = 0; lane < 4; lane++) {
        bool is_box = k + lane < sorted_;
        const f32* box = boxes + u64(slots_[is_box ? k + lane : k]) * width;
        for (int half = 0; half < D - 1; half++) {
          f32x4 row = load<f32x4>(box + 2 * half);
          if (nearest) row = loosened(row, signs[half]);
          rows[half][lane] = is_box ? row : splat(nothing);
        }
      }
      f32* to = reinterpret_cast<f32*>(&blocks_[k / 8]) + k % 8;  // lo and hi as one array
      for (int half = 0; half < D - 1; half++) {
        transpose(rows[half]);
        for (u32 n = 0; n < 4; n++) store(to + 8 * (2 * half + n), rows[half][n]);
      }
    }
    if ((sorted_ - 1) % 8 < 4) {
      for (u32 n = 0; n < width; n++)
        store(reinterpret_cast<f32*>(&blocks_[(sorted_ - 1) / 8]) + 8 * n + 4, splat(nothing));
    }
  }

  /// Fills slots_ with the boxes that are not off.
  SMALL void put_in_order() {
    u32 n = seen_.count, some = 0;
    sorted_ = 0;
    wear_.restart();
    make_room(0);
    if (n == 0) return;
    SceneItems<D> items{{seen_.boxes.at, n, nullptr}, AxisOrder<D>::make(0)};
    HilbertCurve<D>(measure<D>(items, n)).sort(items, n, sort_, [](u32, u32 place) { return place; });
    for (u32 k = 0; k < n; k++) {
      u32 slot = sort_.index(k);
      if (!seen_.is_off(slot)) slots_[some++] = slot;
    }
    find_places(some);
    width_ = group_width();
  }

  /// Records the places of the first n of slots_; no other slot has one.
  void find_places(u32 n) {
    sorted_ = n;
    known_ = seen_.count;
    if (n < seen_.count) __builtin_memset(places_.data(), 0xff, seen_.count * sizeof(u32));
    for (u32 place = 0; place < n; place++) places_[slots_[place]] = place;
  }

  /// Fills slots_ in the previous order, new boxes last. False if boxes that are neighbours in that order no longer are
  /// in space.
  SMALL bool keep_order() {
    make_room(used_);
    bool same = known_ == seen_.count && used_ == seen_.count && !holes_ && !seen_.filtered;
    if (same) sorted_ = seen_.count;
    else fill_up();
    return group_width() <= most_wider * width_;
  }

  SMALL void fill_up() {
    u32 kept = 0;
    for (u32 place = 0; place < used_; place++) {
      u32 slot = slots_[place];
      if (slot < known_ && places_[slot] == place && !seen_.is_off(slot)) slots_[kept++] = slot;
    }
    for (u32 s = 0; s < seen_.count; s++) {
      if ((s >= known_ || places_[s] == nowhere) && !seen_.is_off(s)) slots_[kept++] = s;
    }
    find_places(kept);
  }

  /// The mean width of groups of eight in the order, of a sample, without infinite ones.
  SMALL f32 group_width() const {
    u32 groups = sorted_ / 8, step = groups / sampled + 1, seen = 0;
    f32 sum = 0;
    for (u32 g = 0; g < groups; g += step, seen++) {
      f32x4 low = splat(__builtin_inff()), high = -low;
      for (u32 k = 8 * g; k < 8 * g + 8; k++) {
        const f32* box = &seen_.boxes[u64(slots_[k]) * width];
        low = min(load<f32x4>(box), low);
        high = max(load<f32x4>(box + width - 4), high);
      }
      f32x4 size = maxima<D>(high, high) - low;
      for (u32 a = 0; a < D; a++) sum += size[a] < 1e30f ? size[a] : 0;
    }
    return seen ? sum / f32(seen) : 0;
  }

  /// Room for all places; the contents of some are kept.
  void make_room(u32 keep) {
    slots_.grow(larger(room_, keep) + 8, keep);  // queries read those of a whole block
    places_.grow(larger(room_, keep), known_);
    if (seen_.named) placed_ids_.reserve(room_ + 8);
  }
};
