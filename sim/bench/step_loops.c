/* Step loops of `bench plant`: every tick is timed by itself, without a host language in between.
 *
 * The simulators are reached through function pointers alone, so this library links neither of them and needs
 * no headers of MuJoCo. Durations are of CLOCK_MONOTONIC, in ns, with the two clock readings in them
 * (bench_clock_ns). */
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <time.h>

#define BENCH_EXPORT __attribute__((visibility("default")))

static int64_t now_ns(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (int64_t)t.tv_sec * 1000000000 + t.tv_nsec;
}

/* hoap2_plant_step(plant, inputs): one row of inputs a tick. Stops at the first failure and returns its code.
 */
BENCH_EXPORT int bench_plant(int (*step)(void *, const void *), void *plant, const char *inputs,
                             size_t row_bytes, int32_t ticks, int64_t *ns) {
  for (int32_t k = 0; k < ticks; ++k) {
    const void *const row = inputs + (size_t)k * row_bytes;
    const int64_t start = now_ns();
    const int result = step(plant, row);
    ns[k] = now_ns() - start;
    if (result != 0) return result;
  }
  return 0;
}

/* mj_step(model, data) after copying a row of controls into data->ctrl. */
BENCH_EXPORT void bench_mujoco(void (*step)(const void *, void *), const void *model, void *data,
                               double *ctrl, const double *controls, int32_t count, int32_t ticks,
                               int64_t *ns) {
  for (int32_t k = 0; k < ticks; ++k) {
    const int64_t start = now_ns();
    memcpy(ctrl, controls + (size_t)k * (size_t)count, (size_t)count * sizeof(double));
    step(model, data);
    ns[k] = now_ns() - start;
  }
}

/* f(a, b) again and again: what a call that only reads costs, such as hoap2_plant_get_outputs. */
BENCH_EXPORT void bench_call(void (*f)(const void *, void *), const void *a, void *b, int32_t calls,
                             int64_t *ns) {
  for (int32_t k = 0; k < calls; ++k) {
    const int64_t start = now_ns();
    f(a, b);
    ns[k] = now_ns() - start;
  }
}

/* What the clock itself costs in each of these durations. */
BENCH_EXPORT void bench_clock_ns(int32_t calls, int64_t *ns) {
  for (int32_t k = 0; k < calls; ++k) {
    const int64_t start = now_ns();
    ns[k] = now_ns() - start;
  }
}
