/* What the FMI shells need from a product (controller, plant). One product is
 * linked into each FMU; the shells know nothing else about it.
 */
#ifndef HOAP2_FMU_PRODUCT_H
#define HOAP2_FMU_PRODUCT_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { HOAP2_FMU_INPUT = 0, HOAP2_FMU_OUTPUT = 1, HOAP2_FMU_PARAMETER = 2, HOAP2_FMU_GROUPS = 3 };
enum { HOAP2_FMU_REAL = 0, HOAP2_FMU_INT = 1 };

/* One row of the table of signals. The FMI 3 value reference is the row's number
 * from 1; the FMI 2 one of element e (row-major, from 0) is first_element + e. */
typedef struct {
  const char *name;
  int group;   /* HOAP2_FMU_INPUT ... */
  int kind;    /* HOAP2_FMU_REAL: double, HOAP2_FMU_INT: int32_t */
  int tunable; /* a parameter that may change between steps */
  uint32_t first_element;
  uint32_t count;
  size_t offset; /* bytes from the start of the group's struct */
  double low;    /* allowed range, ends included */
  double high;
} hoap2_fmu_field_t;

typedef struct {
  const char *name;  /* modelIdentifier */
  const char *token; /* guid, instantiationToken: a hash of the tables */
  const hoap2_fmu_field_t *fields;
  uint32_t field_count;
  const char *const *element_names; /* FMI 2 names, by value reference - 1 */
  uint32_t element_count;
  size_t group_size[HOAP2_FMU_GROUPS]; /* bytes of the inputs, outputs and parameters structs */
  int64_t tick_us;
  int32_t schema;
} hoap2_fmu_product_t;

extern const hoap2_fmu_product_t HOAP2_FMU_PRODUCT;

/* The structs behind void pointers are the product's own inputs_t, outputs_t, params_t. */
void hoap2_product_defaults(void *inputs, void *params);
void *hoap2_product_create(void); /* NULL when memory is short */
void hoap2_product_destroy(void *model);
/* 0, or non-zero: hoap2_product_error says why. */
int hoap2_product_init(void *model, const void *params);
int hoap2_product_tune(void *model, const void *params);
/* One tick with inputs held. Non-zero: the model keeps its last state. */
int hoap2_product_step(void *model, const void *inputs);
void hoap2_product_get_outputs(const void *model, void *outputs);
/* Size of the present state; a set one must say its own. */
size_t hoap2_product_state_size(const void *model);
void hoap2_product_get_state(const void *model, void *state);
int hoap2_product_set_state(void *model, const void *state, size_t size);
const char *hoap2_product_error(const void *model);

#ifdef __cplusplus
}
#endif
#endif
