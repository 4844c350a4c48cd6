// Incremental: what the last updates have found out is kept, and an update costs what has changed.
//
// Idea: space is cut into cells of 128 to 256 boxes, once, by a k-d tree over a sample. A box that moves stands in
// every cell it may come to in the next updates, as a fat box that reaches as far as its motion will take it. A cell
// keeps the pairs of fat boxes that overlap in it: its candidates. While boxes stay in their fat ones, which one pass
// over all that may have changed finds out, an update does nothing but test each candidate. Two boxes can be candidates
// in several cells; the cell that holds the larger of their two lower corners reports them.
//   - Cells take turns: a few of them, in each update, give all their boxes new fat ones and collect their candidates
//     anew. So nothing builds up, and no single update pays for all. A box that leaves its fat one before is served
//     by itself.
//   - A box that has not moved from one turn to the next rests. Pairs of boxes at rest are no candidates: they stand
//     settled at the head of the list of pairs, which nobody touches until one of them moves.
//   - Boxes that touch very many cells (the ground, a wall) stand in none and are tested against all that move; one that
//     moves itself (a gate, what a camera sees), against what rests in the cells that it touches too.
// All this is filled little by little, and given up again where many boxes leave their fat ones at once or where it does
// not pay. Meanwhile, and where most boxes move, the generations of coherent.hpp give the answers, which are sooner there;
// until then strip-sweep does.
// Cost: where all move by a hundredth of their size a fifth of strip-sweep, by a tenth of it 0.4 in 2D and 0.5 in 3D;
// where 5 % move 0.12 to 0.15, of a million 0.17 to 0.21; there only the movers count. The first updates, in
// which the first generation is made, up to eighty, cost about a twelfth more.
// Memory, beside that of strip-sweep: about 120 (2D) or 210 (3D) bytes a box that moves, 100 or 150 one at rest.
// Wins where boxes rest, or move slowly. Is strip-sweep where they jump.
// From: candidates kept with a margin, L. Verlet, 1967 (see motion.hpp); k-d tree, J. Bentley, 1975. The combination
// is ours.
#pragma once
#include "../candidates.hpp"
#include "../halves.hpp"
#include "../pair_order.hpp"
#include "coherent.hpp"

template <int D> class Incremental {
  static constexpr u32 width = 2 * D;
  static constexpr u32 padding = 4;          // vector loads may read this many floats past the last box
  static constexpr u32 rests = Expected<D>::rests, waiting = 2, is_huge = 4;  // in a tag, below the exclusion bits
  static constexpr u32 few = 200;            // fewer boxes are not worth keeping anything
  static constexpr u32 cell_boxes = 128;     // at least so many to a cell, and less than twice as many
  static constexpr u32 most_in_cell = 4096;  // where it comes to this, the cells are no good
  static constexpr u32 samples_a_cell = 4, most_samples = 1 << 16;
  static constexpr u32 huge_cells = 32;      // boxes that touch more cells than this are huge
  static constexpr u32 most_huge = 64;
  static constexpr u32 still_for = 3;        // updates without motion after which a box rests
  static constexpr u32 enlisting = 8;        // updates in which it is noted for each box that it waits to be put into cells
  // ... and is, while generations answer; where boxes are so many that caches do not hold them; and where none answers.
  static constexpr u32 filling = 46, filling_far = 56, filling_alone = 150, far_boxes = 400'000;
  static constexpr i32 never = 0x7fffffff;
  static constexpr u32 ahead = 8;            // its motion is known from so many updates
  static constexpr u32 late_share = 40;      // all is given up where one in so many leaves its fat box at once
  static constexpr u32 sample_share = 8;     // ... while they are filled, where it is one in so many of a sample
  static constexpr f32 least_period = 4, most_period = 64, growth = 1.15f;
  static constexpr f32 least_slack = 0.15f;  // fat boxes reach so many motions of an update to all sides, where few are late
  static constexpr f64 few_late = 1;         // ... one for each box that has its turn: it costs as much to be late
  // Where so many move, what an update needs is more than the nearer caches hold, and to wait for one thing after the other
  // takes longer than to work on it. So what so many cells need is read beforehand, all at once.
  static constexpr u32 too_many_to_be_near = 2500;
  static constexpr u32 together = 16;
  static constexpr u32 watched = 512;        // boxes whose motion is looked at before anything is kept
  static constexpr f64 worth = 0.85;         // what is to be kept must promise to cost this share of a strip-sweep
  static constexpr u32 first_pause = 8, longest_pause = 256;
  static constexpr u32 considered = 64;      // updates until cells are thought of again
  // What an update costs, in nanoseconds, to see whether keeping anything pays: an entry and a test of strip-sweep; a
  // box that may have moved; a mover, a candidate and a turn, all dearer where they are so many that they fill the caches.
  static constexpr f64 entry_cost = D == 2 ? 13 : 22, test_cost = D == 2 ? 0.8 : 1.1, look_cost = 2;
  static constexpr f64 copies = D == 2 ? 1.25 : 1.6;  // cells that a mover stands in
  static constexpr f64 mover_cost = 4, candidate_cost = 4.5, turn_cost = 250, cached_movers = 40000;

  // Rows of a fat box that moves: where the box stood when it was made, and in which update that was.
  static constexpr u32 from_row = width + 1, when_row = width + 1 + D;
  using Movers = FatBoxes<D, D + 1>;
  using Stills = FatBoxes<D, 0>;

  struct Cell {
    f32 low[4], high[4];  // where a corner must be for this cell to report: at or above low, not at or above high
    Movers movers;
    Stills stills;
    Candidates<D> candidates;
  };

  StripSweep<D>& anew_;
  Coherent<D> coherent_;
  Buffer<Cell> cells_;
  typename Candidates<D>::Room room_;
  Halves<D> halves_;     // which cell is where
  u32 leaves_ = 0;       // cells; 0: nothing is kept
  u32 count_ = 0;        // boxes that are followed
  u32 planned_ = 0;      // how many they were when the cells were made
  u32 enlisted_ = 0;     // of which so many are known to wait, before any is followed
  Buffer<u32> in_cell_;  // how many of these come to each cell; then, where they begin in the queue
  // Per slot:
  Buffer<f32> known_;    // of a mover: while it is in here its candidates hold; else: at rest, or when it began to wait
  Buffer<u32> since_;    // the update in which a box was, or began to wait, there
  Buffer<u32> tags_;     // exclusion bits, and ours below them
  bool filtered_ = false;  // some may have exclusion bits
  Buffer<u32> queue_;    // slots that wait to be put into cells
  u32 queued_ = 0, resting_ = 0;
  u32 portion_ = 0;      // boxes put into cells in an update, where many wait
  u32 unseen_ = 0;       // of those that wait, so many have not even been looked at
  u32 begun_ = 0;        // in this update all began to wait
  u32 filled_by_ = 0;    // in this one none should any more
  Buffer<u32> late_;     // movers that have left their fat boxes
  u32 late_count_ = 0;
  u32 huge_[most_huge] = {};
  u32 huge_count_ = 0;
  Pairs settled_;
  PairOrder order_;
  Buffer<u32> woken_;    // a bit per slot: it rested, and does no longer
  bool any_woken_ = false;
  bool unchecked_ = false;  // boxes may have changed that were not looked at since
  enum class By : u32 { strips, generations, cells } by_ = By::strips;  // what answered the last update
  u32 cursor_ = 0;       // the cell whose turn is next
  u32 now_ = 0;          // updates, counted
  f32 period_ = 16, target_ = 16;  // updates in which every cell has one turn, and what that is to become
  f32 slack_ = least_slack;  // fat boxes reach to all sides, in motions of one update
  f64 moving_ = 0, candidates_ = 0, turned_ = 0, motion_ = 0;  // of this update
  f64 fresh_ = 0;        // what the last update cost that was answered by strip-sweep
  u32 pause_ = 0, pauses_ = first_pause;  // updates left in which nothing is tried; how many the last pause had
  Buffer<f32> watched_;  // boxes of the update before
  u32 watching_ = 0;     // how many boxes there were then

 public:
  constexpr explicit Incremental(StripSweep<D>& anew) : anew_(anew), coherent_(anew) {}
#if !defined(__wasm__)
  ~Incremental() { release(); }
#endif

  void update(const Scene<D>& scene, const Settings& options, Pairs& pairs, Stats& stats) {
    find(scene, options, pairs, stats);
    if (!scene.ordered) return;
    order_.sort(pairs.list.data(), pairs.count, scene.count);
    pairs.kept = 0;
  }

  /// Where all boxes are looked at anyway, the slots of those that are not where they are expected or that are none,
  /// ascending; else null. If `update` comes next it need not look again.
  const u32* unexpected(const Scene<D>& scene, u32& many) {
    if (by_ == By::generations) return coherent_.unexpected(scene, many);
    if (by_ == By::strips || scene.count > count_) return nullptr;
    filtered_ |= scene.excluded != nullptr;
    look(scene, scene.count, true);
    many = late_count_;
    return late_.data();
  }

  /// Whether all boxes rest: where none is elsewhere, the pairs are those of before.
  bool all_rest() const { return by_ == By::cells && resting_ == count_; }

  /// Whether the last update was answered by what is kept; where it was not, whether these are its boxes.
  bool keeps() const { return by_ != By::strips; }
  bool holds(const Scene<D>& scene) const { return anew_.holds(scene); }

  /// The cells, or the strips.
  COLD void structure(Buffer<f32>& boxes, u32& count, const Stats& stats) const {
    if (by_ == By::strips) return anew_.structure(boxes, count, stats);
    if (by_ == By::generations) return coherent_.structure(boxes, count);
    count = leaves_;
    boxes.reserve(u64(leaves_) * width);
    for (u32 k = 0; k < leaves_; k++) {
      for (int a = 0; a < D; a++) {
        boxes[k * width + a] = cells_[k].low[a];
        f32 high = cells_[k].high[a];
        boxes[k * width + D + a] = high == high ? high : __builtin_inff();
      }
    }
  }

  COLD void release() {
    forget();
    coherent_.release();
    cells_.release();
    halves_.release();
    known_.release();
    since_.release();
    tags_.release();
    queue_.release();
    in_cell_.release();
    late_.release();
    settled_.list.release();
    order_.release();
    woken_.release();
    watched_.release();
    pause_ = 0;
    pauses_ = first_pause;
    anew_.release();
  }

 private:
  void find(const Scene<D>& scene, const Settings& options, Pairs& pairs, Stats& stats) {
    u32 n = scene.count;
    now_++;
    filtered_ |= scene.excluded != nullptr;
    if (leaves_ > 0 && (n < few || n > 2 * planned_ || 4 * n < planned_ || (count_ == 0 && n != planned_))) forget();
    if (coherent_.begun() && (n < few || n > 2 * planned_ || 2 * n < planned_)) coherent_.forget();
    pairs.count = 0;
    if (leaves_ > 0) use_cells(scene, options, pairs, stats);
    if (leaves_ > 0 && count_ > 0 && queued_ == 0) {
      by_ = By::cells;
      stats.reason = f64(u32(Reason::kept));
      if (coherent_.begun()) coherent_.release();
      return balance(f64(pairs.count - settled_.count));
    }
    bool follows = coherent_.begun(), kept = follows && coherent_.update(scene, options, fresh_, needed(), pairs, stats);
    by_ = kept ? By::generations : By::strips;
    if (follows && !coherent_.begun()) pause_ = pauses_ = smaller(longest_pause, pauses_ * 4);
    if (kept) pauses_ = larger(first_pause, pauses_ - 1);
    else find_anew(scene, options, pairs, stats);
    if (leaves_ == 0 && coherent_.begun() == kept && n >= few) consider(scene, f64(pairs.count));
    stats.reason = f64(u32(kept ? Reason::kept : leaves_ > 0 || coherent_.begun() ? Reason::filling : Reason::moving));
  }

  /// Updates in which cells are filled with so many boxes while generations answer; and from when they are cut until they
  /// answer, about.
  static u32 fill_updates(u32 n) { return n > far_boxes ? filling_far : filling; }
  static u32 bridged(u32 n) { return enlisting + still_for + fill_updates(n) + 4; }

  /// For how many updates more generations are to answer: until cells are filled, which may just be thought of; else
  /// nobody knows.
  i32 needed() const {
    if (leaves_ > 0) return filled_by_ > now_ ? i32(filled_by_ - now_) : never;
    return pause_ > 0 ? never : i32(bridged(planned_));
  }

  void find_anew(const Scene<D>& scene, const Settings& options, Pairs& pairs, Stats& stats) {
    stats = Stats{};
    pairs.count = pairs.kept = 0;
    anew_.update(scene, options, pairs, stats);
    fresh_ = entry_cost * stats.entries + test_cost * stats.tests;
  }

  /// Finds the pairs in cells, or fills them a little further, or gives them up.
  void use_cells(const Scene<D>& scene, const Settings& options, Pairs& pairs, Stats& stats) {
    if (by_ == By::cells && cost(moving_, candidates_, period_) > fresh_) return forget();  // strip-sweep is sooner
    moving_ = candidates_ = turned_ = motion_ = 0;
    if (count_ == 0) return enlist(scene);  // another update than the one that made the cells: both take their time
    follow(scene, pairs);
    if (queued_ > portion_ && astray(scene)) return forget();
    serve(scene, options, stats);
    if (leaves_ == 0 || queued_ > 0) return;
    take_turns(scene, options, stats);
    if (leaves_ > 0) serve_late(scene, options, stats);
    if (leaves_ > 0) report(scene, pairs, stats);
  }

  f32* last(u32 slot) const { return known_.data() + u64(slot) * width; }

  static bool equal(const f32* a, const f32* b) { return bitmask(alike<D>(a, b)) == 15; }

  /// Gives up what is kept, but for the memory of what is per slot.
  COLD void forget() {
    for (u32 c = 0; c < leaves_; c++) {
      cells_[c].movers.release();
      cells_[c].stills.release();
      cells_[c].candidates.clear(room_);
    }
    leaves_ = count_ = enlisted_ = queued_ = unseen_ = resting_ = huge_count_ = watching_ = 0;
    settled_.count = 0;
    any_woken_ = unchecked_ = filtered_ = false;
    pause_ = pauses_ = smaller(longest_pause, pauses_ * 4);
  }

  /// Looks at a few boxes, whether they move so little from one update to the next that keeping things promises to pay.
  COLD void consider(const Scene<D>& scene, f64 hits) {
    if (pause_ > 0) {
      pause_--;
      return;
    }
    u32 n = scene.count, many = smaller(n, watched);
    detail::Sampling sampling(n, many);  // the same ones in both updates
    f32* before = watched_.reserve(watched * width + padding);
    f64 moved = 0, movers = 0;
    bool known = watching_ == n;
    for (u32 k = 0; k < many; k++) {
      const f32* box = scene.box(sampling.next());
      f32 step = known ? pace<D>(box, before + k * width, 1) : 0;
      moved += step;
      movers += step > 0;
      __builtin_memcpy(before + k * width, box, width * sizeof(f32));
    }
    watching_ = known ? 0 : n;
    if (!known) return;
    f64 share = movers / many, speed = moved / larger(movers, 1.0);
    period_ = target_ = best_period(n * share, hits * share, speed);
    f64 candidates = hits * share;
    for (int a = 0; a < D; a++) candidates *= 1 + speed * period_;
    bool listed = scene.listed();
    f64 by_cells = cost(copies * n * share, candidates, period_) + (listed ? 0 : look_cost * n);
    f64 by_generations = coherent_.cost(n, hits, share, speed, listed);
    // Generations come first: they are soon there, and answer while cells are filled.
    if (by_ == By::generations) {
      if (by_cells <= by_generations) plan(scene, hits);
      else pause_ = considered;
      return;
    }
    if (by_generations <= worth * fresh_) {
      // It answers for a few updates before cells are cut: then boxes are looked at once more.
      coherent_.begin(n, anew_.lists(), hits, share, speed, fresh_, by_cells <= by_generations ? bridged(n) + 6 : 0);
    }
    planned_ = n;
    if (coherent_.begun()) return;
    if (by_cells <= worth * fresh_) plan(scene, hits);
    else pause_ = first_pause;
  }

  /// Updates in which every cell should have one turn, given how far movers move in one as a share of their size: what
  /// turns cost balances what candidates cost, which are the more the further fat boxes reach.
  static f32 best_period(f64 movers, f64 hits, f64 pace) {
    f64 growth = larger(hits, movers / 8) * D * larger(pace, 1e-4);
    f64 best = __builtin_sqrt(turn_cost / candidate_cost * larger(movers, 1.0) / larger(growth, 1e-4));
    return f32(larger(f64(least_period), smaller(f64(most_period), best)));
  }

  /// What an update costs in which so much is kept.
  static f64 cost(f64 movers, f64 candidates, f64 period) {
    return ((mover_cost + turn_cost / period) * movers + candidate_cost * candidates) * (1 + movers / (movers + cached_movers));
  }

  // --- the cells ---

  /// Cuts space into cells, still empty. No more of the pairs than there are now will soon be settled: a list with room for
  /// them need not be copied while it grows.
  COLD void plan(const Scene<D>& scene, f64 hits) {
    settled_.list.reserve(u64(hits) + Pairs::slack);
    u32 n = scene.count, levels = 0;
    while ((n >> (levels + 1)) >= cell_boxes) levels++;
    u32 leaves = 1u << levels;
    cells_.reserve(leaves);
    __builtin_memset(static_cast<void*>(cells_.data()), 0, leaves * sizeof(Cell));
    halves_.cut(scene, levels, smaller(leaves * samples_a_cell, most_samples), [&](u32 k, const f32* low, const f32* high) {
      __builtin_memcpy(cells_[k].low, low, sizeof(cells_[k].low));
      __builtin_memcpy(cells_[k].high, high, sizeof(cells_[k].high));
    });
    leaves_ = leaves;
    filled_by_ = now_ + bridged(n);
    room_.pairs.chunk_bytes = room_.meetings.chunk_bytes = smaller(n / 4, 1u << 16);
    planned_ = n;
    cursor_ = 0;
    slack_ = least_slack;
  }

  /// All boxes wait to be put into cells: not in one update, since memory that is used for the first time takes long.
  /// They wait in the order of the cells that their lower corners are in, so that a cell is filled while the caches hold it.
  COLD void enlist(const Scene<D>& scene) {
    u32 n = scene.count;
    u64 room = u64(n) + n / 4;
    if (enlisted_ == 0) {
      known_.reserve(room * width + padding);
      since_.reserve(room);
      tags_.reserve(room);
      queue_.reserve(room + 1);
      __builtin_memset(in_cell_.reserve(leaves_), 0, leaves_ * sizeof(u32));
    }
    if (enlisted_ < n) {
      u32 until = smaller(n, enlisted_ + n / enlisting + 1);
      for (; enlisted_ < until; enlisted_++) {
        tags_[enlisted_] = waiting | scene.excluded_of(enlisted_);
        // What is written here nobody reads: it is memory that is used for the first time, and later on anywhere.
        queue_[enlisted_] = enlisted_;
        note(scene, enlisted_);
        in_cell_[since_[enlisted_] = halves_.home(scene.box(enlisted_))]++;  // the cell stands there until all are known
      }
      return;
    }
    count_ = n;
    woken_.reserve(room / 32 + 1);
    __builtin_memset(woken_.data(), 0, (room / 32 + 1) * sizeof(u32));
    for (u32 c = 1; c < leaves_; c++) in_cell_[c] += in_cell_[c - 1];
    for (u32 slot = 0; slot < n; slot++) queue_[--in_cell_[since_[slot]]] = slot;
    queued_ = unseen_ = n;
    portion_ = n / (coherent_.begun() ? fill_updates(n) : filling_alone) + 1;
    begun_ = now_;
    see_first(scene);
  }

  /// In each update before the first are put into cells: as many as it takes to be so far ahead of these.
  void see_first(const Scene<D>& scene) { see(scene, portion_ * ahead / (still_for + 1)); }

  /// Notes where some of those stand that wait to be put into cells, to know their motion when it is their turn.
  COLD void see(const Scene<D>& scene, u32 many) {
    for (; many > 0 && unseen_ > 0; many--) note(scene, queue_[--unseen_]);
  }

  void note(const Scene<D>& scene, u32 slot) {
    __builtin_memcpy(last(slot), scene.box(slot), width * sizeof(f32));
    since_[slot] = now_;
  }

  /// A new box waits to be put into cells.
  void expect(const Scene<D>& scene, u32 slot) {
    tags_[slot] = waiting | scene.excluded_of(slot);
    note(scene, slot);
    queue_[queued_++] = slot;
  }

  /// Cells that a box touches.
  struct Found {
    u32 cell[huge_cells + 1];
    u32 count;
    bool many() const { return count > huge_cells; }
  };

  void cells_of(const f32* box, Found& out) const { out.count = halves_.touched(box, out.cell, huge_cells); }

  /// Whether a box touches no cell but this.
  static bool within(const Cell& cell, const f32* box) { return contains(cell, load<f32x4>(box), load<f32x4>(box + D)); }
  /// Whether it touches this one.
  static bool touches(const Cell& cell, const f32* box) { return contains(cell, load<f32x4>(box + D), load<f32x4>(box)); }
  /// Whether this cell is the one to report two boxes.
  static bool reports(const Cell& cell, const f32* one, const f32* other) {
    f32x4 corner = max(load<f32x4>(one), load<f32x4>(other));
    return contains(cell, corner, corner);
  }
  /// Whether one corner is not before a cell, and another not behind it.
  static bool contains(const Cell& cell, f32x4 first, f32x4 last) {
    u32 both = bitmask((first >= load<f32x4>(cell.low)) & ~(last >= load<f32x4>(cell.high)));
    return !(~both & ((1 << D) - 1));
  }

  // --- boxes in cells ---

  static u32 tag_of(u32 slot, u32 tag) { return slot | (tag & ~slot_mask); }

  /// Notes when and where a fat box was made.
  NOINLINE void stamp(const Cell& cell, u32 at, const f32* box) const {
    f32* its = cell.movers.numbers(at);
    for (u32 a = 0; a < D; a++) its[4 * (from_row + a)] = box[a];
    its[4 * when_row] = bits<f32>(now_);
  }

  /// How long ago that was.
  u32 age(const Cell& cell, u32 at) const { return now_ - bits<u32>(cell.movers.numbers(at)[4 * when_row]); }

  /// Takes a mover and its candidates out of a cell; the last mover comes to its place.
  COLD static void take(Cell& cell, u32 at) {
    cell.candidates.purge(cell.movers.slot(at));
    cell.movers.take(at);
  }

  /// Takes a box at rest and its candidates out of a cell.
  COLD static void take_still(Cell& cell, u32 slot) {
    cell.stills.take(cell.stills.find(slot));
    cell.candidates.purge(slot);
  }

  /// How many updates fat boxes reach ahead: a little more than until their next turn.
  f32 reach() const { return period_ * growth + 1; }

  /// Puts a mover into all cells that its new fat box touches, `found`, where it is not in already with one that still
  /// holds it: then its candidates hold for as long as it is in both.
  COLD void enter(const Scene<D>& scene, u32 slot, const f32* fat, Found& found, Stats& stats) {
    const f32* box = scene.box(slot);
    if (found.many()) {
      fat = box;
      cells_of(box, found);
      if (found.many()) return forget();
    }
    f32* bounds = last(slot);
    __builtin_memcpy(bounds, fat, width * sizeof(f32));
    for (u32 k = 0; k < found.count; k++) {
      Cell& cell = cells_[found.cell[k]];
      u32 at = cell.movers.find(slot);
      if (at == Movers::nowhere) {
        if (cell.movers.count >= most_in_cell) return forget();
        at = cell.movers.put(fat, tag_of(slot, tags_[slot]));
      } else if (holds(cell, at, box)) {
        const f32* its = cell.movers.numbers(at);
        for (u32 a = 0; a < D; a++) {
          bounds[a] = larger(bounds[a], its[4 * a]);
          bounds[D + a] = smaller(bounds[D + a], its[4 * (D + a)]);
        }
        continue;
      } else {
        cell.candidates.purge(slot);
        cell.movers.write(at, fat);
      }
      stamp(cell, at, box);
      stats.tests += cell.movers.count + cell.stills.count;
      cell.candidates.meet(room_, cell.movers, at, 0, cell.stills);
    }
  }

  /// Whether a box is in its fat one in a cell.
  static bool holds(const Cell& cell, u32 at, const f32* box) {
    const f32* its = cell.movers.numbers(at);
    bool is = true;
    for (u32 a = 0; a < D; a++) is &= its[4 * a] <= box[a] && box[D + a] <= its[4 * (D + a)];
    return is;
  }

  /// From now on a box rests, which was in the cells it touches now, or in none.
  COLD void rest(u32 slot, const f32* box, const Found& found, Stats& stats) {
    u32 tag = tags_[slot] = (tags_[slot] & ~slot_mask) | rests;
    __builtin_memcpy(last(slot), box, width * sizeof(f32));
    resting_++;
    for (u32 k = 0; k < found.count; k++) {
      Cell& cell = cells_[found.cell[k]];
      u32 at = cell.movers.find(slot);
      if (at != Movers::nowhere) take(cell, at);
      stats.tests += cell.movers.count + cell.stills.count;
      cell.movers.each_hit(box, tag, [&](u32 other) {
        cell.candidates.add_still(room_, cell.movers.slot(other), slot, box);
      });
      cell.stills.each_hit(box, tag, [&](u32 other) {
        u32 its = cell.stills.slot(other);
        // One that has woken, and waits, is no longer where it rested.
        if (!(tags_[its] & waiting) && reports(cell, box, last(its))) add(settled_, slot, its);
      });
      cell.stills.put(box, tag_of(slot, tag));
    }
    for (u32 h = 0; h < huge_count_; h++) {
      u32 its = tags_[huge_[h]];
      if ((its & rests) && !(its & tag & ~slot_mask) && touch<D>(box, last(huge_[h]))) add(settled_, slot, huge_[h]);
    }
  }

  NOINLINE static void add(Pairs& pairs, u32 a, u32 b) {
    pairs.room(pairs.list.data() + pairs.count, 1);
    pairs.list[pairs.count++] = pair_of(a, b);
  }

  /// A box that rested waits to be a mover. Its cells have it until it is served.
  COLD void wake(u32 slot) {
    woken_[slot / 32] |= 1u << slot % 32;
    any_woken_ = true;
    tags_[slot] |= waiting;
    since_[slot] = now_ - 1;
    queue_[queued_++] = slot;
  }

  COLD void leave_rest(u32 slot) {
    Found found;
    cells_of(last(slot), found);
    for (u32 k = 0; k < found.count; k++) take_still(cells_[found.cell[k]], slot);
    resting_--;
    tags_[slot] &= ~rests;
  }

  // --- an update ---

  /// Finds out who is new, who is gone, and who rests no longer.
  COLD void follow(const Scene<D>& scene, Pairs& pairs) {
    u32 n = scene.count, had = count_, both = smaller(n, had);
    if (n > had) {
      known_.grow(u64(n) * width + padding, u64(had) * width);
      since_.grow(n, had);
      tags_.grow(n, had);
      queue_.grow(n, queued_);
      u64 words = n / 32 + 1, known = had / 32 + 1;
      woken_.grow(words, known);
      for (u64 w = known; w < words; w++) woken_[w] = 0;
    }
    bool sweeps = n < had;
    for (u32 slot = n; slot < had; slot++) {
      u32 tag = tags_[slot];
      if (!(tag & rests)) continue;
      if (!(tag & is_huge)) leave_rest(slot);
      woken_[slot / 32] |= 1u << slot % 32;
      any_woken_ = true;
    }
    if (n < had) unqueue(n);
    // While cells are filled it is asked but in the last of these updates.
    if (queued_ > portion_) {
      unchecked_ = true;
      late_count_ = 0;
    } else {
      if (!scene.looked_at || by_ != By::cells) look(scene, both, unchecked_);
      unchecked_ = false;
    }
    u32 many = late_count_;
    late_count_ = 0;
    for (u32 k = 0; k < many; k++) {
      // Those that are late are left; one at rest that is not what it was wakes, one with another tag is put in anew.
      u32 slot = late_[k];
      late_[late_count_] = slot;
      if (tags_[slot] == scene.excluded_of(slot)) late_count_++;
      else changed(scene, slot, sweeps);
    }
    if (any_woken_) unsettle(pairs, larger(n, had));
    if (sweeps) sweep_out(n);
    count_ = n;
    for (u32 slot = had; slot < n; slot++) expect(scene, slot);
  }

  /// Finds the boxes that are not as expected, among the first so many: of those that may have changed, or of all.
  COLD void look(const Scene<D>& scene, u32 until, bool all) {
    late_count_ = Expected<D>{known_.data(), tags_.data(), filtered_}.look(scene, until, all, late_);
  }

  /// Sees to a box that is not as expected, and not late.
  COLD void changed(const Scene<D>& scene, u32 slot, bool& sweeps) {
    u32 tag = tags_[slot], excluded = scene.excluded_of(slot);
    bool same = (tag & ~slot_mask) == excluded;
    if ((tag & rests) && !(tag & waiting)) {
      if (tag & is_huge) {
        woken_[slot / 32] |= 1u << slot % 32;
        any_woken_ = true;
        tags_[slot] = excluded | is_huge;
        since_[slot] = now_;
        resting_--;
      } else {
        wake(slot);
      }
    } else if (!same) {
      tags_[slot] = (tag & slot_mask) | excluded;
      if (tag & (waiting | is_huge)) return;
      tags_[slot] |= waiting;
      since_[slot] = now_;
      __builtin_memcpy(last(slot), scene.box(slot), width * sizeof(f32));
      queue_[queued_++] = slot;
      sweeps = true;
    }
  }

  /// Those that wait, but for slots from n on.
  COLD void unqueue(u32 n) {
    u32 left = 0;
    u32 unseen = 0;
    for (u32 k = 0; k < queued_; k++) {
      u32 slot = queue_[k];
      queue_[left] = slot;
      left += slot < n;
      unseen += slot < n && k < unseen_;
    }
    queued_ = left;
    unseen_ = unseen;
  }

  /// Takes movers that are gone, or wait to be put in anew, out of all cells.
  COLD void sweep_out(u32 n) {
    for (u32 c = 0; c < leaves_; c++) {
      Cell& cell = cells_[c];
      for (u32 k = cell.movers.count; k-- > 0;) {
        u32 slot = cell.movers.slot(k);
        if (slot >= n || (tags_[slot] & waiting)) take(cell, k);
      }
    }
    u32 left = 0;
    for (u32 h = 0; h < huge_count_; h++) {
      huge_[left] = huge_[h];
      left += huge_[h] < n;
    }
    huge_count_ = left;
  }

  /// Takes the pairs of boxes that no longer rest out of the settled ones.
  COLD void unsettle(Pairs& pairs, u32 slots) {
    const u32* woken = woken_.data();
    u64* list = settled_.list.data();
    u64 left = 0, kept = settled_.count;
    for (u64 k = 0; k < settled_.count; k++) {
      u64 pair = list[k];
      u32 a = u32(pair), b = u32(pair >> 32);
      bool stays = !((woken[a / 32] >> a % 32 | woken[b / 32] >> b % 32) & 1);
      kept = stays ? kept : smaller(kept, left);
      list[left] = pair;
      left += stays;
    }
    settled_.count = left;
    pairs.kept = smaller(pairs.kept, kept);
    __builtin_memset(woken_.data(), 0, (slots / 32 + 1) * sizeof(u32));
    any_woken_ = false;
  }

  /// While cells are filled: whether of a sample of those that are in them many are not where they should be.
  COLD bool astray(const Scene<D>& scene) const {
    u32 stride = larger(1u, count_ / watched), known = 0, out = 0;
    for (u32 slot = 0; slot < count_; slot += stride) {
      u32 tag = tags_[slot];
      if (tag & (waiting | is_huge)) continue;
      known++;
      out += !(tag & rests ? equal(scene.box(slot), last(slot)) : inside<D>(scene.box(slot), last(slot)));
    }
    return out * sample_share > known + sample_share;
  }

  /// Puts boxes that wait into cells: all that are few, else a share of them.
  COLD void serve(const Scene<D>& scene, const Settings& options, Stats& stats) {
    if (now_ - begun_ <= still_for) return see_first(scene);  // nobody knows yet who rests
    u32 many = smaller(queued_, portion_);
    // While all is filled, little by little, the first must reach further ahead than the last.
    f32 until = reach() + f32(queued_ - many) / f32(portion_);
    see(scene, many);
    for (; many > 0; many--) {
      if (many % together == 0) {  // they stand anywhere
        const u32* next = queue_.data() + queued_ - together;
        read_rows(scene.boxes, width * sizeof(f32), next, together, 1);
        read_rows(known_.data(), width * sizeof(f32), next, together, 1);
        read_rows(since_.data(), sizeof(u32), next, together, 1);
        read_rows(tags_.data(), sizeof(u32), next, together, 1);
      }
      u32 slot = queue_[--queued_];
      if (tags_[slot] & rests) leave_rest(slot);
      tags_[slot] = scene.excluded_of(slot);
      const f32* box = scene.box(slot);
      u32 updates = now_ - since_[slot];
      bool still = updates > still_for && equal(box, last(slot));
      f32 fat[width + padding];
      if (!still) fatten<D>(box, last(slot), larger(updates, 1u), 0, until, no_walls, slack_, options.margin, fat);
      Found found;
      cells_of(still ? box : fat, found);
      if (found.many() && !still) {
        __builtin_memcpy(fat, box, width * sizeof(f32));  // until its turn it is late when it moves
        cells_of(fat, found);
      }
      if (found.many()) {
        if (huge_count_ == most_huge) return forget();
        huge_[huge_count_++] = slot;
        tags_[slot] |= is_huge;
        note(scene, slot);
        continue;
      }
      if (still) {
        rest(slot, box, found, stats);
        continue;
      }
      enter(scene, slot, fat, found, stats);
      if (leaves_ == 0) return;
    }
  }

  /// Whether movers are so many.
  bool far() const { return count_ - resting_ > too_many_to_be_near; }

  /// Lets the next cells have their turn.
  void take_turns(const Scene<D>& scene, const Settings& options, Stats& stats) {
    u32 turns = smaller(leaves_, u32(f32(leaves_) / period_) + 1), near = far() ? 0 : turns;
    for (; turns > 0 && leaves_ > 0; turns--) {
      if (near == 0) {
        near = smaller(turns, together);
        fetch_for_turns(scene, smaller(leaves_, cursor_ + near));
      }
      near--;
      turn(cells_[cursor_], scene, options, stats);
      if (++cursor_ < leaves_) continue;
      cursor_ = 0;
      // Not by more than fat boxes reach further.
      period_ = larger(period_ * (2 - growth), smaller(period_ * growth, target_));
    }
  }

  /// Reads what the turns of the next cells are going to read, up to one.
  COLD void fetch_for_turns(const Scene<D>& scene, u32 until) {
    for (u32 c = cursor_; c < until; c++) {
      if (cells_[c].movers.count == 0) continue;
      cells_[c].movers.fetch();
      cells_[c].stills.fetch();
    }
    for (u32 c = cursor_; c < until; c++) {
      const Movers& movers = cells_[c].movers;
      for (u32 k = 0; k < movers.count; k++) {
        u32 slot = movers.slot(k);
        unneeded = tags_[slot] ^ bits<u32>(scene.box(slot)[0]);
      }
    }
  }

  /// New fat boxes for the movers of a cell, and all candidates anew.
  void turn(Cell& cell, const Scene<D>& scene, const Settings& options, Stats& stats) {
    for (u32 k = cell.movers.count; k-- > 0;) {
      u32 slot = cell.movers.slot(k), tag = tags_[slot];
      const f32* box = scene.box(slot);
      if (tag & rests) {
        cell.candidates.clear(room_);  // it rests elsewhere; all candidates are to be collected anyway
        take(cell, k);
        continue;
      }
      f32 low[4], fat[width + padding];
      bool moved = false;
      for (u32 a = 0; a < D; a++) {
        low[a] = cell.movers.numbers(k)[4 * (from_row + a)];
        moved |= low[a] != box[a];
      }
      u32 updates = age(cell, k);
      if (updates == 0) continue;
      Found found;
      if (!moved && updates > still_for && touches(cell, box)) {
        cells_of(box, found);
        if (!found.many()) {
          rest(slot, box, found, stats);
          continue;
        }
      }
      fatten<D>(box, low, updates, 0, reach(), no_walls, slack_, options.margin, fat);
      motion_ += pace<D>(box, low, updates);
      turned_ += 1;
      if (touches(cell, fat)) {
        cell.movers.write(k, fat);
        stamp(cell, k, box);
        if (within(cell, fat)) {
          __builtin_memcpy(last(slot), fat, width * sizeof(f32));
          continue;
        }
      } else {
        cell.candidates.clear(room_);
        take(cell, k);
      }
      cells_of(fat, found);
      enter(scene, slot, fat, found, stats);
      if (leaves_ == 0) return;
    }
    stats.tests += f64(cell.movers.count) * (cell.movers.count - 1) / 2 + f64(cell.movers.count) * cell.stills.count;
    cell.candidates.clear(room_);
    for (u32 k = 0; k < cell.movers.count; k++) cell.candidates.meet(room_, cell.movers, k, k + 1, cell.stills);
  }

  /// Gives movers that have left their fat boxes new ones.
  COLD void serve_late(const Scene<D>& scene, const Settings& options, Stats& stats) {
    u32 n = scene.count;
    if (by_ != By::cells) look(scene, n, true);  // while cells were filled nobody did
    if (late_count_ > n / late_share + 64) return forget();
    for (u32 k = 0; k < late_count_; k++) {
      u32 slot = late_[k];
      const f32* box = scene.box(slot);
      if (tags_[slot] != scene.excluded_of(slot) || inside<D>(box, last(slot))) continue;  // it has had its turn
      // Its motion is known where it is in a cell that it touches still.
      Found found;
      cells_of(box, found);
      f32 low[4], fat[width + padding];
      __builtin_memcpy(low, box, D * sizeof(f32));
      u32 updates = 1;
      for (u32 c = 0; c < found.count; c++) {
        const Cell& cell = cells_[found.cell[c]];
        u32 at = cell.movers.find(slot);
        if (at == Movers::nowhere) continue;
        for (u32 a = 0; a < D; a++) low[a] = cell.movers.numbers(at)[4 * (from_row + a)];
        updates = larger(age(cell, at), 1u);
        break;
      }
      fatten<D>(box, low, updates, 0, reach(), no_walls, slack_, options.margin, fat);
      cells_of(fat, found);
      enter(scene, slot, fat, found, stats);
      if (leaves_ == 0) return;
    }
  }

  /// Reports the settled pairs and the candidates that overlap.
  void report(const Scene<D>& scene, Pairs& pairs, Stats& stats) {
    u64 head = settled_.count;
    pairs.list.grow(head + Pairs::slack, pairs.kept);
    if (head > pairs.kept) {
      __builtin_memcpy(pairs.list.data() + pairs.kept, settled_.list.data() + pairs.kept, (head - pairs.kept) * sizeof(u64));
    }
    pairs.kept = head;
    u64* out = pairs.list.data() + head;
    bool fetches = far();
    u32 moving = 0, candidates = 0, tests = 0;
    for (u32 c = 0; c < leaves_; c++) {
      if (fetches && c % together == 0) {
        u32 until = smaller(leaves_, c + together);
        for (u32 k = c; k < until; k++) cells_[k].candidates.fetch_boxes(scene.boxes);
      }
      const Cell& cell = cells_[c];
      if (cell.movers.count == 0) continue;
      const Candidates<D>& its = cell.candidates;
      out = its.report(scene.boxes, cell.low, cell.high, pairs.room(out, its.tests()));
      moving += cell.movers.count;
      candidates += its.count();
      tests += its.tests();
    }
    pairs.count = Pairs::between(pairs.list.data(), out);
    moving_ = moving;
    candidates_ = candidates;
    stats.tests += tests;
    if (huge_count_ > 0) report_huge(scene, pairs, stats);
    stats.cells = leaves_;
    stats.entries = moving_ + resting_;
  }

  /// The pairs of huge boxes that are not settled.
  COLD void report_huge(const Scene<D>& scene, Pairs& pairs, Stats& stats) {
    auto meet = [&](u32 h, u32 slot) {
      return !(tags_[h] & tags_[slot] & ~slot_mask) && touch<D>(scene.box(h), scene.box(slot));
    };
    for (u32 c = 0; c < leaves_; c++) {
      const Cell& cell = cells_[c];
      for (u32 k = 0; k < cell.movers.count; k++) {
        u32 slot = cell.movers.slot(k);
        const f32* box = scene.box(slot);
        if ((tags_[slot] & rests) || !reports(cell, box, box)) continue;
        for (u32 h = 0; h < huge_count_; h++) {
          if (meet(huge_[h], slot)) add(pairs, huge_[h], slot);
        }
      }
    }
    stats.tests += moving_ * huge_count_;
    for (u32 h = 0; h < huge_count_; h++) {
      u32 slot = huge_[h];
      const f32* box = scene.box(slot);
      bool still = tags_[slot] & rests;
      for (u32 g = 0; g < h; g++) {
        if (!(still && (tags_[huge_[g]] & rests)) && meet(slot, huge_[g])) add(pairs, slot, huge_[g]);
      }
      if (still) continue;
      u64 first = pairs.count;
      for (u32 c = 0; c < leaves_; c++) {
        const Cell& cell = cells_[c];
        if (!touches(cell, box)) continue;
        stats.tests += cell.stills.count;
        cell.stills.each_hit(box, tags_[slot], [&](u32 at) {
          u32 its = cell.stills.slot(at);
          if (reports(cell, box, last(its))) add(pairs, slot, its);
        });
      }
      if (!equal(box, last(slot))) {
        __builtin_memcpy(last(slot), box, width * sizeof(f32));
        since_[slot] = now_;
      } else if (now_ - since_[slot] > still_for) {
        // It rests from the next update on.
        for (u64 k = first; k < pairs.count; k++) add(settled_, u32(pairs.list[k]), u32(pairs.list[k] >> 32));
        for (u32 g = 0; g < huge_count_; g++) {
          if ((tags_[huge_[g]] & rests) && meet(slot, huge_[g])) add(settled_, slot, huge_[g]);
        }
        tags_[slot] |= rests;
        resting_++;
      }
    }
  }

  /// Chooses how far fat boxes reach, by what turns cost and what candidates cost.
  COLD void balance(f64 hits) {
    pauses_ = larger(first_pause, pauses_ - 1);
    if (turned_ < 16) return;
    target_ = best_period(turned_ * period_, hits, motion_ / turned_);
    // Where boxes leave their fat ones too early, reach further to the sides.
    slack_ = smaller(16.0f, larger(least_slack, slack_ * (late_count_ > few_late * turned_ ? 1.05f : 0.99f)));
  }
};
