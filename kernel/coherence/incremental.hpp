// Incremental: each update tests a list of pairs that may come to overlap, instead of a full rebuild.
//
// Idea: candidate_list.hpp has the list; this file decides when one is made, with which margin, and when it ends.
//   - The margin comes from measured displacements, not predictions: see watch.hpp. If no margin is expected to pay,
//     strip sweep runs, and a list is tried again after 8 to 512 updates, from new measurements.
//   - A list ends when late boxes cost more than a new list would, on average, or much more in one update; and when
//     new measurements promise a better one. Bounded motion never ends one.
//   - A new list costs 1.5 rebuilds or more. If the old one has lived long, that is divided between two updates: the
//     last one that the old list answers puts the regions into strips, the next one sweeps them. So the new list is
//     begun when the sample tells that too many boxes will be late in the next update.
// Nothing here reads a clock: work is counted, so the order of the pairs depends on the calls alone.
// Wins when boxes are at rest, jitter, turn, or move by less than a tenth of their size. Equals strip sweep when they
// jump.
#pragma once
#include "coherence/candidate_list.hpp"
#include "coherence/pair_sample.hpp"

template <int D> class Incremental {
  static constexpr Tuning<D> tuning = {};

  StripSweep<D>& strips_;
  CandidateList<D> list_;
  Watch<D> watch_;
  PairSample sample_;
  Prospect<D> prospect_ = {};
  u32 age_ = 0;  // of the list, in updates
  bool ended_ = false;  // a new list is due
  f64 made_ = 0;  // work per box: of making the list
  f64 growth_ = 1, planned_ = 0;  // that was expected of the list; its work per box and update
  f64 lateness_ = 0, smooth_ = 0, life_ = 0;  // since then: for late boxes; the running mean of that; in all
  f64 foretold_ = 0, surplus_ = 0;  // the share of boxes expected to be late; by how much that was too high, at most
  u32 pause_ = 0, pauses_ = tuning.watched;

 public:
  static constexpr bool notes_doubts = true;
  static constexpr bool follows_changes = true;
  static constexpr bool varies_order = true;

  constexpr explicit Incremental(StripSweep<D>& strips) : strips_(strips), list_(strips) {}
#if !defined(__wasm__)
  ~Incremental() { release(); }
#endif

  void update(const Scene<D>& scene, const Options& options, Pairs& pairs, Stats& stats) {
    pairs.count = 0;
    list_.check(scene, pairs.watch);
    bool kept = find(scene, f32(options.margin), pairs, stats);
    if (!kept) rebuild(scene, options, pairs, stats);
    pairs.checked = kept;
    stats.reason = f64(u32(kept                                                  ? Reason::kept
                           : pause_ > 0 || scene.count < Watch<D>::least_watched ? Reason::moving
                                                                                 : Reason::watching));
  }

  SMALL void structure(Buffer<f32>& boxes, u32& count, const Stats& stats) {
    if (!list_.is_empty() && !list_.is_finished()) finish(__builtin_inf());
    strips_.structure(boxes, count, list_.is_empty() ? stats : list_.built());
  }

  SMALL void release() {
    forget();
    watch_.release();
    list_.release();
    sample_.release();
    prospect_.fresh = 0;
    pause_ = 0;
    pauses_ = tuning.watched;
    strips_.release();
  }

 private:
  f32 size() const { return f32(prospect_.size); }

  SMALL bool find(const Scene<D>& scene, f32 margin, Pairs& pairs, Stats& stats) {
    u32 n = scene.count;
    if (n < Watch<D>::least_watched) {
      forget();
      return false;
    }
    if (pause_ > Watch<D>::longest) {  // too early to measure motion
      pause_--;
      return false;
    }
    watch_.look(scene, size());
    list_.origins().pass();
    if (list_.is_empty() && watch_.is_new()) list_.origins().record(scene, watch_.common());
    if (prospect_.fresh == 0) return false;
    f64 most = tuning.build * prospect_.fresh * n;
    if (!list_.is_empty() && !list_.is_finished() && !finish(most)) return false;
    if (list_.is_empty() || ended_ || !follow(scene)) {
      if (!begin(scene, margin) || !finish(most)) return false;
    }
    list_.report(scene, pairs, stats);
    ended_ = account(scene);
    if (ended_ && is_divided()) begin(scene, margin);
    return true;
  }

  bool follow(const Scene<D>& scene) {
    return list_.follow(scene, watch_.common(), most_lateness(), size(), prospect_.least * tuning.apart);
  }

  /// What late boxes may cost in one update: no more than making the list, nor than `spike` times the mean cost of an
  /// update. If all boxes leave their regions within a few updates, the list ends with the first of them.
  f64 most_lateness() const { return smaller(made_, tuning.spike * (made_ + lateness_) / age_); }

  SMALL Plan choose(const Scene<D>& scene) {
    prospect_.looked = scene.listed() ? f64(scene.changes->count()) / scene.count : 1;
    prospect_.rest = watch_.resting();
    share_pairs(scene);
    prospect_.planning = tuning.planning / scene.count;
    prospect_.late = tuning.late_among(scene.count);
    return watch_.plan(prospect_, tuning.ahead * prospect_.fresh);
  }

  /// Estimates which shares of the pairs the next list settles, and which it tests.
  SMALL void share_pairs(const Scene<D>& scene) {
    f64 settled = 0, others = 1, listed = 1;
    if (!list_.is_empty()) {
      settled = f64(list_.still());
      others = (list_.built().candidates - settled) / growth_;
      listed = f64(list_.candidates().count) / growth_;
      sample_.take(list_.candidates());
    }
    f64 all = larger(1.0, settled + others), rest = 0;
    if (prospect_.rest > 0) {
      rest = sample_.resting(scene, list_.origins());
      settled += others * rest;
    } else {
      listed += settled;
      settled = 0;
    }
    prospect_.settled = settled / all;
    prospect_.listed = listed * (1 - rest) / all;
  }

  SMALL void rebuild(const Scene<D>& scene, const Options& options, Pairs& pairs, Stats& stats) {
    stats = Stats{};
    pairs.stable = 0;
    strips_.update(scene, options, pairs, stats);
    f64 n = larger(1u, scene.count);
    prospect_.fresh = strips_.work() / n;
    prospect_.tests = strips_.tested() / n;
    prospect_.pairs = pairs.count / n;
    if (pause_ == 0) sample_.take(pairs);
    if (scene.count >= Watch<D>::least_watched) learn_sizes(scene.count);
  }

  /// Begins a list in place of the one there is, if one is expected to pay. Otherwise drops that.
  SMALL bool begin(const Scene<D>& scene, f32 margin) {
    if (!list_.is_empty() && !has_paid()) give_up();
    else if (!list_.is_empty() && age_ >= tuning.watched) pauses_ = tuning.watched;
    if (list_.is_empty() && pause_ > 0) {
      pause_--;
      return false;
    }
    if (list_.is_empty() && watch_.known() < tuning.watched && !watch_.is_judged())
      return false;  // nothing new is known
    Plan plan = choose(scene);
    if (plan.work == __builtin_inf()) {
      if (!list_.is_empty() || watch_.known() >= tuning.watched || watch_.wavers()) give_up();
      return false;
    }
    if (list_.is_empty() && list_.origins().age() > 2 * plan.lead && plan.lead > 0) {  // velocities are out of date
      list_.origins().record(scene, watch_.common());
      pause_ = plan.lead;
      return false;
    }
    if (margin > 0) plan = {margin, watch_.growth(margin, prospect_), 0, 0, plan.settles};
    list_.begin(scene, plan, watch_.common(), watch_.resting() > 0 && plan.settles, Watch<D>::farthest * size());
    growth_ = plan.growth;
    planned_ = plan.work;
    age_ = 0;
    ended_ = false;
    lateness_ = smooth_ = life_ = 0;
    foretold_ = surplus_ = 0;
    return true;
  }

  /// Finishes a list, and learns from its work. Gives it up and returns false if that takes more than `most` tests: then
  /// it has far more candidates than was expected.
  SMALL bool finish(f64 most) {
    if (!list_.finish(most)) {
      give_up();
      return false;
    }
    f64 n = list_.count(), growth = growth_;
    made_ = prospect_.planning + list_.made_work() / n;
    prospect_.rest = list_.resting() / n;
    // These two estimates may only go down. One that is too low is corrected by the rebuild after the list is given up.
    // One that is too high would keep the list alive, so it would never be corrected.
    f64 entering = strips_.work() - strips_.tested(), settled = f64(list_.still());
    f64 pairs = settled + (list_.built().candidates - settled) / growth;
    prospect_.settled = settled / larger(1.0, pairs);
    prospect_.tests = smaller(prospect_.tests, strips_.tested() / n / prospect_.more_tests(growth));
    prospect_.fresh = smaller(prospect_.fresh, entering / n + prospect_.tests);
    prospect_.pairs = pairs / n;
    return true;
  }

  /// Learns the mean size of boxes along the axis where it is smallest, which is at least a share of their spacing.
  SMALL void learn_sizes(u32 boxes) {
    prospect_.least = watch_.spacing(boxes) / tuning.apart;
    prospect_.size = 0;
    for (int a = 0; a < D; a++) {
      f64 size = larger(strips_.size(a), prospect_.least);
      if (size > 0 && (prospect_.size == 0 || size < prospect_.size)) prospect_.size = size;
    }
  }

  /// Drops the list, but keeps the memory.
  SMALL void forget() {
    if (!list_.is_empty()) pause_ = 0;
    list_.forget();
    ended_ = false;
  }

  SMALL void give_up() {
    forget();
    watch_.forget();
    pause_ = pauses_;
    pauses_ = smaller(Watch<D>::longest * tuning.watched, pauses_ * 2);
  }

  /// Adds up the work of this update, and returns whether a new list is due.
  SMALL bool account(const Scene<D>& scene) {
    f64 n = scene.count;
    f64 late = list_.late_work() / n;
    f64 looked = scene.listed() ? scene.changes->count() : scene.count;
    smooth_ += (late - smooth_) * 2 / tuning.watched;
    lateness_ += late;
    f64 least = list_.least_work(looked) / n;
    life_ += late + least;
    age_++;
    if (least > prospect_.fresh || smooth_ * age_ > made_ + lateness_) return true;
    if (can_divide() && foretell(scene) * tuning.late_among(n) > most_lateness() && is_divided()) return true;
    if (age_ < tuning.watched) return false;
    // If all boxes have come to rest, a new list will test no pairs.
    auto known = [&](u32 slot, f32x4) { return list_.rests_at(slot) || !scene.is_at_home(slot); };
    if (list_.tested() > 0 && watch_.is_quiet() && watch_.leaving(known) > 0) return true;
    // What this list has cost beyond its plan, such as for boxes that come and go, another one will cost as well.
    return watch_.is_new() && choose(scene).work + larger(0.0, life_ / age_ - planned_) < smooth_ + least;
  }

  /// The share of boxes expected to be late in the next update, less the largest error so far: boxes that jitter turn
  /// back.
  f64 foretell(const Scene<D>& scene) {
    surplus_ = larger(surplus_, foretold_ - f64(list_.late_count()) / scene.count);
    foretold_ = watch_.leaving([&](u32 slot, f32x4 move) { return list_.stays(scene, slot, move); });
    return foretold_ - surplus_;
  }

  /// Whether the next list will be made in two updates.
  bool is_divided() const { return age_ >= tuning.watched && can_divide(); }
  /// Whether that can pay: among few boxes, most of the time goes into choosing a margin.
  bool can_divide() const { return 2 * prospect_.planning < prospect_.fresh; }

  /// Whether the list has cost less than rebuilds would have.
  bool has_paid() const { return life_ + made_ <= prospect_.fresh * age_; }
};
