// Spaces with every technique, in one dimension: their pairs are the model's, on scenes and over sequences of calls.
#pragma once
#include "calls.hpp"
#include "corpus.hpp"
#include "pairs_between.hpp"

/// Calls `what(technique)` for every technique; messages name it by its number.
template <class What> void each_technique(What what) {
  for (u32 t = 0; t < technique_count; t++) {
    testing::Where where("technique " + std::to_string(t));
    what(Technique(t));
  }
}

template <int D> PairList pairs_of(const Boxes<D>& boxes) {
  Model<D> model;
  model.replace(boxes);
  return model.pairs();
}

/// Updates and compares, also with nothing changed in between.
template <int D> void check_pairs(Space<D>& space, const PairList& expected) {
  CHECK(space.update() == -1);
  CHECK(sorted_pairs(space) == expected);
  CHECK(space.update() == -1);
  CHECK(sorted_pairs(space) == expected);
  u32 detail;
  CHECK(space.validate(detail) == Broken::nothing);
  space.structure();
}

template <int D> void check_scenes() {
  for (const auto& scene : scenes<D>()) {
    testing::Where where(scene.name);
    Boxes<D> floats = as_floats<D>(scene.boxes);
    PairList expected = pairs_of<D>(scene.boxes), expected_of_floats = pairs_of<D>(floats);
    each_technique([&](Technique technique) {
      auto instance = open<D>(technique);
      CHECK(replace(instance->space, scene.boxes, true) == -1);
      check_pairs(instance->space, expected);
      CHECK(replace(instance->space, floats, false) == -1);
      check_pairs(instance->space, expected_of_floats);
    });
  }
}

/// Fresh arrays of every size, then of a smaller one: the sanitizer sees reads and writes past their ends.
template <int D> void check_every_count() {
  Random random(9);
  for (u32 count = 0; count < 180; count += count < 40 ? 1 : 7) {
    Boxes<D> boxes = spread<D>(random, count, 0, 50, 10);
    Boxes<D> fewer(boxes.begin(), boxes.begin() + count / 4);
    PairList expected = pairs_of<D>(boxes), expected_of_fewer = pairs_of<D>(fewer);
    each_technique([&](Technique technique) {
      auto instance = open<D>(technique);
      replace(instance->space, boxes, true);
      check_pairs(instance->space, expected);
      replace(instance->space, fewer, true);
      check_pairs(instance->space, expected_of_fewer);
    });
  }
}

/// With cells far too small, far too large, and with different sides; with bounds around everything, around nothing,
/// and beyond float32.
template <int D> void check_settings() {
  Random random(10);
  Boxes<D> boxes = spread<D>(random, 150, -30, 30, 5);
  boxes.push_back(cube<D>(-1e30, 1e30));
  boxes.push_back(cube<D>(-std::numeric_limits<f64>::infinity(), 0));
  PairList expected = pairs_of<D>(boxes);
  auto check = [&](f64 size, f64 stretch, f64 low, f64 high) {
    using std::to_string;
    testing::Where where("cells of " + to_string(size) + " from " + to_string(low) + " to " + to_string(high));
    each_technique([&](Technique technique) {
      auto instance = open<D>(technique);
      for (u32 a = 0; a < D; a++) {
        instance->options.cell_size[a] = size * std::pow(stretch, a);
        instance->options.bounds[a] = low;
        instance->options.bounds[D + a] = high;
      }
      replace(instance->space, boxes, true);
      check_pairs(instance->space, expected);
    });
  };
  for (f64 size : {1e-300, 1e-9, 0.3, 7.0, 1e9, 1e300}) check(size, 1, 0, 0);
  for (f64 stretch : {0.1, 3.0}) check(7, stretch, -30, 30);
  check(0, 1, -30, 30);
  check(0, 1, 5, 6);
  check(2, 1, 5, 6);
  check(0, 1, -1e9, 1e9);
  check(0, 1, 0, 1e-300);
  check(1e-30, 1, 0, 1e-300);
  check(0, 1, -1.7e308, 1.7e308);
  check(1e300, 1, -1.7e308, 1.7e308);
  check(0, 1, 1e300, 1.1e300);
}

template <int D> void check_calls() {
  Random random(15);
  for (u32 round = 0; round < 40; round++) {
    testing::Where where("round " + std::to_string(round));
    std::vector<u8> data(2000);
    for (auto& byte : data) byte = u8(random.bits64());
    Bytes bytes(data.data(), data.size());
    Calls<D>(bytes, Technique(round % technique_count)).run();
  }
}

/// Long runs of updates in which little changes, of every kind, for techniques that retain what they find.
template <int D> void check_spells() {
  u8 seed = 0;
  for (Technique technique : {Technique::incremental, Technique::automatic, Technique::aabb_tree}) {
    for (u8 how = 0; how < 32; how += 2) {
      testing::Where where("technique " + std::to_string(u32(technique)) + ", spell " + std::to_string(how));
      u8 events = how & 4 ? 16 : 0, margin = how % 16 == 6 ? 4 : 0, speed = u8(seed % 8 << 5);
      // The options of the space, then twice: a run of updates, a comparison, the technique again.
      std::vector<u8> data = {u8(events | margin)};
      if (margin) data.push_back(seed);
      for (u8 kind : {how, u8(how + 1)}) {
        u8 call[] = {31, ++seed, 0, u8(kind | speed), 40, 19, 18, u8(technique)};
        data.insert(data.end(), std::begin(call), std::end(call));
      }
      Bytes bytes(data.data(), data.size());
      Calls<D>(bytes, technique).run();
    }
  }
}

/// The sequences that the fuzzer found worth keeping, and those that once failed.
template <int D> void check_corpus() {
  CHECK(!corpus().empty());
  for (size_t k = 0; k < corpus().size(); k++) {
    testing::Where where("sequence " + std::to_string(k));
    Bytes bytes(corpus()[k].data(), corpus()[k].size());
    Beginning beginning(bytes.next());
    if (beginning.dimensions == D) Calls<D>(bytes, beginning.technique).run();
  }
}

/// From any scene to any other in one space: with one technique, and with a different one each time.
template <int D> void check_switches() {
  Random random(11);
  const auto& all = scenes<D>();
  std::vector<PairList> expected;
  for (const auto& scene : all) expected.push_back(pairs_of<D>(scene.boxes));
  auto go = [&](Space<D>& space) {
    u32 n = random.below(u32(all.size()));
    testing::Where where(all[n].name);
    replace(space, all[n].boxes, true);
    space.update();
    CHECK(sorted_pairs(space) == expected[n]);
  };
  auto any = open<D>(Technique::automatic);
  each_technique([&](Technique technique) {
    auto one = open<D>(technique);
    for (u32 k = 0; k < 40; k++) go(one->space);
    for (u32 k = 0; k < 10; k++) {
      any->space.technique = Technique(random.below(technique_count));
      go(any->space);
    }
  });
}

/// The order of the pairs follows from the boxes in the space, not from earlier updates: a space that had other boxes,
/// with few and with many changes in between, gives the same order as a fresh one.
template <int D> void check_history() {
  Random random(16);
  Boxes<D> boxes = spread<D>(random, 400, 0, 60, 8);
  for (auto& box : spread<D>(random, 200, 0, 12, 0)) {  // many with equal minima
    for (u32 a = 0; a < D; a++) box[a] = box[D + a] = std::floor(box[a]);
    boxes.push_back(box);
  }
  each_technique([&](Technique technique) {
    auto old = open<D>(technique);
    Boxes<D> now = boxes;
    for (u32 frame = 0; frame < 60; frame++) {
      testing::Where where("frame " + std::to_string(frame));
      u32 moving = frame % 20 == 0 ? u32(now.size()) : frame % 5 == 0 ? 0 : 20;
      for (u32 k = 0; k < moving; k++) {
        Box<D>& box = now[random.below(u32(now.size()))];
        for (u32 a = 0; a < D; a++) {
          f64 by = frame % 7 == 0 ? 30 - f64(random.below(60)) : (f64(random.below(9)) - 4) / 4;
          box[a] += by;
          box[D + a] += by;
        }
      }
      if (frame % 11 == 10) now.resize(now.size() - 40);
      if (frame % 13 == 12) now.insert(now.end(), boxes.begin(), boxes.begin() + 50);
      auto fresh = open<D>(technique);
      for (auto* space : {&old->space, &fresh->space}) {
        replace(*space, now, true);
        if (technique >= Technique::incremental)
          CHECK(space->save() == -1);  // for these, that holds only from a snapshot on
        space->update();
      }
      const u64 *one = old->space.pairs.list.data(), *other = fresh->space.pairs.list.data();
      CHECK(old->space.pairs.count == fresh->space.pairs.count);
      CHECK(std::equal(one, one + old->space.pairs.count, other));
    }
  });
}

/// The order of the pairs follows from the calls alone.
template <int D> void check_order() {
  each_technique([&](Technique technique) {
    auto one = open<D>(technique), other = open<D>(technique);
    for (const auto& scene : scenes<D>()) {
      testing::Where where(scene.name);
      for (auto* space : {&one->space, &other->space}) {
        replace(*space, scene.boxes, true);
        space->store.remove(3);
        space->update();
      }
      const u64 *first = one->space.pairs.list.data(), *second = other->space.pairs.list.data();
      CHECK(one->space.pairs.count == other->space.pairs.count);
      CHECK(std::equal(first, first + one->space.pairs.count, second));
    }
  });
}

template <int D> void check_rounding() {
  Random random(12);
  auto instance = open<D>(Technique::automatic);
  Space<D>& space = instance->space;
  const f64 infinity = std::numeric_limits<f64>::infinity();
  const f64 special[] = {0.0,      -0.0,       1,           0.1,          -0.1,        1e-46,   -1e-46,   5e-324,
                         -5e-324,  1e39,       -1e39,       3.4028235e38, 1e308,       -1e308,  infinity, -infinity,
                         0x1p-149, 0x1.8p-149, -0x1.8p-149, 1 + 0x1p-24,  1 - 0x1p-25, 16777217};
  for (u32 k = 0; k < 5000; k++) {
    f64 x = k < std::size(special) ? special[k] : bits<f64>(random.bits64());
    if (x != x) continue;
    Box<D> box = cube<D>(x, x), held;
    set(space, 3, box.data());
    CHECK(space.store.get(3, held.data()));
    CHECK(held == box);
    u32 detail;
    CHECK(space.validate(detail) == Broken::nothing);
    f32* floats = space.store.expose(4) + 3 * 2 * D;
    for (u32 n = 0; n < 2 * D; n++) CHECK(bits<u32>(floats[n]) == bits<u32>(f32(x)));
  }
  for (u32 k = 0; k < 1000; k++) {
    Box<D> box;  // no two numbers are equal
    for (u32 n = 0; n < 2 * D; n++) box[n] = f32(n) + (random.bits64() % 3 ? 0 : random.fraction() / 2);
    set(space, 3, box.data());
    f32* floats = space.store.expose(4) + 3 * 2 * D;
    for (u32 n = 0; n < 2 * D; n++) CHECK(floats[n] == f32(box[n]));
  }
}

/// Bad boxes written in place are named correctly, even if they have moved to another slot since.
template <int D> void check_exposed() {
  auto instance = open<D>(Technique::automatic);
  Space<D>& space = instance->space;
  u32 detail;
  f32* boxes = space.store.expose(5);
  for (u32 k = 0; k < 5 * 2 * D; k++) CHECK(boxes[k] == 0);
  CHECK(space.update() == -1);
  CHECK(space.pairs.count == 10);
  boxes[4 * 2 * D + 1] = std::nanf("");
  CHECK(space.update() == 4);
  CHECK(space.pairs.count == 10);
  CHECK(space.validate(detail) == Broken::nothing);

  CHECK(space.store.remove(1));  // box 4 moves to the slot of box 1
  CHECK(space.update() == 4);

  Box<D> rounded = cube<D>(0.1, 0.1);
  set(space, 2, rounded.data());
  CHECK(space.update() == 4);
  CHECK(space.validate(detail) == Broken::nothing);

  Box<D> good = cube<D>(0, 0);
  set(space, 4, good.data());
  CHECK(space.update() == -1);
  CHECK(space.pairs.count == 3);
  CHECK(space.validate(detail) == Broken::nothing);
}

template <int D> void check_bad_boxes() {
  auto instance = open<D>(Technique::automatic);
  Space<D>& space = instance->space;
  Boxes<D> boxes(6, cube<D>(0, 1));
  replace(space, boxes, true);
  space.update();
  Boxes<D> bad = boxes;
  bad[3][1] = 2;
  bad[5][D] = std::nan("");
  for (bool doubles : {false, true}) {
    CHECK(replace(space, bad, doubles) == 3);
    Numbers<D>& numbers = space.store.numbers;  // the bad box is still staged
    auto staged = [&](u32 k) {
      return doubles ? numbers.stage_exact(6)[3 * 2 * D + k] : numbers.stage(6)[3 * 2 * D + k];
    };
    CHECK(staged(0) == 0 && staged(1) == 2);
    bad[3][1] = 0.1;
    CHECK(replace(space, bad, doubles) == 5);
    bad[3][1] = 2;
  }
  Box<D> held;
  CHECK(space.store.get(3, held.data()) && held == boxes[3]);
  CHECK(!space.store.get(6, held.data()));
  CHECK(space.pairs.count == 15);
}

template <int D> void check_colours() {
  Random random(13);
  Boxes<D> boxes = spread<D>(random, 500, 0, 60, 10);
  Model<D> model;
  model.replace(boxes);
  for (u32 id = 0; id < 500; id++) {
    model.exclude(id, id < 200 ? is_red : is_blue, true);
    if (id % 3 == 0) model.exclude(id, is_static, true);
  }
  PairList expected = model.pairs();
  CHECK(!expected.empty());
  each_technique([&](Technique technique) {
    auto instance = open<D>(technique);
    replace(instance->space, boxes, true);
    for (u32 id = 0; id < 500; id++) {
      instance->space.store.exclude(id, id < 200 ? is_red : is_blue, true);
      if (id % 3 == 0) instance->space.store.exclude(id, is_static, true);
    }
    check_pairs(instance->space, expected);
  });
}

/// Strips with too many boxes are cut again, deeper and deeper.
template <int D> void check_deep_cuts() {
  Random random(14);
  Boxes<D> boxes;
  for (f64 scale : {1e6, 1e4, 1e2, 1.0}) {
    Boxes<D> part = spread<D>(random, 800, 0, scale, scale * 0.02);
    boxes.insert(boxes.end(), part.begin(), part.end());
  }
  PairList expected = pairs_of<D>(boxes);
  each_technique([&](Technique technique) {
    auto instance = open<D>(technique);
    replace(instance->space, boxes, true);
    check_pairs(instance->space, expected);
  });
}

/// The sample of a frame has usable numbers.
template <int D> void check_statistics_of(const Boxes<D>& boxes) {
  std::vector<f32> floats;
  for (const auto& box : boxes) {
    for (u32 k = 0; k < 2 * D; k++) floats.push_back(outward(box[k], k >= D));
  }
  floats.resize(floats.size() + 4);
  Scene<D> scene{floats.data(), u32(boxes.size()), nullptr};
  SceneSample<D> world = measure<D>(SceneItems<D>{scene, AxisOrder<D>::make(0)}, scene.count);
  for (int a = 0; a < D; a++) {
    CHECK(std::isfinite(world.low[a]) && std::isfinite(world.high[a]));
    CHECK(world.low[a] <= world.high[a]);
    CHECK(world.size[a] >= 0 && world.size[a] <= (world.high[a] - world.low[a]) * (1 + 1e-12));
  }
  CHECK(world.crowding >= 1 && std::isfinite(world.crowding));
}

template <int D> void check_statistics() {
  for (const auto& scene : scenes<D>()) {
    testing::Where where(scene.name);
    if (!scene.boxes.empty()) check_statistics_of<D>(scene.boxes);
  }
}

template <int D> void list_space_tests() {
  testing::list({
      {"spaces find the pairs of all scenes", D, check_scenes<D>},
      {"spaces find the pairs of any number of boxes", D, check_every_count<D>},
      {"spaces find the pairs whatever the cell size and the bounds", D, check_settings<D>},
      {"spaces find the pairs of scenes that need deep cuts", D, check_deep_cuts<D>},
      {"spaces go from any scene and technique to any other", D, check_switches<D>},
      {"spaces give the pairs in an order that follows from the calls", D, check_order<D>},
      {"spaces give the pairs in the same order whatever was there before", D, check_history<D>},
      {"spaces follow random calls", D, check_calls<D>},
      {"spaces follow long spells in which little changes", D, check_spells<D>},
      {"spaces follow the fuzzer's calls", D, check_corpus<D>},
      {"spaces keep the numbers they were given", D, check_rounding<D>},
      {"spaces name bad boxes written in place", D, check_exposed<D>},
      {"spaces refuse bad boxes and stay as they were", D, check_bad_boxes<D>},
      {"spaces find the pairs with another space", D, check_pairs_between<D>},
      {"spaces leave out pairs that share an exclusion bit", D, check_colours<D>},
      {"statistics are finite whatever the boxes", D, check_statistics<D>},
  });
}
