// The state block under two solvers: restored in the middle of sliding contacts, in other instances,
// after another solver has used them, and on several threads.
#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "ground_scenes.h"
#include "tick_rig.h"

namespace hoap2_sim {
namespace {

bool same_state(const Rig &a, const Rig &b) {
  const State x = a.state(), y = b.state();
  return std::memcmp(&x, &y, sizeof x) == 0;
}

constexpr int kSolvers[] = {HOAP2_SOLVER_ARTICULATED, HOAP2_SOLVER_ODE};

class SolverState : public ::testing::TestWithParam<GroundScene> {};

// Wherever the block is taken, whatever the instance did before: the same bits.
TEST_P(SolverState, RestoredInMidContactContinuesBitForBit) {
  for (const int solver : kSolvers) {
    Rig rig, same_kind, other_kind;
    rig.params.solver = solver;
    GetParam().start(&rig);
    // both others are in the middle of motions of their own
    same_kind.params.solver = solver;
    thrown_on_blocks(&same_kind, 7);
    other_kind.params.solver = solver == HOAP2_SOLVER_ODE ? HOAP2_SOLVER_ARTICULATED : HOAP2_SOLVER_ODE;
    fall_askew(&other_kind);
    const int blocks = solver == HOAP2_SOLVER_ODE ? 2 : 8, every = GetParam().ticks / 8;
    for (Rig *const other : {&same_kind, &other_kind}) {
      other->step(60);
      other->inputs = rig.inputs;
    }
    for (int block = 0; block < blocks; ++block) {
      rig.step(every - 12);
      for (Rig *const other : {&same_kind, &other_kind}) ASSERT_EQ(0, other->restore(rig.state()));
      for (int i = 0; i < 12; ++i) {
        rig.step();
        for (Rig *const other : {&same_kind, &other_kind}) {
          other->step();
          ASSERT_TRUE(same_state(rig, *other)) << "solver " << solver << " block " << block << " tick " << i;
        }
      }
      // leaves the other instance with the other solver's world
      if (block % 2 == 0) {
        State away = rig.state();
        away.params.solver = other_kind.params.solver;
        ASSERT_EQ(0, other_kind.restore(away));
        other_kind.step(3);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Ground, SolverState, ::testing::ValuesIn(kGroundScenes), scene_name);

// A tick knows nothing but its state: two throws ticked in turn by one solver, and each by its own.
TEST(SolverTicks, AreTheSameWhateverTheSolverDidBefore) {
  for (std::uint64_t seed = 1; seed <= 19; seed += 2) {
    Rig rigs[2];
    for (std::uint64_t k = 0; k < 2; ++k) {
      rigs[k].params.friction_mu = seed % 3 == 0 ? 1.5 : 0.7;
      rigs[k].params.start_height_m = 0.01;
      thrown(&rigs[k], seed + k, 0.02);
      rigs[k].mode_of_all(kDriveOff);
    }
    TickRig own(rigs[0].params), shared(rigs[0].params);
    own.next = rigs[0].state();
    State elsewhere = rigs[1].state();
    int contacts = 0;
    for (int tick = 0; tick < 400; ++tick) {
      shared.run(elsewhere, rigs[1].inputs);
      elsewhere = shared.next;
      shared.run(own.next, rigs[0].inputs);
      own.run_on(rigs[0].inputs);
      contacts += own.contacts.count;
      ASSERT_EQ(0, std::memcmp(&own.next, &shared.next, sizeof own.next))
          << "seed " << seed << " tick " << tick;
    }
    EXPECT_GT(contacts, 50);
  }
}

// The same of its one part that remembers within a tick. A last tick that ended with a small error, or a
// large one, must not steer the next one.
TEST(SolverTicks, BoundsForgetTheLastTick) {
  const auto fixed_point = [](BoundIteration *bounds, int count, double slope, double at_zero_N) {
    std::vector<double> guess_N(static_cast<std::size_t>(count), 27.0), image_N = guess_N;
    bounds->start(count);
    for (int update = 0; update < 40; ++update) {
      for (std::size_t i = 0; i < guess_N.size(); ++i) {
        image_N[i] = std::fmax(0.0, at_zero_N + slope * guess_N[guess_N.size() - 1 - i]);
      }
      bounds->next(image_N.data(), guess_N.data());
    }
    return guess_N;
  };
  for (const int count : {1, 2}) {
    for (const double slope : {-4.0, -0.7, 0.5, 0.9}) {
      auto fresh = std::make_unique<BoundIteration>(), used = std::make_unique<BoundIteration>();
      const std::vector<double> first_N = fixed_point(fresh.get(), count, slope, 10.0);
      for (const double error_N : {1e-9, 1e-3, 1e6}) {
        used->start(count);
        const double image_N[2] = {1.0 + error_N, 1.0};
        double guess_N[2] = {1.0, 1.0};
        used->next(image_N, guess_N);
        EXPECT_EQ(first_N, fixed_point(used.get(), count, slope, 10.0)) << slope << " after " << error_N;
      }
      if (count == 1) {
        EXPECT_NEAR(10.0 / (1.0 - slope), first_N[0], 1e-8) << slope;
      }
    }
  }
}

// An instance goes back to its own block as well.
TEST(SolverStateBlock, GoesBackBitForBitInTheMiddleOfAWalkingStep) {
  Rig rig;
  rig.params.sensor_preset = 1;
  rig.params.seed = 11;
  Walker walker(&rig);
  walker.start();
  std::vector<hoap2_plant_inputs_t> commands;
  for (int tick = 0; walker.outputs.step_index < 3; ++tick) {
    ASSERT_LT(tick, 5000);
    walker.step();
  }
  const State saved = rig.state();
  for (int tick = 0; tick < 500; ++tick) {
    walker.step();
    commands.push_back(rig.inputs);
  }
  const State first = rig.state();
  ASSERT_EQ(0, rig.restore(saved));
  for (const hoap2_plant_inputs_t &command : commands) {
    rig.inputs = command;
    rig.step();
  }
  const State second = rig.state();
  EXPECT_EQ(0, std::memcmp(&first, &second, sizeof first));
}

TEST(SolverStateBlock, OdeWithTheConeIsRefused) {
  Rig rig;
  rig.params.solver = HOAP2_SOLVER_ODE;
  rig.params.friction_law = HOAP2_FRICTION_LAW_CONE;
  EXPECT_NE(0, hoap2_plant_init(rig.plant(), &rig.params));
  for (const char *const word : {"friction_law", "pyramid", "solver = articulated"}) {
    EXPECT_NE(nullptr, std::strstr(hoap2_plant_error(rig.plant()), word)) << hoap2_plant_error(rig.plant());
  }
  // a block that says so is refused, too, and leaves the instance as it was
  Rig good;
  good.start();
  good.step(5);
  const State kept = good.state();
  State bad = kept;
  bad.params.solver = HOAP2_SOLVER_ODE;
  bad.params.friction_law = HOAP2_FRICTION_LAW_CONE;
  EXPECT_NE(0, good.restore(bad));
  EXPECT_NE(nullptr, std::strstr(hoap2_plant_error(good.plant()), "pyramid"));
  const State now = good.state();
  EXPECT_EQ(0, std::memcmp(&kept, &now, sizeof kept));
  good.step();
  // and the three other pairs are taken
  for (const int solver : kSolvers) {
    for (const int law : {HOAP2_FRICTION_LAW_OF_SOLVER, HOAP2_FRICTION_LAW_PYRAMID}) {
      Rig other;
      other.params.solver = solver;
      other.params.friction_law = law;
      other.start();
    }
  }
}

// Four instances, two of each solver, falling on four threads at once.
TEST(SolverThreads, GiveTheBitsOfOneThread) {
  const auto run = [](Rig *rig) {
    for (int i = 0; i < 400; ++i) ASSERT_EQ(0, hoap2_plant_step(rig->plant(), &rig->inputs));
  };
  Rig alone[4], together[4];
  for (int i = 0; i < 4; ++i) {
    for (Rig *const rig : {&alone[i], &together[i]}) {
      rig->params.solver = kSolvers[i % 2];
      thrown_on_blocks(rig, static_cast<std::uint64_t>(1 + i / 2));
    }
    run(&alone[i]);
  }
  std::vector<std::thread> threads;
  for (Rig &rig : together) threads.emplace_back([&run, &rig] { run(&rig); });
  for (std::thread &thread : threads) thread.join();
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(same_state(alone[i], together[i])) << i;
}

}  // namespace
}  // namespace hoap2_sim
