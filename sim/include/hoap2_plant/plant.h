/* The plant's C interface: robot, drives, sensors, terrain, pushes.
 *
 * Instances are independent. An instance may be stepped from any thread, one
 * thread at a time.
 */
#ifndef HOAP2_PLANT_PLANT_H
#define HOAP2_PLANT_PLANT_H

#include <stddef.h>

#include "hoap2_plant/generated/plant_signals.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hoap2_plant hoap2_plant_t;

/* NULL when memory is short. */
hoap2_plant_t *hoap2_plant_create(void);
void hoap2_plant_destroy(hoap2_plant_t *plant);

/* (Re)start from params. Returns 0, or non-zero: hoap2_plant_error says why. */
int hoap2_plant_init(hoap2_plant_t *plant, const hoap2_plant_params_t *params);

/* One tick of HOAP2_TICK_US with inputs held. Returns 0, or non-zero (NaN input,
 * diverged state); the plant then keeps its last state. */
int hoap2_plant_step(hoap2_plant_t *plant, const hoap2_plant_inputs_t *inputs);

/* Outputs of the present state (valid from hoap2_plant_init on). */
void hoap2_plant_get_outputs(const hoap2_plant_t *plant, hoap2_plant_outputs_t *outputs);

/* The whole state as one block of bytes; restoring it continues bit for bit. The size
 * depends on the parameters (the soil's height field), and is fixed from init on. */
size_t hoap2_plant_state_size(const hoap2_plant_t *plant);
void hoap2_plant_get_state(const hoap2_plant_t *plant, void *state);
/* Returns 0, or non-zero when the block is not a whole state of this version. It may be
 * the state of another instance, with other parameters. */
int hoap2_plant_set_state(hoap2_plant_t *plant, const void *state, size_t size);

/* Last error text of this instance, "" if none. */
const char *hoap2_plant_error(const hoap2_plant_t *plant);

#ifdef __cplusplus
}
#endif
#endif
