// Incremental: a list of the pairs that may come to overlap, which is tested in each update instead of finding all anew.
//
// Idea: each box has a region, which is the box when the list was made and a margin on all sides. Two boxes whose regions
// touch are a candidate. While boxes stay in their regions, an update looks at all boxes and tests the candidates.
//   - Late: a box that has left its region gets another, with twice the margin each time, and the candidates that come
//     with it. It is a stray from then on: its first region still says which candidates are listed.
//   - Wild: a box that is late again and again has no region. It is searched by itself in each update, and given
//     another try now and then.
//   - Rest: a box that has not moved while a list lived, or in the update before the first one, is its own region. Pairs of two at rest are settled: they stand at
//     the head of the list of pairs, and nobody tests them.
//   - A list ends when being late has cost more than a new list would, on average. Motion with bounds never ends one.
//   - The margin is measured, not foreseen: see watch.hpp. Where none promises to pay, strip sweep answers, and it is
//     tried again after 8 to 512 updates.
// Nothing here looks at a clock: work is counted, so the order of the pairs depends on the calls alone.
// Cost: about 1 ns a box and 2 ns a candidate; to make a list, one and a half times what strip sweep takes.
// Memory, beside that of strip sweep: about 60 (2D) or 90 (3D) bytes a box, and 8 a candidate.
// Wins where boxes rest, tremble, turn, or move by less than a tenth of their size. Is strip sweep where they jump.
// From: L. Verlet, "Computer Experiments on Classical Fluids", 1967.
#pragma once
#include "../pair_order.hpp"
#include "../techniques/strip_sweep.hpp"
#include "strays.hpp"
#include "watch.hpp"

template <int D> class Incremental {
  static constexpr u32 width = 2 * D;
  static constexpr u32 padding = 4;  // vector loads may read this many floats past the last box
  static constexpr Tuning<D> tuning = {};
  static constexpr u32 most_cells = 64;  // a region that touches more cells of the strays is too large for them
  static constexpr u32 tries = 32;       // updates in which each wild box has one more try
  // In a tag, below the exclusion bits:
  enum : u32 { rests = 1, strays = 2, wild = 4, grown = 8, most_grown = 15 * grown, struck = 128 };

  struct Stray {
    f32 base[width];  // the region when the list was made: says which of its candidates are listed
    u32 late_at, streak;
  };

  StripSweep<D>& anew_;
  StripSweep<D> strips_;    // of the regions, when the list was made
  Watch<D> watch_;
  Prospect<D> prospect_ = {};
  u32 count_ = 0;           // boxes that are followed; 0: nothing is kept
  bool ended_ = false;      // a new list is due
  bool watched_ = false;    // pairs in doubt are to be noted
  bool filtered_ = false;   // some have exclusion bits
  // Per slot:
  Buffer<f32> regions_;
  Buffer<u32> tags_;        // exclusion bits, and ours below them
  Buffer<u32> records_;     // of a stray: where in `strays_`
  Buffer<u32> late_;
  Buffer<Stray> strays_;
  u32 late_count_ = 0, stray_count_ = 0, resting_ = 0;
  Strays<D> grid_;          // the strays that are not wild
  Buffer<u32> wild_;
  u32 wild_count_ = 0;
  Buffer<f32> wild_boxes_;
  Buffer<u32> wild_bits_, near_;
  Pairs candidates_, extra_, settled_, scratch_;  // extra: those of strays
  PairOrder order_;
  u64 head_ = 0;            // the first so many of `settled_` are those of the last report
  Stats built_ = {};
  f32 margin_ = 0;
  f32x4 offset_ = {}, common_ = {};  // how far all have moved in common since; and what the watch said of it then
  u32 now_ = 0, age_ = 0;
  u32 rest_age_ = tuning.watched;  // updates until it is asked again whether more boxes rest than the list knows
  f64 lateness_ = 0, smooth_ = 0, life_ = 0;  // work, for each box, since the list was made: for the late; of an update; all
  u32 pause_ = 0, pauses_ = tuning.first_pause;

 public:
  constexpr explicit Incremental(StripSweep<D>& anew) : anew_(anew), strips_(anew.swept()) {}
#if !defined(__wasm__)
  ~Incremental() { release(); }
#endif

  void update(const Scene<D>& scene, const Settings& options, Pairs& pairs, Stats& stats) {
    pairs.count = 0;
    if (pairs.watch && !watched_) forget();  // what is settled may be in doubt
    watched_ = pairs.watch;
    now_++;
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
    if (count_ > 0) strips_.structure(boxes, count, built_);
    else anew_.structure(boxes, count, stats);
  }

  COLD void release() {
    forget();
    watch_.release();
    strips_.release();
    regions_.release();
    tags_.release();
    records_.release();
    late_.release();
    strays_.release();
    grid_.release();
    wild_.release();
    wild_boxes_.release();
    wild_bits_.release();
    near_.release();
    Pairs* lists[] = {&candidates_, &extra_, &settled_, &scratch_};
    for (Pairs* pairs : lists) pairs->list.release();
    order_.release();
    prospect_.fresh = 0;
    pause_ = 0;
    pauses_ = tuning.first_pause;
    anew_.release();
  }

 private:
  f32* region(u32 slot) const { return regions_.data() + u64(slot) * width; }
  Stray& stray(u32 slot) const { return strays_[records_[slot]]; }
  /// The region of a box when the list was made.
  const f32* base(u32 slot) const { return tags_[slot] & strays ? stray(slot).base : region(slot); }

  f32 size() const {
    return f32(prospect_.smallest());
  }

  // --- whether anything is kept ---

  COLD bool find(const Scene<D>& scene, f32 margin, Pairs& pairs, Stats& stats) {
    u32 n = scene.count;
    if (n < tuning.few || prospect_.fresh == 0) {
      if (n < tuning.few) forget();
      return false;
    }
    prospect_.boxes = n;
    if (watch_.is_new()) {
      for (int a = 0; a < D; a++) prospect_.sizes[a] = watch_.size(a, n);
    }
    if (!watches()) {
      pause_--;
      return false;
    }
    watch_.look(scene, size());
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
    if (scene.count >= tuning.few && watches()) watch_.begin_if_new(scene);
  }

  /// Whether boxes are watched: not in a long pause until shortly before its end.
  bool watches() const { return pause_ <= Watch<D>::longest; }

  /// Gives up what is kept, but not the memory.
  COLD void forget() {
    if (count_ > 0) pause_ = 0;
    count_ = wild_count_ = stray_count_ = resting_ = 0;
    rest_age_ = tuning.watched;
    candidates_.count = extra_.count = settled_.count = 0;
    ended_ = false;
  }

  COLD void give_up() {
    forget();
    pause_ = pauses_;
    pauses_ = smaller(tuning.longest_pause, pauses_ * 2);
    if (!watches()) watch_.release();
  }

  /// What the update has cost, and whether the list is worth going on with.
  COLD void account(const Scene<D>& scene) {
    f64 n = scene.count, build = build_work(), far = prospect_.farness(tuning);
    f64 late = ((late_count_ + wild_count_) * tuning.late + extra_.count * tuning.candidate) * far / n;
    f64 looked = scene.listed() ? scene.changes->count() : scene.count;
    smooth_ = age_ <= 1 ? late : smooth_ + 0.4 * (late - smooth_);
    lateness_ += late;
    life_ += late + (candidates_.count * tuning.candidate * far + tuning.look * looked) / n;
    age_++;
    ended_ |= smooth_ * age_ > build + lateness_;
    // Boxes have come to rest: a new list will not test their pairs.
    if (age_ % rest_age_ == 0 && candidates_.count + extra_.count > 0) {
      bool more = watch_.more_rest(resting_ / n);
      ended_ |= more;
      rest_age_ = more ? smaller(tuning.longest_pause, 2 * rest_age_) : larger(tuning.watched, rest_age_ / 2);
    }
    if (age_ >= 4 && (ended_ || age_ % 32 == 0) && life_ + build > tuning.proven * prospect_.fresh * age_) give_up();
    else if (ended_ && age_ >= 8) pauses_ = tuning.first_pause;
  }

  f64 build_work() const { return prospect_.build(prospect_.growth(margin_), tuning); }

  // --- a list is made ---

  COLD void make_room(u64 n, u64 had) {
    regions_.grow(n * width + padding, had * width);
    tags_.grow(n, had);
    records_.grow(n, had);
  }

  COLD void build(const Scene<D>& scene, f32 margin) {
    u32 n = scene.count, had = smaller(count_, n);
    make_room(n, had);
    bool first = had == 0;
    bool steady = !any(bits<i32x4>(offset_));
    keep_wild(n);
    resting_ = 0;
    if (first) {
      __builtin_memset(tags_.data(), 0, n * sizeof(u32));
      if (watch_.resting() > 0) anew_.each_same(scene, [&](u32 slot) { tags_[slot] = rests; });
    }
    for (u32 slot = 0; slot < n; slot++) {
      const f32* box = scene.box(slot);
      u32 tag = first || slot < had ? tags_[slot] & slot_mask : 0;
      f32 aside = margin;
      if (!first) {
        bool rested = steady && slot < had && !(tag & strays) && is_widened(region(slot), box, tag & rests ? 0 : margin_);
        tag = rested ? tag | rests : tag & (wild | most_grown);
        if (rested && tag >= grown) tag -= grown;
      }
      if (tag & (rests | wild)) aside = 0;
      resting_ += tag & rests ? 1 : 0;
      widen(box, aside, region(slot));
      tags_[slot] = tag | scene.excluded_of(slot);
    }
    filtered_ = scene.excluded != nullptr;
    count_ = n;
    stray_count_ = 0;
    margin_ = margin;
    candidates_.count = extra_.count = settled_.count = head_ = 0;
    built_ = Stats{};
    candidates_.list.reserve(expected(prospect_.growth(margin)) + Pairs::slack);  // copied while it grows it takes longer
    strips_.update_searched(Scene<D>{regions_.data(), n, scene.excluded}, candidates_, built_);
    if (resting_ > 0) settle(scene);
    f64 low[D], high[D];
    strips_.bounds(low, high);
    grid_.divide(low, high, n);
    for (u32 k = 0; k < wild_count_; k++) stand_aside(wild_[k]);
    offset_ = f32x4{};
    common_ = watch_.common();
    ended_ = false;
    age_ = late_count_ = 0;
    lateness_ = smooth_ = life_ = 0;
    f64 growth = prospect_.growth(margin), work = (tuning.entry * built_.entries + built_.tests) / n;
    prospect_.rest = f64(resting_) / n;
    prospect_.fresh = work / prospect_.widening(growth, tuning);
    prospect_.pairs = larger((settled_.count + candidates_.count / growth) / n, 0.02);
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

  /// Whether a region is just a box and so much on all sides: without a store that a wider load would wait for.
  static bool is_widened(const f32* region, const f32* box, f32 aside) {
    f32x4 its = load<f32x4>(region);
    if constexpr (D == 2) {
      return bitmask(load<f32x4>(box) + f32x4{-aside, -aside, aside, aside} == its) == 15;
    } else {
      f32x4 by = splat(aside);
      i32x4 low = load<f32x4>(box) - by == its, high = load<f32x4>(box + D) + by == load<f32x4>(region + D);
      return (bitmask(low & high) & 7) == 7;
    }
  }

  /// Wild boxes that are still among the first n.
  COLD void keep_wild(u32 n) {
    u32 left = 0;
    for (u32 k = 0; k < wild_count_; k++) {
      if (wild_[k] < n && (tags_[wild_[k]] & wild)) wild_[left++] = wild_[k];
    }
    wild_count_ = left;
  }

  /// A wild box becomes a stray that no search meets.
  void stand_aside(u32 slot) {
    Stray& its = record(slot);
    its.late_at = 0;
    for (u32 k = 0; k < width; k++) region(slot)[k] = k < D ? -__builtin_inff() : __builtin_inff();
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
    u32 n = scene.count, had = count_;
    if (n > had) make_room(n, had);
    u32* late = late_.reserve(u64(n) + 4);
    f32x4 offset = watch_.common() - common_;
    bool moved = any(bits<i32x4>(offset) ^ bits<i32x4>(offset_));
    offset_ = offset;
    u32 both = smaller(n, had);
    // So many late boxes cost as much as a new list.
    u32 enough = u32(smaller(build_work() * n / (tuning.late * prospect_.farness(tuning)), n / 2.0));
    if (!moved && scene.listed() && !scene.changes->most(n)) late_count_ = look_at(scene, both, late);
    else late_count_ = resting_ ? look<true>(scene, both, late, enough) : look<false>(scene, both, late, enough);
    bool strikes = n < had;
    if (scene.filtered || filtered_ != (scene.excluded != nullptr)) {
      late = late_.grow(2 * u64(n) + 4, late_count_);
      strikes |= refilter(scene, both, late);
    }
    u32 many = late_count_ + (n - both);
    if (many > enough) {
      if (age_ <= 1) give_up();
      return false;
    }
    for (u32 slot = had; slot < n; slot++) {
      appear(scene, slot);
      late[late_count_++] = slot;
    }
    for (u32 slot = n; slot < had; slot++) resting_ -= tags_[slot] & rests;
    count_ = n;
    if (strikes) {
      keep_wild(n);
      strike(n);
    }
    if (late_count_ + wild_count_ > 0) serve(scene, late);
    return true;
  }

  /// Whether a box is in its region.
  static bool holds(const f32* box, const f32* region, f32x4 offset) {
    if constexpr (D == 2) {
      f32x4 by = __builtin_shufflevector(offset, offset, 0, 1, 0, 1), at = load<f32x4>(box) - by;
      return bitmask(turned(load<i32x4>(region)) <= turned(bits<i32x4>(at))) == 15;
    } else {
      i32x4 low = load<f32x4>(region) <= load<f32x4>(box) - offset;
      return (bitmask(low & (load<f32x4>(box + D) - offset <= load<f32x4>(region + D))) & 7) == 7;
    }
  }

  /// Whether a box is where it is expected: in its region; one that rests is just its region, and may not be smaller.
  bool is_expected(const f32* box, u32 slot) const {
    const f32* its = region(slot);
    if (!holds(box, its, offset_)) return false;
    if (!(tags_[slot] & rests)) return true;
    f32 at[width + padding];
    shifted(box, at);
    return bitmask(alike<D>(at, its)) == 15;
  }

  /// Writes the slots of boxes that are not where they are expected; gives how many. More than enough it does not seek.
  template <bool some_rest> NOINLINE u32 look(const Scene<D>& scene, u32 until, u32* out, u32 enough) const {
    const f32 *box = scene.boxes, *its = regions_.data();
    const u32* tags = tags_.data();
    f32x4 offset = offset_;
    u32 found = 0, slot = 0;
    for (; slot + 4 <= until; slot += 4, box += 4 * width, its += 4 * width) {
      bool all = true;
      for (u32 k = 0; k < 4; k++) all &= holds(box + k * width, its + k * width, offset);
      if constexpr (some_rest) {
        // Four that are as they were need not be asked whether they rest.
        i32x4 same = alike<D>(box, its);
        for (u32 k = 1; k < 4; k++) same &= alike<D>(box + k * width, its + k * width);
        if (bitmask(same) != 15) all &= !any(bits<i32x4>(load<u32x4>(tags + slot) & splat(u32(rests))));
      }
      if (all) continue;
      for (u32 k = 0; k < 4; k++) {
        out[found] = slot + k;
        found += !is_expected(box + k * width, slot + k);
      }
      if (found > enough) return found;
    }
    for (; slot < until; slot++) {
      out[found] = slot;
      found += !is_expected(scene.box(slot), slot);
    }
    return found;
  }

  /// The same, of those that may have changed.
  NOINLINE u32 look_at(const Scene<D>& scene, u32 until, u32* out) const {
    u32 found = 0;
    for (u32 k = 0; k < scene.changes->count(); k++) {
      u32 slot = scene.changes->list()[k];
      if (slot < until && !is_expected(scene.box(slot), slot)) out[found++] = slot;
    }
    return found;
  }

  /// Adds those to the late whose exclusion bits have changed, which makes them as good as new; says whether there are any.
  COLD bool refilter(const Scene<D>& scene, u32 until, u32* late) {
    filtered_ = scene.excluded != nullptr;
    bool some = false;
    for (u32 slot = 0; slot < until; slot++) {
      if ((tags_[slot] & ~slot_mask) == scene.excluded_of(slot)) continue;
      some = true;
      appear(scene, slot);
      late[late_count_++] = slot;  // perhaps once more: `serve` sees that
    }
    return some;
  }

  /// A box is new, or as good as new: it has no region, and no candidate of it is listed.
  COLD void appear(const Scene<D>& scene, u32 slot) {
    bool known = slot < count_;
    if (known && (tags_[slot] & rests)) resting_--;
    if (!known) tags_[slot] = 0;
    tags_[slot] = (tags_[slot] & strays) | struck | scene.excluded_of(slot);
    Stray& its = record(slot);
    its.late_at = now_ - 4;
    for (u32 k = 0; k < width; k++) its.base[k] = __builtin_nanf("");
  }

  /// The record of a stray; a box becomes one by it.
  Stray& record(u32 slot) {
    if (!(tags_[slot] & strays)) {
      strays_.grow(u64(stray_count_) + 1, stray_count_);
      Stray& its = strays_[stray_count_];
      __builtin_memcpy(its.base, region(slot), sizeof(its.base));
      its.late_at = now_ - age_;
      its.streak = 0;
      records_[slot] = stray_count_++;
      tags_[slot] |= strays;
    }
    return stray(slot);
  }

  /// Strikes out the pairs of boxes that are as good as new, and of slots from n on.
  COLD void strike(u32 n) {
    head_ = 0;
    Pairs* lists[] = {&candidates_, &settled_, &extra_};
    for (Pairs* pairs : lists) {
      filter(*pairs, [&](u32 a, u32 b) { return b < n && !((tags_[a] | tags_[b]) & struck); });
    }
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

  /// Gives new regions to the late, and another try to some of the wild.
  COLD void serve(const Scene<D>& scene, u32* late) {
    bool woken = false;
    u32 many = 0;
    for (u32 k = 0; k < late_count_; k++) {
      u32 slot = late[k];
      if (tags_[slot] & rests) {
        tags_[slot] &= ~rests;
        resting_--;
        woken = true;
      }
      Stray& its = record(slot);
      if (its.late_at == now_) continue;
      its.streak = now_ - its.late_at <= tuning.again ? its.streak + 1 : 0;
      its.late_at = now_;
      tags_[slot] &= ~struck;
      if ((tags_[slot] & most_grown) < most_grown) tags_[slot] += grown;
      late[many++] = slot;
    }
    for (u32 k = now_ % tries; k < wild_count_; k += tries) {
      u32 slot = wild_[k];
      tags_[slot] &= ~wild;
      stray(slot).streak = tuning.wild - 1;
      stray(slot).late_at = now_;
      late[many++] = slot;
    }
    late_count_ = many;
    if (many == 0) return;
    keep_wild(count_);
    if (woken) unsettle();
    filter(extra_, [&](u32 a, u32 b) { return !is_late(a) && !is_late(b); });
    for (u32 k = 0; k < many; k++) enlarge(scene, late[k]);
  }

  bool is_late(u32 slot) const { return (tags_[slot] & strays) && stray(slot).late_at == now_; }

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

  /// A new region for a box that is late, or none where it is wild.
  NOINLINE void enlarge(const Scene<D>& scene, u32 slot) {
    f32 box[width + padding], larger_one[width + padding];
    u32 times = (tags_[slot] & most_grown) / grown;
    f32 aside = larger(margin_, smaller(margin_ * f32(1u << times), size()));
    shifted(scene.box(slot), box);
    widen(box, aside, larger_one);
    if (stray(slot).streak >= tuning.wild || grid_.cells(larger_one) > most_cells) {
      tags_[slot] |= wild;
      wild_.grow(u64(wild_count_) + 1, wild_count_);
      wild_[wild_count_++] = slot;
      return stand_aside(slot);
    }
    for (u32 k = look_around(slot, larger_one); k-- > 0;) add(extra_, slot, near_[k]);
    __builtin_memcpy(region(slot), larger_one, width * sizeof(f32));
    grid_.put(larger_one, slot, now_);
  }

  /// A box where it would be, had the world not moved since the list was made.
  void shifted(const f32* box, f32* out) const {
    store(out, load<f32x4>(box) - (D == 2 ? __builtin_shufflevector(offset_, offset_, 0, 1, 0, 1) : offset_));
    if constexpr (D == 3) store(out + D, load<f32x4>(box + D) - offset_);
  }

  NOINLINE static void add(Pairs& pairs, u32 a, u32 b) {
    u64* out = pairs.room(pairs.list.data() + pairs.count, 1);
    *out = pair_of(a, b);
    pairs.count++;
  }

  /// Writes to `near_` each box whose region touches this one, and that is no candidate with the slot in the list: those
  /// that are not wild. Gives how many.
  NOINLINE u32 look_around(u32 slot, const f32* box) {
    u32 found = 0, tag = tags_[slot] & ~slot_mask;
    const f32* its_base = base(slot);
    auto meet = [&](u32 other) {
      if (other == slot || (tags_[other] & tag) || boxes_touch<D>(its_base, base(other))) return;
      near_.grow(u64(found) + 1, found);
      near_[found++] = other;
    };
    strips_.each_near(box, [&](u32 other) {
      if (other < count_ && !(tags_[other] & strays)) meet(other);
    });
    auto region_of = [&](u32 other, u32 stamp) -> const f32* {
      bool is = other < count_ && (tags_[other] & (strays | wild)) == strays && stray(other).late_at == stamp;
      return is ? region(other) : nullptr;
    };
    grid_.each_near(box, region_of, meet);
    return found;
  }

  // --- the pairs ---

  /// Reports what is settled, the candidates that overlap, and what the wild touch. Only here does a pair become one.
  COLD void report(const Scene<D>& scene, Pairs& pairs, Stats& stats) {
    u64 head = settled_.count, same = smaller(smaller(pairs.stable, head_), head);
    pairs.same = same == head && head == head_ && resting_ == count_ && late_count_ + wild_count_ + candidates_.count == 0;
    u64* out = pairs.room(pairs.list.data() + same, head - same);
    if (head > same) __builtin_memcpy(out, settled_.list.data() + same, (head - same) * sizeof(u64));
    pairs.count = head;
    test(scene, candidates_, pairs);
    test(scene, extra_, pairs);
    u64 sure = pairs.count;
    if (wild_count_ > 0) report_wild(scene, pairs);
    if (watched_) pairs.doubt(pairs.list.data() + sure, pairs.list.data() + pairs.count);
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

  /// The pairs of wild boxes that are no candidates.
  COLD void report_wild(const Scene<D>& scene, Pairs& pairs) {
    f32* boxes = wild_boxes_.reserve(u64(wild_count_) * width + padding);
    u32* bits = wild_bits_.reserve(wild_count_);
    for (u32 k = 0; k < wild_count_; k++) {
      u32 slot = wild_[k];
      const f32* box = scene.box(slot);
      f32 at[width + padding];
      shifted(box, at);
      for (u32 found = look_around(slot, at); found-- > 0;) {
        if (boxes_touch<D>(box, scene.box(near_[found]))) add(pairs, slot, near_[found]);
      }
      __builtin_memcpy(boxes + u64(k) * width, box, width * sizeof(f32));
      bits[k] = scene.excluded_of(slot);
    }
    Stats stats;
    scratch_.count = 0;
    anew_.update(Scene<D>{boxes, wild_count_, bits}, Settings{}, scratch_, stats);
    for (u64 k = 0; k < scratch_.count; k++) {
      u32 a = wild_[u32(scratch_.list[k])], b = wild_[u32(scratch_.list[k] >> 32)];
      if (!boxes_touch<D>(base(a), base(b))) add(pairs, a, b);
    }
  }
};
