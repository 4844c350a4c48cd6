// AABB tree: a packed tree of fat boxes and the pairs of fat boxes, both retained between updates.
//
// Idea: each box is enclosed in a fat one that extends ahead of it, as far as its motion will take it in a few updates.
// While it stays inside, the tree and the candidates, which are the overlapping pairs of fat boxes, remain valid, and
// an update only tests each candidate again. Boxes that left get new fat ones: their candidates are dropped, the nodes
// above them are refitted, and the parts of the tree in which something moved are joined with the tree; boxes at rest
// share an exclusion bit. When boxes have moved far from their places on the curve, the order is rebuilt. When most
// move at once, everything is, at the cost of the r-tree.
// Cost: about 2 ns per box at rest, 6 ns per candidate, 60 ns per box that left; build and pairs as the r-tree; about
// 140 (2D) or 200 (3D) bytes per box.
// Wins when most boxes are at rest or move slowly and steadily. Loses when all jump: fat boxes are then useless.
// From: fat boxes and moved sets as in the dynamic trees of Bullet (N. Presson) and Box2D (E. Catto); candidates
// kept with a margin from L. Verlet, "Computer Experiments on Classical Fluids", 1967.
#pragma once
#include "pairs/pair_order.hpp"
#include "search/packed_tree.hpp"
#include "search/options.hpp"

template <int D> class AabbTree {
  static constexpr u32 width = 2 * D;
  static constexpr u32 padding = 4;  // vector loads may read this many floats past the last box
  static constexpr u32 rests = continues_1;  // the exclusion bit of all boxes that did not move
  static constexpr f32 horizon = 8;  // updates that a fat box reaches ahead, at most: fewer in a crowd
  static constexpr u32 crowd_size = 64;
  static constexpr f32 aside_share = 0.5f;  // how far it extends to all sides, as a share of its motion per update
  static constexpr u32 bulk_share = 2;  // a full rebuild when one box in this many moved
  // The order is rebuilt when each box has moved this many times on average; earlier in an update with little else to
  // do.
  static constexpr u32 worn = 4, worn_early = 2, little_share = 8;
  static constexpr u32 spare_share = 16;  // one place in this many is left free for new boxes
  // Relative costs, to decide whether retaining the tree pays. Per box: building a new r-tree, checking it, refitting
  // its node, moving it; per candidate: testing it; per test in the tree.
  static constexpr f64 build_cost = 30, look_cost = 4, fit_cost = 5, move_cost = D == 2 ? 30 : 50, candidate_cost = 8;
  static constexpr f64 test_cost = D == 2 ? 2 : 4;
  // A pause, in which nothing is retained, begins when retaining has lost more than the cost of this many full
  // rebuilds. Each pause is twice as long as the one before, in updates.
  static constexpr f64 most_loss = 2;
  static constexpr u32 first_pause = 16, longest_pause = 256;

  PackedTree<D> tree_;
  Pairs candidates_;  // in the order of their slots
  Buffer<u64> merged_;  // each update writes them here, and swaps the two
  PairOrder pair_order_;
  Buffer<f32> fat_;  // per slot its fat box, as in a scene
  Buffer<f32> origin_;  // per slot its minima when it got its fat box, and the number of that update
  Buffer<u32> tags_;  // per slot its exclusion bits, and whether it is at rest
  Buffer<u32> place_;  // per slot its place in the tree
  Buffer<u32> free_;  // places without a box
  Buffer<u32> moved_;  // slots that moved
  u32 count_ = 0;  // boxes in the tree; 0: nothing is retained
  u32 free_count_ = 0;
  u64 wear_ = 0;  // boxes moved since the order was built
  u32 now_ = 0;  // updates, counted
  f32 reach_ = 0;  // updates that fat boxes reach ahead, on average
  f64 fresh_ = 0;  // the cost of a full rebuild
  f64 loss_ = 0;  // by how much retaining has exceeded that
  u32 pause_ = 0;  // updates left in which nothing is retained
  u32 pauses_ = 0;  // length of the last pause

 public:
  void update(const Scene<D>& scene, const Options& options, Pairs& pairs, Stats& stats) {
    u32 n = scene.count, had = count_;
    if (n == 0) return release();
    stats.entries = n;
    if (pause_ > 0) {
      pause_--;
      return keep_nothing(scene, pairs, stats);
    }
    make_room(n, had);
    now_++;
    u32 moved = look(scene, had, f32(options.margin));
    bool order = had == 0 || n > had + free_count_;
    if (n < had) remove_from(n, had);
    u64 kept = candidates_.count;
    f64 cost = look_cost * n;
    if (moved > 0 || n != had) {
      cost += follow(n, had, moved, order);
      kept = smaller(kept, candidates_.count);
      count_ = n;
      tree_.join(candidates_, stats);
    }
    pair_order_.sort(candidates_.list.data() + kept, candidates_.count - kept, n);
    retest(scene.boxes, kept, pairs);
    f64 fresh = build_cost * n + test_cost * stats.tests;
    cost += test_cost * stats.tests + candidate_cost * f64(candidates_.count);
    if (had == 0) {
      fresh_ = fresh;
      reach_ = horizon / (1 + f32(candidates_.count) / f32(n));
    } else {
      reckon(cost);
    }
    stats.tests += f64(candidates_.count);
    stats.cells = tree_.nodes();
  }

  SMALL void structure(Buffer<f32>& boxes, u32& count, const Stats&) const { tree_.structure(boxes, count); }

  SMALL void release() {
    tree_.release();
    candidates_.list.release();
    candidates_.count = 0;
    merged_.release();
    pair_order_.release();
    fat_.release();
    origin_.release();
    tags_.release();
    place_.release();
    free_.release();
    moved_.release();
    count_ = free_count_ = pause_ = pauses_ = 0;
    loss_ = 0;
  }

 private:
  /// An update with a new tree.
  void keep_nothing(const Scene<D>& scene, Pairs& pairs, Stats& stats) {
    tree_.build(scene, 0);
    tree_.join(pairs, stats);
    pair_order_.sort(pairs.list.data(), pairs.count, scene.count);
    stats.cells = tree_.nodes();
  }

  void make_room(u32 n, u32 had) {
    u32 most = larger(n, had);
    fat_.grow(u64(most) * width + padding, u64(had) * width);
    origin_.grow(u64(most) * (D + 1), u64(had) * (D + 1));
    tags_.grow(most, had);
    place_.grow(most, had);
    moved_.reserve(n);
  }

  /// Takes the boxes of slots n … had - 1 out of the tree.
  void remove_from(u32 n, u32 had) {
    free_.grow(free_count_ + had - n, free_count_);
    for (u32 slot = n; slot < had; slot++) {
      tags_[slot] = 0;
      tree_.clear(place_[slot]);
      free_[free_count_++] = place_[slot];
    }
    candidates_.filter([n](u32, u32 b) { return b < n; });
  }

  /// Updates the tree for moved and new boxes. `order`: its order has to be rebuilt. Returns the cost.
  f64 follow(u32 n, u32 had, u32 moved, bool order) {
    bool all = u64(moved) * bulk_share > n;
    wear_ += moved;
    f64 cost = fit_cost * n + move_cost * moved;
    if (all) {
      for (u32 slot = 0; slot < n; slot++) tags_[slot] &= ~u32(rests);
      candidates_.count = 0;
    }
    u32 limit = moved * little_share > n ? worn : worn_early;
    if (order || all || wear_ > u64(n) * limit) {
      plant(n);
      return cost + build_cost * n;
    }
    tree_.mark(rests);
    for (u32 slot = had; slot < n; slot++) place_[slot] = free_[--free_count_];
    for (u32 k = 0; k < moved; k++) {
      u32 slot = moved_[k];
      tree_.put(place_[slot], fat_.data() + u64(slot) * width, slot | tags_[slot]);
    }
    tree_.refit();
    return cost;
  }

  /// Starts a pause if retaining the tree has cost more than it saved for some updates.
  void reckon(f64 cost) {
    loss_ = larger(0.0, loss_ + cost - fresh_);
    if (loss_ < most_loss * fresh_) return;
    loss_ = 0;
    pause_ = pauses_ = smaller(longest_pause, 2 * pauses_ + first_pause);
    count_ = free_count_ = 0;
    candidates_.count = 0;
  }

  /// Collects the boxes that left their fat boxes, of the first `had`, and new ones; gives them new fat boxes.
  u32 look(const Scene<D>& scene, u32 had, f32 margin) {
    u32 moved = 0;
    for (u32 slot = 0; slot < scene.count; slot++) {
      const f32* box = scene.boxes + u64(slot) * width;
      const f32* fat = fat_.data() + u64(slot) * width;
      u32 excluded = scene.excluded_of(slot);
      u32 inside = bitmask(load<f32x4>(fat) <= load<f32x4>(box)) &
                   bitmask(load<f32x4>(box + D) <= load<f32x4>(fat + D));
      bool stays = slot < had && !(~inside & ((1 << D) - 1)) && (tags_[slot] | rests) == (excluded | rests);
      tags_[slot] = excluded | (stays ? u32(rests) : 0);
      moved_[moved] = slot;
      moved += !stays;
    }
    for (u32 k = 0; k < moved; k++) fatten(moved_[k], scene.boxes + u64(moved_[k]) * width, moved_[k] >= had, margin);
    return moved;
  }

  NOINLINE void fatten(u32 slot, const f32* box, bool is_new, f32 margin) {
    f32* fat = fat_.data() + u64(slot) * width;
    f32* origin = origin_.data() + u64(slot) * (D + 1);
    // Fat boxes reach ahead by different amounts, or all boxes would leave them at once. Neighbours get the same, since
    // their nodes are refitted together.
    u32 crowd = is_new ? 0 : place_[slot] / crowd_size;
    f32 reach = reach_ * (0.6f + f32(crowd * 0x9e3779b9u >> 8) * 0x0.cp-24f);
    f32 updates = f32(larger(now_ - bits<u32>(origin[D]), 1u));
    for (int a = 0; a < D; a++) {
      f32 motion = is_new ? 0 : (box[a] - origin[a]) / updates;
      f32 size = box[D + a] - box[a];
      if (!(motion <= size && -motion <= size)) motion = 0;  // a jump
      f32 aside = margin > 0 ? margin : aside_share * larger(motion, -motion);
      f32 ahead = margin > 0 ? 0 : reach * motion;
      fat[a] = smaller(box[a], box[a] + smaller(ahead, 0.0f) - aside);
      fat[D + a] = larger(box[D + a], box[D + a] + larger(ahead, 0.0f) + aside);
      origin[a] = box[a];
    }
    origin[D] = bits<f32>(now_);
  }

  /// Rebuilds the order of the tree.
  SMALL void plant(u32 n) {
    u32 spare = n / spare_share;
    tree_.build(Scene<D>{fat_.data(), n, tags_.data()}, spare);
    free_.reserve(spare);
    free_count_ = spare;
    for (u32 k = 0; k < n; k++) place_[tree_.slot(k)] = k;
    for (u32 k = 0; k < spare; k++) free_[k] = n + k;
    wear_ = 0;
  }

  /// Merges the first `kept` candidates, without those of boxes that moved, with the others, and reports all that
  /// overlap. Both parts are sorted, and so is the result.
  void retest(const f32* boxes, u64 kept, Pairs& pairs) {
    u64 count = candidates_.count;
    const u64* list = candidates_.list.data();
    u64* left = merged_.reserve(count + 1);
    u64* out = pairs.list.grow(count + Pairs::slack, 0);
    auto take = [&](u64 pair, bool is_kept) {
      const f32* one = boxes + u64(u32(pair)) * width;
      const f32* other = boxes + (pair >> 32) * width;
      u32 overlap = bitmask((load<f32x4>(one) <= load<f32x4>(other + D)) &
                            (load<f32x4>(other) <= load<f32x4>(one + D)));
      *left = pair;
      left += is_kept;
      *out = pair;
      out += is_kept && !(~overlap & ((1 << D) - 1));
    };
    u64 k = 0, next = kept;
    auto stays = [&](u64 pair) { return bool(tags_[u32(pair)] & tags_[pair >> 32] & rests); };
    while (k < kept && next < count) {
      u64 old = list[k], fresh = list[next];
      bool first = PairOrder::key(old) < PairOrder::key(fresh);  // no branch: it would be mispredicted
      k += first;
      next += !first;
      take(first ? old : fresh, !first | stays(old));
    }
    for (; k < kept; k++) take(list[k], stays(list[k]));
    for (; next < count; next++) take(list[next], true);
    candidates_.count = Pairs::between(merged_.data(), left);
    candidates_.list.swap(merged_);
    pairs.end_at(out);
  }
};
