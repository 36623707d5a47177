/* Limits of the references, and the outputs in the world frame. */
#ifndef HOAP2_CORE_OUTPUTS_H
#define HOAP2_CORE_OUTPUTS_H

#include "hoap2/state.h"

/* Soft joint limits alone. Returns 1 when one was met. */
int hoap2_clip_to_limits(double q_rad[HOAP2_SIZE_JOINT]);

/* Soft joint limits, and the joint rates: q_ref moves at most velocity limit times one tick from q_last. A
 * reference that is not finite becomes q_last. Returns 1 when a soft limit was met. */
int hoap2_limit_references(const double q_last_rad[HOAP2_SIZE_JOINT], double q_ref_rad[HOAP2_SIZE_JOINT]);

/* Fills state->out from the rest of the state and q_ref_rad. */
void hoap2_fill_outputs(hoap2_state_t *state, const double q_ref_rad[HOAP2_SIZE_JOINT]);

#endif
