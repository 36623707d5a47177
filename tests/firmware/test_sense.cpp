// What the controller concludes from its sensors, against robots whose truth is known.
#include <gtest/gtest.h>

#include <cmath>

#include "ideal_robot.hpp"
#include "random_posture.hpp"
#include "robot/leg_ik.hpp"
#include "sense/sense.h"

namespace {

using namespace hoap2;
using hoap2_tests::kGravity;
using hoap2_tests::kTick;
using hoap2_tests::RandomPosture;

constexpr double kOmega = 6.17;
constexpr double kDeg = 3.14159265358979323846 / 180.0;

class Sense : public testing::Test {
 protected:
  Sense() {
    hoap2_params_defaults(&params);
    hoap2_inputs_defaults(&in);
    hoap2_sense_reset(&sense);
    for (int foot = 0; foot < 2; ++foot) {
      feet.pos_O_m[foot][0] = feet.pos_O_m[foot][2] = 0.0;
      feet.pos_O_m[foot][1] = foot == 0 ? -0.039 : 0.039;
      feet.yaw_O_rad[foot] = 0.0;
      feet.support[foot] = 1;
    }
    feet.pad = 0;
  }

  void step() { hoap2_sense_step(&params, &in, &feet, kOmega, &sense); }

  // The accelerometer of a chest at rest with this orientation in O.
  void show_gravity(const Mat3& chest_rot_O) {
    Eigen::Map<Vec3>(in.accel_S_m_s2) = kGravity * chest_rot_O.row(2).transpose();
  }

  void calibrate(int ticks) {
    hoap2_sense_calibrate_begin(&sense);
    for (int k = 0; k < ticks; ++k) {
      step();
      hoap2_sense_calibrate_add(&in, &sense);
    }
    hoap2_sense_calibrate_end(&sense);
  }

  hoap2_params_t params;
  hoap2_inputs_t in;
  hoap2_sense_t sense;
  hoap2_feet_t feet;
};

TEST_F(Sense, AttitudeAtRest) {
  const Vec3 rpy(4 * kDeg, -7 * kDeg, 50 * kDeg);
  show_gravity(matrix_from_rpy(rpy));
  step();
  EXPECT_NEAR(sense.roll_rad, rpy.x(), 1e-12);
  EXPECT_NEAR(sense.pitch_rad, rpy.y(), 1e-12);
}

TEST_F(Sense, CalibrationTakesTheGyroBiasAway) {
  in.gyro_S_rad_s[0] = 0.5 * kDeg;
  in.gyro_S_rad_s[1] = -0.4 * kDeg;
  calibrate(500);
  for (int k = 0; k < 20000; ++k) step();
  EXPECT_LT(std::fabs(sense.roll_rad), 1e-9);
  EXPECT_LT(std::fabs(sense.pitch_rad), 1e-9);
}

TEST_F(Sense, WithoutCalibrationTheBiasShowsTimesTheTimeConstant) {
  in.gyro_S_rad_s[1] = 0.1 * kDeg;
  for (int k = 0; k < 30000; ++k) step();
  EXPECT_NEAR(sense.pitch_rad, 0.1 * kDeg * params.attitude_tau_s, 0.01 * kDeg);
}

// A chest that sways by gyro alone: the accelerometer is dead, so only the gyro's integration can follow.
TEST_F(Sense, TheGyroCarriesFastMotion) {
  step();
  for (double& accel : in.accel_S_m_s2) accel = 0.0;
  Vec3 rpy = Vec3::Zero();
  double worst_rad = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const double t = k * kTick;
    const Mat3 before = matrix_from_rpy(rpy);
    rpy = Vec3(3 * kDeg * std::sin(8 * t), 5 * kDeg * std::sin(6 * t), 20 * kDeg * t);
    const Mat3 turn = before.transpose() * matrix_from_rpy(rpy);
    in.gyro_S_rad_s[0] = 0.5 * (turn(2, 1) - turn(1, 2)) / kTick;
    in.gyro_S_rad_s[1] = 0.5 * (turn(0, 2) - turn(2, 0)) / kTick;
    in.gyro_S_rad_s[2] = 0.5 * (turn(1, 0) - turn(0, 1)) / kTick;
    step();
    worst_rad = std::max(worst_rad, std::hypot(sense.roll_rad - rpy.x(), sense.pitch_rad - rpy.y()));
  }
  EXPECT_LT(worst_rad, 0.05 * kDeg);
}

TEST_F(Sense, FreeFallShowsNoVerticalAndBreaksNothing) {
  show_gravity(matrix_from_rpy(Vec3(0.0, 0.1, 0.0)));
  step();
  for (double& accel : in.accel_S_m_s2) accel = 0.0;
  for (int k = 0; k < 1000; ++k) step();
  EXPECT_NEAR(sense.pitch_rad, 0.1, 1e-12);
}

// (7.65): every cell alone puts the CoP on itself, on a foot anywhere.
TEST_F(Sense, CoPOfOneCellIsItsPlace) {
  RandomPosture random(61);
  for (int foot = 0; foot < 2; ++foot) {
    for (int cell = 0; cell < 4; ++cell) {
      feet.yaw_O_rad[foot] = random.uniform(-1, 1);
      feet.pos_O_m[foot][0] = random.uniform(-1, 1);
      for (double& force : in.cell_force_N) force = 0.0;
      in.cell_force_N[4 * foot + cell] = 20.0;
      step();
      const Vec3 place_O = Eigen::Map<const Vec3>(feet.pos_O_m[foot]) +
                           rot_z(feet.yaw_O_rad[foot]) * Eigen::Map<const Vec3>(HOAP2_CELL_POS_L_M[cell]);
      EXPECT_NEAR(sense.cop_O_m[0], place_O.x(), 1e-13);
      EXPECT_NEAR(sense.cop_O_m[1], place_O.y(), 1e-13);
      EXPECT_NEAR(sense.foot_force_N[foot], 20.0, 1e-13);
    }
  }
}

TEST_F(Sense, NetCoPIsWeightedByTheLoads) {
  for (int cell = 0; cell < 4; ++cell) {
    in.cell_force_N[cell] = 3.0;
    in.cell_force_N[4 + cell] = 9.0;
  }
  step();
  EXPECT_NEAR(sense.cop_O_m[0], 0.009, 1e-12);  // the middle of the cells
  EXPECT_NEAR(sense.cop_O_m[1], 0.25 * -0.039 + 0.75 * 0.039, 1e-12);
}

TEST_F(Sense, ContactHasHysteresisAndTheCoPIsHeldInFlight) {
  in.cell_force_N[0] = params.contact_on_N - 0.1;
  step();
  EXPECT_EQ(sense.contact[0], 0);
  in.cell_force_N[0] = params.contact_on_N + 0.1;
  step();
  EXPECT_EQ(sense.contact[0], 1);
  const double held_m = sense.cop_O_m[0];
  in.cell_force_N[0] = params.contact_off_N + 0.1;
  step();
  EXPECT_EQ(sense.contact[0], 1);
  in.cell_force_N[0] = params.contact_off_N - 0.1;
  step();
  EXPECT_EQ(sense.contact[0], 0);
  EXPECT_EQ(sense.cop_O_m[0], held_m);
}

// A robot frozen in any posture on a foot that may have tilted: base, CoM and capture point are its true
// ones.
TEST_F(Sense, BaseAndCoMOfATiltedRobot) {
  RandomPosture random(62);
  for (int n = 0; n < 300; ++n) {
    hoap2_sense_reset(&sense);
    const int foot = n % 2;
    for (int j = 0; j < HOAP2_JOINTS; ++j)
      in.q_enc_rad[j] = params.posture_rad[j] + random.uniform(-0.2, 0.2);
    feet.pos_O_m[foot][0] = random.uniform(-1, 1);
    feet.pos_O_m[foot][1] = random.uniform(-1, 1);
    feet.yaw_O_rad[foot] = random.uniform(-3, 3);
    feet.support[foot] = 1;
    feet.support[1 - foot] = 0;
    const Mat3 sole_rot_O =
        matrix_from_rpy(Vec3(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), feet.yaw_O_rad[foot]));
    Kinematics kin;
    forward_kinematics(in.q_enc_rad, kin);
    const Pose sole_B = sole_pose_B(kin, foot);
    const Mat3 base_rot_O = sole_rot_O * sole_B.R.transpose();
    const Vec3 base_O = Eigen::Map<const Vec3>(feet.pos_O_m[foot]) - base_rot_O * sole_B.p;
    show_gravity(base_rot_O * chest_rot_B(kin));
    step();
    const Vec3 com_O = base_O + base_rot_O * kin.com_B;
    ASSERT_LT((Eigen::Map<const Vec3>(sense.base_pos_O_m) - base_O).norm(), 1e-12);
    ASSERT_LT((Eigen::Map<const Vec3>(sense.com_O_m) - com_O).norm(), 1e-12);
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(sense.base_rot_O[i][k], base_rot_O(i, k), 1e-12);
    }
    ASSERT_NEAR(sense.cp_O_m[0], com_O.x(), 1e-12);  // at rest the capture point is the CoM
    ASSERT_NEAR(sense.cp_O_m[1], com_O.y(), 1e-12);
  }
}

// The pelvis moves over standing feet at a constant speed; then the support changes side.
TEST_F(Sense, RateAndCapturePointOfASteadyMotion) {
  const double speed_m_s = 0.05;
  double x_m = -0.03;
  double com_x_m = 0.0;
  for (int k = 0; k < 600; ++k) {
    x_m += speed_m_s * kTick;
    for (int foot = 0; foot < 2; ++foot) {
      Pose sole_B;
      sole_B.p = Vec3(-x_m, foot == 0 ? -0.039 : 0.039, -params.hip_height_m);
      LegIkResult leg;
      leg_ik(foot, sole_B, leg);
      ASSERT_EQ(leg.status, LegIk::ok);
      std::copy(leg.q_rad, leg.q_rad + 6, in.q_enc_rad + leg_first_joint(foot));
      feet.support[foot] = k < 400 || foot == 0;
    }
    Kinematics kin;
    forward_kinematics(in.q_enc_rad, kin);
    const double com_rate_m_s = (kin.com_B.x() + x_m - com_x_m) / kTick;  // the legs lag behind the pelvis
    com_x_m = kin.com_B.x() + x_m;
    for (int cell = 0; cell < 8; ++cell) in.cell_force_N[cell] = (cell < 4) == (k < 300) ? 12.0 : 5.0;
    const double before_m_s = sense.com_rate_O_m_s[0];
    step();
    if (k > 200) {
      ASSERT_NEAR(sense.com_rate_O_m_s[0], com_rate_m_s, 0.01 * speed_m_s);
      ASSERT_NEAR(sense.com_rate_O_m_s[0], before_m_s, 1e-3);
      ASSERT_NEAR(sense.cp_O_m[0], sense.com_O_m[0] + sense.com_rate_O_m_s[0] / kOmega, 1e-15);
    }
  }
}

}  // namespace
