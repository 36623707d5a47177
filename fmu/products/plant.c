/* The plant behind the FMI shells. */
#include "hoap2_plant/plant.h"

#include <string.h>

#include "../generated/plant_fields.h"
#include "../product.h"

const hoap2_fmu_product_t HOAP2_FMU_PRODUCT = {
    .name = "hoap2_plant",
    .token = HOAP2_FMU_TOKEN,
    .fields = FIELDS,
    .field_count = HOAP2_FMU_FIELDS,
    .element_names = ELEMENT_NAMES,
    .element_count = HOAP2_FMU_ELEMENTS,
    .group_size = {sizeof(hoap2_plant_inputs_t), sizeof(hoap2_plant_outputs_t), sizeof(hoap2_plant_params_t)},
    .tick_us = HOAP2_TICK_US,
    .schema = HOAP2_SCHEMA,
};

void hoap2_product_defaults(void *inputs, void *params) {
  memset(inputs, 0, sizeof(hoap2_plant_inputs_t));
  memset(params, 0, sizeof(hoap2_plant_params_t));
  hoap2_plant_inputs_defaults(inputs);
  hoap2_plant_params_defaults(params);
}

void *hoap2_product_create(void) { return hoap2_plant_create(); }

void hoap2_product_destroy(void *model) { hoap2_plant_destroy(model); }

int hoap2_product_init(void *model, const void *params) { return hoap2_plant_init(model, params); }

/* The plant has no tunable parameters: the field table lets none through. */
int hoap2_product_tune(void *model, const void *params) {
  (void)model;
  (void)params;
  return 0;
}

int hoap2_product_step(void *model, const void *inputs) { return hoap2_plant_step(model, inputs); }

void hoap2_product_get_outputs(const void *model, void *outputs) { hoap2_plant_get_outputs(model, outputs); }

size_t hoap2_product_state_size(const void *model) { return hoap2_plant_state_size(model); }

void hoap2_product_get_state(const void *model, void *state) { hoap2_plant_get_state(model, state); }

int hoap2_product_set_state(void *model, const void *state, size_t size) {
  return hoap2_plant_set_state(model, state, size);
}

const char *hoap2_product_error(const void *model) { return hoap2_plant_error(model); }
