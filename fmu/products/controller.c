/* The controller behind the FMI shells. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../generated/controller_fields.h"
#include "../product.h"
#include "hoap2/generated/names.h"
#include "hoap2/hoap2.h"

typedef struct {
  hoap2_state_t *state;
  char error[320];
} model_t;

const hoap2_fmu_product_t HOAP2_FMU_PRODUCT = {
    .name = "hoap2_controller",
    .token = HOAP2_FMU_TOKEN,
    .fields = FIELDS,
    .field_count = HOAP2_FMU_FIELDS,
    .element_names = ELEMENT_NAMES,
    .element_count = HOAP2_FMU_ELEMENTS,
    .group_size = {sizeof(hoap2_inputs_t), sizeof(hoap2_outputs_t), sizeof(hoap2_params_t)},
    .tick_us = HOAP2_TICK_US,
    .schema = HOAP2_SCHEMA,
};

void hoap2_product_defaults(void *inputs, void *params) {
  memset(inputs, 0, sizeof(hoap2_inputs_t));
  memset(params, 0, sizeof(hoap2_params_t));
  hoap2_inputs_defaults(inputs);
  hoap2_params_defaults(params);
}

void *hoap2_product_create(void) {
  model_t *model = calloc(1, sizeof *model);
  if (!model) return NULL;
  model->state = calloc(1, hoap2_state_size());
  if (model->state) return model;
  free(model);
  return NULL;
}

void hoap2_product_destroy(void *model) {
  free(((model_t *)model)->state);
  free(model);
}

int hoap2_product_init(void *model, const void *params) {
  model_t *self = model;
  const int32_t faults = hoap2_init(self->state, params);
  if (faults == 0) return 0;
  for (int i = 0; i < HOAP2_FAULT_NAMES; ++i) {
    if (!(faults & HOAP2_FAULT_NAME[i].bit)) continue;
    snprintf(self->error, sizeof self->error, "%s (fault %s)", HOAP2_FAULT_NAME[i].text,
             HOAP2_FAULT_NAME[i].name);
    break;
  }
  return 1;
}

int hoap2_product_tune(void *model, const void *params) {
  model_t *self = model;
  const int32_t refused = hoap2_tune(self->state, params);
  if (refused == 0) return 0;
  if (refused > 0)
    snprintf(self->error, sizeof self->error, "%d values are out of range", (int)refused);
  else
    snprintf(self->error, sizeof self->error,
             "they do not go together: contact_off_N <= contact_on_N, tpcc_kx_1_s2 > tpcc_kp_1_s2 unless "
             "that is 0");
  return 1;
}

int hoap2_product_step(void *model, const void *inputs) {
  hoap2_outputs_t outputs; /* the state keeps them too: hoap2_get_outputs */
  hoap2_step(((model_t *)model)->state, inputs, &outputs);
  return 0;
}

void hoap2_product_get_outputs(const void *model, void *outputs) {
  hoap2_get_outputs(((const model_t *)model)->state, outputs);
}

size_t hoap2_product_state_size(const void *model) {
  (void)model;
  return hoap2_state_size();
}

void hoap2_product_get_state(const void *model, void *state) {
  memcpy(state, ((const model_t *)model)->state, hoap2_state_size());
}

int hoap2_product_set_state(void *model, const void *state, size_t size) {
  if (size != hoap2_state_size()) {
    snprintf(((model_t *)model)->error, sizeof((model_t *)model)->error, "%zu bytes are not a state", size);
    return 1;
  }
  memcpy(((model_t *)model)->state, state, hoap2_state_size());
  return 0;
}

const char *hoap2_product_error(const void *model) { return ((const model_t *)model)->error; }
