/* The controller's tick: inputs -> sense -> requests -> mode manager -> behaviour -> limits -> outputs. */
#include <string.h>

#include "core/mode_manager.h"
#include "core/outputs.h"
#include "core/requests.h"
#include "core/watchdog.h"
#include "gait_cp/gait_cp.h"
#include "hoap2/state.h"
#include "sense/sense.h"

size_t hoap2_state_size(void) { return sizeof(hoap2_state_t); }

/* What single ranges cannot say. K_x > K_p: else the compliance runs to its limit. */
static int fits_together(const hoap2_params_t *params) {
  double crouch_rad[HOAP2_SIZE_JOINT];
  memcpy(crouch_rad, params->crouch_posture_rad, sizeof crouch_rad);
  return params->contact_off_N <= params->contact_on_N &&
         (params->tpcc_kp_1_s2 <= 0.0 || params->tpcc_kx_1_s2 > params->tpcc_kp_1_s2) &&
         !hoap2_clip_to_limits(crouch_rad);
}

int32_t hoap2_init(hoap2_state_t *state, const hoap2_params_t *params) {
  memset(state, 0, sizeof *state);
  hoap2_params_defaults(&state->params);
  hoap2_inputs_defaults(&state->held);
  hoap2_sense_reset(&state->sense);
  if (hoap2_params_out_of_range(params) > 0 || !fits_together(params))
    state->mode.fault = HOAP2_FAULT_BAD_PARAMETER;
  else
    memcpy(&state->params, params, HOAP2_PARAMS_BYTES); /* not its padding: states compare as bytes */
  hoap2_gait_reset(&state->params, &state->gait);
  memcpy(state->stance_q_rad, state->gait.q_ref_rad, sizeof state->stance_q_rad);
  if (state->mode.fault == 0) state->mode.fault = hoap2_gait_check_reach(&state->params, &state->gait);
  state->gait.in_place_fault = hoap2_gait_check_in_place(&state->params, &state->gait);
  if (hoap2_clip_to_limits(state->stance_q_rad)) state->mode.fault |= HOAP2_FAULT_JOINT_LIMIT;
  state->mode.mode = state->mode.fault ? HOAP2_MODE_SAFE : HOAP2_MODE_START_UP;
  double q_ref_rad[HOAP2_SIZE_JOINT];
  memcpy(q_ref_rad, state->params.posture_rad, sizeof q_ref_rad);
  (void)hoap2_clip_to_limits(q_ref_rad);
  hoap2_fill_outputs(state, q_ref_rad);
  return state->mode.fault;
}

int32_t hoap2_tune(hoap2_state_t *state, const hoap2_params_t *params) {
  const int bad = hoap2_params_out_of_range(params);
  if (bad > 0) return (int32_t)bad;
  if (!fits_together(params)) return -1;
  hoap2_params_tune(&state->params, params);
  return 0;
}

void hoap2_step(hoap2_state_t *state, const hoap2_inputs_t *inputs, hoap2_outputs_t *outputs) {
  const int good = hoap2_watchdog_step(state, inputs);
  if (good)
    hoap2_sense_step(&state->params, &state->held, &state->gait.feet, state->gait.omega_1_s, &state->sense);
  hoap2_requests_step(state, inputs);
  double q_ref_rad[HOAP2_SIZE_JOINT];
  hoap2_mode_step(state, good, q_ref_rad);
  if (hoap2_limit_references(state->out.q_ref_rad, q_ref_rad)) state->mode.fault |= HOAP2_FAULT_JOINT_LIMIT;
  if (state->gait.joint_limit) state->mode.fault |= HOAP2_FAULT_JOINT_LIMIT;
  if (state->gait.pulled_back) state->mode.fault |= HOAP2_FAULT_REACH_LIMIT;
  if (state->gait.cp_lost) state->mode.fault |= HOAP2_FAULT_CAPTURE_POINT_LOST;
  ++state->mode.tick;
  hoap2_fill_outputs(state, q_ref_rad);
  *outputs = state->out;
}

void hoap2_get_outputs(const hoap2_state_t *state, hoap2_outputs_t *outputs) { *outputs = state->out; }
