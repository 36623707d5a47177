#include "can/board_parameters.h"

#include "hoap2/generated/robot_model.h"

static double present(const hoap2_can_board_t *board, int parameter, int joint) {
  double refused = 0.0;
  switch (parameter) {
    case HOAP2_CAN_P_ALIVE_LIMIT_TICKS: return board->alive_limit_ticks;
    case HOAP2_CAN_P_VELOCITY_LIMIT_RAD_S: return board->velocity_limit_rad_s[joint];
    case HOAP2_CAN_P_REFUSED:
      for (int i = 0; i < HOAP2_CAN_REFUSALS; ++i) refused += board->refused[i];
      return refused;
    case HOAP2_CAN_P_HOLDS: return board->holds;
    case HOAP2_CAN_P_CLOCK_OFFSET_TICKS: return board->clock_offset_ticks;
    default: return 0.0;
  }
}

static int check(const hoap2_can_board_t *board, const int32_t raw[]) {
  const int parameter = raw[HOAP2_CAN_REQUEST_PARAMETER];
  if (parameter >= HOAP2_CAN_PARAMETERS) return HOAP2_CAN_RESULT_UNKNOWN_PARAMETER;
  const hoap2_can_parameter_t *row = &HOAP2_CAN_PARAMETER[parameter];
  const int joints = row->of_joint ? HOAP2_CAN_BOARD[board->board].joints : 1;
  if (raw[HOAP2_CAN_REQUEST_JOINT] >= joints) return HOAP2_CAN_RESULT_UNKNOWN_JOINT;
  if (raw[HOAP2_CAN_REQUEST_OPERATION] == HOAP2_CAN_OPERATION_READ) return HOAP2_CAN_RESULT_OK;
  if (!row->writable) return HOAP2_CAN_RESULT_READ_ONLY;
  const float value = hoap2_can_bits_float(raw[HOAP2_CAN_REQUEST_VALUE]);
  return value >= row->low && value <= row->high ? HOAP2_CAN_RESULT_OK : HOAP2_CAN_RESULT_OUT_OF_RANGE;
}

static void write(hoap2_can_board_t *board, int parameter, int joint, double value) {
  if (parameter == HOAP2_CAN_P_ALIVE_LIMIT_TICKS) board->alive_limit_ticks = (int32_t)value;
  if (parameter == HOAP2_CAN_P_VELOCITY_LIMIT_RAD_S) {
    const double own = HOAP2_JOINT[HOAP2_CAN_BOARD[board->board].joint[joint]].velocity_limit_rad_s;
    board->velocity_limit_rad_s[joint] = value < own ? value : own;
  }
}

void hoap2_can_board_request(hoap2_can_board_t *board, const int32_t raw[]) {
  const int result = check(board, raw);
  const int parameter = raw[HOAP2_CAN_REQUEST_PARAMETER], joint = raw[HOAP2_CAN_REQUEST_JOINT];
  if (result == HOAP2_CAN_RESULT_OK && raw[HOAP2_CAN_REQUEST_OPERATION] == HOAP2_CAN_OPERATION_WRITE)
    write(board, parameter, joint, (double)hoap2_can_bits_float(raw[HOAP2_CAN_REQUEST_VALUE]));
  const int readable =
      result != HOAP2_CAN_RESULT_UNKNOWN_PARAMETER && result != HOAP2_CAN_RESULT_UNKNOWN_JOINT;
  board->reply_raw[HOAP2_CAN_REPLY_RESULT] = result;
  board->reply_raw[HOAP2_CAN_REPLY_JOINT] = joint & 31;
  board->reply_raw[HOAP2_CAN_REPLY_PARAMETER] = parameter;
  board->reply_raw[HOAP2_CAN_REPLY_VALUE] =
      hoap2_can_float_bits(readable ? (float)present(board, parameter, joint) : 0.0F);
  board->reply_due = 1;
}
