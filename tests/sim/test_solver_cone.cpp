// Coulomb's cone: each contact within it, sliding contacts on it and against the sliding, the same
// in every direction. The pyramid is not; that tells the two apart.
#include <gtest/gtest.h>

#include "ground_scenes.h"
#include "tick_rig.h"

namespace hoap2_sim {
namespace {

constexpr double kShare = 1e-6, kForceTolerance_N = 2e-8;

class SolverCone : public ::testing::TestWithParam<GroundScene> {};

TEST_P(SolverCone, HoldsEachContact) {
  Rig rig;
  GetParam().start(&rig);
  TickRig tick(rig.state().params);
  tick.next = rig.state();
  const double mu = rig.params.friction_mu;
  int sliding = 0, sticking = 0;
  for (int t = 0; t < GetParam().ticks; ++t) {
    tick.run_on(rig.inputs);
    for (int i = 0; i < tick.contacts.count; ++i) {
      const Vec3 normal = vec(tick.contacts.at[i].normal_W), force = tick.force_W_N(i);
      const double normal_N = dot(force, normal);
      const Vec3 friction = force - normal_N * normal, velocity = tick.velocity_W_m_s(i);
      const Vec3 along = velocity - dot(velocity, normal) * normal;
      ASSERT_GE(normal_N, -kForceTolerance_N) << t;
      ASSERT_LE(norm(friction), mu * normal_N * (1.0 + kShare) + kForceTolerance_N) << t;
      // faster than the creep that full friction has: sliding
      if (norm(along) > kContactSlip_m_Ns * mu * normal_N * (1.0 + kShare) + 1e-12) {
        const Vec3 expected = (-mu * normal_N / norm(along)) * along;
        ASSERT_LE(norm(friction - expected), kShare * mu * normal_N + kForceTolerance_N) << t;
        sliding += normal_N > 0.0 ? 1 : 0;
      } else if (normal_N > 0.0) {
        ASSERT_LE(norm(friction + (1.0 / kContactSlip_m_Ns) * along),
                  kShare * norm(friction) + kForceTolerance_N)
            << t;
        ++sticking;
      }
    }
  }
  EXPECT_GT(sticking, 50);
  const std::string name = GetParam().name;
  if (name != "Stand" && name != "CornerOfABlock" && name != "LeanOnHands") {
    EXPECT_GT(sliding, 50);
  }
}

INSTANTIATE_TEST_SUITE_P(Ground, SolverCone, ::testing::ValuesIn(kGroundScenes), scene_name);
INSTANTIATE_TEST_SUITE_P(Lying, SolverCone, ::testing::ValuesIn(kLyingScenes), scene_name);
INSTANTIATE_TEST_SUITE_P(Twice, SolverCone, ::testing::ValuesIn(kTwiceSupportedScenes), scene_name);

// Mean acceleration of the CoM on a floor tilted by 0.15 rad about x, the robot turned by `yaw`.
double slope_acceleration_m_s2(int solver, int law, double yaw_rad) {
  Rig rig;
  rig.params.solver = solver;
  rig.params.friction_law = law;
  rig.params.floor_tilt_rad[0] = 0.15;
  rig.params.start_yaw_W_rad = yaw_rad;
  rig.params.friction_mu = 0.12;  // below tan 0.15 = 0.151, which is below sqrt 2 times 0.12
  rig.start();
  rig.step(200);
  const Vec3 before = vec(rig.out().true_com_rate_W_m_s);
  rig.step(300);
  return norm(vec(rig.out().true_com_rate_W_m_s) - before) / 0.3;
}

TEST(SolverConeSlope, SlidesDiagonallyWhereThePyramidHolds) {
  const double expected_m_s2 = 9.81 * (std::sin(0.15) - 0.12 * std::cos(0.15));
  const double diagonal_rad = std::acos(-1.0) / 4.0;
  constexpr int kTree = HOAP2_SOLVER_ARTICULATED, kOde = HOAP2_SOLVER_ODE;
  constexpr int kCone = HOAP2_FRICTION_LAW_CONE, kPyramid = HOAP2_FRICTION_LAW_PYRAMID;
  EXPECT_NEAR(expected_m_s2, slope_acceleration_m_s2(kTree, kCone, diagonal_rad), 0.02 * expected_m_s2);
  EXPECT_NEAR(expected_m_s2, slope_acceleration_m_s2(kTree, kCone, 0.0), 0.02 * expected_m_s2);
  EXPECT_NEAR(expected_m_s2, slope_acceleration_m_s2(kTree, kPyramid, 0.0), 0.02 * expected_m_s2);
  EXPECT_LT(slope_acceleration_m_s2(kTree, kPyramid, diagonal_rad), 5e-3);
  EXPECT_LT(slope_acceleration_m_s2(kOde, kPyramid, diagonal_rad), 5e-3);
}

struct Glide {
  double deceleration_m_s2, aside_m_s2;  // against the start velocity, across it
};

// A standing robot that is set gliding over the floor.
Glide glide(int law, double heading_rad) {
  Rig rig;
  rig.params.friction_law = law;
  rig.params.friction_mu = 0.06;
  const Vec3 along = {std::cos(heading_rad), std::sin(heading_rad), 0.0}, aside = {-along.y, along.x, 0.0};
  put(0.5 * along, rig.params.start_vel_W_m_s);
  rig.start();
  rig.step(100);
  const Vec3 before = vec(rig.out().true_com_rate_W_m_s);
  rig.step(180);
  const Vec3 change_m_s2 = (1.0 / 0.18) * (vec(rig.out().true_com_rate_W_m_s) - before);
  return {-dot(change_m_s2, along), dot(change_m_s2, aside)};
}

TEST(SolverConeGlide, SlowsByMuGInEveryDirection) {
  const double mu_g_m_s2 = 0.06 * 9.81;
  for (int heading_deg = 0; heading_deg < 360; heading_deg += 30) {
    const Glide cone = glide(HOAP2_FRICTION_LAW_CONE, heading_deg * std::acos(-1.0) / 180.0);
    EXPECT_NEAR(mu_g_m_s2, cone.deceleration_m_s2, 0.01 * mu_g_m_s2) << heading_deg;
    EXPECT_NEAR(0.0, cone.aside_m_s2, 0.01 * mu_g_m_s2) << heading_deg;
  }
}

TEST(SolverConeGlide, ThePyramidSlowsMoreOnTheDiagonal) {
  const double mu_g_m_s2 = 0.06 * 9.81, degree = std::acos(-1.0) / 180.0;
  EXPECT_NEAR(mu_g_m_s2, glide(HOAP2_FRICTION_LAW_PYRAMID, 0.0).deceleration_m_s2, 0.02 * mu_g_m_s2);
  EXPECT_NEAR(std::sqrt(2.0) * mu_g_m_s2, glide(HOAP2_FRICTION_LAW_PYRAMID, 45.0 * degree).deceleration_m_s2,
              0.05 * mu_g_m_s2);
  // it also turns the glide towards an axis
  EXPECT_GT(std::fabs(glide(HOAP2_FRICTION_LAW_PYRAMID, 20.0 * degree).aside_m_s2), 0.3 * mu_g_m_s2);
}

// Gliding and turning, 1000 m away and turned by 130 deg: the same motion in the robot's own frame.
TEST(SolverConeGlide, IsTheSameFarAwayAndTurned) {
  Rig here, there;
  const double yaw_rad = 130.0 * std::acos(-1.0) / 180.0;
  const Mat3 turn = rotation(2, yaw_rad);
  const Vec3 velocity = {0.35, 0.2, 0.0}, away = {1000.0, -500.0, 0.0};
  for (Rig *rig : {&here, &there}) {
    rig->params.friction_mu = 0.05;
    rig->params.start_omega_W_rad_s[2] = 0.8;
    put(rig == &here ? velocity : turn * velocity, rig->params.start_vel_W_m_s);
  }
  there.params.start_pos_W_m[0] = away.x;
  there.params.start_pos_W_m[1] = away.y;
  there.params.start_yaw_W_rad = yaw_rad;
  here.start();
  there.start();
  const Vec3 start = vec(here.out().true_com_W_m);
  double apart_m = 0.0, apart_rad = 0.0;
  for (int tick = 0; tick < 600; ++tick) {
    here.step();
    there.step();
    const hoap2_plant_outputs_t a = here.out(), b = there.out();
    const Vec3 moved = vec(b.true_com_W_m) - away, expected = turn * vec(a.true_com_W_m);
    apart_m = std::fmax(apart_m, norm(moved - expected));
    for (int j = 0; j < HOAP2_JOINTS; ++j) {
      apart_rad = std::fmax(apart_rad, std::fabs(a.true_q_rad[j] - b.true_q_rad[j]));
    }
  }
  EXPECT_GT(norm(vec(here.out().true_com_W_m) - start), 0.1) << "it must glide";
  EXPECT_GT(std::fabs(here.out().true_chest_rpy_rad[2]), 0.1) << "and turn";
  EXPECT_LT(apart_m, 1e-7);
  EXPECT_LT(apart_rad, 1e-7);
}

}  // namespace
}  // namespace hoap2_sim
