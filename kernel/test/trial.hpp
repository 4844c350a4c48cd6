// A space and its model, on which the same calls are made. After each call they must agree on ids and numbers, after
// each update on the pairs. A call that fails for lack of memory must have changed nothing.
#pragma once
#include <optional>

#include "bytes.hpp"
#include "check.hpp"

template <int D> struct Trial {
  static constexpr u32 most_boxes = 450;  // the model tests all against all
  static constexpr u32 crowded = 12'000;   // pairs
  static constexpr u32 most_crowds = 2;  // updates in a crowd are slow, and each further one finds little more

  Bytes& bytes;
  std::unique_ptr<Instance<D>> instance;
  Ids& ids;
  Space<D>& space;
  Model<D> model;
  PairList before;           // the pairs of the last update
  bool unsure = false;
  bool found = false;        // whether the space still has them: not after memory ran out
  std::optional<Model<D>> seen;  // what the last update saw, and queries see
  bool updated = false, was_asked = false;
  u32 crowds = 0;
  bool starved = false;  // the next call has little memory

  Trial(Bytes& given, Technique first)
      : bytes(given), instance(open<D>(first)), ids(instance->ids), space(instance->space) {}

  bool wraps() const { return instance->options.wrap[0] > 0; }

  /// The expected pairs. In a world that wraps around, they are those that a new space finds; tests with whole numbers
  /// show that these are right.
  PairList expected() {
    if (!wraps()) return model.pairs();
    auto fresh = open<D>(Technique::brute_force);
    fresh->options = instance->options;
    for (u32 id : model.ids()) {
      ::set(fresh->space, id, model.at(id).data());
      const Rule& rule = model.rule(id);
      fresh->space.store.filter(fresh->ids.slot(id), rule.layer, rule.mask);
      for (u32 bit : {u32(is_static), u32(is_red), u32(is_blue)}) {
        fresh->space.store.exclude(fresh->ids.slot(id), bit, rule.excluded & bit);
      }
      fresh->space.store.enable(fresh->ids.slot(id), !rule.is_off());
      fresh->space.store.put_in_group(fresh->ids.slot(id), model.group(id));
      fresh->space.store.set_reach(fresh->ids.slot(id), model.reach(id));
    }
    CHECK(fresh->space.update() == -1);
    return sorted_pairs(fresh->space);
  }

  /// Makes a call; returns whether there was memory for it. `recover` is what abi.cpp does after a trap. If memory ran
  /// out, `unmade` checks that nothing has changed.
  template <class Call> bool made(Call call) {
    return made(call, [&] { compare(); });
  }

  template <class Call, class Unmade> bool made(Call call, Unmade unmade) {
    const u64 limit = heap::limit;
    if (starved) heap::limit = heap::used + 64 * u64(bytes.next());
    bool ended = false;
    try {
      call();
    } catch (const Failure& failure) {
      ended = true;
      CHECK(failure.what == Fault::out_of_memory && failure.bytes > 0);
    }
    CHECK(!ended || starved);
    heap::limit = limit;
    starved = false;
    if (!ended) return true;
    space.recover();
    found = false;
    unsure = true;  // whether queries see what this update saw, or what the one before did
    unmade();
    return false;
  }

  void compare() {
    u32 detail;
    CHECK(space.validate(detail) == Broken::nothing);
    CHECK(ids.count() == model.count());
    bool same = true;
    for (u32 id : model.ids()) {
      Box<D> held;
      same &= space.store.get(id, held.data()) && held == model.at(id);
      same &= space.store.own.groups.of(ids.slot(id)) == model.group(id);
      same &= space.store.own.reaches.of(ids.slot(id)) == model.reach(id);
    }
    CHECK(same);
    u32 other = id();
    CHECK((ids.slot(other) != Ids::none) == model.has(other));
  }

  void update(bool whole = true) {
    if (!made([&] { CHECK(space.update() == -1); })) return;
    CHECK(space.stats.pairs == f64(space.pairs.count));
    CHECK(space.stats.candidates >= space.stats.pairs);
    CHECK(space.stats.bytes == f64(heap::used));
    if (whole || space.store.keeps_events) {
      PairList now = sorted_pairs(space);
      if (whole) CHECK(now == expected());
      if (space.store.keeps_events) check_events(now);
      before = now;
    }
    updated = found = true;
    model.updated();
    seen = model;
    unsure = false;
    if (space.pairs.count > crowded && ++crowds > most_crowds) clear();
  }

  /// Makes a query; returns whether there was memory for it.
  template <class Ask> bool asked(Ask ask) {
    // A large space that was never queried may have no copy of what the last update saw.
    if (!was_asked && ids.count() > 4000) update();
    // An update may run out of memory, but only once. A change that there was hardly memory for made no copy either.
    while (unsure || space.store.seen.lost()) update();
    was_asked = true;
    bool done = made(ask);
    if (!done) {
      update();
      ask();
    }
    return done;
  }

  u32 id() {
    u8 kind = bytes.next();
    if (kind < 200) return kind % 100;
    if (kind < 230) return bytes.next16();
    if (kind < 250) return model.count() % max_slots;
    return (max_slots - 1 - bytes.next()) % max_slots;
  }

  u32 someone() {
    std::vector<u32> all = model.ids();
    return all[bytes.next16() % all.size()];
  }

  void clear() {
    space.store.clear();
    model.clear();
  }

 private:
  void check_events(const PairList& now) {
    CHECK(sorted(space.store.events.began) == without(now, before));
    CHECK(sorted(space.store.events.ended) == without(before, now));
  }

  /// The pairs in one list that are not in the other; a pair with a box deleted in between counts as a different one.
  PairList without(const PairList& list, PairList others) const {
    std::erase_if(others, [&](u64 pair) { return model.is_gone(pair); });
    PairList rest;
    std::set_difference(list.begin(), list.end(), others.begin(), others.end(), std::back_inserter(rest));
    return rest;
  }

  static PairList sorted(const Pairs& pairs) {
    PairList list(pairs.list.data(), pairs.list.data() + pairs.count);
    std::sort(list.begin(), list.end());
    return list;
  }
};
