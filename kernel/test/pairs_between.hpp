// The pairs of two spaces are those of their models, whatever changes, and after memory ran out in either. The test
// takes queries and answers from one space to the other, as src/pairs-between.ts does.
#pragma once
#include "around.hpp"
#include "random.hpp"
#include "scenes.hpp"

/// A space, its model, and what its last update saw.
template <int D> struct Side {
  std::unique_ptr<Instance<D>> instance = open<D>(Technique::incremental);
  Space<D>& space = instance->space;
  Questions<D>& questions = space.questions;
  Model<D> model, seen;

  void update() {
    CHECK(space.update() == -1);
    seen = model;
  }
  void change(Random& random) {
    u32 id = random.below(60), slot;
    bool there = model.has(id);
    u32 what = random.below(there ? 12 : 1);
    if (what == 9) {
      space.store.remove(id);
      model.remove(id);
      return;
    }
    if (what < 9) {
      Box<D> box = there ? model.at(id) : spread<D>(random, 1, 0, 30, 6)[0];
      f64 by = (random.fraction() - 0.5) * (what == 8 ? 20 : 0.5);
      for (u32 n = 0; n < 2 * D; n++) box[n] = what % 2 ? f64(f32(box[n] + by)) : box[n] + by;
      set(space, id, box.data());
      model.set(id, box);
      return;
    }
    slot = instance->ids.slot(id);
    u32 bits = what == 10 ? 1 + random.below(3) : ~0u;
    f64 reach = random.below(3) * 0.1;
    space.store.filter(slot, bits, ~0u);
    model.filter(id, bits, ~0u);
    if (random.below(2) == 0) return;
    space.store.set_reach(slot, reach);
    model.set_reach(id, reach);
  }
};

template <int D> class PairsBetween {
  static constexpr u32 row = Index<D>::row, set = 3;

  Side<D>&few_, &many_;
  u32 epoch_ = 0, read_ = 0;

  void carry(Side<D>& from, Side<D>& to, u32 numbers) {
    running = &to;
    f64* place = to.questions.bulk.stage(numbers);
    std::copy_n(from.questions.bulk.given.data(), numbers, place);
  }

  void answer(u32 asked, f64 reach) {
    carry(few_, many_, asked * (row - 1));
    many_.questions.asked = {};
    many_.questions.asked.touching = few_.model.touching;
    many_.questions.ask_many(Asks::meeting, asked, 0);
    Bulk<D>& bulk = many_.questions.bulk;
    u32 found = bulk.offsets()[asked];
    f64* rows = bulk.stage(found * row + asked + 1);
    for (u32 k = 0; k < found; k++) rows[k * row] = bulk.ids[k];
    bulk.fill_rows(many_.questions.index(), found);
    for (u32 k = 0; k <= asked; k++) rows[found * row + k] = bulk.offsets()[k];
    carry(many_, few_, found * row + asked + 1);
    few_.questions.take_answers(set, found, reach == 0);
  }

 public:
  Side<D>* running = nullptr;  // the space that runs, and may run out of memory

  PairsBetween(Side<D>& few, Side<D>& many) : few_(few), many_(many) {}

  void bring() {
    running = &many_;
    u32 now = many_.questions.keep_changes();
    const ChangedIds& changed = many_.space.store.changed;
    f64 reach = many_.questions.index().most_reach();
    bool same = now == epoch_;
    u32 changes = same ? changed.count() - read_ : 0;
    epoch_ = 0;  // if memory runs out, the next call starts over
    running = &few_;
    f64* to = few_.questions.bulk.stage(2 * changes);
    for (u32 n = 0; n < 2 * changes; n++) to[n] = changed.list()[2 * read_ + n];
    u32 asked = few_.questions.begin_pairs(set, changes, same, true, reach);
    bool still = asked == NeighbourLists::still;
    if (!still && asked > 0) answer(asked, reach);
    u32 loose = still ? 0 : few_.questions.neighbours[set].loose();
    if (loose > 0) {
      few_.questions.stage_loose(set);
      carry(few_, many_, loose * row);
      many_.questions.bulk.fill_rows(many_.questions.index(), loose);
      carry(many_, few_, loose * row);
      few_.questions.meet_loose(set);
    }
    epoch_ = now;
    read_ = changed.count();
  }

  void check() const {
    const auto& near = few_.questions.neighbours[set];
    PairList found(near.pairs(), near.pairs() + near.count()), expected;
    std::sort(found.begin(), found.end());
    for (u32 b : many_.seen.ids()) {
      for (u32 a : few_.seen.ids()) {
        Rule one = few_.seen.rule(a), its = many_.seen.rule(b);
        bool meets = (one.layer & its.mask) && (its.layer & one.mask);
        Box<D> mine = few_.seen.grown(a), other = many_.seen.grown(b);
        Question<D> asks;
        std::copy_n(mine.begin(), D, asks.lo);
        std::copy_n(mine.begin() + D, D, asks.hi);
        asks.touching = few_.seen.touching;
        Around<D> around(asks, few_.instance->options.wrap);
        CHECK(around.can_decide() && around.can_decide(other.data()));
        if (meets && around.touches(other.data(), false)) expected.push_back(a | u64(b) << 32);
      }
    }
    CHECK(found == expected);
  }
};

template <int D> void check_pairs_between() {
  u32 failures = 0;
  for (u32 round = 0; round < 30; round++) {
    testing::Where where("round " + std::to_string(round));
    Random random(40 + round);
    Side<D> few, many;
    PairsBetween<D> pairs(few, many);
    for (Side<D>* side : {&few, &many}) {
      side->instance->options.touching = side->model.touching = round % 3 > 0;
      for (u32 a = 0; a < D && round % 5 > 2; a++) side->instance->options.wrap[a] = 20.1 + 3 * a;
    }
    for (u32 frame = 0; frame < 40; frame++) {
      for (Side<D>* side : {&few, &many}) {
        for (u32 n = frame == 0 ? 60 : random.below(4) * random.below(5); n > 0; n--) side->change(random);
        side->update();
      }
      const u64 limit = heap::limit;
      if (round % 2) heap::limit = heap::used + random.below(1 << 14);
      bool failed = false;
      try {
        pairs.bring();
      } catch (const Failure&) {
        failed = true;
        failures++;
      }
      heap::limit = limit;
      if (failed) {
        pairs.running->space.recover();
        pairs.bring();
      }
      pairs.check();
    }
  }
  CHECK(failures > 10);
}
