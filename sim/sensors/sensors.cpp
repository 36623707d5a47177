#include "sensors/sensors.h"

#include <cmath>

#include "drive/drive.h"
#include "robot/kinematics.h"
#include "sensors/cells.h"
#include "sensors/noise.h"

namespace hoap2_sim {
namespace {

constexpr double kTwoPi = 6.283185307179586;
constexpr double kCellAccurateAbove_N = 10.0;
constexpr double kCellError_N = 1.0;

double reading(double value, double lsb, double range) {
  const double shown = lsb * std::nearbyint(value / lsb);
  return shown > range ? range : (shown < -range ? -range : shown);
}

// Step of a first-order low-pass over one tick, exact for an input held over it.
double low_pass(double value, double input, double bandwidth_Hz) {
  return value + (1.0 - std::exp(-kTwoPi * bandwidth_Hz * kTick_s)) * (input - value);
}

struct Imu {
  Vec3 gyro_S_rad_s, accel_S_m_s2;
};

// Specific force = acceleration of the sensor point (velocity difference over the
// tick) minus gravity, in chest axes.
Imu imu_truth(const State &s, const Vec3 &vel_before_W_m_s, const Vec3 &vel_W_m_s) {
  const Mat3 chest_axes = link_axes_W(s, HOAP2_IMU_LINK);
  const Vec3 up_g = {0.0, 0.0, s.params.gravity_m_s2};
  const Vec3 specific_W_m_s2 = (1.0 / kTick_s) * (vel_W_m_s - vel_before_W_m_s) + up_g;
  return {turn_back(chest_axes, vec(s.body[HOAP2_IMU_LINK].omega_W_rad_s)),
          turn_back(chest_axes, specific_W_m_s2)};
}

void measure_imu(State *s, const Imu &truth, SensorFrame *frame) {
  SensorState &sensors = s->sensors;
  double noise[6];
  for (int i = 0; i < 6; i += 2) noise_normal_pair(s->noise, &noise[i], &noise[i + 1]);
  for (int i = 0; i < 3; ++i) {
    double &gyro = sensors.gyro_lp_S_rad_s[i], &accel = sensors.accel_lp_S_m_s2[i];
    gyro = low_pass(gyro, truth.gyro_S_rad_s[i], HOAP2_GYRO_BANDWIDTH_HZ);
    accel = low_pass(accel, truth.accel_S_m_s2[i], HOAP2_ACCEL_BANDWIDTH_HZ);
    frame->gyro_S_rad_s[i] = reading(gyro + s->params.gyro_bias_S_rad_s[i] + HOAP2_GYRO_LSB_RAD_S * noise[i],
                                     HOAP2_GYRO_LSB_RAD_S, HOAP2_GYRO_RANGE_RAD_S);
    frame->accel_S_m_s2[i] =
        reading(accel + HOAP2_ACCEL_LSB_M_S2 * noise[3 + i], HOAP2_ACCEL_LSB_M_S2, HOAP2_ACCEL_RANGE_M_S2);
  }
}

void cells_truth(const State &s, int foot, double cell_N[4]) {
  const Mat3 axes = link_axes_W(s, kFootLink[foot]);
  const Vec3 force_L_N = turn_back(axes, vec(s.foot[foot].force_W_N));
  const Vec3 moment_L_Nm = turn_back(axes, vec(s.foot[foot].moment_W_Nm));
  if (force_L_N.z <= 0.0) {
    for (int i = 0; i < 4; ++i) cell_N[i] = 0.0;
    return;
  }
  plate_on_springs(force_L_N.z, -moment_L_Nm.y / force_L_N.z, moment_L_Nm.x / force_L_N.z, cell_N);
}

void measure_cells(State *s, const double truth_N[8], SensorFrame *frame) {
  for (int i = 0; i < 8; ++i) {
    // Drawn whether used or not: the sequence does not depend on the loads.
    const double error_N = kCellError_N * (2.0 * noise_uniform(s->noise) - 1.0);
    const double gained_N = s->params.cell_gain[i] * truth_N[i];
    frame->cell_force_N[i] = std::fmax(0.0, gained_N < kCellAccurateAbove_N ? gained_N + error_N : gained_N);
  }
}

void measure(State *s, const Imu &imu) {
  SensorState &sensors = s->sensors;
  SensorFrame frame = {};
  frame.number = sensors.now.number + 1;
  double cell_N[8];
  for (int foot = 0; foot < 2; ++foot) cells_truth(*s, foot, &cell_N[4 * foot]);
  const bool real = s->params.sensor_preset == kPresetHoap2;
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    frame.q_enc_rad[j] = real ? quantised_rad(s->drive[j].rotor_q_rad) : s->drive[j].rotor_q_rad;
  }
  if (real) {
    measure_imu(s, imu, &frame);
    measure_cells(s, cell_N, &frame);
  } else {
    put(imu.gyro_S_rad_s, frame.gyro_S_rad_s);
    put(imu.accel_S_m_s2, frame.accel_S_m_s2);
    for (int i = 0; i < 8; ++i) frame.cell_force_N[i] = cell_N[i];
  }
  sensors.shown = real ? sensors.now : frame;
  sensors.now = frame;
}

}  // namespace

void sensors_start(State *s) {
  noise_seed(s->noise, static_cast<std::uint64_t>(s->params.seed));
  const Vec3 vel_W_m_s = point_vel_W_m_s(*s, HOAP2_IMU_LINK, vec(HOAP2_IMU_POS_L_M));
  const Imu imu = imu_truth(*s, vel_W_m_s, vel_W_m_s);
  put(vel_W_m_s, s->sensors.imu_vel_W_m_s);
  put(imu.gyro_S_rad_s, s->sensors.gyro_lp_S_rad_s);
  put(imu.accel_S_m_s2, s->sensors.accel_lp_S_m_s2);
  measure(s, imu);
  // The start's frame is shown as number 0. One frame late means that the first tick
  // shows it again, as frame 1.
  s->sensors.shown = s->sensors.now;
  s->sensors.shown.number = 0;
  s->sensors.now.number = s->params.sensor_preset == kPresetHoap2 ? 1 : 0;
}

void sensors_measure(State *s) {
  const Vec3 vel_W_m_s = point_vel_W_m_s(*s, HOAP2_IMU_LINK, vec(HOAP2_IMU_POS_L_M));
  const Imu imu = imu_truth(*s, vec(s->sensors.imu_vel_W_m_s), vel_W_m_s);
  put(vel_W_m_s, s->sensors.imu_vel_W_m_s);
  measure(s, imu);
}

}  // namespace hoap2_sim
