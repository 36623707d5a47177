// Both solvers side by side over time: same start, same inputs, two trajectories.
#include <gtest/gtest.h>

#include "ground_scenes.h"
#include "tick_rig.h"

namespace hoap2_sim {
namespace {

struct Apart {
  double bodies_m = 0.0, turned_rad = 0.0, joints_rad = 0.0, foot_force_N = 0.0;
};

// Largest differences of two rigs now, kept if larger than before.
void note_apart(const Rig &a, const Rig &b, Apart *apart) {
  const State x = a.state(), y = b.state();
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    const double away_m = norm(vec(x.body[link].com_pos_W_m) - vec(y.body[link].com_pos_W_m));
    const Quat turn = conj(quat(x.body[link].quat_W)) * quat(y.body[link].quat_W);
    apart->bodies_m = std::fmax(apart->bodies_m, away_m);
    apart->turned_rad = std::fmax(apart->turned_rad, 2.0 * norm(Vec3{turn.x, turn.y, turn.z}));
  }
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    apart->joints_rad =
        std::fmax(apart->joints_rad, std::fabs(x.drive[j].link_q_rad - y.drive[j].link_q_rad));
  }
  for (int foot = 0; foot < 2; ++foot) {
    apart->foot_force_N =
        std::fmax(apart->foot_force_N, norm(vec(x.foot[foot].force_W_N) - vec(y.foot[foot].force_W_N)));
  }
}

class SolversInTheAir : public ::testing::TestWithParam<int> {};

TEST_P(SolversInTheAir, StayTogetherForTwoSeconds) {
  Rig rigs[2];
  for (Rig &rig : rigs) {
    rig.params.gravity_m_s2 = 0.0;
    rig.params.start_height_m = 50.0;
    const double omega_rad_s[3] = {1.0, -0.7, 0.5};
    std::copy(omega_rad_s, omega_rad_s + 3, rig.params.start_omega_W_rad_s);
    rig.params.roll_stiffness_Nm_rad = GetParam() % 2 == 0 ? 150.0 : 0.0;
  }
  rigs[1].params.solver = HOAP2_SOLVER_ODE;
  for (Rig &rig : rigs) rig.start();
  const Swing swing(static_cast<std::uint64_t>(GetParam()), 4.0);
  Apart apart;
  double fastest_rad_s[HOAP2_JOINTS] = {};
  for (int tick = 0; tick < 2000; ++tick) {
    for (Rig &rig : rigs) {
      swing.set(&rig, tick);
      rig.step();
    }
    note_apart(rigs[0], rigs[1], &apart);
    const hoap2_plant_outputs_t out = rigs[0].out();
    for (int j = 0; j < HOAP2_JOINTS; ++j) {
      fastest_rad_s[j] = std::fmax(fastest_rad_s[j], std::fabs(out.true_qd_rad_s[j]));
    }
  }
  RecordProperty("apart_pm", std::to_string(apart.bodies_m * 1e12));
  EXPECT_LE(apart.bodies_m, 1e-9);
  EXPECT_LE(apart.turned_rad, 1e-8);
  EXPECT_LE(apart.joints_rad, 1e-8);
  for (int j = 0; j < HOAP2_JOINTS; ++j) EXPECT_GT(fastest_rad_s[j], 0.5) << "joint " << j << " must move";
  EXPECT_GT(*std::max_element(fastest_rad_s, fastest_rad_s + HOAP2_JOINTS), 3.5);
}

INSTANTIATE_TEST_SUITE_P(Seeds, SolversInTheAir, ::testing::Range(1, 3));

// Nothing slides here, so the cone is the pyramid.
TEST(SolversSideBySide, StandWithTheSameForces) {
  Rig rigs[2];
  rigs[1].params.solver = HOAP2_SOLVER_ODE;
  for (Rig &rig : rigs) rig.start();
  Apart apart;
  for (int tick = 0; tick < 1000; ++tick) {
    for (Rig &rig : rigs) rig.step();
    note_apart(rigs[0], rigs[1], &apart);
  }
  EXPECT_LE(apart.bodies_m, 1e-8);
  EXPECT_LE(apart.turned_rad, 1e-8);
  EXPECT_LE(apart.joints_rad, 1e-8);
  EXPECT_LE(apart.foot_force_N, 1e-4);
  const hoap2_plant_outputs_t out = rigs[0].out();
  for (const auto &force : out.true_foot_force_W_N) EXPECT_GT(force[2], 0.4 * kMg_N);
}

// Falling and tipping part trajectories: a difference of dWorldStep's hinge compliance grows from
// impact to impact. Until the horizon it has not grown beyond the bound, which is still far less than
// what a single contact decided otherwise would make.
struct Horizon {
  const char *name;
  void (*start)(Rig *rig);
  int ticks;
  double bound_m, least_moved_m;
};
void PrintTo(const Horizon &horizon, std::ostream *out) { *out << horizon.name; }
std::string horizon_name(const ::testing::TestParamInfo<Horizon> &tested) { return tested.param.name; }

const Horizon kHorizons[] = {
    {"LandHard", land_hard, 500, 5e-7, 0.1},
    {"EdgeOfATread", stand_on_an_edge, 500, 1e-5, 0.03},
    {"TwoTreads", stand_on_two_treads, 500, 1e-5, 0.05},
    {"CornerOfABlock", stand_on_a_corner, 500, 5e-8, 0.005},
    {"FallForward", fall_forward, 1000, 1e-6, 0.15},
    {"FallBackward", fall_backward, 1000, 1e-6, 0.15},
    {"FallSideways", fall_sideways, 1000, 5e-6, 0.1},
    {"FallAskew", fall_askew, 550, 1e-5, 0.1},
    {"LeanOnHands", lean_on_hands, 800, 1e-8, 1e-4},
};

class SolversOnTheGround : public ::testing::TestWithParam<Horizon> {};

TEST_P(SolversOnTheGround, StayTogetherUntilTheHorizon) {
  Rig rigs[2];
  rigs[0].params.friction_law = HOAP2_FRICTION_LAW_PYRAMID;
  rigs[1].params.solver = HOAP2_SOLVER_ODE;
  for (Rig &rig : rigs) GetParam().start(&rig);
  const Vec3 start_W_m = vec(rigs[0].out().true_com_W_m);
  Apart apart;
  for (int tick = 0; tick < GetParam().ticks; ++tick) {
    for (Rig &rig : rigs) {
      rig.inputs = rigs[0].inputs;
      rig.step();
    }
    note_apart(rigs[0], rigs[1], &apart);
  }
  RecordProperty("apart_nm", std::to_string(apart.bodies_m * 1e9));
  EXPECT_LE(apart.bodies_m, GetParam().bound_m);
  EXPECT_LE(apart.turned_rad, 20.0 * GetParam().bound_m);
  EXPECT_GE(norm(vec(rigs[0].out().true_com_W_m) - start_W_m), GetParam().least_moved_m);
}

INSTANTIATE_TEST_SUITE_P(Ground, SolversOnTheGround, ::testing::ValuesIn(kHorizons), horizon_name);

}  // namespace
}  // namespace hoap2_sim
