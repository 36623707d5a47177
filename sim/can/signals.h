// The controller's signals as the link's callers give and take them.
#ifndef HOAP2_SIM_CAN_SIGNALS_H
#define HOAP2_SIM_CAN_SIGNALS_H

#include <cstring>

#include "hoap2/generated/signals.h"
#include "hoap2_link/link.h"

namespace hoap2_sim {

// What the controller's node reads of the controller's outputs.
inline hoap2_outputs_t outputs_of(const hoap2_link_command_t &asked) {
  hoap2_outputs_t out = {};
  std::memcpy(out.q_ref_rad, asked.q_ref_rad, sizeof out.q_ref_rad);
  std::memcpy(out.qd_ref_rad_s, asked.qd_ref_rad_s, sizeof out.qd_ref_rad_s);
  std::memcpy(out.tau_ff_Nm, asked.tau_ff_Nm, sizeof out.tau_ff_Nm);
  std::memcpy(out.kp_Nm_rad, asked.kp_Nm_rad, sizeof out.kp_Nm_rad);
  std::memcpy(out.kd_Nms_rad, asked.kd_Nms_rad, sizeof out.kd_Nms_rad);
  std::memcpy(out.drive_mode, asked.drive_mode, sizeof out.drive_mode);
  return out;
}

inline void tell_controller(const hoap2_inputs_t &inputs, hoap2_link_measured_t *to_controller) {
  *to_controller = {};
  std::memcpy(to_controller->q_enc_rad, inputs.q_enc_rad, sizeof inputs.q_enc_rad);
  std::memcpy(to_controller->gyro_S_rad_s, inputs.gyro_S_rad_s, sizeof inputs.gyro_S_rad_s);
  std::memcpy(to_controller->accel_S_m_s2, inputs.accel_S_m_s2, sizeof inputs.accel_S_m_s2);
  std::memcpy(to_controller->cell_force_N, inputs.cell_force_N, sizeof inputs.cell_force_N);
  to_controller->sensor_tick = inputs.sensor_tick;
}

}  // namespace hoap2_sim

#endif
