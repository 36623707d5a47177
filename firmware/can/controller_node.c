#include "can/controller_node.h"

#include <string.h>

#include "can/outbox.h"

/* So many frames with the controller's own identifiers, and it is taken for certain that there are two. */
enum { FOREIGN_LIMIT = 3, TICK_BITS = 24, SLOW_SILENCE_TICKS = 200 };
/* Settings that are not answered are sent again after so many ticks: to the board and back takes two. */
enum { ANSWER_TICKS = 4 };
/* A stream that does not come every tick counts as there for six of its periods. */
enum { MISSED_PERIODS = 6 };

void hoap2_can_controller_init(hoap2_can_controller_t *controller) {
  memset(controller, 0, sizeof *controller);
  hoap2_inputs_defaults(&controller->inputs);
  controller->state = HOAP2_CAN_CONTROLLER_STATE_BOOT;
  controller->request_board = -1;
}

void hoap2_can_controller_stop(hoap2_can_controller_t *controller, int reason) {
  if (controller->state == HOAP2_CAN_CONTROLLER_STATE_STOPPED) return;
  controller->state = HOAP2_CAN_CONTROLLER_STATE_STOPPED;
  controller->stop_reason = reason;
}

int hoap2_can_controller_request(hoap2_can_controller_t *controller, int board, int operation, int parameter,
                                 int joint, float value) {
  if (controller->request_board >= 0 || board < 0 || board >= HOAP2_CAN_BOARDS) return 1;
  controller->request_board = board;
  controller->request_raw[HOAP2_CAN_REQUEST_OPERATION] = operation;
  controller->request_raw[HOAP2_CAN_REQUEST_JOINT] = joint;
  controller->request_raw[HOAP2_CAN_REQUEST_PARAMETER] = parameter;
  controller->request_raw[HOAP2_CAN_REQUEST_VALUE] = hoap2_can_float_bits(value);
  return 0;
}

/* ---- sending */

static int layout_to(int board, int kind) {
  return hoap2_can_find(HOAP2_CAN_BOARD[board].bus, kind, HOAP2_CAN_BOARD[board].node);
}

static void post_to_all(hoap2_can_controller_t *c, int kind, const int32_t raw[], hoap2_can_outbox_t out[]) {
  for (int bus = 0; bus < HOAP2_CAN_BUSES; ++bus)
    hoap2_can_post(&out[bus], hoap2_can_find(bus, kind, HOAP2_CAN_CONTROLLER_NODE), &c->sent[kind][bus], raw);
}

static void post_to(hoap2_can_controller_t *c, int board, int kind, const int32_t raw[],
                    hoap2_can_outbox_t out[]) {
  hoap2_can_post(&out[HOAP2_CAN_BOARD[board].bus], layout_to(board, kind), &c->peer[board].sent[kind], raw);
}

static int32_t coded(hoap2_can_controller_t *c, const hoap2_can_field_t *field, double value) {
  const int32_t raw = hoap2_can_raw(field, value);
  const double error = hoap2_can_value(field, raw) - value;
  if (!(error <= field->lsb && error >= -field->lsb)) ++c->clipped;
  return raw;
}

static void settings_of(hoap2_can_controller_t *c, int board, const hoap2_outputs_t *outputs, int32_t raw[]) {
  const hoap2_can_board_data_t *data = &HOAP2_CAN_BOARD[board];
  const hoap2_can_field_t *field =
      &HOAP2_CAN_FIELD[HOAP2_CAN_LAYOUT[layout_to(board, HOAP2_CAN_K_SETTINGS)].first_field];
  memset(raw, 0, HOAP2_CAN_MAX_FIELDS * sizeof raw[0]);
  for (int j = 0; j < data->joints; ++j) {
    const int joint = data->joint[j], at = HOAP2_CAN_SETTINGS_FIXED + j * HOAP2_CAN_SETTINGS_STRIDE;
    const int scale = at + HOAP2_CAN_SETTINGS_J_QD_SCALE, kp = at + HOAP2_CAN_SETTINGS_J_KP;
    const int kd = at + HOAP2_CAN_SETTINGS_J_KD;
    raw[at + HOAP2_CAN_SETTINGS_J_MODE] = outputs->drive_mode[joint] & 3;
    /* a controller that gives a rate means the rate of its references */
    raw[scale] = outputs->qd_ref_rad_s[joint] != 0.0 ? hoap2_can_raw(&field[scale], 1.0) : 0;
    raw[kp] = coded(c, &field[kp], outputs->kp_Nm_rad[joint]);
    raw[kd] = coded(c, &field[kd], outputs->kd_Nms_rad[joint]);
  }
}

static void send_settings(hoap2_can_controller_t *c, int board, const hoap2_outputs_t *outputs,
                          hoap2_can_outbox_t out[]) {
  hoap2_can_peer_t *peer = &c->peer[board];
  int32_t raw[HOAP2_CAN_MAX_FIELDS];
  settings_of(c, board, outputs, raw);
  const int changed = memcmp(raw, peer->settings_raw, sizeof raw) != 0;
  const int unanswered = peer->settings_open && peer->settings_age_ticks >= ANSWER_TICKS;
  ++peer->settings_age_ticks;
  if (!changed && !unanswered && !hoap2_can_due(layout_to(board, HOAP2_CAN_K_SETTINGS), c->tick)) return;
  memcpy(peer->settings_raw, raw, sizeof raw);
  post_to(c, board, HOAP2_CAN_K_SETTINGS, raw, out);
  peer->settings_counter = peer->sent[HOAP2_CAN_K_SETTINGS];
  peer->settings_open = 1;
  peer->settings_age_ticks = 0;
}

static void send_command(hoap2_can_controller_t *c, int board, const hoap2_outputs_t *outputs,
                         hoap2_can_outbox_t out[]) {
  const hoap2_can_board_data_t *data = &HOAP2_CAN_BOARD[board];
  const int layout = layout_to(board, HOAP2_CAN_K_COMMAND);
  if (!hoap2_can_due(layout, c->tick) && c->peer[board].sent[HOAP2_CAN_K_COMMAND] != 0) return;
  const hoap2_can_field_t *field = &HOAP2_CAN_FIELD[HOAP2_CAN_LAYOUT[layout].first_field];
  int32_t raw[HOAP2_CAN_MAX_FIELDS];
  for (int j = 0; j < data->joints; ++j) {
    const int at = HOAP2_CAN_COMMAND_FIXED + j * HOAP2_CAN_COMMAND_STRIDE;
    const int q = at + HOAP2_CAN_COMMAND_J_Q_REF, tau = at + HOAP2_CAN_COMMAND_J_TAU_FF;
    raw[q] = coded(c, &field[q], outputs->q_ref_rad[data->joint[j]]);
    raw[tau] = coded(c, &field[tau], outputs->tau_ff_Nm[data->joint[j]]);
  }
  post_to(c, board, HOAP2_CAN_K_COMMAND, raw, out);
}

static void send_beat(hoap2_can_controller_t *c, hoap2_can_outbox_t out[]) {
  int32_t raw[HOAP2_CAN_MAX_FIELDS];
  raw[HOAP2_CAN_BEAT_TICK] = c->tick & ((1 << TICK_BITS) - 1);
  raw[HOAP2_CAN_BEAT_STATE] = c->state;
  raw[HOAP2_CAN_BEAT_PROTOCOL] = HOAP2_CAN_PROTOCOL;
  post_to_all(c, HOAP2_CAN_K_BEAT, raw, out);
}

static void send_sync(hoap2_can_controller_t *c, hoap2_can_outbox_t out[]) {
  const int32_t raw[2] = {c->tick, 0};
  if (hoap2_can_due(hoap2_can_find(0, HOAP2_CAN_K_TIME_SYNC, 0), c->tick))
    post_to_all(c, HOAP2_CAN_K_TIME_SYNC, raw, out);
}

static void send_request(hoap2_can_controller_t *c, hoap2_can_outbox_t out[]) {
  if (c->request_board < 0) return;
  post_to(c, c->request_board, HOAP2_CAN_K_REQUEST, c->request_raw, out);
  c->request_board = -1;
}

void hoap2_can_controller_send(hoap2_can_controller_t *c, const hoap2_outputs_t *outputs,
                               hoap2_can_outbox_t out[HOAP2_CAN_BUSES]) {
  if (c->state != HOAP2_CAN_CONTROLLER_STATE_DOUBLED) {
    if (c->state == HOAP2_CAN_CONTROLLER_STATE_STOPPED)
      post_to_all(c, HOAP2_CAN_K_STOP, &c->stop_reason, out);
    send_beat(c, out);
    for (int b = 0; b < HOAP2_CAN_BOARDS && c->state != HOAP2_CAN_CONTROLLER_STATE_STOPPED; ++b) {
      if (HOAP2_CAN_BOARD[b].joints == 0) continue;
      send_settings(c, b, outputs, out);
      send_command(c, b, outputs, out);
    }
    send_sync(c, out);
    send_request(c, out);
  }
  if (c->tick < INT32_MAX) ++c->tick;
}

/* ---- receiving */

static void take_status(hoap2_can_controller_t *c, const hoap2_can_message_t *m) {
  const hoap2_can_field_t *field = &HOAP2_CAN_FIELD[HOAP2_CAN_LAYOUT[m->layout].first_field];
  const hoap2_can_board_data_t *data = &HOAP2_CAN_BOARD[m->board];
  for (int j = 0; j < data->joints; ++j) {
    const int at = HOAP2_CAN_STATUS_FIXED + j * HOAP2_CAN_STATUS_STRIDE, q = at + HOAP2_CAN_STATUS_J_Q_ENC;
    c->inputs.q_enc_rad[data->joint[j]] = hoap2_can_value(&field[q], m->raw[q]);
    c->peer[m->board].mode = m->raw[at + HOAP2_CAN_STATUS_J_MODE];
  }
}

static void take_sensors(hoap2_can_controller_t *c, const hoap2_can_message_t *m) {
  const hoap2_can_field_t *field = &HOAP2_CAN_FIELD[HOAP2_CAN_LAYOUT[m->layout].first_field];
  if (m->kind == HOAP2_CAN_K_CELLS) {
    double *force_N = &c->inputs.cell_force_N[4 * HOAP2_CAN_BOARD[m->board].foot];
    for (int i = 0; i < 4; ++i) force_N[i] = hoap2_can_value(&field[i], m->raw[i]);
    return;
  }
  for (int i = 0; i < 3; ++i) {
    const int gyro = HOAP2_CAN_IMU_GYRO + i, accel = HOAP2_CAN_IMU_ACCEL + i;
    c->inputs.gyro_S_rad_s[i] = hoap2_can_value(&field[gyro], m->raw[gyro]);
    c->inputs.accel_S_m_s2[i] = hoap2_can_value(&field[accel], m->raw[accel]);
  }
}

static int take_measured(hoap2_can_controller_t *c, const hoap2_can_message_t *m) {
  hoap2_can_peer_t *peer = &c->peer[m->board];
  if (!peer->protocol_known) return HOAP2_CAN_REFUSED_VERSION;
  const int period = HOAP2_CAN_LAYOUT[m->layout].period_ticks;
  if (!hoap2_can_track_take(&peer->measured, m->counter,
                            MISSED_PERIODS * HOAP2_CAN_ALIVE_LIMIT_TICKS * period))
    return HOAP2_CAN_REFUSED_COUNTER;
  peer->measured_tick = c->tick;
  if (m->kind == HOAP2_CAN_K_STATUS)
    take_status(c, m);
  else
    take_sensors(c, m);
  return HOAP2_CAN_REFUSED_NONE;
}

static int take_beat(hoap2_can_controller_t *c, const hoap2_can_message_t *m) {
  hoap2_can_peer_t *peer = &c->peer[m->board];
  if (m->raw[HOAP2_CAN_BOARD_BEAT_PROTOCOL] != HOAP2_CAN_PROTOCOL) {
    peer->protocol_known = 0;
    return HOAP2_CAN_REFUSED_VERSION;
  }
  if (!hoap2_can_track_take(&peer->beat, m->counter, SLOW_SILENCE_TICKS)) return HOAP2_CAN_REFUSED_COUNTER;
  peer->protocol_known = 1;
  peer->mode = m->raw[HOAP2_CAN_BOARD_BEAT_MODE];
  return HOAP2_CAN_REFUSED_NONE;
}

static int take_answer(hoap2_can_controller_t *c, const hoap2_can_message_t *m) {
  hoap2_can_peer_t *peer = &c->peer[m->board];
  if (!hoap2_can_track_take(&peer->answer, m->counter, SLOW_SILENCE_TICKS)) return HOAP2_CAN_REFUSED_COUNTER;
  if (m->raw[HOAP2_CAN_ANSWER_SETTINGS_COUNTER] == peer->settings_counter) peer->settings_open = 0;
  return HOAP2_CAN_REFUSED_NONE;
}

static int take_reply(hoap2_can_controller_t *c, const hoap2_can_message_t *m) {
  hoap2_can_peer_t *peer = &c->peer[m->board];
  if (!hoap2_can_track_take(&peer->reply, m->counter, SLOW_SILENCE_TICKS)) return HOAP2_CAN_REFUSED_COUNTER;
  memcpy(peer->reply_raw, m->raw, sizeof peer->reply_raw);
  ++peer->replies;
  return HOAP2_CAN_REFUSED_NONE;
}

static int take(hoap2_can_controller_t *c, const hoap2_can_message_t *m) {
  if (HOAP2_CAN_LAYOUT[m->layout].sender == HOAP2_CAN_CONTROLLER_NODE) {
    if (++c->foreign >= FOREIGN_LIMIT) c->state = HOAP2_CAN_CONTROLLER_STATE_DOUBLED;
    return HOAP2_CAN_REFUSED_NODE;
  }
  switch (m->kind) {
    case HOAP2_CAN_K_STOP:
      hoap2_can_controller_stop(c, HOAP2_CAN_STOP_REASON_RELAYED);
      return HOAP2_CAN_REFUSED_NONE;
    case HOAP2_CAN_K_BOARD_BEAT: return take_beat(c, m);
    case HOAP2_CAN_K_ANSWER: return take_answer(c, m);
    case HOAP2_CAN_K_REPLY: return take_reply(c, m);
    default: return take_measured(c, m);
  }
}

int hoap2_can_controller_receive(hoap2_can_controller_t *c, int bus, const hoap2_can_frame_t *frame) {
  hoap2_can_message_t message;
  int reason = hoap2_can_decode(bus, frame, &message);
  if (reason == HOAP2_CAN_REFUSED_NONE) reason = take(c, &message);
  if (reason != HOAP2_CAN_REFUSED_NONE && c->refused[reason] < UINT32_MAX) ++c->refused[reason];
  return reason;
}

/* Tick of the oldest measurement that is in use, the slow streams given their time. */
static int32_t oldest_measurement(const hoap2_can_controller_t *c) {
  int32_t oldest = c->tick;
  for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) {
    const int status = layout_to(b, HOAP2_CAN_K_STATUS);
    const int period = status >= 0 ? HOAP2_CAN_LAYOUT[status].period_ticks : 1;
    const int slack = period > 1 ? MISSED_PERIODS * period - HOAP2_CAN_ALIVE_LIMIT_TICKS : 0;
    if (c->peer[b].measured_tick + slack < oldest) oldest = c->peer[b].measured_tick + slack;
  }
  return oldest;
}

void hoap2_can_controller_inputs(hoap2_can_controller_t *c, hoap2_inputs_t *inputs) {
  int there = 1;
  for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) {
    hoap2_can_peer_t *peer = &c->peer[b];
    hoap2_can_track_tick(&peer->measured);
    hoap2_can_track_tick(&peer->beat);
    hoap2_can_track_tick(&peer->answer);
    hoap2_can_track_tick(&peer->reply);
    there = there && peer->measured.started;
  }
  if (c->state == HOAP2_CAN_CONTROLLER_STATE_BOOT && there) c->state = HOAP2_CAN_CONTROLLER_STATE_RUN;
  /* stopped or doubled: the controller is not to go on, so its watchdog sees nothing new */
  if (c->state == HOAP2_CAN_CONTROLLER_STATE_RUN) c->inputs.sensor_tick = oldest_measurement(c);
  memcpy(inputs, &c->inputs, sizeof *inputs);
}
