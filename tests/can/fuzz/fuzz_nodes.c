/* libFuzzer harness: any bytes as frames, to every board and to the controller's node.
 *
 * Input: records of bus (1 bit), ticks to let pass (3 bits), flags, identifier (2 bytes), length, and that
 * many bytes. A record with the top bit of its first byte set is sealed with a right CRC, so that the fuzzer
 * gets behind it. Built with AddressSanitizer and UndefinedBehaviorSanitizer; besides what they find, the
 * drives' limits must hold.
 */
#include <stddef.h>
#include <string.h>

#include "can/board.h"
#include "can/controller_node.h"
#include "fuzz.h"
#include "hoap2/generated/robot_model.h"

#define STEP_RAD HOAP2_RAD_PER_COUNT

static void tick_board(hoap2_can_board_t *board, int32_t sample) {
  hoap2_can_sensed_t sensed;
  hoap2_can_outbox_t out;
  memset(&sensed, 0, sizeof sensed);
  sensed.sample = sample;
  out.count = 0;
  const hoap2_can_drives_t before = board->drives;
  hoap2_can_board_tick(board, &sensed, &out);
  require(out.count >= 0 && out.count <= HOAP2_CAN_OUTBOX_FRAMES);
  const hoap2_can_board_data_t *data = &HOAP2_CAN_BOARD[board->board];
  for (int j = 0; j < data->joints; ++j) {
    const hoap2_joint_data_t *joint = &HOAP2_JOINT[data->joint[j]];
    const double q = board->drives.q_ref_rad[j], moved = q - before.q_ref_rad[j];
    require(q >= joint->limit_hard_rad[0] - 2 * STEP_RAD && q <= joint->limit_hard_rad[1] + 2 * STEP_RAD);
    require(moved <= 1e-3 * joint->velocity_limit_rad_s + 2 * STEP_RAD &&
            moved >= -1e-3 * joint->velocity_limit_rad_s - 2 * STEP_RAD);
    require(board->drives.tau_ff_Nm[j] <= joint->torque_peak_Nm &&
            board->drives.tau_ff_Nm[j] >= -joint->torque_peak_Nm);
    require(board->drives.kp_Nm_rad[j] >= 0.0 && board->drives.kd_Nms_rad[j] >= 0.0);
    require(board->drives.drive_mode[j] >= 0 && board->drives.drive_mode[j] <= 3);
  }
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size) {
  hoap2_can_board_t board[HOAP2_CAN_BOARDS];
  hoap2_can_controller_t controller;
  hoap2_inputs_t inputs;
  hoap2_outputs_t outputs;
  memset(&outputs, 0, sizeof outputs);
  hoap2_inputs_defaults(&inputs);
  hoap2_can_controller_init(&controller);
  for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) {
    hoap2_can_board_init(&board[b], b);
    tick_board(&board[b], 0);
  }
  int32_t sample = 0;
  size_t at = 0;
  for (int records = 0; records < 32 && at + 5 <= size; ++records) {
    const int bus = bytes[at] & 1, ticks = bytes[at] >> 1 & 7, sealed = bytes[at] >> 7;
    hoap2_can_frame_t frame;
    memset(&frame, 0, sizeof frame);
    frame.flags = bytes[at + 1];
    frame.identifier = (uint32_t)bytes[at + 2] | (uint32_t)bytes[at + 3] << 8;
    frame.length = bytes[at + 4];
    at += 5;
    for (size_t i = 0; i < frame.length && i < HOAP2_CAN_DATA_BYTES && at < size; ++i)
      frame.data[i] = bytes[at++];
    if (sealed) seal(&frame);
    (void)hoap2_can_controller_receive(&controller, bus, &frame);
    for (int b = 0; b < HOAP2_CAN_BOARDS; ++b)
      if (HOAP2_CAN_BOARD[b].bus == bus) (void)hoap2_can_board_receive(&board[b], &frame);
    for (int t = 0; t < ticks; ++t) {
      hoap2_can_outbox_t out[HOAP2_CAN_BUSES];
      out[0].count = out[1].count = 0;
      hoap2_can_controller_send(&controller, &outputs, out);
      hoap2_can_controller_inputs(&controller, &inputs);
      ++sample;
      for (int b = 0; b < HOAP2_CAN_BOARDS; ++b)
        if (HOAP2_CAN_BOARD[b].bus == bus) tick_board(&board[b], sample);
    }
    for (int j = 0; j < HOAP2_JOINTS; ++j) require(inputs.q_enc_rad[j] >= -4.0 && inputs.q_enc_rad[j] <= 4.0);
  }
  return 0;
}
