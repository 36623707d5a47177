/* The controller's C interface: one plain state, one tick a millisecond.
 *
 * The state holds everything (parameters included) and no pointers: saving,
 * restoring, cloning and hashing a controller are memcpy, memcmp.
 */
#ifndef HOAP2_HOAP2_H
#define HOAP2_HOAP2_H

#include <stddef.h>

#include "hoap2/generated/signals.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hoap2_state hoap2_state_t; /* defined in hoap2/state.h */

/* Size in bytes of hoap2_state_t, for callers that do not include its definition. */
size_t hoap2_state_size(void);

/* Start from params. Returns 0, or fault bits (HOAP2_FAULT_*) when the
 * parameters cannot be used; the state is then in mode SAFE and stays there. */
int32_t hoap2_init(hoap2_state_t *state, const hoap2_params_t *params);

/* Change tunable parameters between ticks; all others keep their value.
 * Returns 0, the number of elements out of range, or -1 when the values do not go together (fault
 * bad_parameter says which must); unless it is 0, nothing changes. */
int32_t hoap2_tune(hoap2_state_t *state, const hoap2_params_t *params);

/* One tick of exactly HOAP2_TICK_US. Never fails: bad inputs lead to the safe
 * response and to fault bits in the outputs. */
void hoap2_step(hoap2_state_t *state, const hoap2_inputs_t *inputs, hoap2_outputs_t *outputs);

/* The outputs of the last tick (of the initial state before the first). */
void hoap2_get_outputs(const hoap2_state_t *state, hoap2_outputs_t *outputs);

#ifdef __cplusplus
}
#endif
#endif
