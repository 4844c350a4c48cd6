// The list of candidates: the regions in which they hold, and how boxes that leave theirs are served.
//
// Idea: each box has a region: the box as it was when the list was made, with a margin on all sides. If that pays, the
// region also reaches ahead, to where the box will be if it keeps moving as it has since the previous list was made.
// Two boxes whose regions touch are a candidate. While boxes stay in their regions, an update only checks all boxes and
// tests the candidates.
//   - Late: a box that has left its region gets another, with the candidates that this adds. They are searched for in
//     the strips that were swept to make the list, and among the new regions of other late boxes. Its base, which is
//     its first region, still determines which candidates are listed. If it is late again, its region also reaches back
//     to the one before, so that boxes that jitter are soon held, and ahead, for those that move on.
//   - At rest: a box that has not moved since the previous list was made is its own region. Pairs of two such boxes are
//     settled: they are at the head of the list of pairs and are not tested again. In a world that wraps around, boxes at
//     its border are never at rest, since their pairs have to be folded in each update. A list can also be made without
//     any boxes at rest: then all regions have the margin.
// Cost: about 1 ns per box and 2 ns per candidate; 0.3 (2D) to 2 µs per late box; 1.5 to two strip sweeps to make the
// list. Memory, in addition to that of strip sweep: about 55 (2D) or 70 (3D) bytes per box, and 8 per candidate.
// From: L. Verlet, "Computer Experiments on Classical Fluids", 1967.
#pragma once
#include "coherence/origins.hpp"
#include "coherence/places.hpp"
#include "coherence/watch.hpp"
#include "techniques/strip_sweep.hpp"

template <int D> class CandidateList {
  static constexpr u32 width = 2 * D;
  static constexpr u32 room_step = 4096;  // candidates tested between two checks for room in the list of pairs
  static constexpr u32 doubt_step = 32;  // candidates whose pairs are recorded as in doubt together
  static constexpr u32 padding = 4;  // vector loads may read this many floats past the last box
  static constexpr Tuning<D> tuning = {};
  // In a tag, below exclusion bits and class. moved: it has a new region; again: for the second time or more
  enum : u32 { rests = 1, fresh = 2, moved = 4, again = 8, marks = 15 };

  StripSweep<D>& strips_;
  u32 count_ = 0;  // boxes in the list; 0: there is no list
  bool watched_ = false;  // pairs in doubt are recorded
  struct {
    bool rules = false, groups = false;  // some have
    const Rule* classes = nullptr;  // the rule of each; null if that does not matter
  } known_;  // of the boxes
  // Per slot:
  Buffer<f32> regions_;
  Origins<D> origins_;
  Buffer<u32> tags_;  // exclusion bits and class, and below them these marks
  Buffer<u32> groups_;  // while some have one: two boxes of one group are not a candidate
  Buffer<u32> late_;  // slots of late boxes; after them, those that a search finds
  Places<D> places_;  // of late boxes
  bool finished_ = false;  // whether the candidates were found
  u32 late_count_ = 0, resting_ = 0;
  u64 still_ = 0;  // pairs of two boxes at rest that the sweep found, forbidden ones too
  u64 met_ = 0;  // work of the searches for late boxes in this update, in tests of strip sweep
  Pairs candidates_, extra_, settled_;  // extra: those added by late boxes
  u64 head_ = 0;  // length of the prefix of `settled_` that the last report has
  Stats built_ = {};  // of the sweep that made the list; its candidates are all pairs that it found
  f32 margin_ = 0;
  Shift shift_;  // undoes the common motion since then

 public:
  constexpr explicit CandidateList(StripSweep<D>& strips) : strips_(strips) {}

  bool is_empty() const { return count_ == 0; }
  u32 count() const { return count_; }
  u32 resting() const { return resting_; }
  u32 late_count() const { return late_count_; }
  bool rests_at(u32 slot) const { return tags_[slot] & rests; }
  Origins<D>& origins() { return origins_; }
  /// Whether the box of this slot, one of the list, will stay in its region if it moves by this much.
  bool stays(const Scene<D>& scene, u32 slot, f32x4 move) const {
    f32 box[width + padding];
    store(box, load<f32x4>(scene.box(slot)) + move);
    if constexpr (D == 3) store(box + D, load<f32x4>(scene.box(slot) + D) + move);
    return is_expected<true>(box, region(slot), tags_[slot], shift_);
  }
  const Pairs& candidates() const { return candidates_; }
  /// Candidates that are tested in each update.
  u64 tested() const { return candidates_.count + extra_.count; }
  /// Pairs of two boxes at rest that the sweep found to make the list, forbidden ones too.
  u64 still() const { return still_; }
  /// The statistics of that sweep.
  const Stats& built() const { return built_; }

  /// The work of this update for late boxes, and of any update without them. `looked`: boxes that it checks. If some are
  /// late, extra candidates are gone through twice: those of boxes that were late before are dropped first.
  f64 late_work() const {
    u32 passes = late_count_ > 0 ? 2 : 1;
    return late_count_ * tuning.late_among(count_) + met_ + passes * tuning.candidate * extra_.count;
  }
  f64 least_work(f64 looked) const { return candidates_.count * tuning.candidate + looked; }
  /// The work of making the list, while that is the last sweep.
  f64 made_work() const { return strips_.work() + built_.candidates + 2.0 * count_; }

  /// Drops the list if pairs in doubt are to be recorded that may be settled, or if classes have other numbers.
  void check(const Scene<D>& scene, bool watched) {
    if ((watched && !watched_) || known_.classes != scene.classes || (known_.classes && !scene.changes)) forget();
    watched_ = watched;
  }

  /// Drops the list, but keeps the memory.
  SMALL void forget() {
    count_ = resting_ = 0;
    candidates_.count = extra_.count = settled_.count = 0;
  }

  SMALL void release() {
    forget();
    regions_.release();
    origins_.release();
    tags_.release();
    groups_.release();
    late_.release();
    places_.release();
    candidates_.list.release();
    candidates_.doubts.release();
    extra_.list.release();
    settled_.list.release();
  }

  /// Begins a list of these boxes, in place of the one there is. It can be used once `finish` has been called, also with
  /// boxes that have moved since. `some_rest`: some may be at rest. Regions that would reach further ahead than `far` do
  /// not reach ahead at all.
  SMALL void begin(const Scene<D>& scene, const Plan& plan, const Shift& common, bool some_rest, f32 far) {
    u32 n = scene.count;
    make_room(n, smaller(count_, n));
    shift_ = origins_.common().after(common.back());
    u32 known = smaller(n, origins_.count());
    if (some_rest) find_resting(scene, known);
    else __builtin_memset(tags_.data(), 0, n * sizeof(u32));
    resting_ = 0;
    enclose(scene, plan.margin, plan.lead > 0 ? known : 0, f32(plan.lead) / larger(1u, origins_.age()), far);
    origins_.record(scene, common);
    known_.rules = scene.rules != nullptr;
    known_.classes = scene.classes;
    known_.groups = scene.groups != nullptr;
    if (known_.groups) __builtin_memcpy(groups_.reserve(n), scene.groups, n * sizeof(u32));
    count_ = n;
    margin_ = plan.margin;
    candidates_.count = extra_.count = settled_.count = head_ = 0;
    built_ = Stats{};
    strips_.fill(Scene<D>{regions_.data(), n, scene.rules}, built_, true);
    finished_ = false;
    places_.forget();
    shift_ = {};
    late_count_ = 0;
    met_ = 0;
  }

  /// Finds the candidates of a list that has begun. Gives up and returns false if that takes more than `most` tests.
  SMALL bool finish(f64 most) {
    candidates_.watch = watched_ && resting_ > 0;
    candidates_.doubt_count = 0;
    if (!strips_.sweep(candidates_, most)) return false;
    built_.candidates = f64(candidates_.count);
    still_ = 0;
    if (resting_ > 0) settle();
    if (known_.groups || known_.classes) {
      auto may_meet = [&](u32 a, u32 b) { return !are_apart(a, b); };
      candidates_.filter(may_meet);
      settled_.filter(may_meet);
    }
    return finished_ = true;
  }
  bool is_finished() const { return finished_; }

  /// Gives new regions to boxes that have left theirs. Returns false if that would take more than `most` work per box:
  /// then a new list is due. `size`, `spacing`: of boxes.
  SMALL bool follow(const Scene<D>& scene, const Shift& common, f64 most, f32 size, f64 spacing) {
    u32 n = scene.count, had = count_, both = smaller(n, had);
    u32* list = late_.reserve(u64(n) + larger(n, strips_.count()) + 4);  // a search may find all boxes of the strips
    Shift shift = origins_.common().after(common.back());
    bool shifts = shift.differs(shift_);
    shift_ = shift;
    if (!shift.is_sound()) return false;
    u32 enough = u32(smaller(most * n / tuning.late_among(n), n / 2.0));
    if (!shifts && scene.listed()) late_count_ = look_at(scene, both, list);
    else late_count_ = resting_ ? look<true>(scene, both, list, enough) : look<false>(scene, both, list, enough);
    bool other = known_.rules != (scene.rules != nullptr) || known_.groups != (scene.groups != nullptr);
    if (scene.filtered || other) refilter(scene, both, list);
    if (late_count_ + (n - both) > enough) return false;
    met_ = 0;
    if (late_count_ == 0 && n == had) return true;
    if (!places_.has_room()) places_.clear(count_, spacing);
    for (u32 slot = n; slot < had; slot++) {
      resting_ -= tags_[slot] & rests;
      if (tags_[slot] & moved) places_.remove(region(slot), slot);
    }
    make_room(n, both);
    if (known_.groups) groups_.grow(n, both);
    places_.make_room(n, both);
    for (u32 slot = had; slot < n; slot++) {
      tags_[slot] = fresh;
      list[late_count_++] = slot;
    }
    count_ = n;
    return serve(scene, list, had, u64(most * n / tuning.candidate), f32(tuning.late_margin) * size);
  }

  /// Reports the settled pairs and the candidates that overlap. Nothing else in this file reports pairs.
  SMALL void report(const Scene<D>& scene, Pairs& pairs, Stats& stats) {
    u64 head = settled_.count, same = smaller(smaller(pairs.stable, head_), head);
    pairs.same = same == head && head == head_ && resting_ == count_ && late_count_ + candidates_.count == 0;
    u64* out = pairs.room(pairs.list.data() + same, head - same);
    if (head > same) __builtin_memcpy(out, settled_.list.data() + same, (head - same) * sizeof(u64));
    pairs.count = head;
    pairs.kept = same;
    test(scene, candidates_, pairs);
    test(scene, extra_, pairs);
    pairs.stable = head_ = head;
    stats.tests = f64(candidates_.count + extra_.count);
    stats.cells = built_.cells;
    stats.entries = built_.entries;
  }

 private:
  f32* region(u32 slot) const { return regions_.data() + u64(slot) * width; }

  // --- making a list ---

  SMALL void make_room(u64 n, u64 had) {
    regions_.grow(n * width + padding, had * width);
    tags_.grow(n, had);
    if (n > had) __builtin_memset(tags_.data() + had, 0, (n - had) * sizeof(u32));
  }

  /// Marks the boxes that have not moved since their origins were recorded.
  NOINLINE void find_resting(const Scene<D>& scene, u32 known) {
    u32 steady = !shift_.differs({});
    for (u32 slot = 0; slot < known; slot++)
      tags_[slot] = (tags_[slot] & ~rests) | (steady & u32(origins_.has_rested(scene, slot)));
  }

  /// Gives each box its region, which reaches ahead by `lead` times its displacement since its origin was recorded.
  NOINLINE void enclose(const Scene<D>& scene, f32 margin, u32 known, f32 lead, f32 far) {
    for (u32 slot = 0; slot < scene.count; slot++) {
      u32 rest = tags_[slot] & rests;
      resting_ += rest;
      const f32* box = scene.box(slot);
      f32x4 ahead = {};
      if (slot < known)
        ahead = bounded((shift_(load<f32x4>(box)) - load<f32x4>(origins_.box(slot))) * splat(lead), far);
      f32x4 aside = splat(bits<f32>(bits<u32>(margin) & (rest - 1)));
      widen(box, min(ahead, f32x4{}) - aside, max(ahead, f32x4{}) + aside, region(slot));
      tags_[slot] = rest | scene.rule_of(slot);
    }
  }

  /// Adds `low` to the minima of a box, and `high` to its maxima. In 3D, writes one number past the region.
  static void widen(const f32* box, f32x4 low, f32x4 high, f32* out) {
    if constexpr (D == 2) store(out, load<f32x4>(box) + __builtin_shufflevector(low, high, 0, 1, 4, 5));
    else {
      store(out, load<f32x4>(box) + low);
      store(out + D, load<f32x4>(box + D) + high);
    }
  }

  /// Moves candidates of two boxes at rest to the settled pairs, except those in doubt, if these are recorded: only pairs
  /// in the ranges that the sweep has recorded can be.
  NOINLINE void settle() {
    u64 left = 0;
    u64* list = candidates_.list.data();
    u64* out = settled_.list.reserve(candidates_.count + 1);
    if (watched_ && some_nowhere<D>(regions_.data(), count_)) {  // pairs of such boxes are not recorded
      candidates_.doubt_count = 0;
      candidates_.doubt(list, list + candidates_.count);
    }
    const u64 *doubts = candidates_.doubts.data(), *last = doubts + 2 * candidates_.doubt_count;
    for (u64 k = 0; k < candidates_.count; k++) {
      u64 pair = list[k];
      bool rest = tags_[u32(pair)] & tags_[u32(pair >> 32)] & rests;
      still_ += rest;
      while (doubts < last && k >= doubts[1]) doubts += 2;
      if (rest && doubts < last && k >= doubts[0]) {
        i32x4 touching = {};
        const f32 *one = region(u32(pair)), *other = region(u32(pair >> 32));
        boxes_touch<D>(one, other, touching);
        rest = !(any_equal<D>(touching) || some_nowhere<D>(one, 1) || some_nowhere<D>(other, 1));
      }
      list[left] = *out = pair;
      left += !rest;
      out += rest;
    }
    candidates_.count = left;
    settled_.end_at(out);
  }

  // --- boxes that leave their regions ---

  /// Whether a box is where it is expected: within its region, or equal to it if the box is at rest.
  template <bool some_rest> static bool is_expected(const f32* box, const f32* region, u32 tag, const Shift& shift) {
    f32x4 low = shift(load<f32x4>(box)), its_low = load<f32x4>(region);
    u32 moves = (tag & rests) - 1;  // a mask: no branch, since which boxes rest is unpredictable
    if constexpr (D == 2) {
      u32 within = bitmask(turned(bits<i32x4>(its_low)) <= turned(bits<i32x4>(low)));
      return (some_rest ? within & (bitmask(low == its_low) | moves) : within) == 15;
    } else {
      f32x4 high = shift(load<f32x4>(box + D)), its_high = load<f32x4>(region + D);
      u32 within = bitmask((its_low <= low) & (high <= its_high));
      if (some_rest) within &= bitmask((low == its_low) & (high == its_high)) | moves;
      return (within & 7) == 7;
    }
  }
  NOINLINE bool is_expected(const Scene<D>& scene, u32 slot) const {
    return is_expected<true>(scene.box(slot), region(slot), tags_[slot], shift_);
  }

  /// Writes the slots of boxes that are not where they are expected; returns how many. Stops once there are more than
  /// `enough`.
  template <bool some_rest> NOINLINE u32 look(const Scene<D>& scene, u32 until, u32* out, u32 enough) const {
    const f32 *box = scene.boxes, *its = regions_.data();
    const u32* tags = tags_.data();
    Shift shift = shift_;
    u32 found = 0, slot = 0;
    for (; slot + 4 <= until && found <= enough; slot += 4, box += 4 * width, its += 4 * width) {
      u32 expected[4], all = 1;
      for (u32 k = 0; k < 4; k++)
        all &= expected[k] = is_expected<some_rest>(box + k * width, its + k * width, tags[slot + k], shift);
      if (all) continue;
      for (u32 k = 0; k < 4; k++) {
        out[found] = slot + k;
        found += 1 - expected[k];
      }
    }
    for (; slot < until && found <= enough; slot++) {
      out[found] = slot;
      found += !is_expected(scene, slot);
    }
    return found;
  }

  /// The same, for the boxes that may have changed.
  NOINLINE u32 look_at(const Scene<D>& scene, u32 until, u32* out) const {
    u32 found = 0;
    for (u32 k = 0; k < scene.changes->count(); k++) {
      u32 slot = scene.changes->list()[k];
      if (slot < until && !is_expected(scene, slot)) out[found++] = slot;
    }
    return found;
  }

  /// Adds boxes whose rule or group have changed to the late boxes, marked as new ones.
  NOINLINE void refilter(const Scene<D>& scene, u32 until, u32* list) {
    known_.rules = scene.rules != nullptr;
    bool were_grouped = known_.groups;
    known_.groups = scene.groups != nullptr;
    if (known_.groups && !were_grouped) __builtin_memset(groups_.reserve(count_), 0, count_ * sizeof(u32));
    bool listed = scene.listed();
    for (u32 k = 0, all = listed ? scene.changes->count() : until; k < all; k++) {
      u32 slot = listed ? scene.changes->list()[k] : k;
      if (slot >= until) continue;
      bool one = ((known_.groups | were_grouped) ? groups_[slot] : 0) == scene.group_of(slot);
      if (one && (tags_[slot] & ~marks) == scene.rule_of(slot)) continue;
      tags_[slot] |= fresh;
      list[late_count_++] = slot;  // perhaps for the second time: `serve` skips it then
    }
  }

  /// Whether the classes or the groups of two boxes forbid that they are a pair.
  bool are_apart(u32 a, u32 b) const {
    auto class_of = [&](u32 slot) { return (tags_[slot] & class_mask) / class_bit; };
    return (known_.groups && one_group(groups_[a], groups_[b])) ||
           (known_.classes && !meet(known_.classes[class_of(a)], known_.classes[class_of(b)]));
  }

  /// The base of a box: the region that it had first.
  const f32* base(u32 slot) const { return tags_[slot] & moved ? places_.base(slot) : region(slot); }

  /// Gives new regions to the late boxes; those from slot `had` on had none. Returns false if the searches take more work
  /// than `enough`.
  SMALL bool serve(const Scene<D>& scene, u32* list, u32 had, u64 enough, f32 margin) {
    u32 many = 0, were = 0;
    places_.unmark(larger(had, count_));
    for (u32 k = 0; k < late_count_; k++) {
      u32 slot = list[k], tag = tags_[slot];
      if (places_.is_marked(slot)) continue;
      places_.mark(slot);
      list[many++] = slot;
      if (slot < had) were |= tag;  // a new one has no candidates yet
      resting_ -= tag & rests;
      if (tag & moved) places_.remove(region(slot), slot);
      else if (!(tag & fresh)) places_.keep_base(region(slot), slot);
      if (tag & fresh) {  // its listed candidates are dropped below
        tag = fresh | scene.rule_of(slot);
        if (known_.groups) groups_[slot] = scene.group_of(slot);
        places_.forget_base(slot);
      }
      tags_[slot] = (tag & ~rests) | moved | (tag & moved ? u32(again) : 0);
    }
    auto filter_listed = [&](u32 a, u32 b) { return b < count_ && !((tags_[a] | tags_[b]) & fresh); };
    if (had > count_ || (were & fresh)) {
      head_ = 0;
      candidates_.filter(filter_listed);
      settled_.filter(filter_listed);
    }
    if (were & rests) {
      met_ += 2 * settled_.count;  // each is gone through here, and copied by `report`
      unsettle();
    }
    extra_.filter([&](u32 a, u32 b) { return b < count_ && !(places_.is_marked(a) | places_.is_marked(b)); });
    for (u32 k = 0; k < many && met_ <= enough; k++) enlarge(scene, list[k], larger(margin_, margin), list + many);
    for (u32 k = 0; k < many; k++) tags_[list[k]] &= ~fresh;
    late_count_ = many + had - smaller(had, count_);
    return met_ <= enough;
  }

  /// Makes the settled pairs of boxes that are no longer at rest candidates.
  NOINLINE void unsettle() {
    u64* list = settled_.list.data();
    u64 left = 0, many = settled_.count;
    u64* out = candidates_.list.data() + candidates_.count;
    for (u64 k = 0; k < many; k++) {
      u64 pair = list[k];
      list[left++] = pair;
      if (!(places_.is_marked(u32(pair)) | places_.is_marked(u32(pair >> 32)))) continue;  // as nearly always
      head_ = smaller(head_, --left);
      out = candidates_.room(out, 1);
      *out++ = pair;
      candidates_.count++;
    }
    still_ -= settled_.count - left;
    settled_.count = left;
  }

  /// Finds a new region for a late box: with a margin of `aside`, or of the list if it has moved on by more than its size.
  /// If it is late again, its region reaches back to the one before, and as far ahead as it got from that.
  void find_region(const f32* its, const f32* before, u32 tag, f32 aside, f32* out) const {
    f32 box[width + padding];
    store(box, shift_(load<f32x4>(its)));
    store(box + D, shift_(load<f32x4>(its + D)));
    f32x4 low = load<f32x4>(before) - load<f32x4>(box), high = load<f32x4>(before + D) - load<f32x4>(box + D);
    i32x4 far = (low > splat(2 * aside)) | (high < splat(-2 * aside));
    if (!(tag & fresh) && (bitmask(far) & ((1 << D) - 1))) aside = margin_;
    f32x4 least = splat(-aside), most = splat(aside);
    if (tag & again) {
      // A list with a margin as wide as this holds boxes that move on; those that leave it jitter or have jumped.
      f32x4 ahead = (low + high) * splat(aside > margin_ ? -0.5f : 0);
      least += min(ahead, f32x4{});
      most += max(ahead, f32x4{});
      least = min(max(low, least - splat(aside)), least);
      most = max(min(high, most + splat(aside)), most);
    }
    widen(box, least, most, out);
  }

  /// Gives a late box a new region. `near`: room for all slots.
  NOINLINE void enlarge(const Scene<D>& scene, u32 slot, f32 aside, u32* near) {
    f32 larger_one[width + padding];
    u32 tag = tags_[slot];
    find_region(scene.box(slot), region(slot), tag, aside, larger_one);
    const f32* its_base = base(slot);
    u32 found = 0;
    for (u32 k = 0, all = strips_.near(larger_one, near, met_); k < all; k++) {
      u32 other = near[k];
      near[found] = other;
      found += other < count_ && !(tags_[other] & moved);
    }
    found += places_.near(larger_one, regions_.data(), near + found, met_);
    u64* out = extra_.room(extra_.list.data() + extra_.count, found);
    for (u32 k = 0; k < found; k++) {
      u32 other = near[k];
      *out = pair_of(slot, other);
      u32 apart = are_apart(slot, other);
      out += !(boxes_touch<D>(its_base, base(other)) | apart | (tag & tags_[other] & ~slot_mask));
    }
    extra_.end_at(out);
    __builtin_memcpy(region(slot), larger_one, width * sizeof(f32));
    places_.put(larger_one, slot);
  }

  static void test(const Scene<D>& scene, const Pairs& candidates, Pairs& pairs) {
    if (pairs.watch) test_as<true>(scene, candidates, pairs);
    else test_as<false>(scene, candidates, pairs);
  }
  template <bool watch> NOINLINE static void test_as(const Scene<D>& scene, const Pairs& candidates, Pairs& pairs) {
    const u64* list = candidates.list.data();
    const f32* boxes = scene.boxes;
    u64* out = pairs.list.data() + pairs.count;
    for (u64 k = 0; k < candidates.count;) {
      u64 until = smaller(candidates.count, k + room_step);
      out = pairs.room(out, until - k);
      while (k < until) {
        u64 few = watch ? smaller(until, k + doubt_step) : until;
        const u64* begin = out;
        i32x4 touching = {};
        for (; k < few; k++) {
          u64 pair = list[k];
          const f32 *one = boxes + u64(u32(pair)) * width, *other = boxes + (pair >> 32) * width;
          *out = pair;
          out += boxes_touch<D>(one, other, touching);
        }
        if (watch && any_equal<D>(touching)) pairs.doubt(begin, out);
      }
    }
    pairs.end_at(out);
  }
};
