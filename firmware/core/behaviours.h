/* The table of behaviours. A new one is a room of its own, a row here, and its rows in signals.toml. */
#ifndef HOAP2_CORE_BEHAVIOURS_H
#define HOAP2_CORE_BEHAVIOURS_H

#include "hoap2/state.h"

typedef struct {
  /* after calibration, standing */
  void (*start)(hoap2_state_t *state);
  /* one tick: joint references */
  void (*step)(hoap2_state_t *state, double q_ref_rad[HOAP2_SIZE_JOINT]);
} hoap2_behaviour_t;

/* Row of the table; an index outside it gives the first row (standing). */
const hoap2_behaviour_t *hoap2_behaviour(int32_t index);

#endif
