/* Values by value reference, and the range check of the parameters. */
#include <string.h>

#include "instance.h"

/* Neighbouring elements of one row: most importers ask for whole rows, element by element. */
typedef struct {
  const hoap2_fmu_field_t *field;
  uint32_t element; /* first element meant */
  uint32_t count;   /* elements meant */
  size_t used;      /* references that mean them */
} span_t;

static size_t element_size(int kind) { return kind == HOAP2_FMU_REAL ? sizeof(double) : sizeof(int32_t); }

static char *element_address(void *group, const hoap2_fmu_field_t *field, uint32_t element) {
  return (char *)group + field->offset + element * element_size(field->kind);
}

/* Row that holds element `reference` (from 1), or NULL. */
static const hoap2_fmu_field_t *row_of_element(unsigned reference) {
  if (reference == 0 || reference > HOAP2_FMU_PRODUCT.element_count) return NULL;
  uint32_t low = 0,
           high = HOAP2_FMU_PRODUCT.field_count; /* first_element of low <= reference < that of high */
  while (high - low > 1) {
    const uint32_t middle = low + (high - low) / 2;
    if (HOAP2_FMU_PRODUCT.fields[middle].first_element <= reference) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return &HOAP2_FMU_PRODUCT.fields[low];
}

/* What the next of `left` references mean; false (and a log) when the first means nothing of this kind. */
static bool find(hoap2_fmu_instance_t *self, bool by_row, int kind, const unsigned *references, size_t left,
                 span_t *span) {
  const unsigned first = references[0];
  if (by_row) {
    const bool known = first >= 1 && first <= HOAP2_FMU_PRODUCT.field_count;
    span->field = known ? &HOAP2_FMU_PRODUCT.fields[first - 1] : NULL;
    span->element = 0;
    span->count = known ? span->field->count : 0;
    span->used = 1;
  } else {
    span->field = row_of_element(first);
    span->element = span->field ? first - span->field->first_element : 0;
    const size_t rest = span->field ? span->field->count - span->element : 0;
    const size_t most = left < rest ? left : rest;
    size_t run = 1;
    while (run < most && references[run] == first + run) ++run;
    span->count = (uint32_t)run;
    span->used = run;
  }
  if (span->field && span->field->kind == kind) return true;
  hoap2_fmu_error(self, "there is no %s variable with value reference %u",
                  kind == HOAP2_FMU_REAL ? "real" : "integer", first);
  return false;
}

static const char *name_of(bool by_row, const span_t *span) {
  return by_row ? span->field->name
                : HOAP2_FMU_PRODUCT.element_names[span->field->first_element - 1 + span->element];
}

/* Bounds of an array argument: NULL only when empty. */
static bool arguments_ok(hoap2_fmu_instance_t *self, const void *references, size_t count,
                         const void *values) {
  if (count == 0 || (references && values)) return true;
  hoap2_fmu_error(self, "value references or values are NULL");
  return false;
}

static bool sizes_ok(hoap2_fmu_instance_t *self, size_t expected, size_t given) {
  if (expected == given) return true;
  hoap2_fmu_error(self, "the variables have %zu elements in all, not %zu", expected, given);
  return false;
}

/* FMI 3: the independent variable is value reference 0. */
static bool is_time(bool by_row, int kind, unsigned reference) {
  return by_row && kind == HOAP2_FMU_REAL && reference == 0;
}

hoap2_fmu_status_t hoap2_fmu_get(hoap2_fmu_instance_t *self, bool by_row, int kind,
                                 const unsigned *references, size_t count, void *values, size_t value_count) {
  if (!arguments_ok(self, references, count, values)) return HOAP2_FMU_ERROR;
  span_t span = {NULL, 0, 0, 0};
  size_t total = 0;
  bool outputs = false;
  for (size_t i = 0; i < count; i += span.used) {
    if (is_time(by_row, kind, references[i])) {
      total += 1;
      span.used = 1;
      continue;
    }
    if (!find(self, by_row, kind, references + i, count - i, &span)) return HOAP2_FMU_ERROR;
    outputs = outputs || span.field->group == HOAP2_FMU_OUTPUT;
    total += span.count;
  }
  if (!sizes_ok(self, total, value_count)) return HOAP2_FMU_ERROR;
  if (outputs && hoap2_fmu_prepare(self) != HOAP2_FMU_OK) return HOAP2_FMU_ERROR;
  char *target = values;
  for (size_t i = 0; i < count; i += span.used) {
    if (is_time(by_row, kind, references[i])) {
      span.used = 1;
      const double time_s = hoap2_fmu_time_s(self);
      memcpy(target, &time_s, sizeof time_s);
      target += sizeof time_s;
      continue;
    }
    find(self, by_row, kind, references + i, count - i, &span);
    const size_t bytes = span.count * element_size(kind);
    memcpy(target, element_address(self->group[span.field->group], span.field, span.element), bytes);
    target += bytes;
  }
  return HOAP2_FMU_OK;
}

static bool may_set(hoap2_fmu_instance_t *self, bool by_row, const span_t *span) {
  const hoap2_fmu_field_t *field = span->field;
  if (field->group == HOAP2_FMU_INPUT) return true;
  if (field->group == HOAP2_FMU_OUTPUT) {
    hoap2_fmu_error(self, "%s is an output and cannot be set", name_of(by_row, span));
    return false;
  }
  if (!((unsigned)self->mode & HOAP2_FMU_RUNNING) || field->tunable) return true;
  hoap2_fmu_error(self, "%s is fixed: it can be set only before the end of initialisation",
                  name_of(by_row, span));
  return false;
}

/* Write the values of one group's variables to target (that group's struct); all were checked before. */
static void write_group(hoap2_fmu_instance_t *self, int group, void *target, bool by_row, int kind,
                        const unsigned *references, size_t count, const void *values) {
  span_t span = {NULL, 0, 0, 0};
  const char *source = values;
  for (size_t i = 0; i < count; i += span.used) {
    find(self, by_row, kind, references + i, count - i, &span);
    const size_t bytes = span.count * element_size(kind);
    if (span.field->group == group) memcpy(element_address(target, span.field, span.element), source, bytes);
    source += bytes;
  }
}

/* Between steps: the model takes the trial parameters or refuses them, then nothing has changed. */
static hoap2_fmu_status_t tune(hoap2_fmu_instance_t *self) {
  if (hoap2_fmu_check_parameters(self, self->trial_params) != HOAP2_FMU_OK) return HOAP2_FMU_ERROR;
  if (hoap2_product_tune(self->model, self->trial_params) != 0) {
    return hoap2_fmu_error(self, "parameters refused: %s", hoap2_product_error(self->model));
  }
  return HOAP2_FMU_OK;
}

hoap2_fmu_status_t hoap2_fmu_set(hoap2_fmu_instance_t *self, bool by_row, int kind,
                                 const unsigned *references, size_t count, const void *values,
                                 size_t value_count) {
  if (!arguments_ok(self, references, count, values)) return HOAP2_FMU_ERROR;
  span_t span = {NULL, 0, 0, 0};
  size_t total = 0;
  bool parameters = false;
  for (size_t i = 0; i < count; i += span.used) {
    if (!find(self, by_row, kind, references + i, count - i, &span) || !may_set(self, by_row, &span))
      return HOAP2_FMU_ERROR;
    parameters = parameters || span.field->group == HOAP2_FMU_PARAMETER;
    total += span.count;
  }
  if (!sizes_ok(self, total, value_count)) return HOAP2_FMU_ERROR;
  if (parameters) {
    void *params = self->group[HOAP2_FMU_PARAMETER];
    const size_t size = HOAP2_FMU_PRODUCT.group_size[HOAP2_FMU_PARAMETER];
    memcpy(self->trial_params, params, size);
    write_group(self, HOAP2_FMU_PARAMETER, self->trial_params, by_row, kind, references, count, values);
    if ((unsigned)self->mode & HOAP2_FMU_RUNNING) {
      if (tune(self) != HOAP2_FMU_OK) return HOAP2_FMU_ERROR;
    } else {
      self->model_ready = false;
    }
    memcpy(params, self->trial_params, size);
  }
  write_group(self, HOAP2_FMU_INPUT, self->group[HOAP2_FMU_INPUT], by_row, kind, references, count, values);
  return HOAP2_FMU_OK;
}

hoap2_fmu_status_t hoap2_fmu_check_parameters(hoap2_fmu_instance_t *self, const void *params) {
  for (uint32_t i = 0; i < HOAP2_FMU_PRODUCT.field_count; ++i) {
    const hoap2_fmu_field_t *field = &HOAP2_FMU_PRODUCT.fields[i];
    if (field->group != HOAP2_FMU_PARAMETER) continue;
    for (uint32_t e = 0; e < field->count; ++e) {
      const char *address = (const char *)params + field->offset + e * element_size(field->kind);
      double value = 0.0;
      int32_t whole = 0;
      if (field->kind == HOAP2_FMU_REAL) {
        memcpy(&value, address, sizeof value);
      } else {
        memcpy(&whole, address, sizeof whole);
        value = (double)whole;
      }
      if (value >= field->low && value <= field->high) continue;
      return hoap2_fmu_error(self, "parameter %s = %.17g is outside its range %g ... %g",
                             HOAP2_FMU_PRODUCT.element_names[field->first_element - 1 + e], value, field->low,
                             field->high);
    }
  }
  return HOAP2_FMU_OK;
}
