// Incremental: a list of the pairs that may come to overlap, which is tested in each update instead of finding all anew.
//
// Idea: each box has a region, which is the box when the list was made and a margin on all sides. Two boxes whose regions
// touch are a candidate. While boxes stay in their regions, an update looks at all boxes and tests the candidates.
//   - Late: a box that has left its region gets another, with twice the margin each time, and the candidates that come
//     with it. Its base, which is the region it had first, still says which candidates are listed.
//   - Rest: a box that has not moved while a list lived, or in the update before the first one, is its own region. Pairs
//     of two at rest are settled: they stand at the head of the list of pairs, and nobody tests them.
//   - A list ends when being late has cost more than a new list would, on average. Motion with bounds never ends one.
//   - The margin is measured, not foreseen: see watch.hpp. Where none promises to pay, strip sweep answers, and it is
//     tried again after 8 to 512 updates.
// Nothing here looks at a clock: work is counted, so the order of the pairs depends on the calls alone.
// Cost: about 1 ns a box and 2 ns a candidate; to make a list, one and a half times what strip sweep takes.
// Memory, beside that of strip sweep: about 55 (2D) or 71 (3D) bytes a box, and 8 a candidate.
// Wins where boxes rest, tremble, turn, or move by less than a tenth of their size. Is strip sweep where they jump.
// From: L. Verlet, "Computer Experiments on Classical Fluids", 1967.
#pragma once
#include "../pair_order.hpp"
#include "../techniques/strip_sweep.hpp"
#include "places.hpp"
#include "watch.hpp"

template <int D> class Incremental {
  static constexpr u32 width = 2 * D;
  static constexpr u32 padding = 4;  // vector loads may read this many floats past the last box
  static constexpr Tuning<D> tuning = {};
  // In a tag, below the exclusion bits:
  enum : u32 { rests = 1, late = 2, fresh = 4 };

  StripSweep<D>& anew_;
  Watch<D> watch_;
  Prospect<D> prospect_ = {};
  u32 count_ = 0;           // boxes that are followed; 0: nothing is kept
  bool ended_ = false;      // a new list is due
  bool watched_ = false;    // pairs in doubt are to be noted
  bool filtered_ = false;   // some have exclusion bits
  bool grouped_ = false;    // some have a group
  // Per slot:
  Buffer<f32> regions_;
  Buffer<f32> bases_;       // the regions when the list was made, from when the first box was late
  Buffer<u32> tags_;        // exclusion bits, and ours below them
  Buffer<u32> groups_;      // while `grouped_`: two of one group are no candidate
  Buffer<u32> late_;        // slots; and behind them those that a search has met
  Places<D> places_;        // of the regions, likewise
  bool placed_ = false;
  u32 late_count_ = 0, resting_ = 0;
  u64 met_ = 0;             // regions that a search for the late has met in this update
  Pairs candidates_, extra_, settled_;  // extra: those of boxes that have been late
  PairOrder order_;
  u64 head_ = 0;            // the first so many of `settled_` are those of the last report
  Stats built_ = {};
  f32 margin_ = 0;
  Shift common_;            // what the watch said of common motion when the list was made
  Shift shift_;          // takes back what all have moved in common since
  u32 age_ = 0;
  f64 lateness_ = 0, smooth_ = 0, life_ = 0;  // work, for each box, since the list was made: for the late; of an update; all
  u32 pause_ = 0, pauses_ = tuning.watched;

 public:
  constexpr explicit Incremental(StripSweep<D>& anew) : anew_(anew) {}
#if !defined(__wasm__)
  ~Incremental() { release(); }
#endif

  void update(const Scene<D>& scene, const Settings& options, Pairs& pairs, Stats& stats) {
    pairs.count = 0;
    if (pairs.watch && !watched_) forget();  // what is settled may be in doubt
    watched_ = pairs.watch;
    bool kept = find(scene, f32(options.margin), pairs, stats);
    if (!kept) rebuild(scene, options, pairs, stats);
    stats.reason = f64(u32(kept ? Reason::kept : pause_ > 0 || scene.count < tuning.few ? Reason::moving : Reason::watching));
    if (!scene.ordered) return;
    order_.sort(pairs.list.data(), pairs.count, scene.count);
    pairs.doubt_count = 0;  // they stand elsewhere now
    if (watched_) pairs.doubt(pairs.list.data(), pairs.list.data() + pairs.count);
    pairs.stable = 0;
    pairs.same = false;
  }

  COLD void structure(Buffer<f32>& boxes, u32& count, const Stats& stats) const {
    anew_.structure(boxes, count, count_ > 0 ? built_ : stats);
  }

  COLD void release() {
    forget();
    watch_.release();
    regions_.release();
    bases_.release();
    tags_.release();
    groups_.release();
    late_.release();
    places_.release();
    candidates_.list.release();
    extra_.list.release();
    settled_.list.release();
    order_.release();
    prospect_.fresh = 0;
    pause_ = 0;
    pauses_ = tuning.watched;
    anew_.release();
  }

 private:
  f32* region(u32 slot) const { return regions_.data() + u64(slot) * width; }
  f32* base(u32 slot) const { return bases_.data() + u64(slot) * width; }

  f32 size() const { return f32(prospect_.smallest()); }

  // --- whether anything is kept ---

  COLD bool find(const Scene<D>& scene, f32 margin, Pairs& pairs, Stats& stats) {
    u32 n = scene.count;
    if (n < tuning.few) {
      forget();
      return false;
    }
    prospect_.boxes = n;
    if (pause_ > Watch<D>::longest) {  // nobody will ask yet how far boxes have got
      pause_--;
      return false;
    }
    watch_.look(scene, size());
    if (prospect_.fresh == 0) return false;
    if (count_ > 0 && !ended_ && follow(scene)) {
      report(scene, pairs, stats);
      account(scene);
      return true;
    }
    if (count_ == 0 && pause_ > 0) {
      pause_--;
      return false;
    }
    Plan plan = choose(scene);
    if (plan.work > tuning.worth * prospect_.fresh) {
      if (count_ > 0 || watch_.known() >= tuning.watched) give_up();
      return false;
    }
    build(scene, margin > 0 ? margin : plan.margin);
    report(scene, pairs, stats);
    account(scene);
    return true;
  }

  COLD Plan choose(const Scene<D>& scene) {
    prospect_.looked = scene.listed() ? f64(scene.changes->count()) / scene.count : 1;
    prospect_.rest = watch_.resting();
    return watch_.plan(prospect_, tuning);
  }

  void rebuild(const Scene<D>& scene, const Settings& options, Pairs& pairs, Stats& stats) {
    stats = Stats{};
    pairs.stable = 0;
    anew_.update(scene, options, pairs, stats);
    f64 n = larger(1u, scene.count);
    prospect_.fresh = (tuning.entry * stats.entries + stats.tests) / n;
    prospect_.pairs = larger(pairs.count / n, 0.02);
    if (scene.count >= tuning.few) learn_sizes(scene.count, 0);
  }

  /// Of boxes on average, whose regions have this margin; or an eighth of what they are apart.
  COLD void learn_sizes(u32 boxes, f64 margin) {
    f64 low[D], high[D], sizes[D], across = D == 2 ? __builtin_sqrt(f64(boxes)) : cube_root(boxes);
    anew_.bounds(low, high, sizes);
    for (int a = 0; a < D; a++) prospect_.sizes[a] = larger(sizes[a] - 2 * margin, (high[a] - low[a]) / across / 8);
  }

  /// Gives up what is kept, but not the memory.
  COLD void forget() {
    if (count_ > 0) pause_ = 0;
    count_ = resting_ = 0;
    candidates_.count = extra_.count = settled_.count = 0;
    ended_ = false;
  }

  COLD void give_up() {
    forget();
    watch_.forget();
    pause_ = pauses_;
    pauses_ = smaller(tuning.longest_pause, pauses_ * 2);
  }

  /// What the update has cost, and whether the list is worth going on with.
  COLD void account(const Scene<D>& scene) {
    f64 n = scene.count, build = build_work(), far = prospect_.farness(tuning);
    f64 late = (late_count_ * tuning.late + (met_ + extra_.count) * tuning.candidate) * far / n;
    f64 looked = scene.listed() ? scene.changes->count() : scene.count;
    smooth_ = age_ <= 1 ? late : smooth_ + 0.4 * (late - smooth_);
    lateness_ += late;
    life_ += late + (candidates_.count * tuning.candidate * far + tuning.look * looked) / n;
    age_++;
    ended_ |= smooth_ * age_ > build + lateness_;
    // Boxes have come to rest: a new list will not test their pairs.
    bool judged = (age_ & (age_ - 1)) == 0 || watch_.is_new();
    ended_ |= judged && age_ >= tuning.watched && candidates_.count + extra_.count > 0 && watch_.more_rest(resting_ / n);
    if (age_ >= 4 && (ended_ || age_ % 32 == 0) && life_ + build > tuning.worth * prospect_.fresh * age_) give_up();
    else if (ended_ && age_ >= 8) pauses_ = tuning.watched;
  }

  f64 build_work() const { return prospect_.build(prospect_.growth(margin_), tuning); }

  // --- a list is made ---

  COLD void make_room(u64 n, u64 had) {
    regions_.grow(n * width + padding, had * width);
    tags_.grow(n, had);
    if (n > had) __builtin_memset(tags_.data() + had, 0, (n - had) * sizeof(u32));
  }

  COLD void build(const Scene<D>& scene, f32 margin) {
    u32 n = scene.count, had = smaller(count_, n);
    make_room(n, had);
    bool some_rest = watch_.resting() > 0;
    if (had == 0 && some_rest) anew_.each_same(scene, [&](u32 slot) { tags_[slot] = rests; });
    else if (resting_ > 0 || some_rest) find_resting(scene, had);
    resting_ = 0;
    enclose(scene, margin);
    filtered_ = scene.excluded != nullptr;
    grouped_ = scene.groups != nullptr;
    if (grouped_) __builtin_memcpy(groups_.reserve(n), scene.groups, n * sizeof(u32));
    count_ = n;
    margin_ = margin;
    candidates_.count = extra_.count = settled_.count = head_ = 0;
    built_ = Stats{};
    candidates_.list.reserve(expected(prospect_.growth(margin)) + Pairs::slack);  // copied while it grows it takes longer
    anew_.update(Scene<D>{regions_.data(), n, scene.excluded}, Settings{}, candidates_, built_);
    if (grouped_) filter(candidates_, [&](u32 a, u32 b) { return !one_group(groups_[a], groups_[b]); });
    if (resting_ > 0) settle(scene);
    placed_ = ended_ = false;
    shift_ = {};
    common_ = watch_.common();
    age_ = late_count_ = 0;
    met_ = 0;
    lateness_ = smooth_ = life_ = 0;
    f64 growth = prospect_.growth(margin), work = (tuning.entry * built_.entries + built_.tests) / n;
    prospect_.rest = f64(resting_) / n;
    prospect_.fresh = work / prospect_.widening(growth, tuning);
    prospect_.pairs = larger((settled_.count + candidates_.count / growth) / n, 0.02);
    learn_sizes(n, margin * (1 - prospect_.rest));
  }

  /// Marks those that have been where they are while the last list lived.
  NOINLINE void find_resting(const Scene<D>& scene, u32 had) {
    bool steady = !shift_.differs({});
    for (u32 slot = 0; slot < had; slot++) {
      f32 was[width + padding];
      widen(scene.box(slot), margin_ * f32(1 - (tags_[slot] & rests)), was);
      bool rested = steady && bitmask(alike<D>(was, region(slot))) == 15;
      tags_[slot] = (tags_[slot] & ~rests) | rested;
    }
  }

  /// Gives each box its region.
  NOINLINE void enclose(const Scene<D>& scene, f32 margin) {
    for (u32 slot = 0; slot < scene.count; slot++) {
      u32 rest = tags_[slot] & rests;
      resting_ += rest;
      widen(scene.box(slot), bits<f32>(bits<u32>(margin) & (rest - 1)), region(slot));
      tags_[slot] = rest | scene.excluded_of(slot);
    }
  }

  /// So many candidates a list will hardly exceed.
  u64 expected(f64 growth) const {
    return u64(1.25 * prospect_.boxes * prospect_.pairs * (1 + (growth - 1) * (1 - prospect_.rest * prospect_.rest)));
  }

  /// A box, and so much on all sides.
  static void widen(const f32* box, f32 aside, f32* out) {
    if constexpr (D == 2) {
      store(out, load<f32x4>(box) + f32x4{-aside, -aside, aside, aside});
    } else {
      f32x4 by = splat(aside), high = load<f32x4>(box + D) + by;
      store(out, load<f32x4>(box) - by);
      __builtin_memcpy(out + D, &high, D * sizeof(f32));
    }
  }

  /// Of the candidates, those of two boxes at rest are settled, but for those that will be in doubt.
  NOINLINE void settle(const Scene<D>& scene) {
    u64 left = 0;
    u64* list = candidates_.list.data();
    u64* out = settled_.list.reserve(candidates_.count + 1);
    for (u64 k = 0; k < candidates_.count; k++) {
      u64 pair = list[k];
      bool rest = tags_[u32(pair)] & tags_[u32(pair >> 32)] & rests;
      if (watched_ && rest) rest = !any(equal_bounds<D>(scene.box(u32(pair)), scene.box(u32(pair >> 32))));
      list[left] = *out = pair;
      left += !rest;
      out += rest;
    }
    candidates_.count = left;
    settled_.count = Pairs::between(settled_.list.data(), out);
  }

  // --- an update that a list answers ---

  /// Sees to it that boxes are in their regions; false where a new list is due.
  COLD bool follow(const Scene<D>& scene) {
    u32 n = scene.count, had = count_, both = smaller(n, had);
    u32* list = late_.reserve(2 * u64(n) + 4);
    Shift shift = common_.after(watch_.common().back());
    bool moved = shift.differs(shift_);
    shift_ = shift;
    if (!shift.is_sound()) return false;
    // So many late boxes cost as much as a new list.
    u32 enough = u32(smaller(build_work() * n / (tuning.late * prospect_.farness(tuning)), n / 2.0));
    if (!moved && scene.listed() && !scene.changes->most(n)) late_count_ = look_at(scene, both, list);
    else late_count_ = resting_ ? look<true>(scene, both, list, enough) : look<false>(scene, both, list, enough);
    bool other = filtered_ != (scene.excluded != nullptr) || grouped_ != (scene.groups != nullptr);
    if (scene.filtered || other) refilter(scene, both, list);
    if (late_count_ + (n - both) > enough) {
      if (age_ <= 1) give_up();
      return false;
    }
    met_ = 0;
    if (late_count_ == 0 && n == had) return true;
    if (!placed_) place();
    for (u32 slot = n; slot < had; slot++) {
      resting_ -= tags_[slot] & rests;
      places_.remove(slot);
    }
    make_room(n, both);
    bases_.grow(u64(n) * width + padding, u64(both) * width);
    if (grouped_) groups_.grow(n, both);
    places_.make_room(n, both);
    for (u32 slot = had; slot < n; slot++) {
      tags_[slot] = fresh;
      list[late_count_++] = slot;
    }
    count_ = n;
    serve(scene, list, had);
    return true;
  }

  /// Whether a box is where it is expected: in its region, and where it rests it is just that.
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
  bool is_expected(const Scene<D>& scene, u32 slot) const {
    return is_expected<true>(scene.box(slot), region(slot), tags_[slot], shift_);
  }

  /// Writes the slots of boxes that are not where they are expected; gives how many. More than enough it does not seek.
  template <bool some_rest> NOINLINE u32 look(const Scene<D>& scene, u32 until, u32* out, u32 enough) const {
    const f32 *box = scene.boxes, *its = regions_.data();
    const u32* tags = tags_.data();
    Shift shift = shift_;
    u32 found = 0, slot = 0;
    for (; slot + 4 <= until && found <= enough; slot += 4, box += 4 * width, its += 4 * width) {
      u32 expected[4], all = 1;
      for (u32 k = 0; k < 4; k++) all &= expected[k] = is_expected<some_rest>(box + k * width, its + k * width, tags[slot + k], shift);
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

  /// The same, of those that may have changed.
  NOINLINE u32 look_at(const Scene<D>& scene, u32 until, u32* out) const {
    u32 found = 0;
    for (u32 k = 0; k < scene.changes->count(); k++) {
      u32 slot = scene.changes->list()[k];
      if (slot < until && !is_expected(scene, slot)) out[found++] = slot;
    }
    return found;
  }

  /// Adds those to the late whose exclusion bits or group have changed, which makes them as good as new.
  COLD void refilter(const Scene<D>& scene, u32 until, u32* list) {
    filtered_ = scene.excluded != nullptr;
    bool were_grouped = grouped_;
    grouped_ = scene.groups != nullptr;
    if (grouped_ && !were_grouped) __builtin_memset(groups_.reserve(count_), 0, count_ * sizeof(u32));
    for (u32 slot = 0; slot < until; slot++) {
      bool one = ((grouped_ | were_grouped) ? groups_[slot] : 0) == scene.group_of(slot);
      if (one && (tags_[slot] & ~slot_mask) == scene.excluded_of(slot)) continue;
      tags_[slot] |= fresh;
      list[late_count_++] = slot;  // perhaps once more: `serve` sees that
    }
  }

  /// Sees where all regions are, for the late to be searched among them.
  NOINLINE void place() {
    f64 low[D], high[D], sizes[D];
    anew_.bounds(low, high, sizes);
    places_.divide(low, high, count_);
    places_.make_room(count_, 0);
    for (u32 slot = 0; slot < count_; slot++) places_.put(region(slot), slot);
    u64 numbers = u64(count_) * width;
    __builtin_memcpy(bases_.reserve(numbers + padding), regions_.data(), numbers * sizeof(f32));
    placed_ = true;
  }

  template <class Stays> NOINLINE static void filter(Pairs& pairs, Stays stays) {
    u64 left = 0;
    u64* list = pairs.list.data();
    for (u64 k = 0; k < pairs.count; k++) {
      u64 pair = list[k];
      list[left] = pair;
      left += stays(u32(pair), u32(pair >> 32));
    }
    pairs.count = left;
  }

  /// Gives new regions to the late; those from slot `had` on had none.
  COLD void serve(const Scene<D>& scene, u32* list, u32 had) {
    u32 many = 0, were = 0;
    for (u32 k = 0; k < late_count_; k++) {
      u32 slot = list[k], tag = tags_[slot];
      if (tag & late) continue;
      list[many++] = slot;
      were |= tag;
      resting_ -= tag & rests;
      if (slot < had) places_.remove(slot);
      if (tag & fresh) {  // no candidate of it is listed
        tag = fresh | scene.excluded_of(slot);
        if (grouped_) groups_[slot] = scene.group_of(slot);
        for (u32 k = 0; k < width; k++) base(slot)[k] = __builtin_nanf("");
      }
      tags_[slot] = (tag & ~rests) | late;
    }
    auto filter_listed = [&](u32 a, u32 b) { return b < count_ && !((tags_[a] | tags_[b]) & fresh); };
    if (had > count_ || (were & fresh)) {
      head_ = 0;
      filter(candidates_, filter_listed);
      filter(settled_, filter_listed);
    }
    if (were & rests) unsettle();
    filter(extra_, [&](u32 a, u32 b) { return b < count_ && !((tags_[a] | tags_[b]) & late); });
    for (u32 k = 0; k < many; k++) enlarge(scene, list[k], list + many);
    for (u32 k = 0; k < many; k++) tags_[list[k]] &= ~(late | fresh);
    late_count_ = many + had - smaller(had, count_);
  }

  /// The settled pairs of boxes that do not rest become candidates.
  COLD void unsettle() {
    u64* list = settled_.list.data();
    u64 left = 0, many = settled_.count;
    u64* out = candidates_.list.data() + candidates_.count;
    for (u64 k = 0; k < many; k++) {
      u64 pair = list[k];
      list[left] = pair;
      if (tags_[u32(pair)] & tags_[u32(pair >> 32)] & rests) {
        left++;
        continue;
      }
      head_ = smaller(head_, left);
      out = candidates_.room(out, 1);
      *out++ = pair;
      candidates_.count++;
    }
    settled_.count = left;
  }

  /// A new region for a box that is late. `near`: room for as many slots as there are.
  NOINLINE void enlarge(const Scene<D>& scene, u32 slot, u32* near) {
    f32 box[width + padding], larger_one[width + padding];
    u32 tag = tags_[slot];
    f32 aside = larger(margin_, f32(tuning.late_margin) * size());
    shifted(scene.box(slot), box);
    widen(box, aside, larger_one);
    u32 found = 0;
    places_.each_near(larger_one, [&](u32 other) { near[found++] = other; });
    met_ += found;
    u64* out = extra_.room(extra_.list.data() + extra_.count, found);
    const f32* its_base = base(slot);
    for (u32 k = 0; k < found; k++) {  // without a branch: what a region touches is unpredictable
      u32 other = near[k];
      *out = pair_of(slot, other);
      u32 apart = !boxes_touch<D>(larger_one, region(other)), listed = boxes_touch<D>(its_base, base(other));
      u32 together = grouped_ && one_group(groups_[slot], groups_[other]);
      out += !(apart | listed | together | (tag & tags_[other] & ~slot_mask));
    }
    extra_.count = Pairs::between(extra_.list.data(), out);
    __builtin_memcpy(region(slot), larger_one, width * sizeof(f32));
    places_.put(larger_one, slot);
  }

  /// A box where it would be, had the world not moved since the list was made.
  void shifted(const f32* box, f32* out) const {
    store(out, shift_(load<f32x4>(box)));
    if constexpr (D == 3) store(out + D, shift_(load<f32x4>(box + D)));
  }

  // --- the pairs ---

  /// Reports what is settled, and the candidates that overlap. Only here does a pair become one.
  COLD void report(const Scene<D>& scene, Pairs& pairs, Stats& stats) {
    u64 head = settled_.count, same = smaller(smaller(pairs.stable, head_), head);
    pairs.same = same == head && head == head_ && resting_ == count_ && late_count_ + candidates_.count == 0;
    u64* out = pairs.room(pairs.list.data() + same, head - same);
    if (head > same) __builtin_memcpy(out, settled_.list.data() + same, (head - same) * sizeof(u64));
    pairs.count = head;
    test(scene, candidates_, pairs);
    test(scene, extra_, pairs);
    pairs.stable = head_ = head;
    stats.tests = f64(candidates_.count + extra_.count);
    stats.cells = built_.cells;
    stats.entries = built_.entries;
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
      u64 until = smaller(candidates.count, k + 4096);
      out = pairs.room(out, until - k);
      while (k < until) {
        u64 few = watch ? smaller(until, k + 32) : until;
        const u64* begin = out;
        i32x4 touching = {};
        for (; k < few; k++) {
          u64 pair = list[k];
          const f32 *one = boxes + u64(u32(pair)) * width, *other = boxes + (pair >> 32) * width;
          *out = pair;
          out += boxes_touch<D>(one, other);
          if constexpr (watch) touching |= equal_bounds<D>(one, other);
        }
        if (watch && any(touching)) pairs.doubt(begin, out);
      }
    }
    pairs.count = Pairs::between(pairs.list.data(), out);
  }
};
