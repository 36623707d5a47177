// The articulated solver against the tick's equations as docs/solver.md states them, written for all
// bodies at once: with the forces that the contact law gives at the solver's velocities, the dense
// equations must give these velocities back.
#include <gtest/gtest.h>

#include "dense_tick.h"
#include "ground_scenes.h"

namespace hoap2_sim {
namespace {

constexpr int kSamples = 12;
// What is left of the solver's own tolerance, 1e-8 N a contact: a newton over a tick moves a point of a
// hand by 5e-3 m/s.
constexpr double kVelocityTolerance_m_s = 1e-9, kVelocityPerContact_m_s = 1e-10;
constexpr double kForceTolerance_N = 5e-8;

// Largest difference of all links' velocities, linear or angular.
double velocity_error(const TickRig &tick, const std::vector<Vec3> &force_W_N) {
  const Eigen::VectorXd dense = DenseTick(tick).velocities(force_W_N);
  double worst = 0.0;
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    const BodyState &body = tick.next.body[link];
    for (int k = 0; k < 3; ++k) {
      worst = std::fmax(worst, std::fabs(dense[6 * link + k] - body.com_vel_W_m_s[k]));
      worst = std::fmax(worst, std::fabs(dense[6 * link + 3 + k] - body.omega_W_rad_s[k]));
    }
  }
  return worst;
}

double normal_N(const TickRig &tick, int i) {
  const hoap2_plant_params_t &params = tick.before.params;
  const Contact &at = tick.contacts.at[i];
  const double row_Ns_m = kTick_s * params.contact_stiffness_N_m + params.contact_damping_Ns_m;
  const double target_m_s = params.contact_stiffness_N_m * at.depth_m / row_Ns_m;
  return std::fmax(0.0, (target_m_s - dot(vec(at.normal_W), tick.velocity_W_m_s(i))) * row_Ns_m);
}

// Coulomb's cone: creep 1e-6 m/s per newton within mu N, against the sliding on it.
Vec3 cone_force_W_N(const TickRig &tick, int i) {
  const Vec3 normal = vec(tick.contacts.at[i].normal_W), velocity = tick.velocity_W_m_s(i);
  const Vec3 along = velocity - dot(velocity, normal) * normal;
  const double size_N = normal_N(tick, i), bound_N = tick.before.params.friction_mu * size_N;
  const double stick_N = norm(along) / 1e-6;
  const double friction_N = std::fmin(stick_N, bound_N);
  return size_N * normal - (stick_N > 0.0 ? friction_N / norm(along) : 0.0) * along;
}

// ODE's pyramid: bounds mu times the normal force of the frictionless tick, in each of two directions.
Vec3 pyramid_force_W_N(const TickRig &tick, int i, double frictionless_N) {
  const Vec3 normal = vec(tick.contacts.at[i].normal_W), first = vec(tick.contacts.at[i].along_W);
  const Vec3 second = cross(normal, first), velocity = tick.velocity_W_m_s(i);
  const double bound_N = tick.before.params.friction_mu * frictionless_N;
  const double f1 = std::fmax(-bound_N, std::fmin(bound_N, -dot(velocity, first) / 1e-6));
  const double f2 = std::fmax(-bound_N, std::fmin(bound_N, -dot(velocity, second) / 1e-6));
  return normal_N(tick, i) * normal + f1 * first + f2 * second;
}

// Normal forces of the same tick, same motor rows, without friction.
std::vector<double> frictionless_N(const TickRig &tick) {
  State smooth = tick.before;
  smooth.params.friction_mu = 0.0;
  ArticulatedSolver solver(smooth.params);
  solver.begin({&smooth, tick.axes_W, tick.load, &tick.contacts});
  double rate_rad_s[HOAP2_JOINTS];
  solver.solve(tick.row, rate_rad_s);
  std::vector<double> normal;
  for (int i = 0; i < tick.contacts.count; ++i) {
    double force[3], moment[3];
    solver.contact_load(i, force, moment);
    normal.push_back(dot(vec(force), vec(tick.contacts.at[i].normal_W)));
  }
  return normal;
}

void expect_law(const TickRig &tick, const std::vector<Vec3> &law_W_N, int at) {
  for (int i = 0; i < tick.contacts.count; ++i) {
    const Vec3 &law = law_W_N[static_cast<std::size_t>(i)];
    ASSERT_LE(norm(law - tick.force_W_N(i)), kForceTolerance_N + 1e-9 * norm(law)) << at << " contact " << i;
  }
  const double tolerance = kVelocityTolerance_m_s + kVelocityPerContact_m_s * tick.contacts.count;
  ASSERT_LE(velocity_error(tick, law_W_N), tolerance) << at;
}

void expect_equations(const State &s, const hoap2_plant_inputs_t &inputs, int at) {
  TickRig cone(with(s, HOAP2_SOLVER_ARTICULATED, HOAP2_FRICTION_LAW_CONE).params);
  cone.run(with(s, HOAP2_SOLVER_ARTICULATED, HOAP2_FRICTION_LAW_CONE), inputs);
  std::vector<Vec3> law;
  for (int i = 0; i < cone.contacts.count; ++i) law.push_back(cone_force_W_N(cone, i));
  expect_law(cone, law, at);
  TickRig pyramid(with(s, HOAP2_SOLVER_ARTICULATED, HOAP2_FRICTION_LAW_PYRAMID).params);
  pyramid.run(with(s, HOAP2_SOLVER_ARTICULATED, HOAP2_FRICTION_LAW_PYRAMID), inputs);
  const std::vector<double> normal = frictionless_N(pyramid);
  law.clear();
  for (int i = 0; i < pyramid.contacts.count; ++i) {
    law.push_back(pyramid_force_W_N(pyramid, i, normal[static_cast<std::size_t>(i)]));
  }
  expect_law(pyramid, law, at);
}

class SolverEquations : public ::testing::TestWithParam<GroundScene> {};

TEST_P(SolverEquations, HoldInEachTick) {
  Rig rig;
  GetParam().start(&rig);
  int with_contacts = 0;
  for (int sample = 0; sample < kSamples; ++sample) {
    rig.step(GetParam().ticks / kSamples);
    // go on to a tick with contacts, if one comes soon
    for (int i = 0; i < 40; ++i) {
      if (lowest_corner_m(rig.state()) < 0.0) break;
      rig.step();
    }
    with_contacts += lowest_corner_m(rig.state()) < 0.0 ? 1 : 0;
    expect_equations(rig.state(), rig.inputs, sample);
    if (HasFatalFailure()) return;
  }
  if (rig.params.block_count == 0) {
    EXPECT_GE(with_contacts, kSamples / 2);
  }
}

INSTANTIATE_TEST_SUITE_P(Ground, SolverEquations, ::testing::ValuesIn(kGroundScenes), scene_name);
INSTANTIATE_TEST_SUITE_P(Lying, SolverEquations, ::testing::ValuesIn(kLyingScenes), scene_name);
INSTANTIATE_TEST_SUITE_P(Twice, SolverEquations, ::testing::ValuesIn(kTwiceSupportedScenes), scene_name);

TEST(SolverEquations, HoldInTheAirWithCompliantJointsAndTorqueLimits) {
  Rig rig;
  rig.float_free();
  rig.params.joint_friction_scale = 1.0;
  rig.params.roll_stiffness_Nm_rad = 100.0;
  rig.params.chest_com_shift_L_m[0] = 0.01;
  rig.params.start_omega_W_rad_s[1] = 3.0;
  rig.start();
  const Swing swing(4, 4.0);
  bool limited = false;
  for (int tick = 0; tick < 600; ++tick) {
    swing.set(&rig, tick);
    const State s = rig.state();
    rig.step();
    for (int j = 0; j < HOAP2_JOINTS; ++j) {
      limited = limited || std::fabs(rig.out().true_tau_Nm[j]) >= HOAP2_JOINT[j].torque_peak_Nm;
    }
    if (tick % 50 != 0) continue;
    TickRig solved(s.params);
    solved.run(s, rig.inputs);
    ASSERT_LE(velocity_error(solved, {}), 1e-11) << tick;
  }
  EXPECT_TRUE(limited) << "some drive must be at its peak for this to mean anything";
}

TEST(SolverEquations, HoldInWalking) {
  Rig rig;
  Walker walker(&rig);
  walker.start();
  for (int tick = 0; walker.outputs.step_index < 3; ++tick) {
    ASSERT_LT(tick, 5000);
    const State s = rig.state();
    walker.step();
    if (walker.outputs.step_index < 1 || tick % 50 != 0) continue;
    expect_equations(s, rig.inputs, tick);
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace hoap2_sim
