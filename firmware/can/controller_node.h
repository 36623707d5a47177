/* The controller's side of the two buses: its outputs become frames, the boards' frames become its inputs.
 *
 * One tick: hoap2_can_controller_send makes the frames of the controller's last outputs; each frame that
 * arrives goes to hoap2_can_controller_receive; hoap2_can_controller_inputs then gives the inputs of the next
 * controller step. A board's measurements that did not come are held. `sensor_tick` of the inputs is the tick
 * of the oldest measurement in use, so the controller's own watchdog sees any board that is silent. All state
 * is one plain struct.
 */
#ifndef HOAP2_CAN_CONTROLLER_NODE_H
#define HOAP2_CAN_CONTROLLER_NODE_H

#include "can/codec.h"
#include "can/track.h"
#include "hoap2/generated/signals.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What the controller knows of a board. */
typedef struct {
  hoap2_can_track_t measured; /* status, cells or imu */
  hoap2_can_track_t beat;
  hoap2_can_track_t answer;
  hoap2_can_track_t reply;
  int32_t settings_raw[HOAP2_CAN_MAX_FIELDS];
  int32_t reply_raw[4];  /* last reply */
  int32_t replies;       /* number of them */
  int32_t measured_tick; /* of the newest measurement */
  int32_t protocol_known;
  int32_t mode;          /* HOAP2_CAN_BOARD_MODE_* as told by the board */
  int32_t settings_open; /* not answered yet */
  int32_t settings_age_ticks;
  uint8_t settings_counter;
  uint8_t sent[HOAP2_CAN_KINDS]; /* message counters of frames to this board */
} hoap2_can_peer_t;

typedef struct {
  hoap2_can_peer_t peer[HOAP2_CAN_BOARDS];
  hoap2_inputs_t inputs; /* as measured last */
  int32_t tick;
  int32_t state;   /* HOAP2_CAN_CONTROLLER_STATE_* */
  int32_t foreign; /* frames heard that carry the controller's own identifiers */
  int32_t stop_reason;
  int32_t request_board; /* -1: none waits */
  int32_t request_raw[4];
  uint32_t clipped; /* references that the coding could not hold */
  uint32_t refused[HOAP2_CAN_REFUSALS];
  uint8_t sent[HOAP2_CAN_KINDS][HOAP2_CAN_BUSES]; /* message counters of frames to all */
} hoap2_can_controller_t;

void hoap2_can_controller_init(hoap2_can_controller_t *controller);

/* Frames of this tick, by bus. */
void hoap2_can_controller_send(hoap2_can_controller_t *controller, const hoap2_outputs_t *outputs,
                               hoap2_can_outbox_t out[HOAP2_CAN_BUSES]);

/* A frame that arrived. Returns 0, or why it is refused (it is counted). */
int hoap2_can_controller_receive(hoap2_can_controller_t *controller, int bus, const hoap2_can_frame_t *frame);

/* Ends the tick: the inputs of the next controller step. */
void hoap2_can_controller_inputs(hoap2_can_controller_t *controller, hoap2_inputs_t *inputs);

/* Emergency stop of all boards, until init. */
void hoap2_can_controller_stop(hoap2_can_controller_t *controller, int reason);

/* Asks a board for a parameter, or writes it; the reply appears in peer[board].reply_raw. Returns 0, or 1
 * when another request waits or there is no such board. */
int hoap2_can_controller_request(hoap2_can_controller_t *controller, int board, int operation, int parameter,
                                 int joint, float value);

#ifdef __cplusplus
}
#endif
#endif
