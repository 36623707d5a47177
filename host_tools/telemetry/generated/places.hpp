// Generated from firmware/signals.toml and firmware/hoap2.json by ./hoap2 generate: do not edit.
#ifndef HOAP2_TELEMETRY_PLACES_H
#define HOAP2_TELEMETRY_PLACES_H
#include <cstddef>
#include "hoap2_lcm/state_t.hpp"
#include "hoap2_lcm/gait_t.hpp"
#include "hoap2_lcm/truth_t.hpp"

namespace hoap2::telemetry {

struct place_t {
  std::size_t offset;
  int count;
  bool real; // double; else int32_t
};

struct fault_name_t {
  int bit;
  const char *name;
};

inline constexpr fault_name_t FAULT_NAMES[] = {{1, "bad_input"}, {2, "stale_input"}, {4, "footprint_out_of_reach"}, {8, "joint_limit"}, {16, "bad_parameter"}, {32, "reach_limit"}, {128, "capture_point_lost"}, {64, "joint_too_fast"}};
inline constexpr const char *MODE_NAMES[] = {"start_up", "calibrate", "stand", "walk", "hold", "crouch", "safe"};
inline constexpr place_t STATE_PLACES[] = {
    {offsetof(hoap2_lcm::state_t, q_ref_rad), 25, true},
    {offsetof(hoap2_lcm::state_t, qd_ref_rad_s), 25, true},
    {offsetof(hoap2_lcm::state_t, tau_ff_Nm), 25, true},
    {offsetof(hoap2_lcm::state_t, kp_Nm_rad), 25, true},
    {offsetof(hoap2_lcm::state_t, kd_Nms_rad), 25, true},
    {offsetof(hoap2_lcm::state_t, q_enc_rad), 25, true},
    {offsetof(hoap2_lcm::state_t, gyro_S_rad_s), 3, true},
    {offsetof(hoap2_lcm::state_t, accel_S_m_s2), 3, true},
    {offsetof(hoap2_lcm::state_t, cell_force_N), 8, true},
    {offsetof(hoap2_lcm::state_t, drive_mode), 25, false},
    {offsetof(hoap2_lcm::state_t, sensor_tick), 1, false},
};
inline constexpr place_t GAIT_PLACES[] = {
    {offsetof(hoap2_lcm::gait_t, roll_est_rad), 1, true},
    {offsetof(hoap2_lcm::gait_t, pitch_est_rad), 1, true},
    {offsetof(hoap2_lcm::gait_t, base_pos_W_m), 3, true},
    {offsetof(hoap2_lcm::gait_t, base_quat_W), 4, true},
    {offsetof(hoap2_lcm::gait_t, com_ref_W_m), 3, true},
    {offsetof(hoap2_lcm::gait_t, com_plan_W_m), 2, true},
    {offsetof(hoap2_lcm::gait_t, com_est_W_m), 3, true},
    {offsetof(hoap2_lcm::gait_t, com_rate_est_W_m_s), 3, true},
    {offsetof(hoap2_lcm::gait_t, cop_ref_W_m), 2, true},
    {offsetof(hoap2_lcm::gait_t, cop_est_W_m), 2, true},
    {offsetof(hoap2_lcm::gait_t, cp_ref_W_m), 2, true},
    {offsetof(hoap2_lcm::gait_t, cp_est_W_m), 2, true},
    {offsetof(hoap2_lcm::gait_t, cp_eos_W_m), 2, true},
    {offsetof(hoap2_lcm::gait_t, tpcc_shift_W_m), 2, true},
    {offsetof(hoap2_lcm::gait_t, com_deviation_W_m), 2, true},
    {offsetof(hoap2_lcm::gait_t, landing_shift_W_m), 2, true},
    {offsetof(hoap2_lcm::gait_t, foot_ref_W_m), 6, true},
    {offsetof(hoap2_lcm::gait_t, foot_ref_yaw_W_rad), 2, true},
    {offsetof(hoap2_lcm::gait_t, footprint_W_m_rad), 3, true},
    {offsetof(hoap2_lcm::gait_t, step_advance_m_rad), 3, true},
    {offsetof(hoap2_lcm::gait_t, foot_force_est_N), 2, true},
    {offsetof(hoap2_lcm::gait_t, controller_tick), 1, false},
    {offsetof(hoap2_lcm::gait_t, mode), 1, false},
    {offsetof(hoap2_lcm::gait_t, fault), 1, false},
    {offsetof(hoap2_lcm::gait_t, phase), 1, false},
    {offsetof(hoap2_lcm::gait_t, step_index), 1, false},
    {offsetof(hoap2_lcm::gait_t, steps_done), 1, false},
    {offsetof(hoap2_lcm::gait_t, stance_foot), 1, false},
    {offsetof(hoap2_lcm::gait_t, walk_done), 1, false},
    {offsetof(hoap2_lcm::gait_t, request_state), 1, false},
};
inline constexpr place_t TRUTH_PLACES[] = {
    {offsetof(hoap2_lcm::truth_t, true_base_pos_W_m), 3, true},
    {offsetof(hoap2_lcm::truth_t, true_base_quat_W), 4, true},
    {offsetof(hoap2_lcm::truth_t, true_base_vel_W_m_s), 3, true},
    {offsetof(hoap2_lcm::truth_t, true_base_omega_W_rad_s), 3, true},
    {offsetof(hoap2_lcm::truth_t, true_q_rad), 25, true},
    {offsetof(hoap2_lcm::truth_t, true_qd_rad_s), 25, true},
    {offsetof(hoap2_lcm::truth_t, true_tau_Nm), 25, true},
    {offsetof(hoap2_lcm::truth_t, true_com_W_m), 3, true},
    {offsetof(hoap2_lcm::truth_t, true_com_rate_W_m_s), 3, true},
    {offsetof(hoap2_lcm::truth_t, true_cop_W_m), 2, true},
    {offsetof(hoap2_lcm::truth_t, true_sinkage_m), 2, true},
    {offsetof(hoap2_lcm::truth_t, true_chest_rpy_rad), 3, true},
    {offsetof(hoap2_lcm::truth_t, true_foot_pos_W_m), 6, true},
    {offsetof(hoap2_lcm::truth_t, true_foot_yaw_W_rad), 2, true},
    {offsetof(hoap2_lcm::truth_t, true_foot_force_W_N), 6, true},
    {offsetof(hoap2_lcm::truth_t, true_foot_moment_W_Nm), 6, true},
    {offsetof(hoap2_lcm::truth_t, true_push_force_W_N), 3, true},
    {offsetof(hoap2_lcm::truth_t, plant_tick), 1, false},
    {offsetof(hoap2_lcm::truth_t, other_contacts), 1, false},
};

} // namespace hoap2::telemetry
#endif
