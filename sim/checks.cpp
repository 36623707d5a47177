#include "checks.h"

#include <cmath>

#include "drive/drive.h"
#include "hoap2/generated/names.h"

namespace hoap2_sim {
namespace {

// No drive command is meaningful beyond this; keeps sums and products finite.
constexpr double kInputLimit = 1e6;
// A body faster than this has left physics.
constexpr double kSpeedLimit = 1e4;
constexpr double kQuatTolerance = 1e-6;
constexpr double kPostureTolerance_rad = 1e-6;

// The generated range check only counts: find the parameter by putting the default
// back, one parameter at a time, and seeing the count fall.
#define HOAP2_TRY(name)                                                                            \
  do {                                                                                             \
    hoap2_plant_params_t trial_ = params;                                                          \
    for (std::size_t i_ = 0; i_ < sizeof trial_.name; ++i_) {                                      \
      reinterpret_cast<char *>(&trial_.name)[i_] = reinterpret_cast<const char *>(&good.name)[i_]; \
    }                                                                                              \
    if (hoap2_plant_params_out_of_range(&trial_) < bad) return #name;                              \
  } while (false)

const char *name_of_bad_parameter(const hoap2_plant_params_t &params, int bad) {
  hoap2_plant_params_t good = {};
  hoap2_plant_params_defaults(&good);
  HOAP2_TRY(start_pos_W_m);
  HOAP2_TRY(start_yaw_W_rad);
  HOAP2_TRY(start_height_m);
  HOAP2_TRY(start_posture_rad);
  HOAP2_TRY(start_vel_W_m_s);
  HOAP2_TRY(start_omega_W_rad_s);
  HOAP2_TRY(gravity_m_s2);
  HOAP2_TRY(gyro_bias_S_rad_s);
  HOAP2_TRY(cell_gain);
  HOAP2_TRY(chest_com_shift_L_m);
  HOAP2_TRY(floor_tilt_rad);
  HOAP2_TRY(solver);
  HOAP2_TRY(friction_law);
  HOAP2_TRY(ground);
  HOAP2_TRY(soil_law);
  HOAP2_TRY(soil_links);
  HOAP2_TRY(soil_patches);
  HOAP2_TRY(soil_size_m);
  HOAP2_TRY(soil_centre_m);
  HOAP2_TRY(soil_cell_m);
  HOAP2_TRY(soil_kc_N_m_n1);
  HOAP2_TRY(soil_kphi_N_m_n2);
  HOAP2_TRY(soil_n);
  HOAP2_TRY(soil_cohesion_Pa);
  HOAP2_TRY(soil_friction_rad);
  HOAP2_TRY(soil_shear_m);
  HOAP2_TRY(soil_unload_Pa_m);
  HOAP2_TRY(soil_unload_Pa_m2);
  HOAP2_TRY(soil_damping_Pas_m);
  HOAP2_TRY(soil_heave);
  HOAP2_TRY(soil_repose_rad);
  HOAP2_TRY(soil_edge_loss);
  HOAP2_TRY(soil_edge_m);
  HOAP2_TRY(soil_rft_zeta);
  HOAP2_TRY(soil_roughness_m);
  HOAP2_TRY(soil_roughness_length_m);
  HOAP2_TRY(soil_seed);
  HOAP2_TRY(friction_mu);
  HOAP2_TRY(contact_stiffness_N_m);
  HOAP2_TRY(contact_damping_Ns_m);
  HOAP2_TRY(block_centre_W_m);
  HOAP2_TRY(block_size_m);
  HOAP2_TRY(block_yaw_W_rad);
  HOAP2_TRY(joint_friction_scale);
  HOAP2_TRY(roll_stiffness_Nm_rad);
  HOAP2_TRY(roll_damping_Nms_rad);
  HOAP2_TRY(push_force_W_N);
  HOAP2_TRY(push_point_L_m);
  HOAP2_TRY(push_start_s);
  HOAP2_TRY(push_duration_s);
  HOAP2_TRY(push_ramp_s);
  HOAP2_TRY(seed);
  HOAP2_TRY(sensor_preset);
  HOAP2_TRY(block_count);
  HOAP2_TRY(push_link);
  return "a parameter";
}
#undef HOAP2_TRY

std::string input_fault(const char *signal, int joint) {
  return std::string("input ") + signal + " of joint " + HOAP2_JOINT_NAME[joint] + " is not usable";
}

}  // namespace

std::string fault_of_params(const hoap2_plant_params_t &params) {
  const int bad = hoap2_plant_params_out_of_range(&params);
  if (bad != 0) {
    return std::string("parameter ") + name_of_bad_parameter(params, bad) +
           " is out of its range (see docs/generated/signals.md)";
  }
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    const double *const hard_rad = HOAP2_JOINT[j].limit_hard_rad;
    const double q_rad = params.start_posture_rad[j];
    if (q_rad < hard_rad[0] - kPostureTolerance_rad || q_rad > hard_rad[1] + kPostureTolerance_rad) {
      return std::string("parameter start_posture_rad: joint ") + HOAP2_JOINT_NAME[j] +
             " starts beyond its mechanical stop";
    }
  }
  if (params.solver == HOAP2_SOLVER_ODE && params.friction_law == HOAP2_FRICTION_LAW_CONE) {
    return "parameter friction_law: ODE's solver knows only the pyramid; leave friction_law out, or take "
           "solver = articulated";
  }
  if (params.ground == HOAP2_GROUND_SOIL && params.solver == HOAP2_SOLVER_ODE) {
    return "parameter ground: ODE's solver knows only the rigid floor; take solver = articulated for soil";
  }
  return "";
}

std::string fault_of_inputs(const hoap2_plant_inputs_t &in) {
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    // Written so that NaN fails.
    if (!(std::fabs(in.q_ref_rad[j]) <= kInputLimit)) return input_fault("q_ref_rad", j);
    if (!(std::fabs(in.qd_ref_rad_s[j]) <= kInputLimit)) return input_fault("qd_ref_rad_s", j);
    if (!(std::fabs(in.tau_ff_Nm[j]) <= kInputLimit)) return input_fault("tau_ff_Nm", j);
    if (!(in.kp_Nm_rad[j] >= 0.0 && in.kp_Nm_rad[j] <= kInputLimit)) return input_fault("kp_Nm_rad", j);
    if (!(in.kd_Nms_rad[j] >= 0.0 && in.kd_Nms_rad[j] <= kInputLimit)) return input_fault("kd_Nms_rad", j);
    if (in.drive_mode[j] < 0 || in.drive_mode[j] >= kDriveModes) return input_fault("drive_mode", j);
  }
  for (int i = 0; i < 3; ++i) {
    const double force_N = in.push_now_force_W_N[i], point_m = in.push_now_point_L_m[i];
    if (!(force_N >= HOAP2_PUSH_NOW_FORCE_W_N_LOW && force_N <= HOAP2_PUSH_NOW_FORCE_W_N_HIGH))
      return "input push_now_force_W_N is out of its range";
    if (!(point_m >= HOAP2_PUSH_NOW_POINT_L_M_LOW && point_m <= HOAP2_PUSH_NOW_POINT_L_M_HIGH))
      return "input push_now_point_L_m is out of its range";
  }
  if (in.push_now_link < HOAP2_PUSH_NOW_LINK_LOW || in.push_now_link > HOAP2_PUSH_NOW_LINK_HIGH)
    return "input push_now_link is out of its range";
  return "";
}

// Drives, sensors, wrenches: finite, and not beyond what any run reaches.
std::string fault_of_memory(const State &state) {
  constexpr double kLimit = 1e9;
  const auto sane = [](const double *first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      if (!(std::fabs(first[i]) <= kLimit)) return false;
    }
    return true;
  };
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    const DriveState &drive = state.drive[j];
    const double values[] = {drive.link_q_rad,     drive.link_qd_rad_s,         drive.rotor_q_rad,
                             drive.rotor_qd_rad_s, drive.rotor_qd_before_rad_s, drive.tau_Nm};
    if (!sane(values, 6)) return std::string("drive of ") + HOAP2_JOINT_NAME[j];
  }
  const SensorState &sensors = state.sensors;
  for (const SensorFrame *frame : {&sensors.now, &sensors.shown}) {
    if (!sane(frame->q_enc_rad, HOAP2_JOINTS) || !sane(frame->gyro_S_rad_s, 3) ||
        !sane(frame->accel_S_m_s2, 3) || !sane(frame->cell_force_N, 8)) {
      return "sensor frame";
    }
  }
  if (!sane(sensors.gyro_lp_S_rad_s, 3) || !sane(sensors.accel_lp_S_m_s2, 3) ||
      !sane(sensors.imu_vel_W_m_s, 3)) {
    return "sensor filters";
  }
  for (const FootWrench &foot : state.foot) {
    if (!sane(foot.force_W_N, 3) || !sane(foot.moment_W_Nm, 3)) return "foot wrench";
  }
  for (const BodyState &body : state.body) {
    if (!sane(body.omega_before_W_rad_s, 3)) return "body rates";
  }
  return sane(state.cop_W_m, 2) && sane(state.push_force_W_N, 3) && sane(state.sinkage_m, 2) &&
                 state.tick >= 0
             ? ""
             : "outputs or tick";
}

std::string fault_of_bodies(const State &state) {
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    const BodyState &body = state.body[link];
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
      sum += std::fabs(body.com_vel_W_m_s[i]) + std::fabs(body.omega_W_rad_s[i]) + 0.0 * body.com_pos_W_m[i];
    }
    double square = 0.0;
    for (const double q : body.quat_W) square += q * q;
    if (!(sum <= kSpeedLimit) || !(std::fabs(square - 1.0) < kQuatTolerance)) {
      return std::string("the simulation diverged at link ") + HOAP2_LINK_NAME[link] +
             "; the state before this tick is kept";
    }
  }
  return "";
}

}  // namespace hoap2_sim
