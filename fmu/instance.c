#include "instance.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "network.h"

static const char *const CATEGORY_NAMES[HOAP2_FMU_LOG_CATEGORIES] = {"logStatusError", "logStatusWarning",
                                                                     "logEvents"};
/* Communication points that an importer adds up in floating point may be off by this part of a tick. */
static const double TICK_TOLERANCE = 0.1;
static const double MAX_TICKS_PER_STEP = 1e9;

hoap2_fmu_instance_t *hoap2_fmu_create(const char *name, hoap2_fmu_emit_t emit, void (*logger)(void),
                                       void *environment, bool logging_on) {
  hoap2_fmu_instance_t *self = calloc(1, sizeof *self);
  if (!self) return NULL;
  self->emit = emit;
  self->logger = logger;
  self->environment = environment;
  self->logging_on = logging_on;
  self->categories = HOAP2_FMU_LOG_ALL;
  self->name = malloc(strlen(name) + 1);
  self->model = hoap2_product_create();
  self->trial_params = calloc(1, HOAP2_FMU_PRODUCT.group_size[HOAP2_FMU_PARAMETER]);
  bool complete = self->name && self->model && self->trial_params;
  if (hoap2_network_present()) {
    self->network = calloc(1, hoap2_network_size());
    complete = complete && self->network;
  }
  for (int g = 0; g < HOAP2_FMU_GROUPS; ++g) {
    self->group[g] = calloc(1, HOAP2_FMU_PRODUCT.group_size[g]);
    complete = complete && self->group[g];
  }
  if (!complete) {
    hoap2_fmu_free(self);
    return NULL;
  }
  strcpy(self->name, name);
  hoap2_fmu_reset(self);
  return self;
}

void hoap2_fmu_free(hoap2_fmu_instance_t *self) {
  if (!self) return;
  if (self->model) hoap2_product_destroy(self->model);
  for (int g = 0; g < HOAP2_FMU_GROUPS; ++g) free(self->group[g]);
  free(self->trial_params);
  free(self->undo);
  free(self->network);
  free(self->name);
  free(self);
}

static void log_v(hoap2_fmu_instance_t *self, hoap2_fmu_category_t category, const char *format,
                  va_list values) __attribute__((format(printf, 3, 0)));

static void log_v(hoap2_fmu_instance_t *self, hoap2_fmu_category_t category, const char *format,
                  va_list values) {
  if (!self->logging_on || !self->logger || !(self->categories & (1u << category))) return;
  char text[512];
  vsnprintf(text, sizeof text, format, values);
  for (char *c = text; *c; ++c) {
    if (*c == '%' || *c == '#') *c = '?';
  }
  self->emit(self, category, CATEGORY_NAMES[category], text);
}

void hoap2_fmu_log(hoap2_fmu_instance_t *self, hoap2_fmu_category_t category, const char *format, ...) {
  va_list values;
  va_start(values, format);
  log_v(self, category, format, values);
  va_end(values);
}

hoap2_fmu_status_t hoap2_fmu_error(hoap2_fmu_instance_t *self, const char *format, ...) {
  va_list values;
  va_start(values, format);
  log_v(self, HOAP2_FMU_LOG_ERROR, format, values);
  va_end(values);
  return HOAP2_FMU_ERROR;
}

hoap2_fmu_status_t hoap2_fmu_set_logging(hoap2_fmu_instance_t *self, bool logging_on, size_t count,
                                         const char *const names[]) {
  unsigned categories = count ? 0 : HOAP2_FMU_LOG_ALL;
  if (count && !names) return hoap2_fmu_error(self, "set debug logging: no names of categories");
  for (size_t i = 0; i < count; ++i) {
    int found = -1;
    for (int k = 0; k < HOAP2_FMU_LOG_CATEGORIES; ++k) {
      if (names[i] && strcmp(names[i], CATEGORY_NAMES[k]) == 0) found = k;
    }
    if (found < 0) return hoap2_fmu_error(self, "unknown log category %s", names[i] ? names[i] : "(null)");
    categories |= 1u << found;
  }
  self->logging_on = logging_on;
  self->categories = categories;
  return HOAP2_FMU_OK;
}

bool hoap2_fmu_allowed(hoap2_fmu_instance_t *self, const char *call, unsigned modes) {
  if (!self) return false;
  if ((unsigned)self->mode & modes) return true;
  const char *where = self->mode == HOAP2_FMU_INSTANTIATED   ? "before initialisation"
                      : self->mode == HOAP2_FMU_INITIALISING ? "in initialisation"
                      : self->mode == HOAP2_FMU_STEPPING     ? "between steps"
                      : self->mode == HOAP2_FMU_EVENT        ? "in event mode"
                                                             : "after termination";
  hoap2_fmu_error(self, "%s is not allowed %s", call, where);
  return false;
}

hoap2_fmu_status_t hoap2_fmu_set_times(hoap2_fmu_instance_t *self, double start_s, bool stop_defined,
                                       double stop_s) {
  if (!isfinite(start_s)) return hoap2_fmu_error(self, "start time %g s is not a finite number", start_s);
  if (stop_defined && !(stop_s >= start_s)) {
    return hoap2_fmu_error(self, "stop time %g s lies before start time %g s", stop_s, start_s);
  }
  self->start_time_s = start_s;
  self->stop_time_s = stop_defined ? stop_s : (double)INFINITY;
  return HOAP2_FMU_OK;
}

hoap2_fmu_status_t hoap2_fmu_enter_initialisation(hoap2_fmu_instance_t *self) {
  self->model_ready = false;
  self->tick = 0;
  self->mode = HOAP2_FMU_INITIALISING;
  return HOAP2_FMU_OK;
}

hoap2_fmu_status_t hoap2_fmu_prepare(hoap2_fmu_instance_t *self) {
  if (self->model_ready) return HOAP2_FMU_OK;
  const void *params = self->group[HOAP2_FMU_PARAMETER];
  if (hoap2_fmu_check_parameters(self, params) != HOAP2_FMU_OK) return HOAP2_FMU_ERROR;
  if (hoap2_product_init(self->model, params) != 0) {
    return hoap2_fmu_error(self, "initialisation failed: %s", hoap2_product_error(self->model));
  }
  hoap2_product_get_outputs(self->model, self->group[HOAP2_FMU_OUTPUT]);
  self->model_ready = true;
  return HOAP2_FMU_OK;
}

hoap2_fmu_status_t hoap2_fmu_exit_initialisation(hoap2_fmu_instance_t *self) {
  if (hoap2_fmu_prepare(self) != HOAP2_FMU_OK) return HOAP2_FMU_ERROR;
  self->mode = self->event_mode_used ? HOAP2_FMU_EVENT : HOAP2_FMU_STEPPING;
  hoap2_network_start(self);
  hoap2_fmu_log(self, HOAP2_FMU_LOG_EVENT, "initialised at %g s", self->start_time_s);
  return HOAP2_FMU_OK;
}

void hoap2_fmu_reset(hoap2_fmu_instance_t *self) {
  memset(self->group[HOAP2_FMU_OUTPUT], 0, HOAP2_FMU_PRODUCT.group_size[HOAP2_FMU_OUTPUT]);
  hoap2_product_defaults(self->group[HOAP2_FMU_INPUT], self->group[HOAP2_FMU_PARAMETER]);
  self->mode = HOAP2_FMU_INSTANTIATED;
  self->start_time_s = 0.0;
  self->stop_time_s = (double)INFINITY;
  self->tick = 0;
  self->model_ready = false;
  if (self->network) memset(self->network, 0, hoap2_network_size());
}

static double tick_s(void) { return (double)HOAP2_FMU_PRODUCT.tick_us / 1e6; }

double hoap2_fmu_time_s(const hoap2_fmu_instance_t *self) {
  if (self->event_mode_used) return hoap2_network_time_s(self);
  return self->start_time_s + (double)(self->tick * HOAP2_FMU_PRODUCT.tick_us) / 1e6;
}

/* Whole number of ticks of a step, 0 when it is refused (the reason is logged). */
static int64_t ticks_of_step(hoap2_fmu_instance_t *self, double now_s, double step_s) {
  const double here_s = hoap2_fmu_time_s(self);
  const double rounding_s = 4e-16 * (fabs(here_s) + fabs(step_s));
  if (!(fabs(now_s - here_s) <= TICK_TOLERANCE * tick_s() + rounding_s)) {
    hoap2_fmu_error(self, "a step must start at the current time %.9g s, not at %.9g s", here_s, now_s);
    return 0;
  }
  const double ticks = round(step_s / tick_s());
  if (!(ticks >= 1.0 && ticks <= MAX_TICKS_PER_STEP) ||
      !(fabs(step_s - ticks * tick_s()) <= TICK_TOLERANCE * tick_s() + rounding_s)) {
    hoap2_fmu_error(self, "a step of %.9g s is not a whole positive number of ticks of %g s", step_s,
                    tick_s());
    return 0;
  }
  if (here_s + ticks * tick_s() > self->stop_time_s + 0.5 * tick_s()) {
    hoap2_fmu_error(self, "a step of %.9g s from %.9g s passes the stop time %.9g s", step_s, here_s,
                    self->stop_time_s);
    return 0;
  }
  return (int64_t)ticks;
}

/* Keeps the model's state for the case that a later tick fails. */
static bool keep_undo(hoap2_fmu_instance_t *self) {
  const size_t size = hoap2_product_state_size(self->model);
  if (size > self->undo_size) {
    void *larger = realloc(self->undo, size);
    if (!larger) return false;
    self->undo = larger;
  }
  self->undo_size = size;
  hoap2_product_get_state(self->model, self->undo);
  return true;
}

hoap2_fmu_status_t hoap2_fmu_do_step(hoap2_fmu_instance_t *self, double now_s, double step_s) {
  if (self->event_mode_used) return hoap2_network_do_step(self, now_s, step_s);
  const int64_t ticks = ticks_of_step(self, now_s, step_s);
  if (ticks == 0) return HOAP2_FMU_ERROR;
  /* one tick keeps its own state when it fails; several are undone together */
  if (ticks > 1 && !keep_undo(self)) return hoap2_fmu_error(self, "out of memory");
  for (int64_t i = 0; i < ticks; ++i) {
    if (hoap2_product_step(self->model, self->group[HOAP2_FMU_INPUT]) == 0) continue;
    hoap2_fmu_error(self, "tick %lld failed: %s", (long long)(self->tick + i),
                    hoap2_product_error(self->model));
    if (i > 0 && hoap2_product_set_state(self->model, self->undo, self->undo_size) != 0) {
      hoap2_fmu_error(self, "the state before the step could not be restored: %s",
                      hoap2_product_error(self->model));
    }
    return HOAP2_FMU_ERROR;
  }
  self->tick += ticks;
  hoap2_product_get_outputs(self->model, self->group[HOAP2_FMU_OUTPUT]);
  return HOAP2_FMU_OK;
}
