/* The link over CAN between a controller and a plant: the controller's node, two modelled buses, nine boards.
 *
 * It stands between the two products where signals are exchanged directly otherwise:
 *
 *   outputs of the controller -> frames -> buses -> boards -> inputs of the plant
 *   outputs of the plant -> boards -> frames -> buses -> controller's node -> inputs of the controller
 *
 * In the exchange at tick k the boards act on the commands that had arrived before, both sides send, the
 * buses run for a tick, and the controller gets the measurements that arrived in it. So a command takes one
 * tick more than directly, a measurement none.
 */
#ifndef HOAP2_LINK_LINK_H
#define HOAP2_LINK_LINK_H

#include <stddef.h>
#include <stdint.h>

#include "can/frame.h"
#include "hoap2/generated/signals.h"
#include "hoap2_link/generated/disturbances.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { HOAP2_LINK_BUSES = 2, HOAP2_LINK_PRIORITIES = 16, HOAP2_LINK_CAUSES = 6, HOAP2_LINK_REASONS = 9 };

typedef struct hoap2_link hoap2_link_t;

/* What the controller asks of the drives, and what the drives are set to; signals as in
 * docs/generated/signals.md. */
typedef struct {
  double q_ref_rad[HOAP2_SIZE_JOINT];
  double qd_ref_rad_s[HOAP2_SIZE_JOINT];
  double tau_ff_Nm[HOAP2_SIZE_JOINT];
  double kp_Nm_rad[HOAP2_SIZE_JOINT];
  double kd_Nms_rad[HOAP2_SIZE_JOINT];
  int32_t drive_mode[HOAP2_SIZE_JOINT];
} hoap2_link_command_t;

/* What the boards measure, and what the controller gets of it. */
typedef struct {
  double q_enc_rad[HOAP2_SIZE_JOINT];
  double gyro_S_rad_s[HOAP2_SIZE_XYZ];
  double accel_S_m_s2[HOAP2_SIZE_XYZ];
  double cell_force_N[HOAP2_SIZE_CELL];
  double true_tau_Nm[HOAP2_SIZE_JOINT]; /* as motor current; not for the controller */
  int32_t sensor_tick;
} hoap2_link_measured_t;

/* Since the start of the run (the boot is not counted). */
typedef struct {
  int64_t queued[HOAP2_LINK_BUSES];
  int64_t delivered[HOAP2_LINK_BUSES];
  int64_t pending[HOAP2_LINK_BUSES];
  int64_t lost[HOAP2_LINK_BUSES]
              [HOAP2_LINK_CAUSES]; /* on_the_way, superseded, no_room, node_down, cut, bad */
  int64_t error_frames[HOAP2_LINK_BUSES];
  int64_t not_acknowledged[HOAP2_LINK_BUSES];
  int64_t changed[HOAP2_LINK_BUSES];
  int64_t busy_ns[HOAP2_LINK_BUSES];
  int64_t frames[HOAP2_LINK_PRIORITIES]; /* delivered, by message of the table */
  int64_t latency_sum_ns[HOAP2_LINK_PRIORITIES];
  int64_t latency_max_ns[HOAP2_LINK_PRIORITIES];
  int64_t refused_by_controller[HOAP2_LINK_REASONS]; /* HOAP2_CAN_REFUSED_* */
  int64_t refused_by_boards[HOAP2_LINK_REASONS];
  int64_t holds;      /* times that a board went to its safe mode */
  int64_t hold_ticks; /* sum over the boards */
  int64_t clipped;    /* values of the controller that the coding could not hold */
  int64_t ticks;
} hoap2_link_counts_t;

/* One tick. */
typedef struct {
  double busy_us[HOAP2_LINK_BUSES];
  double lost; /* frames */
  double refused;
  double holding;   /* boards in hold or stopped */
  double state;     /* HOAP2_CAN_CONTROLLER_STATE_* */
  double bus_modes; /* the largest error state of any node: 0 active, 1 passive, 2 off */
} hoap2_link_tick_t;

/* NULL when memory is short. */
hoap2_link_t *hoap2_link_create(void);
void hoap2_link_destroy(hoap2_link_t *link);

/* (Re)start; run_seed is that of the run. Returns 0, or 1 when a parameter is out of range. */
int hoap2_link_init(hoap2_link_t *link, const hoap2_link_params_t *params, uint32_t run_seed);

/* The exchange of a tick: outputs of both in, inputs of both out. */
void hoap2_link_exchange(hoap2_link_t *link, const hoap2_link_command_t *asked,
                         const hoap2_link_measured_t *measured, hoap2_link_command_t *to_plant,
                         hoap2_link_measured_t *to_controller, hoap2_link_tick_t *tick);

void hoap2_link_counts(const hoap2_link_t *link, hoap2_link_counts_t *counts);

/* Bits of a frame on the wire at each rate, from its start to the end of the intermission. */
void hoap2_link_frame_bits(const hoap2_can_frame_t *frame, int32_t *nominal, int32_t *data);

/* The whole state as one block of bytes; restoring it continues bit for bit. */
size_t hoap2_link_state_size(const hoap2_link_t *link);
void hoap2_link_get_state(const hoap2_link_t *link, void *state);
/* Returns 0, or 1 when the block is not a state of this version. */
int hoap2_link_set_state(hoap2_link_t *link, const void *state, size_t size);

#ifdef __cplusplus
}
#endif
#endif
