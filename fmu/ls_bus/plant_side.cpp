// The robot's nine boards between the plant and two bus terminals.
#include <cstring>

#include "boards/boards.h"
#include "can/board.h"
#include "hoap2_plant/generated/plant_signals.h"
#include "ls_bus/generated/tokens.h"
#include "ls_bus/side.h"

namespace {

struct Boards {
  hoap2_can_board_t board[HOAP2_CAN_BOARDS];
  std::int32_t sample;  // number of the plant's measurement
  std::int32_t last_sensor_tick;
};

void start(void *side) {
  auto *boards = static_cast<Boards *>(side);
  for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) hoap2_can_board_init(&boards->board[b], b);
}

bool sent_by(const hoap2_can_board_data_t &board, const hoap2_can_frame_t &frame) {
  if (frame.flags & HOAP2_CAN_EXTENDED || frame.identifier >= HOAP2_CAN_KINDS << HOAP2_CAN_NODE_BITS) return false;
  const int layout = HOAP2_CAN_LOOKUP[board.bus][frame.identifier];
  return layout >= 0 && HOAP2_CAN_LAYOUT[layout].sender == board.node;
}

// A frame of one board comes back for the others on its bus: they share the terminal.
void receive(void *side, int terminal, const hoap2_can_frame_t *frame, std::int64_t /*now_ns*/) {
  auto *boards = static_cast<Boards *>(side);
  for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) {
    const hoap2_can_board_data_t &data = HOAP2_CAN_BOARD[b];
    if (data.bus == terminal && !sent_by(data, *frame)) hoap2_can_board_receive(&boards->board[b], frame);
  }
}

hoap2_link_measured_t measured_by(const hoap2_plant_outputs_t &plant) {
  hoap2_link_measured_t measured;
  std::memcpy(measured.q_enc_rad, plant.q_enc_rad, sizeof measured.q_enc_rad);
  std::memcpy(measured.gyro_S_rad_s, plant.gyro_S_rad_s, sizeof measured.gyro_S_rad_s);
  std::memcpy(measured.accel_S_m_s2, plant.accel_S_m_s2, sizeof measured.accel_S_m_s2);
  std::memcpy(measured.cell_force_N, plant.cell_force_N, sizeof measured.cell_force_N);
  std::memcpy(measured.true_tau_Nm, plant.true_tau_Nm, sizeof measured.true_tau_Nm);
  measured.sensor_tick = plant.sensor_tick;
  return measured;
}

void set_drives(const hoap2_link_command_t &drives, hoap2_plant_inputs_t *plant) {
  std::memcpy(plant->q_ref_rad, drives.q_ref_rad, sizeof plant->q_ref_rad);
  std::memcpy(plant->qd_ref_rad_s, drives.qd_ref_rad_s, sizeof plant->qd_ref_rad_s);
  std::memcpy(plant->tau_ff_Nm, drives.tau_ff_Nm, sizeof plant->tau_ff_Nm);
  std::memcpy(plant->kp_Nm_rad, drives.kp_Nm_rad, sizeof plant->kp_Nm_rad);
  std::memcpy(plant->kd_Nms_rad, drives.kd_Nms_rad, sizeof plant->kd_Nms_rad);
  std::memcpy(plant->drive_mode, drives.drive_mode, sizeof plant->drive_mode);
}

void tick(hoap2_fmu_instance_t *self, void *side, std::int64_t number) {
  auto *boards = static_cast<Boards *>(side);
  const hoap2_link_measured_t measured =
      measured_by(*static_cast<const hoap2_plant_outputs_t *>(self->group[HOAP2_FMU_OUTPUT]));
  // a sensor that stands still sends nothing
  if (number < HOAP2_LS_BOOT_TICKS || measured.sensor_tick != boards->last_sensor_tick) ++boards->sample;
  boards->last_sensor_tick = measured.sensor_tick;
  hoap2_link_command_t drives = {};
  for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) {
    hoap2_can_outbox_t out;
    out.count = 0;
    const hoap2_can_sensed_t sensed = hoap2_sim::sensed_by(b, measured, boards->sample);
    hoap2_can_board_tick(&boards->board[b], &sensed, &out);
    hoap2_sim::drive_plant(boards->board[b], &drives);
    for (int i = 0; i < out.count; ++i) hoap2_ls_send(self, HOAP2_CAN_BOARD[b].bus, &out.frame[i]);
  }
  set_drives(drives, static_cast<hoap2_plant_inputs_t *>(self->group[HOAP2_FMU_INPUT]));
}

int advance(hoap2_fmu_instance_t *self, void * /*side*/, std::int64_t number) {
  if (number < HOAP2_LS_BOOT_TICKS) return 0;
  const int failed = hoap2_product_step(self->model, self->group[HOAP2_FMU_INPUT]);
  if (failed == 0) hoap2_product_get_outputs(self->model, self->group[HOAP2_FMU_OUTPUT]);
  return failed;
}

int is_whole(const void *side) {
  const auto *boards = static_cast<const Boards *>(side);
  bool whole = boards->sample >= 0;
  for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) {
    const hoap2_can_board_t &board = boards->board[b];
    whole = whole && board.board == b && board.tick >= 0 && board.mode >= HOAP2_CAN_BOARD_MODE_BOOT &&
            board.mode <= HOAP2_CAN_BOARD_MODE_STOPPED;
  }
  return whole ? 1 : 0;
}

}  // namespace

extern "C" const hoap2_ls_side_t HOAP2_LS_SIDE = {
    "hoap2_plant_ls_bus", HOAP2_LS_PLANT_TOKEN, HOAP2_CAN_BUSES, 0, sizeof(Boards), start, receive, tick, advance,
    is_whole};
