// Memory that runs out in the middle of a call: the failure is reported, nothing is half changed, and the space works
// again.
#pragma once
#include "calls.hpp"

/// Makes `call` with more and more memory until it succeeds; after each failure `unchanged` must hold.
/// Returns the number of failures.
template <int D, class Call, class Unchanged> u32 starve(Space<D>& space, Call call, Unchanged unchanged) {
  const u64 limit = heap::limit;
  u32 failures = 0;
  for (u64 room = 0;; room += 1 + room / 8) {
    bool failed = false;
    heap::limit = heap::used + room;
    try {
      call();
    } catch (const Failure& failure) {
      failed = failure.what == Fault::out_of_memory && failure.bytes > 0;
    }
    heap::limit = limit;
    if (!failed) return failures;
    failures++;
    space.recover();
    unchanged();
  }
}

template <int D> struct Fixture {
  std::unique_ptr<Instance<D>> instance = open<D>(Technique::automatic);
  Space<D>& space = instance->space;
  Model<D> model;

  void unchanged() {
    boxes_unchanged();
    CHECK(space.pairs.count == 0);
  }
  void boxes_unchanged() {
    u32 detail;
    bool same = space.validate(detail) == Broken::nothing && instance->ids.count() == model.count();
    for (u32 id : model.ids()) {
      Box<D> held;
      same &= space.store.get(id, held.data()) && held == model.at(id);
    }
    CHECK(same);
  }
  void works() {
    CHECK(space.update() == -1);
    CHECK(sorted_pairs(space) == model.pairs());
  }
};

template <int D> void check_changes() {
  Random random(21);
  Boxes<D> doubles = spread<D>(random, 300, 0, 40, 6), floats = as_floats<D>(doubles);
  // Dense ids or gaps, floats or doubles, exclusion bits or none.
  for (u32 state = 0; state < 8; state++) {
    testing::Where where("state " + std::to_string(state));
    auto fresh = [&] {
      auto fixture = std::make_unique<Fixture<D>>();
      for (u32 k = 0; k < 40; k++) {
        const Box<D>& box = state & 2 ? doubles[k] : floats[k];
        u32 id = state & 1 ? k * 700 : k;
        set(fixture->space, id, box.data());
        fixture->model.set(id, box);
      }
      if (state & 4) {
        for (u32 id : fixture->model.ids()) {
          if (id % 3) continue;
          fixture->space.store.exclude(fixture->instance->ids.slot(id), is_static, true);
          fixture->model.exclude(id, is_static, true);
        }
      }
      return fixture;
    };
    auto change = [&](auto call, auto on_model) {
      auto fixture = fresh();
      Fixture<D>& f = *fixture;
      u32 failures = starve(f.space, [&] { call(f); }, [&] { f.unchanged(); });
      on_model(f.model);
      f.works();
      return failures;
    };

    // set: one id after another, until every array has grown.
    auto fixture = fresh();
    u32 failures = 0;
    for (u32 k = 40; k < 300; k++) {
      u32 id = state & 1 ? k * 700 : k;
      failures += starve(
          fixture->space, [&] { set(fixture->space, id, doubles[k].data()); }, [&] { fixture->unchanged(); });
      fixture->model.set(id, doubles[k]);
    }
    fixture->works();
    CHECK(failures > 20);

    change([&](auto& f) { CHECK(f.space.store.remove(f.model.ids()[7])); },
           [&](auto& model) { model.remove(model.ids()[7]); });
    change([&](auto& f) { f.space.store.reserve(5000); }, [](auto&) {});
    CHECK(change([&](auto& f) { f.space.store.expose(250); }, [](auto& model) { model.expose(250); }) > 0);
    change([&](auto& f) { f.space.store.expose(10); }, [](auto& model) { model.expose(10); });
    CHECK(change([&](auto& f) { replace(f.space, doubles, true); }, [&](auto& model) { model.replace(doubles); }) > 0);
    CHECK(change([&](auto& f) { replace(f.space, floats, false); }, [&](auto& model) { model.replace(floats); }) > 0);
    change([&](auto& f) { f.space.store.exclude(0, is_blue, true); },
           [](auto& model) { model.exclude(0, is_blue, true); });
  }
}

template <int D> void check_updates() {
  Random random(22);
  Boxes<D> boxes = spread<D>(random, 1200, 0, 100, 8);
  for (u32 t = 0; t < technique_count; t++) {
    testing::Where where("technique " + std::to_string(t));
    Fixture<D> f;
    f.space.technique = Technique(t);
    replace(f.space, boxes, true);
    f.model.replace(boxes);
    CHECK(starve(f.space, [&] { CHECK(f.space.update() == -1); }, [&] { f.unchanged(); }) > 10);
    f.works();
    // Calls other than update leave the pairs of the last one.
    PairList pairs = sorted_pairs(f.space);
    starve(
        f.space, [&] { f.space.structure(); },
        [&] {
          f.boxes_unchanged();
          CHECK(sorted_pairs(f.space) == pairs);
        });
  }
}

/// A few boxes creep, appear, wake and jump, update after update, until techniques retain what they find. Then memory
/// runs out in one update: when they begin to retain, while they fill their lists, and when they answer from these.
template <int D> void check_kept_updates() {
  Random random(23);
  const Boxes<D> boxes = as_floats<D>(spread<D>(random, 400, 0, D == 2 ? 200 : 60, 8));
  u32 failures = 0;
  auto change = [](Fixture<D>& f, u32 k, bool much) {
    for (u32 id = 0; id < (much ? 60u : 12u); id++) {
      Box<D> box = f.model.at(id);
      for (u32 n = 0; n < 2 * D; n++) box[n] += (id % 2 ? 0.125 : -0.125) * (k / 30 % 2 ? 1 : -1);
      set(f.space, id, box.data());
      f.model.set(id, box);
    }
    if (!much) return;
    Box<D> other = f.model.at(77);
    for (u32 id : {f.model.count(), 99u}) {
      set(f.space, id, other.data());
      f.model.set(id, other);
    }
  };
  for (Technique technique :
       {Technique::incremental, Technique::automatic, Technique::aabb_tree, Technique::retained_grid}) {
    testing::Where where("technique " + std::to_string(u32(technique)));
    for (u32 last : {1u, 2u, 3u, 40u, 93u, 98u, 130u}) {
      for (u32 room : {0u, 100u, 1000u, 10'000u}) {
        testing::Where where("update " + std::to_string(last) + " with " + std::to_string(room) + " bytes left");
        Fixture<D> f;
        f.space.technique = technique;
        replace(f.space, boxes, false);
        f.model.replace(boxes);
        for (u32 k = 0; k < last; k++) {
          change(f, k, false);
          f.space.update();
        }
        change(f, last, true);
        const u64 limit = heap::limit;
        heap::limit = heap::used + room;
        bool failed = false;
        try {
          f.space.update();
        } catch (const Failure&) {
          failed = true;
        }
        heap::limit = limit;
        if (failed) {
          failures++;
          f.space.recover();
          f.unchanged();
        }
        f.works();
        for (u32 k = 0; k < 3; k++) change(f, k, true);
        f.works();
      }
    }
  }
  CHECK(failures > 40);
}

/// With no memory left, what would be copied for queries is given up, and the change is made.
template <int D> void check_given_up_copies() {
  Random random(26);
  const Boxes<D> boxes = spread<D>(random, 300, 0, 100, 8);
  for (u32 call = 0; call < 4; call++) {
    testing::Where where("call " + std::to_string(call));
    Fixture<D> f;
    replace(f.space, boxes, true);
    f.model.replace(boxes);
    f.works();
    f.space.store.seen.ask();
    const u64 limit = heap::limit;
    heap::limit = heap::used;
    if (call == 0) {
      set(f.space, 5, boxes[6].data());
      f.model.set(5, boxes[6]);
    } else if (call == 1) {
      CHECK(f.space.store.remove(299));
      f.model.remove(299);
    } else if (call == 2) {
      f.space.store.expose(0);
      f.model.expose(0);
    } else {
      f.space.store.clear();
      f.model.expose(0);
    }
    heap::limit = limit;
    CHECK(f.space.store.seen.lost());
    f.boxes_unchanged();
    f.works();
    CHECK(!f.space.store.seen.lost());
  }
}

/// All boxes that may wait in the ring can be taken with no memory left but what is kept for that: old and new ones, with
/// dense ids or gaps, in slots that are in order or not, with settings or without, floats or the first doubles.
template <int D> void check_waiting() {
  Random random(27);
  const Boxes<D> boxes = spread<D>(random, 3200, 0, 900, 8), floats = as_floats<D>(boxes);
  for (u32 state = 0; state < 16; state++) {
    testing::Where where("state " + std::to_string(state));
    const bool gaps = state & 1, settings = state & 4, doubles = state & 8;
    auto name = [&](u32 k) { return gaps ? 2 * k + 1 : k; };
    Fixture<D> f;
    for (u32 k = 0; k < 1200; k++) {
      set(f.space, name(k), floats[k].data());
      f.model.set(name(k), floats[k]);
    }
    if (settings) f.space.store.exclude(3, is_static, true), f.model.exclude(name(3), is_static, true);
    if (settings) f.space.store.set_reach(4, 0), f.space.store.put_in_group(5, 9), f.space.store.put_in_group(5, 0);
    if (state & 2) CHECK(f.space.store.remove(name(gaps ? 8 : 1199))), f.model.remove(name(gaps ? 8 : 1199));
    auto ring = std::make_unique<Ring<D>>();
    ring->place(nullptr);
    for (u32 k = 0; k < 60; k++) f.works();
    f.space.store.take(*ring, 0);
    u32 known = gaps ? 1200 : u32(ring->dense), room = u32(gaps ? ring->usable : ring->room);
    CHECK(gaps == (ring->pages > 0) && room > 0);
    u32 count = smaller(u32(ring->usable), room + 100);
    if (gaps) count = smaller(count, 2048 - (known - 100));  // the table of ids from 4096 on does not exist yet
    const u64 limit = heap::limit;
    heap::limit = heap::used + heap::kept;
    for (u32 k = 0; k < count; k++) {
      u32 number = known - 100 + k;
      const Box<D>& box = doubles ? boxes[number] : floats[number];
      f64* entry = ring->first() + k * Ring<D>::step;
      entry[0] = name(number);
      std::copy(box.begin(), box.end(), entry + 1);
      f.model.set(name(number), box);
    }
    f.space.store.take(*ring, count);
    heap::limit = limit;
    f.boxes_unchanged();
    f.works();
  }
}

/// An update that was cut off, as by the end of the stack, and nobody recovered: the next one finds all pairs.
template <int D> void check_cut_off() {
  Random random(28);
  const Boxes<D> boxes = spread<D>(random, 400, 0, D == 2 ? 200 : 60, 8);
  u32 failures = 0;
  for (u32 t = 0; t < technique_count; t++) {
    testing::Where where("technique " + std::to_string(t));
    for (u64 room = 64; room < 1 << 17; room *= 2) {
      Fixture<D> f;
      f.space.technique = Technique(t);
      replace(f.space, boxes, true);
      f.model.replace(boxes);
      const u64 limit = heap::limit;
      heap::limit = heap::used + room;
      try {
        f.space.update();
      } catch (const Failure&) {
        failures++;
      }
      heap::limit = limit;
      f.works();
    }
  }
  CHECK(failures > 4 * technique_count);
}

/// More pairs than there is memory for, then fewer boxes in the same memory.
template <int D> void check_too_many_pairs() {
  for (u32 t = 0; t < technique_count; t++) {
    testing::Where where("technique " + std::to_string(t));
    Fixture<D> f;
    f.space.technique = Technique(t);
    Boxes<D> boxes(3000, cube<D>(0, 1));
    replace(f.space, boxes, false);
    f.model.replace(boxes);
    const u64 limit = heap::limit;
    heap::limit = heap::used + (4 << 20);
    for (u32 k = 0; k < 3; k++) {
      bool failed = false;
      try {
        f.space.update();
      } catch (const Failure&) {
        failed = true;
        f.space.recover();
      }
      CHECK(failed);
      f.unchanged();
    }
    for (u32 id = 0; id < 3000; id++) {
      if (id % 10 == 0) continue;
      CHECK(f.space.store.remove(id));
      f.model.remove(id);
    }
    f.works();
    CHECK(f.space.pairs.count == 300 * 299 / 2);
    heap::limit = limit;
  }
}

/// A huge box that moves among many at rest: room for all boxes that it may meet is reserved first, so that
/// lists are copied to a larger place at most once after they were made.
template <int D> void check_huge_mover() {
  Random random(24);
  const u32 count = 20'000;
  const f64 world = D == 2 ? 5800 : 750, side = world / 2;
  Boxes<D> boxes = as_floats<D>(spread<D>(random, count, 0, world, 10));
  auto instance = open<D>(Technique::automatic);
  Space<D>& space = instance->space;
  u32 copies = 0;
  for (u32 k = 0; k < 90; k++) {
    Box<D>& huge = boxes[0];
    for (u32 a = 0; a < D; a++) {
      huge[a] = f32((world - side) * k / 90);
      huge[D + a] = f32(huge[a] + side);
    }
    if (k == 0) replace(space, boxes, false);
    else set(space, 0, huge.data());
    heap::copied = 0;
    CHECK(space.update() == -1);
    copies += k > 10 && heap::copied >= 1024;
  }
  CHECK(space.stats.reason == f64(u32(Reason::kept)));
  CHECK(copies <= 1);
}

/// A crowded world at rest, of which few move: once its pairs are settled, their list is not copied to a larger place.
template <int D> void check_settled_room() {
  Random random(25);
  const u32 count = 6000;
  const f64 world = D == 2 ? 390 : 115;
  Boxes<D> boxes = as_floats<D>(spread<D>(random, count, 0, world, 10));
  auto instance = open<D>(Technique::automatic);
  Space<D>& space = instance->space;
  replace(space, boxes, false);
  u64 most = 0;
  for (u32 k = 0; k < 230; k++) {
    for (u32 id = 0; id < count; id += 20) {
      boxes[id][0] += 0.05f;
      boxes[id][D] += 0.05f;
      set(space, id, boxes[id].data());
    }
    heap::copied = 0;
    CHECK(space.update() == -1);
    if (k > 60) most = larger(most, heap::copied);
  }
  CHECK(space.stats.reason == f64(u32(Reason::kept)));
  CHECK(most < 1024);
}

template <int D> void list_memory_tests() {
  testing::list({
      {"memory that ends in a change leaves all as it was", D, check_changes<D>},
      {"memory that ends in an update ends it with no pairs", D, check_updates<D>},
      {"memory that ends in an update of techniques that keep things ends it with no pairs", D, check_kept_updates<D>},
      {"with no memory left, queries lose their copy and changes are made", D, check_given_up_copies<D>},
      {"with no memory left, what may wait in the ring can be taken", D, check_waiting<D>},
      {"an update that was cut off is followed by a whole one", D, check_cut_off<D>},
      {"memory suffices again with fewer boxes", D, check_too_many_pairs<D>},
      {"memory for what a huge box may meet is there before it is met", D, check_huge_mover<D>},
      {"memory for settled pairs is there once they are settled", D, check_settled_room<D>},
  });
}
