/* LCM telemetry of a run: rows of its signals become messages, in a log and live.
 *
 * The rows stay the caller's; nothing here changes them. Times in the log are simulated. Not for several
 * threads. A sink that fails is closed and told by hoap2_telemetry_problem(); the other one goes on.
 */
#ifndef HOAP2_TELEMETRY_H
#define HOAP2_TELEMETRY_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define HOAP2_TELEMETRY_API __attribute__((visibility("default")))

enum { HOAP2_TELEMETRY_STATE, HOAP2_TELEMETRY_GAIT, HOAP2_TELEMETRY_TRUTH, HOAP2_TELEMETRY_MESSAGES };
enum { HOAP2_TELEMETRY_TO_LOG = 1, HOAP2_TELEMETRY_LIVE = 2 };

typedef struct hoap2_telemetry hoap2_telemetry_t;

typedef struct {
  int64_t run_id;
  const char *log_path; /* NULL: no log */
  const char *live_url; /* NULL: not live */
  int32_t paced;        /* live view gets every message; otherwise about 100 a second of each channel */
  int32_t tick_us;
  const double *real; /* row k begins at real + k * real_stride */
  int64_t real_stride;
  const int32_t *integer;
  int64_t integer_stride;
  const int64_t *controller_ns; /* wall-clock duration of the step that led to row k + 1 */
  const int64_t *plant_ns;
  /* for each message the column of every element in the order of generated/places.hpp; -1: the run has it not
   */
  const int32_t *columns[HOAP2_TELEMETRY_MESSAGES];
  int32_t push_column; /* first of three reals, or -1 */
} hoap2_telemetry_config_t;

typedef struct {
  int64_t logged;    /* messages in the log */
  int64_t published; /* sent live */
  int64_t dropped;   /* refused by the transport */
  int64_t decimated; /* left out of the live view */
  int64_t waiting;   /* on their way to the transport */
  int64_t spent_ns;  /* wall clock of the calls */
  int64_t sender_ns; /* processor time of the thread that sends; known once finished */
} hoap2_telemetry_counts_t;

/* NULL when neither sink can be opened as asked; `error` then says why. */
HOAP2_TELEMETRY_API hoap2_telemetry_t *hoap2_telemetry_open(const hoap2_telemetry_config_t *config,
                                                            char *error, size_t error_size);

/* The next rows, up to `end` (not with it). lag_us and overruns as the pacing knows them. */
HOAP2_TELEMETRY_API void hoap2_telemetry_rows(hoap2_telemetry_t *telemetry, int64_t end, double lag_us,
                                              int64_t overruns);

/* A message of any channel, encoded. Unless it is a command, its run_id, sequence, tick and time are filled
 * in (tick < 0: the tick of the last row). A run_t is repeated live each second from now on. */
HOAP2_TELEMETRY_API void hoap2_telemetry_send(hoap2_telemetry_t *telemetry, const char *channel,
                                              const void *data, int32_t length, int64_t tick, int32_t where);

HOAP2_TELEMETRY_API void hoap2_telemetry_counts(const hoap2_telemetry_t *telemetry,
                                                hoap2_telemetry_counts_t *counts);

/* What closed a sink early; "" if nothing did. */
HOAP2_TELEMETRY_API const char *hoap2_telemetry_problem(const hoap2_telemetry_t *telemetry);

/* Calls back with every message that arrives on the live connection: the way to listen within one process on
 * memq://. */
typedef void (*hoap2_telemetry_callback_t)(const char *channel, const void *data, int32_t length);
HOAP2_TELEMETRY_API int hoap2_telemetry_subscribe(hoap2_telemetry_t *telemetry,
                                                  hoap2_telemetry_callback_t callback);
HOAP2_TELEMETRY_API int hoap2_telemetry_poll(hoap2_telemetry_t *telemetry, int timeout_ms);

/* Closes both sinks; `ended`: one more health_t says so before. problem() tells whether the log is whole. */
HOAP2_TELEMETRY_API void hoap2_telemetry_finish(hoap2_telemetry_t *telemetry, int32_t ended);

/* NULL is fine. */
HOAP2_TELEMETRY_API void hoap2_telemetry_destroy(hoap2_telemetry_t *telemetry);

/* Elements that `columns` must have, and the size of the config, for bindings to check. */
HOAP2_TELEMETRY_API int32_t hoap2_telemetry_elements(int32_t message);
HOAP2_TELEMETRY_API size_t hoap2_telemetry_config_size(void);

#ifdef __cplusplus
}
#endif
#endif
