// Strip sweep: cut the world into strips (2D) or columns (3D), order each along the remaining axis, sweep.
//
// Idea: an item enters every strip it touches and is marked "continues" in all but its first (3D: one mark per axis).
// Two items that both continue into a strip have already met, so their shared mark keeps them from being tested again:
// every pair is found once, with no table. If a strip has too many candidates that are not hits, it is divided again,
// along the same axes, by its own statistics. In 3D, a few thousand boxes that hardly overlap stay one column.
// Cost: build O(n), pairs O(n + candidates); memory about 48 (2D) or 80 (3D) bytes for each entry.
// Wins when boxes move further than their size in a frame: box size costs almost nothing, there is no cell size to
// choose. Loses otherwise: each update is a full rebuild.
// From: two-layer partitioning, Tsitsigkos et al., "A Two-layer Partitioning for Non-point Spatial Data",
// ICDE 2021; the sweep in strips goes back to Güting & Schilling 1987.
#pragma once
#include "search/options.hpp"
#include "search/stats.hpp"
#include "search/strip_index.hpp"
#include "search/sweep_list.hpp"

template <int D> class StripSweep {
  // What an entry in a strip costs, relative to a tested candidate: sets the width of the strips.
  static constexpr f64 entry_cost = D == 2 ? 24 : 40;
  // Below this many candidates per box, narrower strips save nothing: the first block of four is tested anyway.
  static constexpr f64 free_candidates = 1.5;
  // Strips with more items than this do not fit the cache of the core.
  static constexpr f64 cached_items = 8192;
  static constexpr f64 least_items = 100;  // in a strip, on average: shorter ones cost more than they save
  static constexpr u32 one_strip_below = 400;  // fewer boxes stay one strip, unless that has too many candidates
  static constexpr u32 sampled_from = 2000;  // fewer boxes are not sampled, unless some are far from most others
  static constexpr u32 most_strips = D == 2 ? 4096 : 255;  // along one axis; 3D packs the range into bytes
  static constexpr u32 deepest = 6;
  // A strip is cut again if it has this many candidates per item, this many in all, and fewer hits among them than the
  // share `wasteful`.
  static constexpr u64 again_factor = D == 2 ? 24 : 48, again_least = 8192;
  static constexpr f64 wasteful = 0.25;
  // In 3D, sixteen are tested at a time if an item has more candidates than this, and fewer than the share `rare` are
  // hits. In 2D, strips can always be made narrow enough.
  static constexpr u64 sixteen_from = D == 2 ? again_factor : 8;
  static constexpr f64 rare = 0.1;
  // A world of up to `most_alone` boxes in 3D stays one column, and sixteen are tested at a time, if a box is expected to
  // overlap fewer than `seldom` others, and nowhere more than `even` times as many as if all were spread evenly.
  static constexpr u32 most_alone = 5000;
  static constexpr f64 seldom = 0.4, even = 12;
  // Work, in tests of four at a time: of a test of sixteen at a time; of entering a box into one of many columns, or into
  // a strip or the only column.
  static constexpr f64 light = 0.25, entered_column = 20, entered_strip = 16;
  // No cut is made that would lead to more entries per box than this.
  static constexpr u64 most_copies = 8;

  /// How one set of items is cut: along the binned axes 1 (and 2); axis 0 is swept.
  struct Cut {
    SceneSample<D> world;
    Axis along[D];
    u32 strips[D];

    u32 lists() const { return strips[1] * (D == 2 ? 1 : strips[D - 1]); }
    // One more strip along each axis, which stays empty: counting by differences writes one past the last strip.
    u32 across() const { return D == 2 ? 1 : strips[D - 1] + 1; }
    u32 rows() const { return (strips[1] + 1) * across(); }
  };

  /// A part of the world, along the item's axes; unbounded at its borders.
  struct Region {
    f64 low[D], high[D];
  };

  /// The entries of the strips of a cut; deeper cuts put theirs behind these.
  struct Strips {
    u32 begin, end, depth;
  };

  /// First and last strip of an item along each binned axis, packed to 4 bytes.
  struct Range {
    u32 packed;
    u32 first(int axis) const { return D == 2 ? packed & 0xffff : packed >> (16 * axis - 16) & 0xff; }
    u32 last(int axis) const { return D == 2 ? packed >> 16 : packed >> (16 * axis - 8) & 0xff; }
  };

  SMALL static Axes lanes_of(const Cut& cut) {
    const Axis& a = cut.along[0];
    const Axis& b = cut.along[1];
    if constexpr (D == 2) return {a, b, a, b};
    else return {a, b, cut.along[2], a};
  }
  static Range range_of(const Axes& axes, const Item<D>& item) {
    if constexpr (D == 2) {
      u32x4 strips = axes(item.box);
      return {strips[1] | strips[3] << 16};
    } else {
      u32x4 strips = axes(item.first()) | axes(item.high) << 8;
      return {strips[1] | strips[2] << 16};
    }
  }

  Items<D> entries_;  // by strip; deeper cuts stack theirs on top
  SweepList<D> swept_;  // the items of one strip
  Buffer<Range> ranges_;  // per item that is being cut
  Buffer<u32> offsets_[deepest + 1];  // per cut: where each strip's entries begin
  Buffer<Region> leaves_;  // the strips in use
  StripIndex index_;  // of the outermost cut, if that is `searched_`
  bool searched_ = false;
  AxisOrder<D> order_ = {};
  Cut cut_ = {};  // the outermost one
  Strips strips_ = {};
  u32 boxes_ = 0;
  f64 alone_ = 0;  // the most tests with which the world stays one column; 0: it is cut
  f64 tested_ = 0, most_ = 0;  // the work of tests
  f64 entered_ = 0;
  u64 found_ = 0;  // pairs before this sweep
  Stats* stats_ = nullptr;

 public:
  static constexpr bool notes_doubts = true;

  SMALL void update(const Scene<D>& scene, const Options&, Pairs& pairs, Stats& stats) {
    fill(scene, stats, false);
    sweep(pairs, __builtin_inf());
  }

  /// Puts boxes into strips. Until they are swept, `stats` must stay where it is. `searched`: `near` will be called.
  SMALL void fill(const Scene<D>& scene, Stats& stats, bool searched) {
    stats_ = &stats;
    searched_ = searched;
    boxes_ = scene.count;
    strips_ = {};
    alone_ = tested_ = 0;
    if (scene.count < 2) return;
    bool cuts = cut_up(scene);
    SceneItems<D> items{scene, order_};
    if (!cuts || !fill(items, scene.count, cut_, 0, strips_)) {
      leave_whole();
      if (cuts) strips_.depth = deepest;
      entries_.grow(scene.count, 0);
      ItemsAt<D> all(entries_, 0);
      for (u32 k = 0; k < scene.count; k++) all.put(k, items[k]);
      stats.entries = strips_.end = offsets_[strips_.depth].reserve(1)[0] = scene.count;
    }
    if (searched) index_.reserve(cut_.rows(), strips_.end);
  }

  /// Finds the pairs in the strips that were filled. Gives up and returns false if tests take more than `most` work.
  SMALL bool sweep(Pairs& pairs, f64 most) {
    most_ = most;
    found_ = pairs.count;
    bool columns = D == 3 && !stays_whole();
    sweep(cut_, everywhere(), strips_, pairs);
    entered_ = (columns ? entered_column : entered_strip) * stats_->entries;
    return tested_ <= most;
  }

  /// The work of the last sweep, in tests of four at a time: all of it; that of tests alone.
  f64 work() const { return entered_ + tested_; }
  f64 tested() const { return tested_; }

  /// The number of boxes that were swept.
  u32 count() const { return boxes_; }

  /// Writes the slots of the boxes, as they were swept, that touch this one; returns how many. `met` counts those tested.
  NOINLINE u32 near(const f32* box, u32* out, u64& met) const {
    Item<D> item = SceneItems<D>{{box, 1, nullptr}, order_}[0];
    Range range = range_of(lanes_of(cut_), item);
    u32 found = 0, first = D == 2 ? 0 : range.first(2), last = D == 2 ? 0 : range.last(2);
    for (u32 s = range.first(1); s <= range.last(1); s++) {
      for (u32 t = first; t <= last; t++) {
        u32 marks = (s > range.first(1) ? u32(continues_1) : 0) | (t > first ? u32(continues_2) : 0);
        u32 l = s * cut_.across() + t, begin = l ? offsets_[strips_.depth][l - 1] : 0;
        u32 count = offsets_[strips_.depth][l] - begin;  // filling has moved offsets to the ends of their strips
        found += index_.near(l, begin, ItemsAt<D>(entries_, begin), count, item, marks, out + found, met);
      }
    }
    return found;
  }

  /// The mean size of the last update's boxes, along one of the axes in the order of the sweep.
  f64 size(int axis) const { return cut_.world.size[axis]; }

  /// The strips of the last update, as boxes in the world's axes; unbounded sides are infinite.
  SMALL void structure(Buffer<f32>& boxes, u32& count, const Stats& stats) const {
    count = u32(stats.cells);
    boxes.reserve(u64(count) * 2 * D);
    for (u32 k = 0; k < count; k++) {
      for (int a = 0; a < D; a++) {
        boxes[k * 2 * D + order_.axis[a]] = f32(leaves_[k].low[a]);
        boxes[k * 2 * D + D + order_.axis[a]] = f32(leaves_[k].high[a]);
      }
    }
  }

  SMALL void release() {
    entries_.release();
    swept_.release();
    ranges_.release();
    for (auto& offsets : offsets_) offsets.release();
    leaves_.release();
    index_.release();
  }

 private:
  /// Strip widths that balance entries against candidates: a strip w boxes wide makes 1 / w more entries and
  /// tests w times the neighbours along the sweep axis.
  SMALL static Cut choose(const SceneSample<D>& world, u32 count) {
    f64 relative[D];
    for (int a = 0; a < D; a++) relative[a] = share(world, count, a);
    f64 neighbours = world.crowding * count * relative[0];  // along the sweep axis, without strips
    f64 width[D];  // as a share of the extent
    auto one_axis = [&](int axis) {
      f64 balanced = __builtin_sqrt(entry_cost * relative[axis] / neighbours);
      return larger(balanced, free_candidates / neighbours);
    };
    if constexpr (D == 2) {
      width[1] = larger(smaller(one_axis(1), cached_items / count), least_items / count);
    } else {
      f64 boxes = cube_root(entry_cost / (neighbours * relative[1] * relative[2]));
      boxes = larger(boxes, __builtin_sqrt(free_candidates / (neighbours * relative[1] * relative[2])));
      width[1] = boxes * relative[1];
      width[2] = boxes * relative[2];
      // If one axis is not worth cutting, the world is flat: balance the other alone.
      if (width[1] >= 1) width[2] = one_axis(2);
      else if (width[2] >= 1) width[1] = one_axis(1);
    }
    if constexpr (D == 3) {
      f64 share = width[1] * width[2] * count / least_items;
      if (share < 1) {
        f64 factor = __builtin_sqrt(1 / share);
        width[1] *= factor;
        width[2] *= factor;
      }
    }
    Cut cut;
    cut.world = world;
    cut.strips[0] = 1;
    for (int a = 1; a < D; a++) {
      cut.strips[a] = u32(larger(1.0, smaller(f64(most_strips), 1 / width[a])));
      cut.along[a] = Axis::make(world.low[a], world.high[a], cut.strips[a]);
      if (cut.along[a].scale == 0) cut.strips[a] = 1;
    }
    return cut;
  }

  /// The mean size along an axis, as a share of the extent.
  SMALL static f64 share(const SceneSample<D>& world, u32 count, int axis) {
    f64 extent = world.high[axis] - world.low[axis];
    return extent > 0 ? smaller(1.0, larger(world.size[axis] / extent, 1e-3 / count)) : 1;
  }

  /// The most tests with which the world stays one column, 1.5 times as many as are expected; 0 if it is cut.
  SMALL static f64 tests_alone(const SceneSample<D>& world, u32 count) {
    f64 met = world.crowding * count;  // by a box
    for (int a = 0; a < D; a++) met *= share(world, count, a);
    bool stays = count <= most_alone && met <= seldom && world.crowding <= even;
    return stays ? 1.5 * count * count * share(world, count, 0) * cube_root(world.crowding) : 0;
  }

  bool stays_whole() const { return D == 3 && alone_ > 0; }

  SMALL static Region everywhere() {
    Region region;
    for (int a = 0; a < D; a++) {
      region.low[a] = -__builtin_inf();
      region.high[a] = __builtin_inf();
    }
    return region;
  }

  /// Chooses the sweep axis and the outermost cut; false if that leaves all in one strip.
  SMALL bool cut_up(const Scene<D>& scene) {
    SceneItems<D> plain{scene, AxisOrder<D>::make(0)};
    SceneSample<D> world = scene.count < sampled_from ? glance<D>(plain, scene.count) : measure<D>(plain, scene.count);
    int a = world.longest();
    order_ = AxisOrder<D>::make(a);
    bool sparse = scene.count * world.size[a] <= again_factor * (world.high[a] - world.low[a]);
    cut_.world = world.in(order_);
    if (D == 3 && !searched_) alone_ = tests_alone(cut_.world, scene.count);
    if (stays_whole() || (sparse && scene.count < one_strip_below)) return false;
    cut_ = choose(cut_.world, scene.count);
    return cut_.lists() > 1;
  }

  /// All in one strip.
  SMALL void leave_whole() {
    for (int a = 0; a < D; a++) {
      cut_.strips[a] = 1;
      cut_.along[a] = Axis::make(0, 0, 1);
    }
  }

  /// Puts items into the strips of a cut, after the `base` entries of the cuts further out. Does nothing and returns
  /// false if the cut would not pay: boxes that overlap nearly all others enter every strip, and each further cut would
  /// multiply them.
  template <class Source> bool fill(Source items, u32 size, const Cut& cut, u32 base, Strips& strips) {
    u32 depth = strips.depth;
    clear(cut, depth);
    ranges_.reserve(size);
    count(items, size, cut, depth);
    u64 total = base;
    if (!add_up(size, cut, depth, total)) return false;
    size_t source = place(items);
    entries_.grow(total, base);
    move(items, source);
    enter(items, size, cut, depth);
    stats_->entries += f64(total - base);
    strips.begin = base;
    strips.end = u32(total);
    return true;
  }

  SMALL void clear(const Cut& cut, u32 depth) {
    __builtin_memset(offsets_[depth].reserve(cut.rows()), 0, cut.rows() * sizeof(u32));
  }

  /// Counting by differences: +1 where an item's range of strips begins, -1 behind its end, then prefix sums.
  template <class Source> NOINLINE void count(Source items, u32 size, const Cut& cut, u32 depth) {
    u32 across = cut.across();
    u32* offsets = offsets_[depth].data();
    Range* ranges = ranges_.data();
    Axes axes = lanes_of(cut);
    for (u32 k = 0; k < size; k++) {
      Range range = range_of(axes, items[k]);
      ranges[k] = range;
      u32 first = range.first(1), behind = range.last(1) + 1;
      if constexpr (D == 2) {
        offsets[first]++;
        offsets[behind]--;
      } else {
        u32 first_2 = range.first(2), behind_2 = range.last(2) + 1;
        offsets[first * across + first_2]++;
        offsets[first * across + behind_2]--;
        offsets[behind * across + first_2]--;
        offsets[behind * across + behind_2]++;
      }
    }
  }

  /// Computes where each strip's entries begin, and how many there will be in all; returns whether the cut pays.
  SMALL bool add_up(u32 size, const Cut& cut, u32 depth, u64& total) const {
    u32 across = cut.across(), lists = cut.rows();
    u32* offsets = offsets_[depth].data();
    if constexpr (D == 3) {
      for (u32 l = 0; l < lists; l++) {
        if (l % across) offsets[l] += offsets[l - 1];
      }
    }
    for (u32 l = across; l < lists; l++) offsets[l] += offsets[l - across];
    u64 base = total;
    f64 tests = 0;  // relative to those of the uncut items
    for (u32 l = 0; l < lists; l++) {
      u32 here = offsets[l];
      offsets[l] = u32(total);
      total += here;
      tests += f64(here) * here;
    }
    // It pays if it saves a third of the tests, or if it makes few copies: then it isolates a crowd, which the next cut
    // can divide.
    bool pays = tests * 3 < 2 * f64(size) * size || (total - base) * 2 < size * 3;
    return pays && total <= most_copies * boxes_;
  }

  /// Puts items into their strips.
  template <class Source> NOINLINE void enter(Source items, u32 size, const Cut& cut, u32 depth) {
    u32 across = cut.across();
    u32* offsets = offsets_[depth].data();
    const Range* ranges = ranges_.data();
    ItemsAt<D> entries(entries_, 0);
    for (u32 k = 0; k < size; k++) {
      Item<D> item = items[k];
      Range range = ranges[k];
      u32 first = range.first(1), last = range.last(1);
      if constexpr (D == 2) {
        entries.put(offsets[first]++, item);
        if (first == last) continue;
        item = with_tag(item, continues_1);
        for (u32 s = first + 1; s <= last; s++) entries.put(offsets[s]++, item);
      } else {
        u32 first_2 = range.first(2), last_2 = range.last(2);
        for (u32 s = first; s <= last; s++) {
          Item<D> marked = s == first ? item : with_tag(item, continues_1);
          u32* row = offsets + s * across;
          entries.put(row[first_2]++, marked);
          if (first_2 == last_2) continue;
          marked = with_tag(marked, continues_2);
          for (u32 t = first_2 + 1; t <= last_2; t++) entries.put(row[t]++, marked);
        }
      }
    }
  }

  /// Sweeps the strips of a cut.
  SMALL void sweep(const Cut& cut, const Region& region, const Strips& strips, Pairs& pairs) {
    u32 across = cut.across(), depth = strips.depth, begin = strips.begin;
    for (u32 l = 0; begin < strips.end && tested_ <= most_; l++) {
      u32 end = offsets_[depth][l];  // filling the strip has moved it from the beginning to the end
      if (end == begin) continue;
      Region part = region;
      narrow(part, 1, cut, l / across);
      if constexpr (D == 3) narrow(part, 2, cut, l % across);
      ItemsAt<D> items(entries_, begin);
      u64 tests = swept_.order(items, end - begin, &cut.world, cut.lists() == 1);
      if (searched_ && &strips == &strips_) note_order(l, begin, end);
      list(items, end - begin, tests, part, strips.end, depth + 1, pairs);
      begin = end;
    }
  }

  /// Retains the order of the strip that was ordered last.
  void note_order(u32 strip, u32 begin, u32 end) {
    swept_.put_back(ItemsAt<D>(entries_, begin), end - begin);
    LaneView<D> items = swept_.view();
    index_.add(strip, begin, items.lo[0], items.hi[0], end - begin);
  }

  // Items that are cut again are in entries_ themselves, which may move when it grows.
  static size_t place(const SceneItems<D>&) { return 0; }
  static void move(SceneItems<D>&, size_t) {}
  size_t place(const ItemsAt<D>& items) const { return size_t(items.boxes - entries_.boxes.data()) / (D - 1); }
  void move(ItemsAt<D>& items, size_t first) const { items = ItemsAt<D>(entries_, first); }

  /// Clips a region to one strip along an axis; the border strips keep the region's own border.
  SMALL static void narrow(Region& region, int axis, const Cut& cut, u32 strip) {
    u32 last = cut.strips[axis] - 1;
    if (last == 0) return;
    // Strips are centred on whole steps, since Axis rounds to the nearest.
    f64 low = cut.world.low[axis], step = (cut.world.high[axis] - low) / last;
    if (strip > 0) region.low[axis] = low + (strip - 0.5) * step;
    if (strip < last) region.high[axis] = low + (strip + 0.5) * step;
  }

  /// Sweeps the items of one strip, which were just ordered, or cuts the strip again if that saves work.
  void list(const ItemsAt<D>& items, u32 count, u64 tests, const Region& region, u32 base, u32 depth, Pairs& pairs) {
    bool alone = D == 3 && tests <= alone_;
    alone_ = 0;
    f64 hits = !alone && tests > sixteen_from * count && tests > again_least ? swept_.hits(count) : 1;
    if (hits < wasteful && tests > again_factor * count && depth < deepest) {
      SceneSample<D> part = measure<D>(items, count);
      for (int a = 1; a < D; a++) {
        part.low[a] = larger(part.low[a], region.low[a]);
        part.high[a] = smaller(part.high[a], region.high[a]);
        part.size[a] = smaller(part.size[a], larger(0.0, part.high[a] - part.low[a]));
      }
      Cut cut = choose(part, count);
      Strips strips = {0, 0, depth};
      if (cut.lists() > 1 && fill(items, count, cut, base, strips)) return sweep(cut, region, strips, pairs);
    }
    if (hits == 1 && stats_->tests > 0) hits = f64(pairs.count - found_) / stats_->tests;  // as in the strips before
    bool few = D == 3 && tests > sixteen_from * count && (alone || hits < rare);
    stats_->tests += f64(tests);
    tested_ += tests * (few ? light : 1);
    if (tested_ > most_) return;
    stats_->cells++;
    note(region);
    if constexpr (D == 3) {
      if (few) return swept_.find_few(cut_.world, count, pairs);
    }
    swept_.find(count, pairs);
  }

  SMALL void note(const Region& region) {
    u64 leaf = u64(stats_->cells) - 1;
    leaves_.grow(leaf + 1, leaf);
    leaves_[leaf] = region;
  }
};
