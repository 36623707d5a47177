/* One FMU instance, the same for FMI 2.0 and FMI 3.0: life cycle, values, steps, snapshots, log. */
#ifndef HOAP2_FMU_INSTANCE_H
#define HOAP2_FMU_INSTANCE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "product.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where an instance stands; bits, so that a call can name all states that allow it. */
typedef enum {
  HOAP2_FMU_INSTANTIATED = 1,
  HOAP2_FMU_INITIALISING = 2,
  HOAP2_FMU_STEPPING = 4,
  HOAP2_FMU_TERMINATED = 8,
  HOAP2_FMU_EVENT = 16 /* FMI 3.0 with bus terminals: event mode */
} hoap2_fmu_mode_t;

enum {
  HOAP2_FMU_RUNNING = HOAP2_FMU_STEPPING | HOAP2_FMU_EVENT,
  HOAP2_FMU_CAN_GET = HOAP2_FMU_INITIALISING | HOAP2_FMU_RUNNING | HOAP2_FMU_TERMINATED,
  HOAP2_FMU_CAN_SET = HOAP2_FMU_INSTANTIATED | HOAP2_FMU_INITIALISING | HOAP2_FMU_RUNNING,
  HOAP2_FMU_ANY_MODE = 31
};

typedef enum { HOAP2_FMU_OK = 0, HOAP2_FMU_ERROR = 1 } hoap2_fmu_status_t;

typedef enum {
  HOAP2_FMU_LOG_ERROR = 0,
  HOAP2_FMU_LOG_WARNING = 1,
  HOAP2_FMU_LOG_EVENT = 2
} hoap2_fmu_category_t;

enum { HOAP2_FMU_LOG_CATEGORIES = 3, HOAP2_FMU_LOG_ALL = 7 };

struct hoap2_fmu_instance;
typedef void (*hoap2_fmu_emit_t)(struct hoap2_fmu_instance *, hoap2_fmu_category_t, const char *category,
                                 const char *text);

typedef struct hoap2_fmu_instance {
  char *name;
  hoap2_fmu_emit_t emit; /* the FMI version's way to the importer's callback */
  void (*logger)(void);  /* that callback, cast back by emit */
  void *environment;
  bool logging_on;
  unsigned categories; /* bit of each category that is let through */
  hoap2_fmu_mode_t mode;
  bool event_mode_used; /* the bus terminals are alive */
  double start_time_s;
  double stop_time_s; /* +inf when not given */
  int64_t tick;       /* ticks done; time = start_time_s + tick * tick_us */
  bool model_ready;   /* model and outputs belong to the present parameters */
  void *model;
  void *group[HOAP2_FMU_GROUPS]; /* inputs, outputs, parameters */
  void *trial_params;            /* parameters on trial */
  void *undo;                    /* model state before a step of several ticks, NULL until needed */
  size_t undo_size;
  void *network; /* network.h; NULL without bus terminals */
} hoap2_fmu_instance_t;

/* NULL when memory is short. */
hoap2_fmu_instance_t *hoap2_fmu_create(const char *name, hoap2_fmu_emit_t emit, void (*logger)(void),
                                       void *environment, bool logging_on);
void hoap2_fmu_free(hoap2_fmu_instance_t *self);

/* Log (if logging is on); the error form returns HOAP2_FMU_ERROR. Texts carry neither
 * '%' (FMI 2 passes them as a printf format) nor '#' (FMI 2's reference escape). */
void hoap2_fmu_log(hoap2_fmu_instance_t *self, hoap2_fmu_category_t category, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
hoap2_fmu_status_t hoap2_fmu_error(hoap2_fmu_instance_t *self, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Error when a name is not a declared category; count 0 means all categories. */
hoap2_fmu_status_t hoap2_fmu_set_logging(hoap2_fmu_instance_t *self, bool logging_on, size_t count,
                                         const char *const names[]);

/* True when self is an instance in one of the allowed states; else logs the reason. */
bool hoap2_fmu_allowed(hoap2_fmu_instance_t *self, const char *call, unsigned modes);

hoap2_fmu_status_t hoap2_fmu_set_times(hoap2_fmu_instance_t *self, double start_s, bool stop_defined,
                                       double stop_s);
hoap2_fmu_status_t hoap2_fmu_enter_initialisation(hoap2_fmu_instance_t *self);
hoap2_fmu_status_t hoap2_fmu_exit_initialisation(hoap2_fmu_instance_t *self);
void hoap2_fmu_reset(hoap2_fmu_instance_t *self);
double hoap2_fmu_time_s(const hoap2_fmu_instance_t *self);
/* A refused step changes nothing. */
hoap2_fmu_status_t hoap2_fmu_do_step(hoap2_fmu_instance_t *self, double now_s, double step_s);

/* values.c: by FMI 2 scalars (one reference an element) or FMI 3 rows (all elements of each).
 * Either all values are set or none. values: double or int32_t, as kind says. */
hoap2_fmu_status_t hoap2_fmu_get(hoap2_fmu_instance_t *self, bool by_row, int kind,
                                 const unsigned *references, size_t count, void *values, size_t value_count);
hoap2_fmu_status_t hoap2_fmu_set(hoap2_fmu_instance_t *self, bool by_row, int kind,
                                 const unsigned *references, size_t count, const void *values,
                                 size_t value_count);
/* First parameter outside its range is logged by name. */
hoap2_fmu_status_t hoap2_fmu_check_parameters(hoap2_fmu_instance_t *self, const void *params);
/* Make model and outputs those of the present parameters. */
hoap2_fmu_status_t hoap2_fmu_prepare(hoap2_fmu_instance_t *self);

/* snapshot.c: *state is NULL or a snapshot of this product, which is then reused. */
hoap2_fmu_status_t hoap2_fmu_get_state(hoap2_fmu_instance_t *self, void **state);
hoap2_fmu_status_t hoap2_fmu_set_state(hoap2_fmu_instance_t *self, const void *state);
hoap2_fmu_status_t hoap2_fmu_free_state(hoap2_fmu_instance_t *self, void **state);
hoap2_fmu_status_t hoap2_fmu_serialized_size(hoap2_fmu_instance_t *self, const void *state, size_t *size);
hoap2_fmu_status_t hoap2_fmu_serialize(hoap2_fmu_instance_t *self, const void *state, void *bytes,
                                       size_t size);
hoap2_fmu_status_t hoap2_fmu_deserialize(hoap2_fmu_instance_t *self, const void *bytes, size_t size,
                                         void **state);

#ifdef __cplusplus
}
#endif
#endif
