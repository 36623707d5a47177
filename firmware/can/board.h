/* What runs on a board: takes the controller's frames, refuses what it must not do, and tells what it
 * measures.
 *
 * Modes: BOOT holds the position that was measured first; FOLLOW does what the controller says; HOLD keeps
 * the last reference with the servo's own gains, from `alive_limit_ticks` ticks without heartbeat or commands
 * until both are back; STOPPED damps with no torque, until the power is switched.
 *
 * Between two ticks hoap2_can_board_receive is called for each frame that arrived; then hoap2_can_board_tick
 * makes the drives' settings of this tick and the frames to send. All state is one plain struct.
 */
#ifndef HOAP2_CAN_BOARD_H
#define HOAP2_CAN_BOARD_H

#include "can/codec.h"
#include "can/track.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a board measures; a board uses what it has. Joints in the order of HOAP2_CAN_BOARD[board].joint. */
typedef struct {
  double q_enc_rad[HOAP2_CAN_BOARD_JOINTS];
  double current_A[HOAP2_CAN_BOARD_JOINTS];
  double cell_force_N[4];
  double gyro_S_rad_s[3];
  double accel_S_m_s2[3];
  int32_t at_limit[HOAP2_CAN_BOARD_JOINTS]; /* torque limit reached */
  int32_t sample; /* number of this measurement: one that does not change is not sent again */
} hoap2_can_sensed_t;

/* What a board's drives are set to in a tick. */
typedef struct {
  double q_ref_rad[HOAP2_CAN_BOARD_JOINTS];
  double qd_ref_rad_s[HOAP2_CAN_BOARD_JOINTS];
  double tau_ff_Nm[HOAP2_CAN_BOARD_JOINTS];
  double kp_Nm_rad[HOAP2_CAN_BOARD_JOINTS];
  double kd_Nms_rad[HOAP2_CAN_BOARD_JOINTS];
  int32_t drive_mode[HOAP2_CAN_BOARD_JOINTS]; /* HOAP2_DRIVE_MODE_* */
} hoap2_can_drives_t;

typedef struct {
  hoap2_can_drives_t drives;                  /* of the last tick */
  double q_asked_rad[HOAP2_CAN_BOARD_JOINTS]; /* of the last accepted command */
  double tau_asked_Nm[HOAP2_CAN_BOARD_JOINTS];
  double qd_scale[HOAP2_CAN_BOARD_JOINTS];
  double kp_Nm_rad[HOAP2_CAN_BOARD_JOINTS];
  double kd_Nms_rad[HOAP2_CAN_BOARD_JOINTS];
  double velocity_limit_rad_s[HOAP2_CAN_BOARD_JOINTS];
  int32_t drive_mode[HOAP2_CAN_BOARD_JOINTS];
  hoap2_can_track_t beat, command, settings, request, stop, sync;
  int32_t board; /* index in HOAP2_CAN_BOARD */
  int32_t mode;  /* HOAP2_CAN_BOARD_MODE_* */
  int32_t tick;
  int32_t command_tick; /* of the last accepted command */
  int32_t last_sample;
  int32_t alive_limit_ticks;
  int32_t clock_offset_ticks;
  int32_t protocol_known; /* the controller's heartbeat carries our protocol */
  int32_t has_settings;
  int32_t has_command;
  int32_t stop_wanted; /* to tell the others */
  int32_t answer_due;
  int32_t reply_due;
  int32_t reply_raw[4];
  uint32_t refused[HOAP2_CAN_REFUSALS];
  uint32_t holds;
  uint8_t joint_refused[HOAP2_CAN_BOARD_JOINTS];
  uint8_t sent[HOAP2_CAN_KINDS]; /* message counters */
  uint8_t answer_counter;
} hoap2_can_board_t;

/* Power on. board: index in HOAP2_CAN_BOARD. */
void hoap2_can_board_init(hoap2_can_board_t *board, int index);

/* A frame of the board's bus. Returns 0, or why it is refused (it is counted). */
int hoap2_can_board_receive(hoap2_can_board_t *board, const hoap2_can_frame_t *frame);

/* One tick: drives are set (see board->drives), frames are added to the outbox. */
void hoap2_can_board_tick(hoap2_can_board_t *board, const hoap2_can_sensed_t *sensed,
                          hoap2_can_outbox_t *out);

/* The board's stop button: it stops, and tells everyone on its bus. */
void hoap2_can_board_stop(hoap2_can_board_t *board);

#ifdef __cplusplus
}
#endif
#endif
