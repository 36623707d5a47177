#include "core/requests.h"

/* False for NaN and infinities. */
static int is_number(double value) { return value >= -1e300 && value <= 1e300; }

static double clip(double value, double low, double high, int32_t *clipped) {
  if (value < low || value > high) *clipped = 1;
  return value < low ? low : (value > high ? high : value);
}

void hoap2_requests_step(hoap2_state_t *state, const hoap2_inputs_t *inputs) {
  hoap2_request_t *request = &state->gait.request;
  const int32_t walk = inputs->walk_request;
  state->mode.request_clipped = 0;
  state->mode.request_bad = walk < HOAP2_WALK_REQUEST_LOW || walk > HOAP2_WALK_REQUEST_HIGH;
  if (walk == HOAP2_WALK_REQUEST_WALK)
    state->mode.request_bad = !is_number(inputs->step_length_request_m) ||
                              !is_number(inputs->step_sideways_request_m) ||
                              !is_number(inputs->step_turn_request_rad);
  if (state->mode.request_bad) return;
  request->walk = walk;
  if (walk != HOAP2_WALK_REQUEST_WALK) return;
  int32_t *clipped = &state->mode.request_clipped;
  request->step[0] = clip(inputs->step_length_request_m, HOAP2_STEP_LENGTH_REQUEST_M_LOW,
                          HOAP2_STEP_LENGTH_REQUEST_M_HIGH, clipped);
  request->step[1] = clip(inputs->step_sideways_request_m, HOAP2_STEP_SIDEWAYS_REQUEST_M_LOW,
                          HOAP2_STEP_SIDEWAYS_REQUEST_M_HIGH, clipped);
  request->step[2] = clip(inputs->step_turn_request_rad, HOAP2_STEP_TURN_REQUEST_RAD_LOW,
                          HOAP2_STEP_TURN_REQUEST_RAD_HIGH, clipped);
}

int hoap2_requests_may_walk(const hoap2_state_t *state) {
  return state->gait.in_place_fault == 0 && !state->gait.cp_lost;
}

int32_t hoap2_request_state(const hoap2_state_t *state) {
  const hoap2_gait_t *gait = &state->gait;
  const int32_t mode = state->mode.mode;
  const int ready = mode == HOAP2_MODE_STAND || mode == HOAP2_MODE_WALK;
  const int to_come = mode == HOAP2_MODE_START_UP || mode == HOAP2_MODE_CALIBRATE;
  if (state->mode.request_bad) return HOAP2_REQUEST_STATE_REFUSED;
  if (gait->request.walk == HOAP2_WALK_REQUEST_AS_PLANNED) return HOAP2_REQUEST_STATE_NONE;
  if (gait->request.walk == HOAP2_WALK_REQUEST_STOP)
    return gait->walking || to_come ? HOAP2_REQUEST_STATE_WAITING : HOAP2_REQUEST_STATE_TAKEN;
  if (!(ready || to_come) || !hoap2_requests_may_walk(state)) return HOAP2_REQUEST_STATE_REFUSED;
  if (state->mode.request_clipped || (gait->walking && gait->drawn_in)) return HOAP2_REQUEST_STATE_LIMITED;
  const int steps = gait->walking && gait->on_request && !gait->closing;
  return steps ? HOAP2_REQUEST_STATE_TAKEN : HOAP2_REQUEST_STATE_WAITING;
}
