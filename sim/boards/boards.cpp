#include "boards/boards.h"

#include <cmath>

#include "hoap2/generated/robot_model.h"

namespace hoap2_sim {
namespace {

constexpr double kPeakCurrent_A = 3.0;  // at peak torque
constexpr double kAtLimit = 0.999;

}  // namespace

hoap2_can_sensed_t sensed_by(int board, const hoap2_link_measured_t &plant, std::int32_t sample) {
  const hoap2_can_board_data_t &data = HOAP2_CAN_BOARD[board];
  hoap2_can_sensed_t sensed = {};
  sensed.sample = sample;
  for (int j = 0; j < data.joints; ++j) {
    const int joint = data.joint[j];
    const double part = plant.true_tau_Nm[joint] / HOAP2_JOINT[joint].torque_peak_Nm;
    sensed.q_enc_rad[j] = plant.q_enc_rad[joint];
    sensed.current_A[j] = kPeakCurrent_A * part;
    sensed.at_limit[j] = std::fabs(part) >= kAtLimit ? 1 : 0;
  }
  for (int i = 0; data.kind == HOAP2_CAN_BOARD_FOOT && i < 4; ++i) {
    sensed.cell_force_N[i] = plant.cell_force_N[4 * data.foot + i];
  }
  for (int i = 0; data.kind == HOAP2_CAN_BOARD_POSTURE && i < 3; ++i) {
    sensed.gyro_S_rad_s[i] = plant.gyro_S_rad_s[i];
    sensed.accel_S_m_s2[i] = plant.accel_S_m_s2[i];
  }
  return sensed;
}

void drive_plant(const hoap2_can_board_t &board, hoap2_link_command_t *plant) {
  const hoap2_can_board_data_t &data = HOAP2_CAN_BOARD[board.board];
  for (int j = 0; j < data.joints; ++j) {
    const int joint = data.joint[j];
    plant->q_ref_rad[joint] = board.drives.q_ref_rad[j];
    plant->qd_ref_rad_s[joint] = board.drives.qd_ref_rad_s[j];
    plant->tau_ff_Nm[joint] = board.drives.tau_ff_Nm[j];
    plant->kp_Nm_rad[joint] = board.drives.kp_Nm_rad[j];
    plant->kd_Nms_rad[joint] = board.drives.kd_Nms_rad[j];
    plant->drive_mode[joint] = board.drives.drive_mode[j];
  }
}

}  // namespace hoap2_sim
