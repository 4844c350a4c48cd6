// Coherent motion: where nearly all boxes move, but little, what may meet soon is found once and tested often.
//
// Idea: each box gets a fat one. The pairs of fat boxes that overlap, which strip sweep finds, are the candidates.
// While boxes stay in their fat ones, an update tests these and nothing else. Meanwhile the next fat boxes are made and
// their candidates found, a slice in each update, and take over when all is done: a generation. So no update pays for
// all, and the work of a strip sweep is shared by as many updates as one generation lasts.
//   - A box that leaves its fat one too early gets one that covers both, and whoever overlaps that but not the old one
//     becomes a candidate too. So two boxes are candidates, once, if and only if their fat ones overlap.
//   - The candidates of a box that has jumped, or may meet others than before, are struck out first.
// All is given up where many boxes leave their fat ones at once, or where it does not pay.
// Cost: a pass over the boxes and one over the candidates, some two to four times as many as pairs, and a share of a
// strip sweep: 5 to 9 ns a box in 2D, 10 to 20 in 3D. In the twelve updates in which the first generation is made, one
// costs a quarter to a third more than strip-sweep. Memory, beside that of strip-sweep: about 155 (2D) or 265 (3D) bytes
// a box.
// Part of `incremental`, which says when. From: L. Verlet, 1967; see motion.hpp. Making the next generation a slice at a
// time is ours.
#pragma once
#include "../motion.hpp"
#include "strip_sweep.hpp"

template <int D> class Coherent {
  static constexpr u32 width = 2 * D, padding = 4;
  static constexpr u32 struck = 1u << 31;  // a mark
  static constexpr u32 late_share = 100;  // all is given up where one in so many leaves its fat box at once
  static constexpr f32 least_period = 4, most_period = 48, first_period = 12, growth = 1.15f;
  // What the work of a generation costs for each box, in nanoseconds: noting where it stands, making its fat box and
  // counting it, entering it in its strip, sweeping that; and each update, a box, a candidate, and a box that is late.
  static constexpr f64 look_cost = 3, fatten_cost = D == 2 ? 12 : 18, enter_cost = D == 2 ? 6 : 12,
                       sweep_cost = D == 2 ? 14 : 40;
  static constexpr f64 worth = 0.9;  // what it costs with what has been found, as a share of what it would cost without
  static constexpr f64 all_costs = fatten_cost + enter_cost + sweep_cost, box_cost = 2.5, candidate_cost = 3, late_cost = 1500;

  enum class Stage : u32 { begin, look, fatten, enter, sweep };

  struct Generation {
    Buffer<f32> fat;       // per slot
    Buffer<u32> excluded;  // per slot, the exclusion bits its candidates were found with
    StripSweep<D> strips;
    Pairs candidates;
    Stats stats;
  };

  Generation generations_[2];
  u32 current_ = 0;
  bool begun_ = false;
  u32 count_ = 0;          // boxes that the current generation follows; 0: none answers yet
  bool unchecked_ = false; // no update has looked yet whether boxes are in the fat ones of this generation
  Buffer<f32> from_;       // per slot: its lower corner when it was given its last fat box, and in which update
  Buffer<u32> marks_;      // per slot: one more than its place among the grown, and whether it is struck out
  Buffer<u32> late_;
  Buffer<u32> grown_;      // slots whose fat boxes are not those that were entered any more
  Buffer<f32> grown_fat_;  // these
  u32 grown_count_ = 0;
  u32 now_ = 0;            // updates, counted
  // Of the generation that is being made: how far it is.
  Stage stage_ = Stage::begin;
  u32 at_ = 0, boxes_ = 0, age_ = 0;
  bool known_ = false;     // where boxes were is known from the generation before
  f32 period_ = 16, slack_ = 0.5f;
  f32 pace_ = 0;           // how far boxes move in an update, as a share of their size, in the mean
  f64 motion_ = 0, lates_ = 0;
  f64 hits_ = 0;           // pairs of the last update that was answered; less than 0: none was

  Generation& current() { return generations_[current_]; }
  Generation& next() { return generations_[1 - current_]; }
  f32* from(u32 slot) const { return from_.data() + u64(slot) * (D + 1); }
  static const f32* box_of(const Scene<D>& scene, u32 slot) { return scene.boxes + u64(slot) * width; }
  static u32 excluded_of(const Scene<D>& scene, u32 slot) { return scene.excluded ? scene.excluded[slot] : 0; }

 public:
  /// What an update is going to cost for so many boxes and pairs, where such a share of the boxes moves, so far as a
  /// share of their size.
  COLD static f64 cost(f64 boxes, f64 hits, f64 share, f64 pace) {
    f64 period = best_period(boxes, hits * share, pace), one = 1, both = 1;
    for (int a = 0; a < D; a++) {
      one *= 1 + pace * period;
      both *= 1 + 2 * pace * period;
    }
    f64 candidates = hits * (1 + 2 * share * (1 - share) * (one - 1) + share * share * (both - 1));
    return boxes * (box_cost + all_costs / period) + candidate_cost * candidates;
  }

  bool begun() const { return begun_; }

  COLD void begin(f64 boxes, f64 hits, f64 pace) {
    begun_ = true;
    pace_ = f32(pace);
    period_ = best_period(boxes, hits, pace);
    stage_ = Stage::begin;
    known_ = unchecked_ = false;
    slack_ = 0.5f;
    grown_count_ = 0;
    hits_ = -1;
  }

  /// Finds the pairs, where a generation is there to answer; else false. Gives up where that costs more than `fresh`.
  COLD bool update(const Scene<D>& scene, const Settings& options, f64 fresh, Pairs& pairs, Stats& stats) {
    now_++;
    bool answers = count_ > 0 && follow(scene, options);
    if (answers) report(scene, pairs, stats);
    if (begun_) build(scene, options, fresh);
    return answers;
  }

  COLD void structure(Buffer<f32>& boxes, u32& count) const {
    const Generation& answering = generations_[current_];
    answering.strips.structure(boxes, count, answering.stats);
  }

  /// Gives up what is kept, but not the memory.
  COLD void forget() {
    for (u32 k = 0; k < grown_count_; k++) marks_[grown_[k]] = 0;
    begun_ = false;
    count_ = grown_count_ = 0;
  }

  COLD void release() {
    forget();
    for (Generation& each : generations_) {
      each.fat.release();
      each.excluded.release();
      each.strips.release();
      each.candidates.list.release();
    }
    from_.release();
    marks_.release();
    late_.release();
    grown_.release();
    grown_fat_.release();
    marked_ = 0;
  }

 private:
  u32 marked_ = 0;  // slots that have marks

  /// Updates that a generation should answer: the work of making it balances its candidates, which are the more the
  /// further fat boxes reach, and they must reach twice as far: from when they are made until the next are.
  COLD static f32 best_period(f64 boxes, f64 hits, f64 pace) {
    f64 more = 2 * candidate_cost * larger(hits, boxes / 8) * D * larger(pace, 1e-4);
    return f32(larger(f64(least_period), smaller(f64(most_period), __builtin_sqrt(all_costs * boxes / more))));
  }

  /// Sees to it that fat boxes hold their boxes again; false where all is given up.
  NOINLINE bool follow(const Scene<D>& scene, const Settings& options) {
    Generation& g = current();
    u32 n = scene.count, had = count_, both = smaller(n, had);
    make_room(n, had);
    const f32* fat = g.fat.data();
    const u32* excluded = g.excluded.data();
    u32* late = late_.reserve(u64(n) + 1);
    u32 many = 0;
    auto check = [&](u32 slot) {
      bool holds = inside<D>(box_of(scene, slot), fat + u64(slot) * width) && excluded[slot] == excluded_of(scene, slot);
      late[many] = slot;
      many += !holds;
    };
    if (scene.changes && !scene.changes->all() && !unchecked_) {
      for (u32 k = 0; k < scene.changes->count(); k++) {
        if (scene.changes->list()[k] < both) check(scene.changes->list()[k]);
      }
    } else {
      for (u32 slot = 0; slot < both; slot++) check(slot);
    }
    unchecked_ = false;
    if (u64(many) + (n - both) > n / late_share + 64) {
      forget();
      return false;
    }
    bool strikes = n < had;
    for (u32 k = 0; k < many; k++) {
      u32 slot = late[k];
      f32* its = g.fat.data() + u64(slot) * width;
      if (excluded[slot] == excluded_of(scene, slot) && touch<D>(box_of(scene, slot), its)) continue;
      marks_[slot] |= struck;
      strikes = true;
      appear(scene, slot);
    }
    for (u32 slot = had; slot < n; slot++) {
      late[many++] = slot;
      appear(scene, slot);
    }
    count_ = n;
    if (strikes) strike(g.candidates, n);
    if (n < had) drop_grown(n);
    for (u32 k = 0; k < many; k++) {
      marks_[late[k]] &= ~struck;
      grow(scene, options, late[k]);
    }
    lates_ += many;
    return true;
  }

  /// Room for n slots, of which `had` are in use.
  COLD void make_room(u32 n, u32 had) {
    if (n > had) {
      Generation& g = current();
      g.fat.grow(u64(n) * width + padding, u64(had) * width);
      g.excluded.grow(n, had);
    }
    if (n <= marked_) return;
    from_.grow(u64(n) * (D + 1) + padding, u64(marked_) * (D + 1));
    marks_.grow(n, marked_);
    __builtin_memset(marks_.data() + marked_, 0, (n - marked_) * sizeof(u32));
    marked_ = n;
  }

  /// A box is new, or as good as new: it has no fat box yet.
  COLD void appear(const Scene<D>& scene, u32 slot) {
    Generation& g = current();
    u32 place = marks_[slot] & ~struck;
    for (u32 k = 0; k < width; k++) {
      g.fat[u64(slot) * width + k] = __builtin_nanf("");
      if (place > 0) grown_fat(place - 1)[k] = __builtin_nanf("");
    }
    g.excluded[slot] = excluded_of(scene, slot);
    note(scene, slot);
  }

  /// Notes where a box stands.
  void note(const Scene<D>& scene, u32 slot) const {
    __builtin_memcpy(from(slot), box_of(scene, slot), D * sizeof(f32));
    from(slot)[D] = bits<f32>(now_);
  }

  /// Strikes out the candidates of boxes that are marked, and of slots from n on.
  COLD void strike(Pairs& candidates, u32 n) const {
    u64 left = 0;
    for (u64 k = 0; k < candidates.count; k++) {
      u64 pair = candidates.list[k];
      u32 a = u32(pair), b = u32(pair >> 32);
      candidates.list[left] = pair;
      left += b < n && !((marks_[a] | marks_[b]) & struck);
    }
    candidates.count = left;
  }

  COLD void drop_grown(u32 n) {
    u32 left = 0;
    for (u32 k = 0; k < grown_count_; k++) {
      u32 slot = grown_[k];
      marks_[slot] = slot < n ? left + 1 : 0;
      if (slot >= n) continue;
      grown_[left] = slot;
      __builtin_memcpy(grown_fat(left), grown_fat(k), width * sizeof(f32));
      left++;
    }
    grown_count_ = left;
  }

  /// How much longer a fat box is along an axis than the box; 0 where there is none.
  static f32 spare(const f32* fat, const f32* box, int a) {
    return larger(0.0f, (fat[D + a] - fat[a]) - (box[D + a] - box[a]));
  }

  /// A larger fat box for one that has left its own, and the candidates that come with it.
  COLD void grow(const Scene<D>& scene, const Settings& options, u32 slot) {
    Generation& g = current();
    f32* its = g.fat.data() + u64(slot) * width;
    f32 old[width + padding], fat[width + padding];
    __builtin_memcpy(old, its, width * sizeof(f32));
    const f32* box = box_of(scene, slot);
    for (int a = 0; a < D; a++) {
      // Where it goes now nobody knows, but about how fast.
      f32 size = box[D + a] - box[a], beyond = larger(0.0f, larger(old[a] - box[a], box[D + a] - old[D + a]));
      f32 reach = larger(spare(old, box, a), smaller(8 * beyond, size));
      if (!(old[a] <= old[D + a])) reach = 2 * pace_ * size * (left() + 1);
      if (options.margin > 0) reach = f32(options.margin);
      fat[a] = smaller(smaller(box[a], box[a] - reach), old[a]);
      fat[D + a] = larger(larger(box[D + a], box[D + a] + reach), old[D + a]);
    }
    __builtin_memcpy(its, fat, width * sizeof(f32));
    auto meet = [&](u32 other, const f32* box) {
      if (!touch<D>(fat, box) || touch<D>(old, box)) return;
      if (other == slot || (g.excluded[slot] & g.excluded[other])) return;
      g.candidates.room(g.candidates.list.data() + g.candidates.count, 1);
      g.candidates.list[g.candidates.count++] = pair_of(slot, other);
    };
    g.strips.each_near(fat, [&](u32 other) {
      if (other < count_ && marks_[other] == 0) meet(other, g.fat.data() + u64(other) * width);
    });
    for (u32 k = 0; k < grown_count_; k++) meet(grown_[k], grown_fat(k));
    if (marks_[slot] == 0) {
      grown_.grow(u64(grown_count_) + 1, grown_count_);
      grown_fat_.grow((u64(grown_count_) + 1) * width + padding, u64(grown_count_) * width);
      grown_[grown_count_++] = slot;
      marks_[slot] = grown_count_;
    }
    __builtin_memcpy(grown_fat(marks_[slot] - 1), fat, width * sizeof(f32));
  }

  f32* grown_fat(u32 k) const { return grown_fat_.data() + u64(k) * width; }

  /// Reports the candidates that overlap.
  NOINLINE void report(const Scene<D>& scene, Pairs& pairs, Stats& stats) {
    const Pairs& candidates = current().candidates;
    const u64* list = candidates.list.data();
    const f32* boxes = scene.boxes;
    pairs.kept = 0;
    u64* out = pairs.list.data();
    for (u64 k = 0; k < candidates.count;) {
      u64 until = smaller(candidates.count, k + 4096);
      pairs.count = Pairs::between(pairs.list.data(), out);
      out = pairs.room(out, until - k);
      for (; k < until; k++) {
        u64 pair = list[k];
        *out = pair;
        out += touch<D>(boxes + u64(u32(pair)) * width, boxes + (pair >> 32) * width);
      }
    }
    pairs.count = Pairs::between(pairs.list.data(), out);
    hits_ = f64(pairs.count);
    stats.tests += f64(candidates.count);
    stats.cells = current().stats.cells;
    stats.entries = current().stats.entries;
  }

  /// Updates in which a generation is made: the first one soon, though no update should pay much for it.
  f32 making() const { return known_ ? period_ : first_period; }

  /// Updates until the generation that is being made is likely to be done.
  f32 left() const { return larger(0.0f, making() - f32(age_)); }

  /// Makes a slice of the next generation.
  COLD void build(const Scene<D>& scene, const Settings& options, f64 fresh) {
    if (stage_ == Stage::begin) open(scene);
    else age_++;
    f64 budget = (known_ ? all_costs : all_costs + look_cost) * boxes_ / making();
    while (begun_ && budget > 0 && stage_ != Stage::begin) budget -= slice(scene, options, budget, fresh);
  }

  /// Begins a generation.
  COLD void open(const Scene<D>& scene) {
    Generation& g = next();
    boxes_ = scene.count;
    at_ = age_ = 0;
    motion_ = lates_ = 0;
    make_room(boxes_, boxes_);
    g.fat.reserve(u64(boxes_) * width + padding);
    g.excluded.reserve(boxes_);
    g.candidates.count = 0;
    stage_ = known_ ? Stage::fatten : Stage::look;
    g.strips.begin(scene, g.stats);
  }

  /// Does work of the stage for about so many nanoseconds; gives how many.
  COLD f64 slice(const Scene<D>& scene, const Settings& options, f64 budget, f64 fresh) {
    Generation& g = next();
    f64 each = stage_ == Stage::look ? look_cost : stage_ == Stage::fatten ? fatten_cost : stage_ == Stage::enter ? enter_cost : sweep_cost * boxes_ / g.stats.entries;
    u32 many = u32(smaller(budget / each + 1, f64(max_slots))), until = smaller(boxes_, at_ + many), n = scene.count;
    Scene<D> fat{g.fat.data(), boxes_, g.excluded.data()};
    if (stage_ == Stage::look) {
      for (u32 slot = at_; slot < smaller(n, until); slot++) note(scene, slot);
    } else if (stage_ == Stage::fatten) {
      make_fat(scene, options, until);
      g.strips.count(fat, at_, until);
    } else if (stage_ == Stage::enter) {
      g.strips.enter(fat, at_, until);
    } else {
      if (g.strips.sweep(many, g.candidates) == 0) take_over(scene, fresh);
      return many * each;
    }
    f64 spent = (until - at_) * each;
    at_ = until;
    if (at_ < boxes_) return spent;
    at_ = 0;
    if (stage_ == Stage::look) spent = budget;  // boxes must move before their motion can be seen
    if (stage_ == Stage::fatten && !g.strips.add_up()) forget();
    stage_ = Stage(u32(stage_) + 1);
    return spent;
  }

  /// Fat boxes from `at_` on.
  NOINLINE void make_fat(const Scene<D>& scene, const Settings& options, u32 until) {
    Generation& g = next();
    f32 reach = left() + period_ * growth + 1;
    f32 fat[width + padding];
    for (u32 slot = at_; slot < until; slot++) {
      if (slot < scene.count) {
        const f32* box = box_of(scene, slot);
        u32 updates = now_ - bits<u32>(from(slot)[D]);
        fatten<D>(box, from(slot), larger(updates, 1u), reach, slack_, options.margin, fat);
        if (updates == 0 || marks_[slot] > 0) surround(box, slot, reach, fat);
        motion_ += pace<D>(box, from(slot), larger(updates, 1u));
        note(scene, slot);
        g.excluded[slot] = excluded_of(scene, slot);
      } else {
        for (u32 k = 0; k < width; k++) fat[k] = __builtin_nanf("");
        g.excluded[slot] = 0;
      }
      __builtin_memcpy(g.fat.data() + u64(slot) * width, fat, width * sizeof(f32));
    }
  }

  /// Of a box that left its fat one nobody knows where it goes, but about how fast; of one that has just come, that it
  /// may be as fast as others. Its fat box reaches to all sides.
  COLD void surround(const f32* box, u32 slot, f32 updates, f32* out) {
    for (int a = 0; a < D; a++) {
      f32 reach = pace_ * (box[D + a] - box[a]) * updates;
      if (slot < count_) reach = larger(reach, spare(current().fat.data() + u64(slot) * width, box, a) / 2);
      out[a] = smaller(out[a], box[a] - reach);
      out[D + a] = larger(out[D + a], box[D + a] + reach);
    }
  }

  /// The generation is done: it answers from the next update on.
  COLD void take_over(const Scene<D>& scene, f64 fresh) {
    Generation& g = next();
    u32 n = scene.count;
    for (u32 k = 0; k < grown_count_; k++) marks_[grown_[k]] = 0;
    grown_count_ = 0;
    current_ = 1 - current_;
    count_ = smaller(boxes_, n);
    if (n < boxes_) strike(g.candidates, n);
    unchecked_ = known_ = true;
    stage_ = Stage::begin;
    pace_ = f32(motion_ / boxes_);
    if (hits_ >= 0) {
      f64 cost = boxes_ * (box_cost + all_costs / period_) + candidate_cost * f64(g.candidates.count) + late_cost * lates_ / (age_ + 1);
      if (cost > worth * fresh) return forget();
      // Not longer than by what fat boxes reach further.
      period_ = smaller(period_ * growth, best_period(boxes_, hits_, pace_));
      // Where boxes leave their fat ones too early, the next reach further to the sides.
      slack_ = smaller(16.0f, larger(0.5f, slack_ * (lates_ > 0.1 * boxes_ ? 1.3f : 0.95f)));
    }
  }
};
