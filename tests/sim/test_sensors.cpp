// The sensors: cells, inertial unit, encoders; both presets.
#include <gtest/gtest.h>

#include <vector>

#include "drive/drive.h"
#include "rig.h"
#include "sensors/cells.h"
#include "sensors/noise.h"

namespace hoap2_sim {
namespace {

struct CellSum {
  double force_N = 0.0, x_m = 0.0, y_m = 0.0;
};
CellSum sum_of(const double cell_N[4]) {
  CellSum sum;
  for (int i = 0; i < 4; ++i) {
    sum.force_N += cell_N[i];
    sum.x_m += cell_N[i] * HOAP2_CELL_POS_L_M[i][0];
    sum.y_m += cell_N[i] * HOAP2_CELL_POS_L_M[i][1];
  }
  sum.x_m /= sum.force_N;
  sum.y_m /= sum.force_N;
  return sum;
}

TEST(Cells, CarryTheForceAndTheCopWithoutPulling) {
  for (double x = -0.0275; x <= 0.0456; x += 0.00365) {
    for (double y = -0.0185; y <= 0.0186; y += 0.00185) {
      double cell_N[4];
      plate_on_springs(35.0, x, y, cell_N);
      for (const double f : cell_N) EXPECT_GE(f, -1e-12);
      const CellSum sum = sum_of(cell_N);
      EXPECT_NEAR(35.0, sum.force_N, 1e-9);
      EXPECT_NEAR(x, sum.x_m, 1e-9);
      EXPECT_NEAR(y, sum.y_m, 1e-9);
    }
  }
}

TEST(Cells, CentralLoadIsSharedEquallyAndOutsideIsClamped) {
  double cell_N[4];
  plate_on_springs(40.0, 0.009, 0.0, cell_N);
  for (const double f : cell_N) EXPECT_NEAR(10.0, f, 1e-9);
  plate_on_springs(40.0, 0.2, 0.01, cell_N);
  EXPECT_NEAR(0.0455, sum_of(cell_N).x_m, 1e-12);
  EXPECT_NEAR(0.01, sum_of(cell_N).y_m, 1e-12);
  plate_on_springs(-5.0, 0.0, 0.0, cell_N);
  for (const double f : cell_N) EXPECT_EQ(0.0, f);
}

TEST(Cells, StandingRobotReadsItsWeightAndCop) {
  Rig rig;
  rig.params.floor_tilt_rad[0] = 0.01;
  rig.start();
  rig.step(2000);
  const hoap2_plant_outputs_t out = rig.out();
  double weight_N = 0.0, x = 0.0, y = 0.0;
  for (int i = 0; i < 8; ++i) {
    const int foot = i / 4;
    weight_N += out.cell_force_N[i];
    x += out.cell_force_N[i] * (out.true_foot_pos_W_m[foot][0] + HOAP2_CELL_POS_L_M[i % 4][0]);
    y += out.cell_force_N[i] * (out.true_foot_pos_W_m[foot][1] + HOAP2_CELL_POS_L_M[i % 4][1]);
  }
  EXPECT_NEAR(kMg_N, weight_N, 1e-3 * kMg_N);
  EXPECT_NEAR(out.true_cop_W_m[0], x / weight_N, 1e-4);
  EXPECT_NEAR(out.true_cop_W_m[1], y / weight_N, 1e-4);
}

TEST(Cells, GainsAndErrorsOfThePreset) {
  Rig rig;
  rig.params.sensor_preset = 1;
  rig.params.cell_gain[0] = 1.2;  // 1.2 * 9 N: still beside the limit of 10 N
  rig.params.joint_friction_scale = 0.0;
  rig.start();
  rig.step(1000);
  double mean_N[8] = {}, low_N[8], high_N[8];
  for (int k = 0; k < 8; ++k) low_N[k] = 1e9, high_N[k] = -1e9;
  for (int i = 0; i < 1000; ++i) {
    rig.step();
    const hoap2_plant_outputs_t out = rig.out();
    for (int k = 0; k < 8; ++k) {
      mean_N[k] += out.cell_force_N[k] / 1000.0;
      low_N[k] = std::fmin(low_N[k], out.cell_force_N[k]);
      high_N[k] = std::fmax(high_N[k], out.cell_force_N[k]);
    }
  }
  EXPECT_NEAR(1.2, mean_N[0] / mean_N[1], 0.05);
  EXPECT_GT(high_N[2] - low_N[2], 1.8) << "+-1 N below 10 N, and the robot's own sway";
  EXPECT_LT(high_N[2] - low_N[2], 3.0);
  EXPECT_GT(low_N[2], 5.0) << "never cut";
}

TEST(Cells, UnloadedCellsReadNearZeroAndNeverBelow) {
  Rig rig;
  rig.params.sensor_preset = 1;
  rig.params.start_height_m = 2.0;
  rig.start();
  for (int i = 0; i < 200; ++i) {
    rig.step();
    const hoap2_plant_outputs_t out = rig.out();
    for (const double f : out.cell_force_N) {
      EXPECT_GE(f, 0.0);
      EXPECT_LE(f, 1.0);
    }
  }
}

TEST(Imu, AtRestShowsGravityInChestAxes) {
  Rig rig;
  rig.params.floor_tilt_rad[0] = 0.03;
  rig.params.floor_tilt_rad[1] = 0.02;
  rig.start();
  rig.step(3000);
  const hoap2_plant_outputs_t out = rig.out();
  const double roll = out.true_chest_rpy_rad[0], pitch = out.true_chest_rpy_rad[1];
  EXPECT_NEAR(-9.81 * std::sin(pitch), out.accel_S_m_s2[0], 2e-3);
  EXPECT_NEAR(9.81 * std::cos(pitch) * std::sin(roll), out.accel_S_m_s2[1], 2e-3);
  EXPECT_NEAR(9.81 * std::cos(pitch) * std::cos(roll), out.accel_S_m_s2[2], 2e-3);
  EXPECT_GT(std::fabs(out.accel_S_m_s2[0]), 0.1);
  for (const double g : out.gyro_S_rad_s) EXPECT_NEAR(0.0, g, 1e-4);
}

TEST(Imu, FreeFallReadsNothingAndSpinReadsTheCentripetalAcceleration) {
  Rig rig;
  rig.params.start_height_m = 20.0;
  rig.posture({});
  rig.start();
  rig.step(5);
  EXPECT_NEAR(0.0, norm(vec(rig.out().accel_S_m_s2)), 1e-6);

  Rig spun;
  spun.float_free();
  spun.posture({});
  spun.params.start_omega_W_rad_s[2] = 1.0;
  spun.start();
  spun.step(3);
  const State s = spun.state();
  const hoap2_plant_outputs_t out = spun.out();
  const Vec3 arm_W_m = point_W_m(s, HOAP2_L_CHEST, vec(HOAP2_IMU_POS_L_M)) - vec(out.true_com_W_m);
  const Vec3 inward_S = turn_back(link_axes_W(s, HOAP2_L_CHEST), Vec3{-arm_W_m.x, -arm_W_m.y, 0.0});
  EXPECT_NEAR(inward_S.x, out.accel_S_m_s2[0], 5e-3);
  EXPECT_NEAR(1.0, out.gyro_S_rad_s[2], 1e-3);
}

TEST(Imu, BiasAndNoiseHaveTheirSize) {
  Rig rig;
  rig.params.sensor_preset = 1;
  rig.params.seed = 7;
  rig.params.gyro_bias_S_rad_s[0] = 0.008;
  rig.params.gyro_bias_S_rad_s[1] = -0.005;
  rig.start();
  rig.step(500);
  const int n = 4000;
  double sum[6] = {}, square[6] = {};
  for (int i = 0; i < n; ++i) {
    rig.step();
    const hoap2_plant_outputs_t out = rig.out();
    for (int k = 0; k < 6; ++k) {
      const double v = k < 3 ? out.gyro_S_rad_s[k] : out.accel_S_m_s2[k - 3];
      const double lsb = k < 3 ? HOAP2_GYRO_LSB_RAD_S : HOAP2_ACCEL_LSB_M_S2;
      EXPECT_NEAR(std::nearbyint(v / lsb), v / lsb, 1e-9);
      sum[k] += v / lsb;
      square[k] += v / lsb * v / lsb;
    }
  }
  const double expected[6] = {0.008 / HOAP2_GYRO_LSB_RAD_S, -0.005 / HOAP2_GYRO_LSB_RAD_S, 0.0};
  for (int k = 0; k < 6; ++k) {
    const double mean = sum[k] / n;
    if (k < 3) {
      EXPECT_NEAR(expected[k], mean, 0.07) << k;
    }
    // 1 LSB of noise and the quantisation's 1/12
    EXPECT_NEAR(std::sqrt(1.0 + 1.0 / 12.0), std::sqrt(square[k] / n - mean * mean), 0.05) << k;
  }
}

TEST(Imu, RangeIsClipped) {
  Rig rig;
  rig.params.sensor_preset = 1;
  rig.float_free();
  rig.params.start_omega_W_rad_s[2] = 5.0;
  rig.start();
  rig.step(10);
  EXPECT_EQ(HOAP2_GYRO_RANGE_RAD_S, rig.out().gyro_S_rad_s[2]);
}

// The same motion with both presets (drives off: counts do not matter): the gyro of
// the preset is the truth behind a 10 Hz low-pass and one frame.
TEST(Imu, GyroIsLowPassedAndLate) {
  Rig ideal, real;
  for (Rig *rig : {&ideal, &real}) {
    rig->float_free();
    rig->params.push_link[0] = HOAP2_L_CHEST;
    rig->params.push_force_W_N[0][1] = 4.0;
    rig->params.push_point_L_m[0][2] = 0.15;
    rig->params.push_start_s[0] = 0.02;
    rig->params.push_duration_s[0] = 0.05;
  }
  real.params.sensor_preset = 1;
  for (Rig *rig : {&ideal, &real}) {
    rig->start();
    rig->mode_of_all(kDriveOff);
  }
  const double share = 1.0 - std::exp(-2.0 * std::acos(-1.0) * HOAP2_GYRO_BANDWIDTH_HZ * kTick_s);
  double filtered = 0.0, late = 0.0, error = 0.0, truth_error = 0.0;
  for (int i = 0; i < 120; ++i) {
    ideal.step();
    real.step();
    late = filtered;
    filtered += share * (ideal.out().gyro_S_rad_s[0] - filtered);
    error += std::pow(real.out().gyro_S_rad_s[0] - late, 2.0);
    truth_error += std::pow(real.out().gyro_S_rad_s[0] - ideal.out().gyro_S_rad_s[0], 2.0);
  }
  EXPECT_LT(std::sqrt(error / 120.0), 1.3 * HOAP2_GYRO_LSB_RAD_S);
  EXPECT_GT(std::sqrt(truth_error / 120.0), 5.0 * HOAP2_GYRO_LSB_RAD_S);
}

TEST(Encoders, AreQuantisedAndOneFrameLate) {
  Rig rig;
  rig.params.sensor_preset = 1;
  rig.start();
  const int j = HOAP2_J_R_SHOULDER_PITCH;
  rig.inputs.q_ref_rad[j] -= 0.3;
  double before = rig.out().true_q_rad[j];
  for (int i = 1; i <= 100; ++i) {
    rig.step();
    const hoap2_plant_outputs_t out = rig.out();
    EXPECT_EQ(quantised_rad(before), out.q_enc_rad[j]);
    EXPECT_EQ(i, out.sensor_tick);
    before = out.true_q_rad[j];
  }
  EXPECT_LT(before, rig.params.start_posture_rad[j] - 0.1);
}

TEST(Encoders, IdealShowsThePresentAngle) {
  Rig rig;
  rig.start();
  rig.inputs.q_ref_rad[HOAP2_J_R_ELBOW] -= 0.2;
  for (int i = 1; i <= 30; ++i) {
    rig.step();
    EXPECT_EQ(rig.out().true_q_rad[HOAP2_J_R_ELBOW], rig.out().q_enc_rad[HOAP2_J_R_ELBOW]);
    EXPECT_EQ(i, rig.out().sensor_tick);
  }
}

TEST(Noise, SeedsDifferAndRepeat) {
  std::uint64_t a[4], b[4], c[4];
  noise_seed(a, 1);
  noise_seed(b, 1);
  noise_seed(c, 2);
  const double first = noise_uniform(a);
  EXPECT_EQ(first, noise_uniform(b));
  EXPECT_NE(first, noise_uniform(c));
  double sum = 0.0, square = 0.0;
  for (int i = 0; i < 20000; ++i) {
    double x, y;
    noise_normal_pair(a, &x, &y);
    sum += x + y;
    square += x * x + y * y;
  }
  EXPECT_NEAR(0.0, sum / 40000.0, 0.02);
  EXPECT_NEAR(1.0, square / 40000.0, 0.03);
}

}  // namespace
}  // namespace hoap2_sim
