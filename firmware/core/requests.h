/* What the operator asks for: taken into the gait, limited or refused, and what became of it. */
#ifndef HOAP2_CORE_REQUESTS_H
#define HOAP2_CORE_REQUESTS_H

#include "hoap2/state.h"

/* Takes the requests of this tick over into state->gait.request. A request that is unknown, or whose step is
 * not finite, changes nothing; a step beyond its range is limited. As planned, the step does not count. */
void hoap2_requests_step(hoap2_state_t *state, const hoap2_inputs_t *inputs);

/* May a walk on request begin? Not with parameters whose steps in place are impossible, nor after a walk that
 * ended with the capture point lost (the feet then do not stand side by side). */
int hoap2_requests_may_walk(const hoap2_state_t *state);

/* HOAP2_REQUEST_STATE_* after this tick. */
int32_t hoap2_request_state(const hoap2_state_t *state);

#endif
