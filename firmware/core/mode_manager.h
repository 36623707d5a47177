/* Mode manager: start-up, calibration, behaviour, and the safe stop after a fault. */
#ifndef HOAP2_CORE_MODE_MANAGER_H
#define HOAP2_CORE_MODE_MANAGER_H

#include "hoap2/state.h"

/* One tick: chooses the mode, runs what belongs to it, and leaves the joint references in q_ref_rad.
 * good: the inputs of this tick were fit for use. */
void hoap2_mode_step(hoap2_state_t *state, int good, double q_ref_rad[HOAP2_SIZE_JOINT]);

#endif
