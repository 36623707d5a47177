/* The controller's whole state as plain structs: no pointers, no hidden parts.
 *
 * Frame O is the start frame: on the floor midway between the soles at the start,
 * x forward, z up. The controller thinks in O only; the outputs are moved to W by
 * the start pose at the very end, so the joint commands do not depend on W.
 */
#ifndef HOAP2_STATE_H
#define HOAP2_STATE_H

#include "gait_cp/gait_state.h"
#include "hoap2/hoap2.h"
#include "sense/sense_state.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Mode manager: what the robot is doing and since when. */
typedef struct {
  double safe_from_rad[HOAP2_SIZE_JOINT]; /* references when the crouch began */
  int32_t mode;                           /* HOAP2_MODE_* */
  int32_t mode_tick;                      /* ticks since the mode began */
  int32_t fault;                          /* HOAP2_FAULT_* bits, never cleared */
  int32_t bad_ticks;                      /* consecutive frames with bad values */
  int32_t stale_ticks;                    /* consecutive frames without a new sensor_tick */
  int32_t last_sensor_tick;
  int32_t request_clipped; /* a requested value of this tick was beyond its range */
  int32_t request_bad;     /* the request of this tick was not finite or not known: the last good one holds */
  int32_t tick;
} hoap2_mode_state_t;

struct hoap2_state {
  hoap2_params_t params;
  hoap2_inputs_t held; /* the last valid inputs */
  hoap2_outputs_t out;
  hoap2_sense_t sense;
  hoap2_gait_t gait;
  double stance_q_rad[HOAP2_SIZE_JOINT]; /* the walking stance, found at init */
  double start_q_rad[HOAP2_SIZE_JOINT];  /* where the joints were in the first tick */
  hoap2_mode_state_t mode;
};

#ifdef __cplusplus
}
#endif
#endif
