#include "can/board.h"

#include <string.h>

#include "can/board_parameters.h"
#include "can/board_send.h"
#include "hoap2/generated/robot_model.h"
#include "hoap2/generated/signals.h"

#define TICK_S (1e-6 * HOAP2_TICK_US)
/* A reference may be a step of its coding beyond what the law allows. */
#define STEP_RAD HOAP2_RAD_PER_COUNT
/* Streams that are not sent every tick are given six periods. */
enum { MISSED_PERIODS = 6, SLOW_SILENCE_TICKS = 200 };

static const hoap2_can_board_data_t *data_of(const hoap2_can_board_t *board) {
  return &HOAP2_CAN_BOARD[board->board];
}

static int layout_of(const hoap2_can_board_t *board, int kind) {
  return hoap2_can_find(data_of(board)->bus, kind, data_of(board)->node);
}

void hoap2_can_board_init(hoap2_can_board_t *board, int index) {
  memset(board, 0, sizeof *board);
  board->board = index;
  board->mode = HOAP2_CAN_BOARD_MODE_BOOT;
  board->alive_limit_ticks = HOAP2_CAN_ALIVE_LIMIT_TICKS;
  board->last_sample = -1;
  const hoap2_can_board_data_t *data = data_of(board);
  for (int j = 0; j < data->joints; ++j)
    board->velocity_limit_rad_s[j] = HOAP2_JOINT[data->joint[j]].velocity_limit_rad_s;
}

/* Ticks without a command that are bridged by keeping the last one. */
static int command_limit_ticks(const hoap2_can_board_t *board) {
  const int layout = layout_of(board, HOAP2_CAN_K_COMMAND);
  if (layout < 0) return board->alive_limit_ticks;
  const int period = HOAP2_CAN_LAYOUT[layout].period_ticks;
  return period > 1 ? MISSED_PERIODS * period : board->alive_limit_ticks;
}

static int take_beat(hoap2_can_board_t *board, const hoap2_can_message_t *message) {
  if (message->raw[HOAP2_CAN_BEAT_PROTOCOL] != HOAP2_CAN_PROTOCOL) {
    board->protocol_known = 0;
    return HOAP2_CAN_REFUSED_VERSION;
  }
  if (!hoap2_can_track_take(&board->beat, message->counter, board->alive_limit_ticks))
    return HOAP2_CAN_REFUSED_COUNTER;
  board->protocol_known = 1;
  return HOAP2_CAN_REFUSED_NONE;
}

static int take_settings(hoap2_can_board_t *board, const hoap2_can_message_t *message) {
  if (!hoap2_can_track_take(&board->settings, message->counter, SLOW_SILENCE_TICKS))
    return HOAP2_CAN_REFUSED_COUNTER;
  const hoap2_can_field_t *field = &HOAP2_CAN_FIELD[HOAP2_CAN_LAYOUT[message->layout].first_field];
  for (int j = 0; j < data_of(board)->joints; ++j) {
    const int at = HOAP2_CAN_SETTINGS_FIXED + j * HOAP2_CAN_SETTINGS_STRIDE;
    const int scale = at + HOAP2_CAN_SETTINGS_J_QD_SCALE, kp = at + HOAP2_CAN_SETTINGS_J_KP;
    const int kd = at + HOAP2_CAN_SETTINGS_J_KD;
    board->drive_mode[j] = message->raw[at + HOAP2_CAN_SETTINGS_J_MODE];
    board->qd_scale[j] = hoap2_can_value(&field[scale], message->raw[scale]);
    board->kp_Nm_rad[j] = hoap2_can_value(&field[kp], message->raw[kp]);
    board->kd_Nms_rad[j] = hoap2_can_value(&field[kd], message->raw[kd]);
  }
  board->has_settings = 1;
  board->answer_due = 1;
  board->answer_counter = message->counter;
  return HOAP2_CAN_REFUSED_NONE;
}

/* Inside the joint's stops, and not further from the last reference than the drive can follow in the time
 * since then, as it passed here or, for frames that come late one upon the other, at the sender. */
static int command_allowed(hoap2_can_board_t *board, const double q_rad[], int32_t sent_ticks) {
  const hoap2_can_board_data_t *data = data_of(board);
  const int32_t here_ticks = board->tick - board->command_tick;
  const int32_t elapsed = here_ticks > sent_ticks ? here_ticks : sent_ticks;
  int allowed = 1;
  for (int j = 0; j < data->joints; ++j) {
    const double *stop_rad = HOAP2_JOINT[data->joint[j]].limit_hard_rad;
    const double reach_rad = board->velocity_limit_rad_s[j] * TICK_S * elapsed + STEP_RAD;
    const double move_rad = q_rad[j] - board->q_asked_rad[j];
    const int inside = q_rad[j] >= stop_rad[0] - STEP_RAD && q_rad[j] <= stop_rad[1] + STEP_RAD;
    const int near = !board->has_command || (move_rad <= reach_rad && move_rad >= -reach_rad);
    if (inside && near) continue;
    board->joint_refused[j] = 1;
    allowed = 0;
  }
  return allowed;
}

static int take_command(hoap2_can_board_t *board, const hoap2_can_message_t *message) {
  const int layout = message->layout;
  const hoap2_can_field_t *field = &HOAP2_CAN_FIELD[HOAP2_CAN_LAYOUT[layout].first_field];
  hoap2_can_track_t track = board->command;
  const int ahead = hoap2_can_track_take(&track, message->counter, command_limit_ticks(board));
  if (ahead == 0) return HOAP2_CAN_REFUSED_COUNTER;
  double q_rad[HOAP2_CAN_BOARD_JOINTS];
  const int joints = data_of(board)->joints;
  for (int j = 0; j < joints; ++j) {
    const int at = HOAP2_CAN_COMMAND_FIXED + j * HOAP2_CAN_COMMAND_STRIDE + HOAP2_CAN_COMMAND_J_Q_REF;
    q_rad[j] = hoap2_can_value(&field[at], message->raw[at]);
  }
  if (!command_allowed(board, q_rad, ahead * HOAP2_CAN_LAYOUT[layout].period_ticks))
    return HOAP2_CAN_REFUSED_LIMIT;
  for (int j = 0; j < joints; ++j) {
    const int at = HOAP2_CAN_COMMAND_FIXED + j * HOAP2_CAN_COMMAND_STRIDE + HOAP2_CAN_COMMAND_J_TAU_FF;
    const double peak_Nm = HOAP2_JOINT[data_of(board)->joint[j]].torque_peak_Nm;
    const double tau_Nm = hoap2_can_value(&field[at], message->raw[at]);
    board->q_asked_rad[j] = q_rad[j];
    board->tau_asked_Nm[j] = tau_Nm > peak_Nm ? peak_Nm : tau_Nm < -peak_Nm ? -peak_Nm : tau_Nm;
  }
  board->command = track;
  board->command_tick = board->tick;
  board->has_command = 1;
  return HOAP2_CAN_REFUSED_NONE;
}

static int take_stop(hoap2_can_board_t *board, const hoap2_can_message_t *message) {
  board->mode = HOAP2_CAN_BOARD_MODE_STOPPED; /* whatever its counter says */
  (void)hoap2_can_track_take(&board->stop, message->counter, 1);
  return HOAP2_CAN_REFUSED_NONE;
}

static int take_request(hoap2_can_board_t *board, const hoap2_can_message_t *message) {
  if (!hoap2_can_track_take(&board->request, message->counter, SLOW_SILENCE_TICKS))
    return HOAP2_CAN_REFUSED_COUNTER;
  hoap2_can_board_request(board, message->raw);
  return HOAP2_CAN_REFUSED_NONE;
}

static int take_sync(hoap2_can_board_t *board, const hoap2_can_message_t *message) {
  if (!hoap2_can_track_take(&board->sync, message->counter, SLOW_SILENCE_TICKS))
    return HOAP2_CAN_REFUSED_COUNTER;
  board->clock_offset_ticks = message->raw[HOAP2_CAN_TIME_SYNC_TICK] - board->tick;
  return HOAP2_CAN_REFUSED_NONE;
}

/* What a CAN controller's acceptance filter does: the other boards' frames are no business of this one.
 * Unknown identifiers pass, to be counted. */
static int concerns(const hoap2_can_board_t *board, const hoap2_can_frame_t *frame) {
  if (frame->identifier >= HOAP2_CAN_KINDS << HOAP2_CAN_NODE_BITS) return 1;
  const int index = HOAP2_CAN_LOOKUP[data_of(board)->bus][frame->identifier];
  if (index < 0) return 1;
  const hoap2_can_layout_t *layout = &HOAP2_CAN_LAYOUT[index];
  if (layout->kind == HOAP2_CAN_K_STOP || layout->board == board->board) return 1;
  return layout->sender == HOAP2_CAN_CONTROLLER_NODE && layout->board < 0;
}

/* A message that decodes: from a controller that speaks as we do? */
static int take(hoap2_can_board_t *board, const hoap2_can_message_t *message) {
  if (message->kind == HOAP2_CAN_K_STOP) return take_stop(board, message);
  if (HOAP2_CAN_LAYOUT[message->layout].sender != HOAP2_CAN_CONTROLLER_NODE)
    return HOAP2_CAN_REFUSED_NODE; /* someone uses our identifiers */
  if (message->kind == HOAP2_CAN_K_BEAT) return take_beat(board, message);
  if (!board->protocol_known) return HOAP2_CAN_REFUSED_VERSION;
  switch (message->kind) {
    case HOAP2_CAN_K_SETTINGS: return take_settings(board, message);
    case HOAP2_CAN_K_COMMAND: return take_command(board, message);
    case HOAP2_CAN_K_REQUEST: return take_request(board, message);
    case HOAP2_CAN_K_TIME_SYNC: return take_sync(board, message);
    default: return HOAP2_CAN_REFUSED_NODE;
  }
}

int hoap2_can_board_receive(hoap2_can_board_t *board, const hoap2_can_frame_t *frame) {
  if (!concerns(board, frame)) return HOAP2_CAN_REFUSED_NONE;
  hoap2_can_message_t message;
  int reason = hoap2_can_decode(data_of(board)->bus, frame, &message);
  if (reason == HOAP2_CAN_REFUSED_NONE) reason = take(board, &message);
  if (reason != HOAP2_CAN_REFUSED_NONE && board->refused[reason] < UINT32_MAX) ++board->refused[reason];
  return reason;
}

void hoap2_can_board_stop(hoap2_can_board_t *board) {
  board->mode = HOAP2_CAN_BOARD_MODE_STOPPED;
  board->stop_wanted = 1;
}

static void age(hoap2_can_board_t *board) {
  hoap2_can_track_tick(&board->beat);
  hoap2_can_track_tick(&board->command);
  hoap2_can_track_tick(&board->settings);
  hoap2_can_track_tick(&board->request);
  hoap2_can_track_tick(&board->stop);
  hoap2_can_track_tick(&board->sync);
}

static void next_mode(hoap2_can_board_t *board) {
  if (board->mode == HOAP2_CAN_BOARD_MODE_STOPPED) return;
  const int beats = board->beat.started && board->beat.age_ticks < board->alive_limit_ticks;
  const int commands = data_of(board)->joints == 0 || (board->has_settings && board->has_command &&
                                                       board->command.age_ticks < command_limit_ticks(board));
  if (beats && commands) {
    board->mode = HOAP2_CAN_BOARD_MODE_FOLLOW;
  } else if (board->mode == HOAP2_CAN_BOARD_MODE_FOLLOW) {
    board->mode = HOAP2_CAN_BOARD_MODE_HOLD;
    ++board->holds;
  }
}

/* The reference goes to the asked one, never faster than the drive's velocity limit. */
static double towards(double from_rad, double to_rad, double limit_rad_s) {
  const double reach_rad = limit_rad_s * TICK_S + STEP_RAD;
  if (to_rad > from_rad + reach_rad) return from_rad + limit_rad_s * TICK_S;
  if (to_rad < from_rad - reach_rad) return from_rad - limit_rad_s * TICK_S;
  return to_rad;
}

static void set_drives(hoap2_can_board_t *board) {
  hoap2_can_drives_t *drives = &board->drives;
  const hoap2_can_board_data_t *data = data_of(board);
  const int follow = board->mode == HOAP2_CAN_BOARD_MODE_FOLLOW,
            stopped = board->mode == HOAP2_CAN_BOARD_MODE_STOPPED;
  for (int j = 0; j < data->joints; ++j) {
    const double before_rad = drives->q_ref_rad[j];
    const hoap2_can_servo_t *servo = &HOAP2_CAN_SERVO[data->joint[j]];
    if (follow)
      drives->q_ref_rad[j] = towards(before_rad, board->q_asked_rad[j], board->velocity_limit_rad_s[j]);
    drives->qd_ref_rad_s[j] =
        follow ? board->qd_scale[j] * (drives->q_ref_rad[j] - before_rad) / TICK_S : 0.0;
    drives->tau_ff_Nm[j] = follow ? board->tau_asked_Nm[j] : 0.0;
    drives->kp_Nm_rad[j] = follow ? board->kp_Nm_rad[j] : servo->kp_Nm_rad;
    drives->kd_Nms_rad[j] = follow ? board->kd_Nms_rad[j] : servo->kd_Nms_rad;
    drives->drive_mode[j] = follow    ? board->drive_mode[j]
                            : stopped ? HOAP2_DRIVE_MODE_DAMPED_TORQUE
                                      : HOAP2_DRIVE_MODE_POSITION;
  }
}

void hoap2_can_board_tick(hoap2_can_board_t *board, const hoap2_can_sensed_t *sensed,
                          hoap2_can_outbox_t *out) {
  const hoap2_can_board_data_t *data = data_of(board);
  if (board->tick == 0)
    for (int j = 0; j < data->joints; ++j) board->drives.q_ref_rad[j] = sensed->q_enc_rad[j];
  age(board);
  next_mode(board);
  set_drives(board);
  hoap2_can_board_send(board, sensed, out);
  if (board->tick < INT32_MAX) ++board->tick;
}
