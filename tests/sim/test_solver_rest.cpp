// At rest on many contacts, hands among them: forces and moments balance, with either solver.
#include <gtest/gtest.h>

#include <map>

#include "ground_scenes.h"
#include "tick_rig.h"

namespace hoap2_sim {
namespace {

constexpr int kMeanTicks = 50;

struct Rest {
  Vec3 force_W_N, moment_com_W_Nm;       // of the ground on the robot
  std::map<int, double> normal_force_N;  // on each link
  int contacts_least = 1 << 20;
};

// Means over some ticks that go on from a state with one of the solvers.
Rest rest(const State &s, const hoap2_plant_inputs_t &inputs) {
  TickRig tick(s.params);
  tick.next = s;
  Rest mean;
  for (int t = 0; t < kMeanTicks; ++t) {
    tick.run_on(inputs);
    Vec3 com_W_m, rate_W_m_s;
    total_com(tick.before, &com_W_m, &rate_W_m_s);
    mean.contacts_least = std::min(mean.contacts_least, tick.contacts.count);
    for (int i = 0; i < tick.contacts.count; ++i) {
      const Contact &at = tick.contacts.at[i];
      const Vec3 force = (1.0 / kMeanTicks) * tick.force_W_N(i);
      mean.force_W_N = mean.force_W_N + force;
      mean.moment_com_W_Nm = mean.moment_com_W_Nm + cross(vec(at.point_W_m) - com_W_m, force);
      mean.normal_force_N[at.link] += dot(force, vec(at.normal_W));
    }
  }
  return mean;
}

void expect_balance(const Rest &mean) {
  EXPECT_NEAR(kMg_N, mean.force_W_N.z, 0.01 * kMg_N);
  EXPECT_LE(std::hypot(mean.force_W_N.x, mean.force_W_N.y), 0.01 * kMg_N);
  EXPECT_LE(norm(mean.moment_com_W_Nm), 0.01 * kMg_N * 0.1);
}

State settled(const GroundScene &scene, int ticks, hoap2_plant_inputs_t *inputs) {
  Rig rig;
  scene.start(&rig);
  rig.step(ticks);
  *inputs = rig.inputs;
  EXPECT_LT(norm(vec(rig.out().true_com_rate_W_m_s)), 5e-3);
  return rig.state();
}

TEST(SolverRest, LimbsOnTheFloorShareTheWeight) {
  hoap2_plant_inputs_t inputs;
  const State s = settled(kLyingScenes[0], 3000, &inputs);
  for (const int solver : {HOAP2_SOLVER_ARTICULATED, HOAP2_SOLVER_ODE}) {
    const Rest mean = rest(with(s, solver, HOAP2_FRICTION_LAW_PYRAMID), inputs);
    expect_balance(mean);
    EXPECT_GE(mean.contacts_least, 12);
    EXPECT_GE(mean.normal_force_N.size(), 6u);
  }
}

TEST(SolverRest, MoreThanTwentyContactsShareTheWeight) {
  hoap2_plant_inputs_t inputs;
  const State soft = settled(kLyingScenes[1], 4000, &inputs);
  for (const int solver : {HOAP2_SOLVER_ARTICULATED, HOAP2_SOLVER_ODE}) {
    const Rest mean = rest(with(soft, solver, HOAP2_FRICTION_LAW_PYRAMID), inputs);
    expect_balance(mean);
    EXPECT_GT(mean.contacts_least, 20);
    EXPECT_GE(mean.normal_force_N.size(), 10u);
  }
  const State on_plate = settled(kTwiceSupportedScenes[0], 3000, &inputs);
  const Rest mean = rest(on_plate, inputs);
  expect_balance(mean);
  EXPECT_GT(mean.contacts_least, 20);
}

TEST(SolverRest, FeetAndHandsShareTheWeight) {
  Rig rig;
  lean_on_hands(&rig);
  rig.step(1500);
  double on_right_hand_N[2];
  for (const int solver : {HOAP2_SOLVER_ARTICULATED, HOAP2_SOLVER_ODE}) {
    Rest mean = rest(with(rig.state(), solver, HOAP2_FRICTION_LAW_OF_SOLVER), rig.inputs);
    expect_balance(mean);
    for (const int hand : {HOAP2_L_R_HAND, HOAP2_L_L_HAND}) EXPECT_GT(mean.normal_force_N[hand], 1.0);
    for (const int foot : kFootLink) EXPECT_GT(mean.normal_force_N[foot], 10.0);
    on_right_hand_N[solver] = mean.normal_force_N[HOAP2_L_R_HAND];
    EXPECT_EQ(4u, mean.normal_force_N.size());
  }
  EXPECT_NEAR(on_right_hand_N[0], on_right_hand_N[1], 1e-3);
}

}  // namespace
}  // namespace hoap2_sim
