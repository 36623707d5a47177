/* The bus FMU has bus terminals and no other variables: behind the shell is nothing that computes. */
#include <stdlib.h>

#include "../product.h"

enum { NOTHING = 8 }; /* bytes of a group without fields */

const hoap2_fmu_product_t HOAP2_FMU_PRODUCT = {
    .name = "hoap2_can_bus",
    .group_size = {NOTHING, NOTHING, NOTHING},
    .tick_us = 1000,
};

void hoap2_product_defaults(void *inputs, void *params) {
  (void)inputs;
  (void)params;
}

void *hoap2_product_create(void) { return calloc(1, NOTHING); }

void hoap2_product_destroy(void *model) { free(model); }

int hoap2_product_init(void *model, const void *params) {
  (void)model;
  (void)params;
  return 0;
}

int hoap2_product_tune(void *model, const void *params) {
  (void)model;
  (void)params;
  return 0;
}

int hoap2_product_step(void *model, const void *inputs) {
  (void)model;
  (void)inputs;
  return 0;
}

void hoap2_product_get_outputs(const void *model, void *outputs) {
  (void)model;
  (void)outputs;
}

size_t hoap2_product_state_size(const void *model) {
  (void)model;
  return 0;
}

void hoap2_product_get_state(const void *model, void *state) {
  (void)model;
  (void)state;
}

int hoap2_product_set_state(void *model, const void *state, size_t size) {
  (void)model;
  (void)state;
  return size == 0 ? 0 : 1;
}

const char *hoap2_product_error(const void *model) {
  (void)model;
  return "";
}
