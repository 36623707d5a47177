// Limp falls until the robot lies: no energy from nowhere, no sinking, rest under its weight. With
// either solver.
#include <gtest/gtest.h>

#include <tuple>

#include "ground_scenes.h"
#include "tick_rig.h"

namespace hoap2_sim {
namespace {

// Energies in J. A tick's equations give
//   gain of motion and height <= work of motor rows + work of contact forces, at the velocities after it;
// only the gyroscopic torque's extrapolation and the hinges' error feedback are outside of it.
constexpr double kTickGain_J = 3e-6, kAllTicksGain_J = 1e-3;
// What springs of contacts and stops may give back at a time.
constexpr double kBounce_J = 0.8;
// A corner enters the ground by up to h v before it is felt, 3.6 mm at the 3.6 m/s of a hand; what the spring
// and damper take to stop a limb (m / (h k + c) = 0.5 ms a kilogram) is less.
constexpr double kDeepest_m = 4e-3;
constexpr double kRestDepth_m = 1e-4;
constexpr int kTicks = 3000, kRestTicks = 100;

double link_energy_J(const State &s) {
  double energy_J = kinetic_energy_J(s) + potential_energy_J(s);
  for (int j = 0; j < HOAP2_JOINTS; ++j) {  // rotors belong to the motor rows
    energy_J -= 0.5 * HOAP2_JOINT[j].armature_kgm2 * s.drive[j].rotor_qd_rad_s * s.drive[j].rotor_qd_rad_s;
  }
  return energy_J;
}

double motor_work_J(const TickRig &tick) {
  double work_J = 0.0;
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    const double torque_Nm = tick.row[j].stiffness_Nms_rad * (tick.row[j].target_rad_s - tick.rate_rad_s[j]);
    work_J += kTick_s * torque_Nm * tick.rate_rad_s[j];
  }
  return work_J;
}

struct ContactWork {
  double all_J = 0.0, largest_friction_J = -1e9;
};

ContactWork contact_work(const TickRig &tick) {
  ContactWork work;
  for (int i = 0; i < tick.contacts.count; ++i) {
    const Vec3 force = tick.force_W_N(i), velocity = tick.velocity_W_m_s(i);
    const Vec3 normal = vec(tick.contacts.at[i].normal_W);
    const double all_J = kTick_s * dot(force, velocity);
    work.all_J += all_J;
    const double friction_J = all_J - kTick_s * dot(force, normal) * dot(velocity, normal);
    work.largest_friction_J = std::fmax(work.largest_friction_J, friction_J);
  }
  return work;
}

using Fall = std::tuple<GroundScene, int>;  // scene, solver

class SolverFalls : public ::testing::TestWithParam<Fall> {
 protected:
  void SetUp() override {
    rig_.params.solver = std::get<1>(GetParam());
    std::get<0>(GetParam()).start(&rig_);
    rig_.mode_of_all(kDriveOff);
    tick_ = std::make_unique<TickRig>(rig_.state().params);
    tick_->next = rig_.state();
  }
  Rig rig_;
  std::unique_ptr<TickRig> tick_;
};

TEST_P(SolverFalls, GainNothingSinkNowhereAndRest) {
  const double start_J = kinetic_energy_J(rig_.state()) + potential_energy_J(rig_.state());
  double lowest_J = start_J, gain_J = 0.0, contact_J = 0.0, deepest_m = 0.0;
  Vec3 rest_force_W_N;
  for (int i = 0; i < kTicks; ++i) {
    tick_->run_on(rig_.inputs);
    const ContactWork contact = contact_work(*tick_);
    const double tick_gain_J =
        link_energy_J(tick_->next) - link_energy_J(tick_->before) - motor_work_J(*tick_) - contact.all_J;
    ASSERT_LE(tick_gain_J, kTickGain_J) << i;
    ASSERT_LE(contact.largest_friction_J, 1e-12) << i;
    gain_J += std::fmax(0.0, tick_gain_J);
    contact_J += contact.all_J;
    ASSERT_LE(contact_J, 1e-6) << "ground gives more than it got, tick " << i;
    const double energy_J = kinetic_energy_J(tick_->next) + potential_energy_J(tick_->next);
    ASSERT_LE(energy_J, start_J + 1e-6) << i;
    ASSERT_LE(energy_J, lowest_J + kBounce_J) << i;
    lowest_J = std::fmin(lowest_J, energy_J);
    deepest_m = std::fmax(deepest_m, -lowest_corner_m(tick_->next));
    if (i >= kTicks - kRestTicks) rest_force_W_N = rest_force_W_N + tick_->total_force_W_N();
  }
  RecordProperty("deepest_um", std::to_string(deepest_m * 1e6));
  EXPECT_LE(gain_J, kAllTicksGain_J);
  EXPECT_LE(deepest_m, kDeepest_m);
  EXPECT_GE(deepest_m, 1e-4) << "it must hit the floor";
  const State end = tick_->next;
  EXPECT_LE(-lowest_corner_m(end), kRestDepth_m);
  EXPECT_GE(start_J - lowest_J, 5.0) << "it must fall";
  EXPECT_LE(kinetic_energy_J(end), 1e-3) << "it must come to rest";
  EXPECT_GE(tick_->contacts.count, 3);
  const Vec3 mean_W_N = (1.0 / kRestTicks) * rest_force_W_N;
  EXPECT_NEAR(kMg_N, mean_W_N.z, 0.01 * kMg_N);
  EXPECT_LE(std::hypot(mean_W_N.x, mean_W_N.y), 0.01 * kMg_N);
}

std::string fall_name(const ::testing::TestParamInfo<Fall> &tested) {
  return std::string(std::get<0>(tested.param).name) +
         (std::get<1>(tested.param) == 0 ? "Articulated" : "Ode");
}

INSTANTIATE_TEST_SUITE_P(Limp, SolverFalls,
                         ::testing::Combine(::testing::Values(GroundScene{"Forward", fall_forward, 0, 0, 0},
                                                              GroundScene{"Backward", fall_backward, 0, 0, 0},
                                                              GroundScene{"Sideways", fall_sideways, 0, 0, 0},
                                                              GroundScene{"Askew", fall_askew, 0, 0, 0},
                                                              GroundScene{"OnBlocks", thrown_1, 0, 0, 0}),
                                            ::testing::Values(HOAP2_SOLVER_ARTICULATED, HOAP2_SOLVER_ODE)),
                         fall_name);

}  // namespace
}  // namespace hoap2_sim
