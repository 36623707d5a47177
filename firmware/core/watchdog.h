/* Are the inputs of this tick fit for use? */
#ifndef HOAP2_CORE_WATCHDOG_H
#define HOAP2_CORE_WATCHDOG_H

#include "hoap2/state.h"

/* Takes good inputs over into state->held. Returns 1 when they are good; otherwise held keeps the last
 * good frame, and the fault bit is set once more than params.stale_limit_ticks frames in a row were bad. */
int hoap2_watchdog_step(hoap2_state_t *state, const hoap2_inputs_t *inputs);

#endif
