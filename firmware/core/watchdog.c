#include "core/watchdog.h"

#include <string.h>

/* Wider than any reading of a healthy sensor, narrow enough to catch a broken frame. */
#define MAX_JOINT_RAD 3.5
#define MAX_GYRO_RAD_S 20.0
#define MAX_ACCEL_M_S2 200.0
#define MAX_CELL_N 1000.0

/* False for NaN and infinities too. */
static int all_within(const double *values, int count, double limit) {
  for (int i = 0; i < count; ++i)
    if (!(values[i] >= -limit && values[i] <= limit)) return 0;
  return 1;
}

static int frame_is_good(const hoap2_inputs_t *in) {
  return all_within(in->q_enc_rad, HOAP2_SIZE_JOINT, MAX_JOINT_RAD) &&
         all_within(in->gyro_S_rad_s, HOAP2_SIZE_XYZ, MAX_GYRO_RAD_S) &&
         all_within(in->accel_S_m_s2, HOAP2_SIZE_XYZ, MAX_ACCEL_M_S2) &&
         all_within(in->cell_force_N, HOAP2_SIZE_CELL, MAX_CELL_N);
}

static int32_t one_more(int32_t count) { return count < INT32_MAX ? count + 1 : count; }

int hoap2_watchdog_step(hoap2_state_t *state, const hoap2_inputs_t *inputs) {
  hoap2_mode_state_t *mode = &state->mode;
  const int good = frame_is_good(inputs);
  const int fresh = mode->tick == 0 || inputs->sensor_tick != mode->last_sensor_tick;
  mode->last_sensor_tick = inputs->sensor_tick;
  mode->bad_ticks = good ? 0 : one_more(mode->bad_ticks);
  mode->stale_ticks = fresh ? 0 : one_more(mode->stale_ticks);
  if (mode->bad_ticks > state->params.stale_limit_ticks) mode->fault |= HOAP2_FAULT_BAD_INPUT;
  if (mode->stale_ticks > state->params.stale_limit_ticks) mode->fault |= HOAP2_FAULT_STALE_INPUT;
  if (good) memcpy(&state->held, inputs, HOAP2_INPUTS_BYTES); /* no foreign padding */
  return good;
}
