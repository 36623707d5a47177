#include "can/board_send.h"

#include "can/outbox.h"

enum { TICK_BITS = 24 };

static const hoap2_can_board_data_t *data_of(const hoap2_can_board_t *board) {
  return &HOAP2_CAN_BOARD[board->board];
}

static int layout_of(const hoap2_can_board_t *board, int kind) {
  return hoap2_can_find(data_of(board)->bus, kind, data_of(board)->node);
}

static void post(hoap2_can_board_t *board, int kind, const int32_t raw[], hoap2_can_outbox_t *out) {
  hoap2_can_post(out, layout_of(board, kind), &board->sent[kind], raw);
}

static void post_status(hoap2_can_board_t *board, const hoap2_can_sensed_t *sensed, hoap2_can_outbox_t *out) {
  const hoap2_can_field_t *field =
      &HOAP2_CAN_FIELD[HOAP2_CAN_LAYOUT[layout_of(board, HOAP2_CAN_K_STATUS)].first_field];
  int32_t raw[HOAP2_CAN_MAX_FIELDS];
  for (int j = 0; j < data_of(board)->joints; ++j) {
    const int at = HOAP2_CAN_STATUS_FIXED + j * HOAP2_CAN_STATUS_STRIDE;
    const int q = at + HOAP2_CAN_STATUS_J_Q_ENC, current = at + HOAP2_CAN_STATUS_J_CURRENT;
    raw[q] = hoap2_can_raw(&field[q], sensed->q_enc_rad[j]);
    raw[current] = hoap2_can_raw(&field[current], sensed->current_A[j]);
    raw[at + HOAP2_CAN_STATUS_J_MODE] = board->mode;
    raw[at + HOAP2_CAN_STATUS_J_FAULT] = (board->joint_refused[j] ? 1 : 0) | (sensed->at_limit[j] ? 2 : 0);
    board->joint_refused[j] = 0;
  }
  post(board, HOAP2_CAN_K_STATUS, raw, out);
}

static void post_sensors(hoap2_can_board_t *board, const hoap2_can_sensed_t *sensed,
                         hoap2_can_outbox_t *out) {
  const int foot = data_of(board)->kind == HOAP2_CAN_BOARD_FOOT;
  const int kind = foot ? HOAP2_CAN_K_CELLS : HOAP2_CAN_K_IMU;
  const hoap2_can_field_t *field = &HOAP2_CAN_FIELD[HOAP2_CAN_LAYOUT[layout_of(board, kind)].first_field];
  int32_t raw[HOAP2_CAN_MAX_FIELDS];
  for (int i = 0; foot && i < 4; ++i) raw[i] = hoap2_can_raw(&field[i], sensed->cell_force_N[i]);
  for (int i = 0; !foot && i < 3; ++i) {
    raw[HOAP2_CAN_IMU_GYRO + i] = hoap2_can_raw(&field[HOAP2_CAN_IMU_GYRO + i], sensed->gyro_S_rad_s[i]);
    raw[HOAP2_CAN_IMU_ACCEL + i] = hoap2_can_raw(&field[HOAP2_CAN_IMU_ACCEL + i], sensed->accel_S_m_s2[i]);
  }
  post(board, kind, raw, out);
}

static void post_measured(hoap2_can_board_t *board, const hoap2_can_sensed_t *sensed,
                          hoap2_can_outbox_t *out) {
  if (data_of(board)->joints == 0) {
    if (sensed->sample != board->last_sample) post_sensors(board, sensed, out);
  } else {
    const int layout = layout_of(board, HOAP2_CAN_K_STATUS);
    const int period = HOAP2_CAN_LAYOUT[layout].period_ticks;
    const int fresh = sensed->sample != board->last_sample;
    if (fresh && (period == 1 || sensed->sample % period == HOAP2_CAN_LAYOUT[layout].offset_ticks ||
                  board->last_sample < 0))
      post_status(board, sensed, out);
  }
  board->last_sample = sensed->sample;
}

static void post_beat(hoap2_can_board_t *board, hoap2_can_outbox_t *out) {
  int32_t raw[HOAP2_CAN_MAX_FIELDS];
  raw[HOAP2_CAN_BOARD_BEAT_TICK] = board->tick & ((1 << TICK_BITS) - 1);
  raw[HOAP2_CAN_BOARD_BEAT_MODE] = board->mode;
  raw[HOAP2_CAN_BOARD_BEAT_PROTOCOL] = HOAP2_CAN_PROTOCOL;
  post(board, HOAP2_CAN_K_BOARD_BEAT, raw, out);
}

void hoap2_can_board_send(hoap2_can_board_t *board, const hoap2_can_sensed_t *sensed,
                          hoap2_can_outbox_t *out) {
  if (board->stop_wanted) {
    const int32_t reason = HOAP2_CAN_STOP_REASON_BOARD;
    post(board, HOAP2_CAN_K_STOP, &reason, out);
  }
  if (board->tick == 0 || hoap2_can_due(layout_of(board, HOAP2_CAN_K_BOARD_BEAT), board->tick))
    post_beat(board, out);
  if (board->tick > 0) post_measured(board, sensed, out); /* the first heartbeat goes before them */
  if (board->answer_due) {
    const int32_t counter = board->answer_counter;
    post(board, HOAP2_CAN_K_ANSWER, &counter, out);
    board->answer_due = 0;
  }
  if (board->reply_due) {
    post(board, HOAP2_CAN_K_REPLY, board->reply_raw, out);
    board->reply_due = 0;
  }
}
