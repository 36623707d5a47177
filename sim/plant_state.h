// Everything the plant remembers, as one plain block. The physics engine is
// rewritten from it at the start of every tick, so a restored block continues bit
// for bit: nothing of the engine survives a tick.
#ifndef HOAP2_SIM_PLANT_STATE_H
#define HOAP2_SIM_PLANT_STATE_H

#include <cstdint>
#include <type_traits>

#include "hoap2/generated/robot_model.h"
#include "hoap2_plant/plant.h"

namespace hoap2_sim {

constexpr double kTick_s = 1e-3;
constexpr std::uint64_t kStateMagic = 0x32504c4e54504f48ULL;
constexpr std::uint32_t kStateVersion = 3;

// A link's centre of mass; the axes are the link's.
struct BodyState {
  double com_pos_W_m[3];
  double quat_W[4];
  double com_vel_W_m_s[3];
  double omega_W_rad_s[3];
  double omega_before_W_rad_s[3];  // a tick earlier
};

// A joint: the link side as the bodies have it, and the rotor side, which is equal to it
// unless the joint is compliant.
struct DriveState {
  double link_q_rad;
  double link_qd_rad_s;
  double rotor_q_rad;
  double rotor_qd_rad_s;
  double rotor_qd_before_rad_s;  // a tick earlier
  double tau_Nm;                 // drive torque of the last tick, after limits
};

struct SensorFrame {
  double q_enc_rad[HOAP2_JOINTS];
  double gyro_S_rad_s[3];
  double accel_S_m_s2[3];
  double cell_force_N[8];
  std::int64_t number;
};

struct SensorState {
  SensorFrame now;    // what the sensors measured in the last tick
  SensorFrame shown;  // what the outputs show (one frame older in the preset hoap2)
  double gyro_lp_S_rad_s[3];
  double accel_lp_S_m_s2[3];
  double imu_vel_W_m_s[3];  // velocity of the sensor point at the end of the last tick
};

// Contact wrench on a foot in the last tick, about the sole point under its ankle.
struct FootWrench {
  double force_W_N[3];
  double moment_W_Nm[3];
};

struct State {
  std::uint64_t magic;
  std::uint32_t version;
  std::uint32_t size;  // of the whole block: this and what follows it (the soil)
  hoap2_plant_params_t params;
  BodyState body[HOAP2_LINKS];
  DriveState drive[HOAP2_JOINTS];
  SensorState sensors;
  FootWrench foot[2];  // right, left
  double cop_W_m[2];
  double push_force_W_N[3];
  std::uint64_t noise[4];
  std::int64_t tick;
  std::int64_t other_contacts;
  double sinkage_m[2];  // mean over each sole
};

static_assert(std::is_trivially_copyable<State>::value, "the state is saved by memcpy");

}  // namespace hoap2_sim
#endif
