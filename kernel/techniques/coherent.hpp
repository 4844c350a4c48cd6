// Coherent motion: where nearly all boxes move, but little, what may meet soon is found once and tested often.
//
// Idea: each box gets a fat one. The pairs of fat boxes that overlap, which strip sweep finds, are the candidates.
// While boxes stay in their fat ones, an update tests these and nothing else. Meanwhile the next fat boxes are made and
// their candidates found, a slice in each update, and take over when all is done: a generation. So no update pays for
// all, and the work of a strip sweep is shared by as many updates as one generation lasts.
//   - A fat box covers where its box will be from the takeover on, not how it comes there: the generation before answers
//     until then. Just before, those are seen to that are elsewhere. Where they are many, fat boxes begin earlier.
//   - A box that leaves its fat one too early gets one that covers both, and whoever overlaps that but not the old one
//     becomes a candidate too. So two boxes are candidates, once, if and only if their fat ones overlap.
//   - The candidates of a box that has jumped, or may meet others than before, are struck out first.
// All is given up where many boxes leave their fat ones at once, or where it does not pay.
// Cost: a pass over the boxes that may have moved and one over the candidates, some two or three times as many as pairs,
// and a share of two or three strip sweeps: 4 to 10 ns a box in 2D, 10 to 30 in 3D. The updates in which the first
// generation is made, up to eighty, cost about a twelfth more than strip-sweep.
// Memory, beside that of strip-sweep: 180 to 230 (2D) or 290 to 400 (3D) bytes a box.
// Part of `incremental`, which says when. From: L. Verlet, 1967; see motion.hpp. Making the next generation a slice at a
// time is ours.
#pragma once
#include "../expected.hpp"
#include "../fat_bins.hpp"
#include "strip_sweep.hpp"

template <int D> class Coherent {
  static constexpr u32 width = 2 * D, padding = 4;
  static constexpr u8 is_grown = 1, struck = 2;  // marks
  static constexpr f64 late_share = 0.5;  // all is given up where those that leave their fat ones cost this share of fresh
  static constexpr f64 few_late = 64;  // so many are no reason
  static constexpr f64 few_late_share = 0.2, few_lost_share = 0.15;  // of what an update costs: it may cost to serve these
  static constexpr i32 least_period = 3, most_period = 64, least_making = 2, most_making = 72;  // these of the first
  // What making the first generation may add to an update, as a share of strip sweep or in nanoseconds.
  static constexpr f64 bearable = 0.08, unnoticed = 1e4;
  static constexpr f64 bearable_once = 0.5, unnoticed_once = 8e4;  // the same for what cannot be shared out: one strip
  static constexpr f32 least_slack = 0.15f;  // fat boxes reach so many motions of an update to all sides, where none is late
  static constexpr f64 spread = D == 2 ? 0.75 : 0.67;  // of motion along an axis, to that along the fastest
  // What the work of a generation costs for each box, in nanoseconds: making its fat box and counting it, writing to the
  // memory of strips, entering it in its strip, sweeping that; where memory is used again, and where for the first time, as
  // it is by the first two.
  static constexpr f64 costs[2][4] = {{D == 2 ? 17 : 20, 0, D == 2 ? 7 : 13, D == 2 ? 18 : 31},
                                      {D == 2 ? 40 : 52, D == 2 ? 16 : 26, D == 2 ? 8 : 14, D == 2 ? 33 : 70}};
  static constexpr f64 mend_cost = D == 2 ? 4 : 10, hit_cost = D == 2 ? 3 : 6;  // a last look; and for each candidate
  // What an update costs for each box, and for a box that is late and each of its candidates.
  static constexpr f64 box_cost = D == 2 ? 2 : 3, late_base = 400, late_each = 300;
  static constexpr f64 late_anew = 3000;  // so much more where nobody has read what was made: by the first two generations
  // And for each candidate; five times as much where the boxes of a scene are far more than the cache holds.
  static constexpr f64 cached_cost = D == 2 ? 2 : 3, uncached_cost = 4 * cached_cost, cached_boxes = 4e5;
  static constexpr f64 all_costs = costs[0][0] + costs[0][2] + costs[0][3] + mend_cost;
  // Boxes of which it is asked whether they are where they were foreseen: at the end, and before the strips are swept, when
  // all is given up where one in so many is not.
  static constexpr u32 asked = 1024, asked_early = 256, lost_early = 8;
  static constexpr f64 bearable_lost = 0.5;  // what seeing to those that are not may cost, as a share of strip sweep
  static constexpr u32 watched = 2;  // it is noted where a box stands about so many updates before its fat box is made
  static constexpr u32 sampled = 4;  // of so many boxes one is asked how fast it is
  static constexpr f64 much_faster = 0.1;  // than expected, in sizes: what is begun is given up
  static constexpr f64 little_more = 1.15;  // times as much is little
  static constexpr f64 worth = 0.9;  // what it costs with what has been found, as a share of what it would cost without

  enum class Stage : u32 { begin, fatten, touch, enter, sweep, mend };

  struct Generation {
    Buffer<f32> fat;       // per slot
    Buffer<u32> excluded;  // per slot, the exclusion bits its candidates were found with
    StripSweep<D> strips;
    Pairs candidates;
    Stats stats;
    FatBins<D> grown;     // the fat boxes that are not those that were entered any more
    Buffer<u8> marks;     // per slot: is_grown, struck
    constexpr explicit Generation(StripSweep<D>& anew) : strips(anew.swept()) {}
  };

  Generation generations_[2];
  u32 current_ = 0;
  bool begun_ = false;
  u32 made_ = 0;           // generations, since memory for them was taken
  u32 count_ = 0;          // boxes that the current generation follows; 0: none answers yet
  bool unchecked_ = false; // no update has looked yet whether boxes are in the fat ones of this generation
  Buffer<f32> from_;       // per slot: its lower corner when it was given its last fat box, and in which update
  Buffer<u32> late_;       // boxes that are not in their fat ones
  u32 late_count_ = 0;
  u32 now_ = 0;            // updates, counted
  // Of the generation that is being made: how far it is.
  Stage stage_ = Stage::begin;
  u32 at_ = 0, boxes_ = 0;
  u32 noted_ = 0;          // of so many boxes it is known where they were
  f64 spent_ = 0;          // of its work, in nanoseconds
  bool known_ = false;     // where boxes were is known from the generation before
  Walls walls_;            // when it was begun
  i32 period_ = 16;        // updates that it is to answer
  i32 making_ = 0;         // updates in which it is made, after the one that begins it
  i32 age_ = 0;            // updates since that
  i32 lasts_ = 0;          // updates that the current one is to answer still
  f32 slack_ = least_slack;
  f32 foresight_ = 1;      // from which part of the way to its takeover on a generation's fat boxes hold their boxes
  f32 pace_ = 0;           // how far boxes move in an update, as a share of their size, in the mean
  f64 motion_ = 0, lates_ = 0;
  f64 found_ = 0, lost_ = 0;  // of the last one, for each box: candidates, and about how many were elsewhere
  f64 hits_ = 0;           // pairs of the last update that was answered; less than 0: none was

  Generation& current() { return generations_[current_]; }
  Generation& next() { return generations_[1 - current_]; }
  f32* from(u32 slot) const { return from_.data() + u64(slot) * (D + 1); }

 public:
  constexpr explicit Coherent(StripSweep<D>& anew) : generations_{Generation(anew), Generation(anew)} {}

  /// What an update is going to cost for so many boxes and pairs, where such a share of the boxes moves, so far as a
  /// share of their size. `listed`: it will be known which have moved.
  COLD f64 cost(f64 boxes, f64 hits, f64 share, f64 pace, bool listed) const {
    i32 period = best_period(boxes, hits, share, pace);
    return cost(boxes, hits, share, pace, period) - (listed ? (1 - share) * box_cost * boxes : 0);
  }

  bool begun() const { return begun_; }

  /// Begins the first generation. `lists`: the strips of strip-sweep; where they are so few that sweeping one of fat boxes,
  /// which is done at once, would take too long for an update, nothing is begun. `bridged`: updates after which something
  /// better is going to answer; where it costs little the first generation does so until then, and stays the only one.
  COLD void begin(f64 boxes, f64 lists, f64 hits, f64 share, f64 pace, f64 fresh, u32 bridged) {
    pace_ = f32(share * pace);
    period_ = best_period(boxes, hits, share, pace);
    i32 longer = i32(bridged * 2 / 3 + 1);
    if (longer > period_ && cost(boxes, hits, share, pace, longer) <= little_more * cost(boxes, hits, share, pace, period_)) {
      period_ = longer;
    }
    stage_ = Stage::begin;
    known_ = unchecked_ = false;
    slack_ = least_slack;
    hits_ = -1;
    found_ = candidates(boxes, hits, share, pace, 1.5 * ahead(period_)) / boxes;
    lost_ = 0;
    for (int a = 1; a < D; a++) lists /= growth();
    f64 strip = (stage_costs()[3] + hit_cost * found_) * boxes / larger(lists, 1);
    begun_ = strip <= larger(bearable_once * fresh, unnoticed_once);
    if (!begun_) return;
    make_room(u32(boxes), u32(boxes));  // not in the update that first looks at all of them
    // The longer the first one takes, the less does an update pay for it, but the later does it answer.
    making_ = i32(larger(f64(least_making), smaller(f64(most_making), 1.15 * work() * boxes / added(fresh))));
  }

  /// Finds the pairs, where a generation is there to answer; else false. Gives up where that costs more than `fresh`.
  /// `needed`: so many updates more; where the generation that answers lasts for as many, none is begun after it.
  COLD bool update(const Scene<D>& scene, const Settings& options, f64 fresh, i32 needed, Pairs& pairs, Stats& stats) {
    now_++;
    bool answers = count_ > 0 && follow(scene, options, fresh);
    if (answers) report(scene, pairs, stats);
    if (begun_) build(scene, options, fresh, needed);
    return answers;
  }

  /// The slots of the boxes that are not where they are expected, or that are none, ascending; null where nobody can tell.
  const u32* unexpected(const Scene<D>& scene, u32& many) {
    if (count_ == 0 || scene.count > count_) return nullptr;
    look(scene, scene.count);
    many = late_count_;
    return late_.data();
  }

  COLD void structure(Buffer<f32>& boxes, u32& count) const {
    const Generation& answering = generations_[current_];
    answering.strips.structure(boxes, count, answering.stats);
  }

  /// Gives up what is kept, but not the memory.
  COLD void forget() {
    for (Generation& each : generations_) forget_grown(each);
    begun_ = false;
    count_ = 0;
  }

  COLD void release() {
    forget();
    for (Generation& each : generations_) {
      each.fat.release();
      each.excluded.release();
      each.strips.release();
      each.candidates.list.release();
      each.marks.release();
      each.grown.release();
    }
    from_.release();
    late_.release();
    marked_ = made_ = 0;
  }

 private:
  u32 marked_ = 0;  // slots that have marks

  /// The same, where a generation answers so many updates.
  COLD f64 cost(f64 boxes, f64 hits, f64 share, f64 pace, i32 period) const {
    f64 all = candidates(boxes, hits, share, pace, ahead(period));
    return boxes * (box_cost + all_costs / period) + (candidate_cost(boxes) + hit_cost / period) * all;
  }

  /// What making the first generation may add to an update, in nanoseconds.
  static f64 added(f64 fresh) { return larger(bearable * fresh, unnoticed); }

  /// Updates that fat boxes are to hold from the takeover on: the first are mended meanwhile.
  i32 life() const { return known_ ? period_ : period_ + period_ * 3 / 4; }

  /// How many times as long as boxes fat ones are.
  f64 growth() const { return 1 + spread * pace_ * ahead(period_); }

  /// Updates of whose motion a fat box must hold.
  f64 ahead(i32 period) const { return period + 1 + (1 - foresight_) * period; }

  static f64 candidate_cost(f64 boxes) {
    return cached_cost + uncached_cost * boxes * boxes / (boxes * boxes + cached_boxes * cached_boxes);
  }

  /// Candidates where fat boxes reach so many updates ahead.
  COLD static f64 candidates(f64 boxes, f64 hits, f64 share, f64 pace, f64 updates) {
    f64 one = 1, both = 1;
    for (int a = 0; a < D; a++) {
      one *= 1 + spread * pace * updates / 2;
      both *= 1 + spread * pace * updates;
    }
    return larger(hits, boxes / 8) * (1 + 2 * share * (1 - share) * (one - 1) + share * share * (both - 1));
  }

  /// What making a generation costs for each box, going by the last one.
  f64 work() const {
    const f64* each = stage_costs();
    return each[0] + each[1] + each[2] + each[3] + hit_cost * found_ + mending();
  }
  f64 mending() const { return mend_cost + mend_late_cost() * lost_; }
  const f64* stage_costs() const { return costs[made_ < 2]; }
  f64 late_cost() const { return late_base + late_each * found_; }
  f64 mend_late_cost() const { return (made_ < 2 ? late_anew : 0) + late_cost(); }

  /// Updates that a generation should answer: the work of making it balances its candidates, which are the more the
  /// further fat boxes reach.
  COLD i32 best_period(f64 boxes, f64 hits, f64 share, f64 pace) const {
    i32 best = least_period;
    f64 least = __builtin_inf();
    for (i32 period = best; period <= most_period; period += 1 + period / 8) {
      f64 costs = cost(boxes, hits, share, pace, period);
      best = costs < least ? period : best;
      least = smaller(costs, least);
    }
    return best;
  }

  /// Finds the boxes that are not in their fat ones, or are none, among the first so many.
  COLD void look(const Scene<D>& scene, u32 until) {
    const Generation& g = current();
    Expected<D> expected{g.fat.data(), g.excluded.data(), true};
    late_count_ = expected.look(scene, until, unchecked_, late_);
  }

  /// Sees to it that fat boxes hold their boxes again; false where all is given up.
  COLD bool follow(const Scene<D>& scene, const Settings& options, f64 fresh) {
    Generation& g = current();
    u32 n = scene.count, had = count_, both = smaller(n, had);
    make_room(n, had);
    if (!scene.looked_at) look(scene, both);
    unchecked_ = false;
    const u32* excluded = g.excluded.data();
    u32* late = late_.data();
    u32 many = late_count_;
    if (late_cost() * (f64(many) + (n - both) - few_late) > late_share * fresh) {
      forget();
      return false;
    }
    bool strikes = n < had;
    for (u32 k = 0; k < many; k++) {
      u32 slot = late[k];
      f32* its = g.fat.data() + u64(slot) * width;
      if (excluded[slot] == scene.excluded_of(slot) && touch<D>(scene.box(slot), its)) continue;
      appear(scene, slot);
      g.marks[slot] |= struck;
      strikes = true;
    }
    for (u32 slot = had; slot < n; slot++) {
      late[many++] = slot;
      appear(scene, slot);
    }
    count_ = n;
    if (strikes) strike(g, n);
    if (n < had) forget_grown(g, n);
    for (u32 k = 0; k < many; k++) {
      g.marks[late[k]] &= u8(~struck);
      grow(g, n, scene, options, late[k]);
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
    for (Generation& each : generations_) {
      each.marks.grow(n, marked_);
      __builtin_memset(each.marks.data() + marked_, 0, n - marked_);
    }
    marked_ = n;
  }

  /// A box is new, or as good as new: it has no fat box yet.
  COLD void appear(const Scene<D>& scene, u32 slot) {
    Generation& g = current();
    if (g.marks[slot] & is_grown) g.grown.take(g.fat.data() + u64(slot) * width, slot);
    g.marks[slot] = 0;
    for (u32 k = 0; k < width; k++) g.fat[u64(slot) * width + k] = __builtin_nanf("");
    g.excluded[slot] = scene.excluded_of(slot);
    note(scene, slot);
  }

  /// Notes where a box stands.
  void note(const Scene<D>& scene, u32 slot) const {
    f32x4 corner = load<f32x4>(scene.box(slot));
    corner[D] = bits<f32>(now_);
    __builtin_memcpy(from(slot), &corner, (D + 1) * sizeof(f32));
  }

  /// Strikes out the candidates of boxes that are marked, and of slots from n on.
  COLD static void strike(Generation& g, u32 n) {
    Pairs& candidates = g.candidates;
    u64 left = 0;
    for (u64 k = 0; k < candidates.count; k++) {
      u64 pair = candidates.list[k];
      u32 a = u32(pair), b = u32(pair >> 32);
      candidates.list[left] = pair;
      left += b < n && !((g.marks[a] | g.marks[b]) & struck);
    }
    candidates.count = left;
  }

  /// Leaves those that have grown only where they are among the first n slots.
  COLD static void forget_grown(Generation& g, u32 n = 0) {
    g.grown.leave([&](u32 slot) {
      if (slot >= n) g.marks[slot] = 0;
      return slot >= n;
    });
  }

  /// How much longer a fat box is along an axis than the box; 0 where there is none.
  static f32 spare(const f32* fat, const f32* box, int a) {
    return larger(0.0f, (fat[D + a] - fat[a]) - (box[D + a] - box[a]));
  }

  /// A larger fat box for one that has left its own, among the first `count`, and the candidates that come with it.
  COLD void grow(Generation& g, u32 count, const Scene<D>& scene, const Settings& options, u32 slot) const {
    f32* its = g.fat.data() + u64(slot) * width;
    f32 old[width + padding], fat[width + padding];
    __builtin_memcpy(old, its, width * sizeof(f32));
    const f32* box = scene.box(slot);
    for (int a = 0; a < D; a++) {
      // Where it goes now nobody knows, but about how fast.
      f32 size = box[D + a] - box[a], beyond = larger(0.0f, larger(old[a] - box[a], box[D + a] - old[D + a]));
      f32 reach = larger(spare(old, box, a) / 2, smaller(8 * beyond, size));
      if (!(old[a] <= old[D + a])) reach = 2 * pace_ * size * f32(larger(1, lasts_));
      if (options.margin > 0) reach = f32(options.margin);
      fat[a] = smaller(smaller(box[a], box[a] - reach), old[a]);
      fat[D + a] = larger(larger(box[D + a], box[D + a] + reach), old[D + a]);
    }
    __builtin_memcpy(its, fat, width * sizeof(f32));
    auto meet = [&](u32 other) COLD {
      const f32* box = g.fat.data() + u64(other) * width;
      if (!touch<D>(fat, box) || touch<D>(old, box)) return;
      if (other == slot || (g.excluded[slot] & g.excluded[other])) return;
      g.candidates.room(g.candidates.list.data() + g.candidates.count, 1);
      g.candidates.list[g.candidates.count++] = pair_of(slot, other);
    };
    g.strips.each_near(fat, [&](u32 other) {
      if (other < count && g.marks[other] == 0) meet(other);
    });
    g.grown.each_hit(fat, g.excluded[slot], meet);
    if (g.marks[slot] & is_grown) g.grown.take(old, slot);
    g.grown.put(fat, slot | g.excluded[slot]);
    g.marks[slot] |= is_grown;
  }

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

  /// Makes a slice of the next generation.
  COLD void build(const Scene<D>& scene, const Settings& options, f64 fresh, i32 needed) {
    lasts_--;
    age_++;
    if (stage_ == Stage::begin) {
      if (known_ && (lasts_ > making_ || lasts_ >= needed)) return;
      if (known_) making_ = smaller(making_, larger(least_making, lasts_));  // it was not begun when it could be
      open(scene);
      if (!known_) return;
    }
    // What is left to do is shared by the updates that are left, but for mending, which comes in the last: only then can
    // be seen whether boxes are in fat ones that are to hold them from then on.
    f64 all = work() * boxes_, last = mending() * boxes_, left = larger(0, making_ - age_);
    // The first generation is mended in a third of the updates that it holds.
    f64 budget = known_ ? __builtin_inf() : larger(larger(added(fresh), all / making_), 1.8 * last / period_);
    if (left > 0) {
      f64 share = smaller((all - spent_) / (left + 1), (all - last - spent_) / left);
      budget = smaller(budget, larger(share, all / 8 / (left + 1)));
    }
    while (begun_ && budget > 0 && stage_ != Stage::begin && (stage_ != Stage::mend || left == 0)) {
      Stage at = stage_;
      f64 spent = slice(scene, options, budget, fresh);
      budget -= spent;
      spent_ += spent;
      if (stage_ == at) return;  // all that is to be spent on it now, or boxes must move before their motion can be seen
    }
  }

  /// Begins a generation.
  COLD void open(const Scene<D>& scene) {
    Generation& g = next();
    boxes_ = scene.count;
    at_ = noted_ = 0;
    age_ = 0;
    motion_ = lates_ = spent_ = 0;
    make_room(boxes_, boxes_);
    g.fat.reserve(u64(boxes_) * width + padding);
    g.excluded.reserve(boxes_);
    // Room for half as many again: where that is not enough they are copied, which takes long.
    g.candidates.list.reserve(u64(smaller(1.5 * found_, 16.0) * boxes_) + Pairs::slack);
    g.candidates.count = 0;
    walls_ = Walls::empty();
    stage_ = Stage::fatten;
    g.strips.begin(scene, growth(), g.stats);
    g.strips.cut_alike(g.grown);
  }

  /// Does work of the stage for about so many nanoseconds; gives how many.
  COLD f64 slice(const Scene<D>& scene, const Settings& options, f64 budget, f64 fresh) {
    Generation& g = next();
    if (stage_ == Stage::mend) return mend(scene, options, budget, fresh);
    f64 each = stage_costs()[u32(stage_) - u32(Stage::fatten)];
    if (stage_ == Stage::sweep) each += hit_cost * found_;
    bool by_entries = stage_ == Stage::touch || stage_ == Stage::sweep;
    u32 all = by_entries ? u32(g.stats.entries) : boxes_;
    each *= f64(boxes_) / all;
    u32 many = u32(smaller(budget / each + 1, f64(max_slots))), until = smaller(all, at_ + many);
    Scene<D> fat{g.fat.data(), boxes_, g.excluded.data()};
    if (stage_ == Stage::fatten) {
      u32 noted = noted_;
      see(scene, u32(smaller(f64(at_) + f64(watched) * many, f64(all))));
      if (age_ < making_) until = smaller(until, noted);
      make_fat(scene, options, until);
      // A world that rested when it was looked at, and jumps: nothing will come of it.
      if (!known_ && motion_ * sampled > few_late + until * (2 * pace_ + much_faster)) return forget(), budget;
      g.strips.count(fat, at_, until);
    } else if (stage_ == Stage::touch) {
      if (made_ < 2) g.strips.touch(at_, until);
    } else if (stage_ == Stage::enter) {
      g.strips.enter(fat, at_, until);
    } else {
      if (age_ < making_ && at_ > all / 4 && makes_room(g.candidates, f64(all) / at_)) return budget;
      until = all - g.strips.sweep(many, g.candidates);
    }
    f64 spent = (until - at_) * each;
    at_ = until;
    if (at_ < all) return spent;
    at_ = 0;
    if (stage_ == Stage::fatten && !g.strips.add_up()) forget();
    if (stage_ == Stage::enter && !known_) {
      if (elsewhere(scene, asked_early) * lost_early > boxes_) forget();  // motion that none can foresee
      spent += asked_early * all_costs;
    }
    stage_ = Stage(u32(stage_) + 1);
    return spent;
  }

  /// Whether all candidates, `share` times as many as there are, need more room, which is then made. Where they are more
  /// than was thought (a huge box may have as many as all others) they are copied while they are few.
  COLD static bool makes_room(Pairs& candidates, f64 share) {
    f64 room = f64(candidates.list.capacity()), all = share * f64(candidates.count);
    if (all <= room) return false;
    candidates.list.grow(u64(smaller(1.1 * all, 2 * room)), candidates.count);
    return true;
  }

  /// Notes where the boxes up to this one stand: when their fat boxes are made, in an update to come, it is known how they
  /// move.
  COLD void see(const Scene<D>& scene, u32 until) {
    for (; noted_ < until; noted_++) {
      if (noted_ >= scene.count) continue;
      note(scene, noted_);
      walls_.template hold<D>(scene.box(noted_));
    }
  }

  /// Looks who has left its fat box before all was done.
  COLD f64 mend(const Scene<D>& scene, const Settings& options, f64 budget, f64 fresh) {
    Generation& g = next();
    u32 until = smaller(boxes_, scene.count);
    f64 spent = 0, most = smaller(budget, larger(fresh / 2, unnoticed));
    if (at_ == 0) {
      f64 many = elsewhere(scene, asked);
      spent = smaller(most / 2, 2 * asked * mend_cost);
      if ((many - few_late) * late_cost() > bearable_lost * fresh) return forget(), budget;
      lost_ = many / boxes_;
    }
    for (; at_ < until && spent < most; at_++) {
      const f32* box = scene.box(at_);
      const f32* fat = g.fat.data() + u64(at_) * width;
      spent += mend_cost;
      if (inside<D>(box, fat) || !is_near(box, fat)) continue;
      grow(g, until, scene, options, at_);
      spent += mend_late_cost();
    }
    if (at_ >= until || known_) take_over(scene, fresh);
    return spent;
  }

  /// About how many boxes will not be in the next fat ones, as they move now, when these are to hold; by a sample.
  COLD f64 elsewhere(const Scene<D>& scene, u32 sample) {
    u32 n = smaller(boxes_, scene.count), stride = n / sample + 1, out = 0;
    f32 left = f32(larger(0, making_ - age_));
    for (u32 slot = 0; slot < n; slot += stride) {
      const f32* box = scene.box(slot);
      f32 then[width + padding];
      u32 updates = larger(now_ - bits<u32>(from(slot)[D]), 1u);
      if (left > 0) fatten<D>(box, from(slot), updates, left, left, no_walls, 0, 0, then);
      out += !inside<D>(left > 0 ? then : box, next().fat.data() + u64(slot) * width);
    }
    return f64(out) * stride;
  }

  /// Whether a box is no further away from its fat one than it is long.
  COLD static bool is_near(const f32* box, const f32* fat) {
    bool is = true;
    for (int a = 0; a < D; a++) {
      f32 size = box[D + a] - box[a];
      is &= box[a] - size <= fat[D + a] && fat[a] <= box[D + a] + size;
    }
    return is;
  }

  /// Fat boxes from `at_` on.
  NOINLINE void make_fat(const Scene<D>& scene, const Settings& options, u32 until) {
    Generation& g = next();
    f32 begins = f32(larger(0, making_ - age_)), reach = begins + f32(life());
    begins *= foresight_;
    for (u32 slot = at_; slot < until; slot++) {
      // Written in place, in order: what is written beyond a fat box is where the next one comes.
      f32* fat = g.fat.data() + u64(slot) * width;
      if (slot < scene.count) {
        const f32* box = scene.box(slot);
        u32 updates = now_ - bits<u32>(from(slot)[D]);
        fatten<D>(box, from(slot), larger(updates, 1u), begins, reach, walls_, slack_, options.margin, fat);
        if (updates == 0 || current().marks[slot] > 0) surround(box, slot, reach, fat);
        if (slot % sampled == 0) motion_ += pace<D>(box, from(slot), larger(updates, 1u));
        g.excluded[slot] = scene.excluded_of(slot);
      } else {
        for (u32 k = 0; k < width; k++) fat[k] = __builtin_nanf("");
        g.excluded[slot] = 0;
      }
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
    forget_grown(current());
    current_ = 1 - current_;
    made_++;
    count_ = smaller(boxes_, n);
    if (n < boxes_) {
      strike(g, n);
      forget_grown(g, n);
    }
    lasts_ = making_ + life() - age_;
    unchecked_ = known_ = true;
    found_ = f64(g.candidates.count) / boxes_;
    stage_ = Stage::begin;
    pace_ = f32(motion_ * sampled / boxes_);
    if (hits_ >= 0) {
      f64 each = box_cost + work() / period_ + candidate_cost(boxes_) * found_;
      f64 late = late_cost() * lates_ / (age_ + 1) / boxes_;
      if (boxes_ * (each + late) > worth * fresh) return forget();
      // Where boxes leave their fat ones too early, the next reach further to the sides; where many are elsewhere when
      // these begin to hold, they begin earlier.
      slack_ = smaller(16.0f, larger(least_slack, slack_ * (late > few_late_share * each ? 1.3f : 0.95f)));
      bool foreseen = late_cost() * lost_ / period_ <= few_lost_share * each;
      foresight_ = foreseen ? smaller(1.0f, foresight_ + 0.1f) : foresight_ / 2;
      period_ = best_period(boxes_, hits_, 1, pace_);
    }
    // In all updates but the one that begins it: so they are alike. The first that one answers finds nothing in the caches,
    // and does nothing else.
    making_ = lasts_ - 1 - (made_ == 1);
  }
};
