/* The two ends of the buses for processes of their own: the controller's node here, the robot's nine boards there,
 * and any CAN bus between them. The modelled link (link.h) has both ends and the buses in one.
 *
 * A tick of either end: take the frames that arrived, then hoap2_*_end_tick, then send its frames.
 */
#ifndef HOAP2_LINK_ENDS_H
#define HOAP2_LINK_ENDS_H

#include "hoap2_link/link.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { HOAP2_END_FRAMES = 9 * HOAP2_CAN_OUTBOX_FRAMES };

typedef struct hoap2_controller_end hoap2_controller_end_t;
typedef struct hoap2_boards_end hoap2_boards_end_t;

/* Frames to send. */
typedef struct {
  int32_t count;
  int32_t bus[HOAP2_END_FRAMES];
  hoap2_can_frame_t frame[HOAP2_END_FRAMES];
} hoap2_end_frames_t;

/* How an end is. */
typedef struct {
  int32_t state; /* HOAP2_CAN_CONTROLLER_STATE_*; of the boards: 0 */
  int32_t holding; /* boards that do not follow the controller */
  int32_t holds;   /* times that a board went to its safe mode */
  int32_t clipped; /* values of the controller that the coding could not hold */
  int32_t refused[HOAP2_LINK_REASONS]; /* HOAP2_CAN_REFUSED_* */
} hoap2_end_health_t;

/* NULL when memory is short. Switched on when created. */
hoap2_controller_end_t *hoap2_controller_end_create(void);
void hoap2_controller_end_destroy(hoap2_controller_end_t *end);
/* A frame that arrived; returns 0, or why it is refused. */
int hoap2_controller_end_receive(hoap2_controller_end_t *end, int bus, const hoap2_can_frame_t *frame);
/* The frames of the controller's outputs. */
void hoap2_controller_end_send(hoap2_controller_end_t *end, const hoap2_link_command_t *asked,
                               hoap2_end_frames_t *frames);
/* Ends the tick: the controller's next inputs. */
void hoap2_controller_end_inputs(hoap2_controller_end_t *end, hoap2_link_measured_t *inputs);
void hoap2_controller_end_health(const hoap2_controller_end_t *end, hoap2_end_health_t *health);

hoap2_boards_end_t *hoap2_boards_end_create(void);
void hoap2_boards_end_destroy(hoap2_boards_end_t *end);
/* To every board of the bus; returns how many refuse it. */
int hoap2_boards_end_receive(hoap2_boards_end_t *end, int bus, const hoap2_can_frame_t *frame);
/* The boards act on what has arrived, measure and send. fresh: this is a new measurement. */
void hoap2_boards_end_tick(hoap2_boards_end_t *end, const hoap2_link_measured_t *measured, int fresh,
                           hoap2_link_command_t *to_plant, hoap2_end_frames_t *frames);
void hoap2_boards_end_health(const hoap2_boards_end_t *end, hoap2_end_health_t *health);

#ifdef __cplusplus
}
#endif
#endif
