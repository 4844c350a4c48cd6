// What a sample tells of how boxes move, and the margin chosen from it: watch.hpp.
#include "coherence/watch.hpp"

#include <cmath>
#include <vector>

#include "check.hpp"
#include "random.hpp"

namespace {

template <int D> struct World {
  static constexpr u32 count = 60;
  std::vector<f32> boxes = std::vector<f32>(count * 2 * D + 4);
  std::vector<f64> velocities = std::vector<f64>(count * D);
  Watch<D> watch;
  Tuning<D> tuning;
  Prospect<D> prospect;
  Random random{31};

  World() {
    for (u32 k = 0; k < count; k++) {
      for (u32 a = 0; a < D; a++) {
        f32& low = boxes[k * 2 * D + a];
        low = f32(200 * random.fraction());
        boxes[k * 2 * D + D + a] = low + 10;
        velocities[k * D + a] = random.fraction() - 0.5;
      }
    }
    prospect.size = 10;
    prospect.pairs = 0.5;
    prospect.tests = 8;
    prospect.fresh = (D == 2 ? 16 : 20) + prospect.tests;
    prospect.looked = 1;
    prospect.late = tuning.late;
  }
  ~World() { watch.release(); }

  /// Moves all boxes by their velocities times `speed`, and looks.
  void update(f64 speed) {
    for (u32 k = 0; k < count; k++) {
      for (u32 a = 0; a < 2 * D; a++) boxes[k * 2 * D + a] += f32(speed * velocities[k * D + a % D]);
    }
    watch.look(Scene<D>{boxes.data(), count, nullptr}, 10);
  }
  void run(u32 updates, f64 speed) {
    for (u32 k = 0; k < updates; k++) update(speed);
  }
  Plan plan() const { return watch.plan(prospect, prospect.fresh); }
};

/// Choosing a margin is part of what a list costs: then it must live longer, or is not worth it.
template <int D> void check_planning() {
  World<D> world;
  world.run(65, 0.5);
  Plan free = world.plan();
  CHECK(free.work < world.prospect.fresh);
  world.prospect.planning = world.tuning.planning / world.count;
  Plan paid = world.plan();
  CHECK(paid.work > free.work);
  world.prospect.planning = 1e6;
  CHECK(world.plan().work == __builtin_inf());
}

/// Boxes rest if they have not moved for as long as is known.
template <int D> void check_rest() {
  World<D> world;
  world.run(65, 0);
  CHECK(world.watch.resting() == 1);
  world.run(8, 0.5);
  CHECK(world.watch.resting() == 1);
  CHECK(!world.watch.is_quiet());
  world.run(56, 0.5);
  CHECK(world.watch.resting() == 0);
  world.run(7, 0);
  CHECK(!world.watch.is_quiet());  // too early to tell
  world.update(0);
  CHECK(world.watch.is_quiet());
  CHECK(world.watch.resting() == 1);
  world.velocities.assign(world.velocities.size(), 0);
  u32 first = Sampling(world.count, Watch<D>::least_watched).next();  // in every sample
  for (u32 a = 0; a < D; a++) world.velocities[first * D + a] = 1;
  for (u32 update = 0; update < 64; update++) {
    world.update(0.5);
    CHECK(!world.watch.is_quiet());
  }
}

/// Some boxes move in each update, by little: always the same ones, or others each time.
template <int D> Plan plan_of_nudges(bool others) {
  World<D> world;
  std::vector<f64> velocities = world.velocities;
  for (u32 update = 0; update < 129; update++) {
    for (u32 k = 0; k < world.count * D; k++) {
      u32 turn = others ? update / 2 % 40 : 0;
      world.velocities[k] = k / D == turn || k / D == turn + 20 ? velocities[k] * (update % 2 ? 1 : -1) : 0;
    }
    world.update(0.5);
  }
  world.prospect.rest = world.watch.resting();
  CHECK(world.prospect.rest > 0);
  CHECK(world.prospect.rest < 1);
  return world.plan();
}

/// Boxes at rest get a margin if others of them begin to move all the time.
template <int D> void check_waking() {
  CHECK(plan_of_nudges<D>(false).settles);
  Plan plan = plan_of_nudges<D>(true);
  CHECK(!plan.settles);
  CHECK(plan.margin > 0);
}

/// A box is expected to move on as in the last update, unless it has jumped.
template <int D> void check_leaving() {
  World<D> world;
  world.run(3, 0.5);
  u32 asked = 0, fast = 0;
  f64 share = world.watch.leaving([&](u32 slot, f32x4 move) {
    const f64* velocity = world.velocities.data() + slot * D;
    for (u32 a = 0; a < D; a++) CHECK(std::fabs(move[a] - 0.5 * velocity[a]) < 1e-3);
    asked++;
    fast += std::fabs(velocity[0]) > 0.25;
    return std::fabs(velocity[0]) <= 0.25;
  });
  CHECK(asked >= 16);
  CHECK(share == f64(fast) / asked);
  for (f64& velocity : world.velocities) velocity = 11;  // longer than a box
  world.update(1);
  CHECK(world.watch.leaving([](u32, f32x4 move) { return move[0] == 0; }) == 0);
}

TEST("the choice of a margin is counted, 2D") { check_planning<2>(); }
TEST("the choice of a margin is counted, 3D") { check_planning<3>(); }
TEST("boxes rest if they have not moved for as long as is known, 2D") { check_rest<2>(); }
TEST("boxes rest if they have not moved for as long as is known, 3D") { check_rest<3>(); }
TEST("boxes at rest get a margin if others of them begin to move all the time, 2D") { check_waking<2>(); }
TEST("boxes at rest get a margin if others of them begin to move all the time, 3D") { check_waking<3>(); }
TEST("boxes are expected to move on as they have, 2D") { check_leaving<2>(); }
TEST("boxes are expected to move on as they have, 3D") { check_leaving<3>(); }

}  // namespace
