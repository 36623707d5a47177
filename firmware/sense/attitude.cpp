#include "sense/attitude.hpp"

#include "robot/rotation.hpp"
#include "sense/sense.h"

namespace hoap2 {
namespace {

constexpr double kTick_s = 1e-6 * HOAP2_TICK_US;
constexpr double kMinAccel_m_s2 = 1.0;  // below this (free fall) the accelerometer shows no vertical

using MapVec3 = Eigen::Map<Vec3>;
using ConstMapVec3 = Eigen::Map<const Vec3>;

}  // namespace

void roll_pitch_from_up(const double up[3], double& roll_rad, double& pitch_rad) {
  roll_rad = hoap2_atan2(up[1], up[2]);
  pitch_rad = hoap2_atan2(-up[0], hoap2_sqrt(up[1] * up[1] + up[2] * up[2]));
}

void attitude_step(const hoap2_inputs_t& inputs, double tau_s, hoap2_sense_t& sense) {
  MapVec3 up(sense.up_S);
  const ConstMapVec3 accel(inputs.accel_S_m_s2);
  const double magnitude = hoap2_sqrt(accel.squaredNorm());
  if (!sense.started) {
    if (magnitude > kMinAccel_m_s2) up = accel / magnitude;
  } else {
    // A direction that is fixed in the world turns backwards in the chest.
    const Vec3 omega = ConstMapVec3(inputs.gyro_S_rad_s) - ConstMapVec3(sense.gyro_bias_S_rad_s);
    Vec3 next = up - kTick_s * omega.cross(up);
    if (magnitude > kMinAccel_m_s2) next += (kTick_s / tau_s) * (accel / magnitude - up);
    up = next / hoap2_sqrt(next.squaredNorm());
  }
  roll_pitch_from_up(sense.up_S, sense.roll_rad, sense.pitch_rad);
}

}  // namespace hoap2

extern "C" {

void hoap2_sense_calibrate_begin(hoap2_sense_t* sense) {
  for (int i = 0; i < 3; ++i) {
    sense->gyro_sum_S_rad_s[i] = 0.0;
    sense->accel_sum_S_m_s2[i] = 0.0;
  }
  sense->sum_count = 0;
}

void hoap2_sense_calibrate_add(const hoap2_inputs_t* inputs, hoap2_sense_t* sense) {
  for (int i = 0; i < 3; ++i) {
    sense->gyro_sum_S_rad_s[i] += inputs->gyro_S_rad_s[i];
    sense->accel_sum_S_m_s2[i] += inputs->accel_S_m_s2[i];
  }
  ++sense->sum_count;
}

void hoap2_sense_calibrate_end(hoap2_sense_t* sense) {
  if (sense->sum_count == 0) return;
  const double count = static_cast<double>(sense->sum_count);
  const hoap2::Vec3 accel = Eigen::Map<const hoap2::Vec3>(sense->accel_sum_S_m_s2) / count;
  const double magnitude = hoap2_sqrt(accel.squaredNorm());
  for (int i = 0; i < 3; ++i) {
    sense->gyro_bias_S_rad_s[i] = sense->gyro_sum_S_rad_s[i] / count;
    if (magnitude > hoap2::kMinAccel_m_s2) sense->up_S[i] = accel[i] / magnitude;
  }
  hoap2::roll_pitch_from_up(sense->up_S, sense->roll_rad, sense->pitch_rad);
}

}  // extern "C"
