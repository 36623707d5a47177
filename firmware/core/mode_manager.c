#include "core/mode_manager.h"

#include "core/behaviours.h"
#include "core/quintic.h"
#include "core/requests.h"
#include "gait_cp/gait_cp.h"
#include "sense/sense.h"

#define TICK_S (1e-6 * HOAP2_TICK_US)
/* The first part of the calibration lets the robot come to rest. */
#define CALIBRATION_REST 0.3
/* Faults that end the walk; the others only tell. */
#define STOPPING_FAULTS (HOAP2_FAULT_BAD_INPUT | HOAP2_FAULT_STALE_INPUT)

static void enter(hoap2_state_t *state, int32_t mode) {
  state->mode.mode = mode;
  state->mode.mode_tick = 0;
}

static void copy_joints(const double from[], double to[]) {
  for (int i = 0; i < HOAP2_SIZE_JOINT; ++i) to[i] = from[i];
}

static void blend_joints(const double from[], const double to[], double phase, double out[]) {
  const double s = hoap2_quintic(phase);
  for (int i = 0; i < HOAP2_SIZE_JOINT; ++i) out[i] = from[i] + s * (to[i] - from[i]);
}

static double mode_phase(const hoap2_state_t *state, double duration_s) {
  return (state->mode.mode_tick + 1) * TICK_S / duration_s;
}

static void start_up(hoap2_state_t *state, double q_ref_rad[]) {
  if (!state->sense.started) { /* no good frame yet: stay */
    copy_joints(state->out.q_ref_rad, q_ref_rad);
    state->mode.mode_tick = -1;
    return;
  }
  if (state->mode.mode_tick == 0) copy_joints(state->held.q_enc_rad, state->start_q_rad);
  const double phase = mode_phase(state, state->params.start_up_s);
  blend_joints(state->start_q_rad, state->stance_q_rad, phase, q_ref_rad);
  if (phase >= 1.0) enter(state, HOAP2_MODE_CALIBRATE);
}

static void calibrate(hoap2_state_t *state, int good, double q_ref_rad[]) {
  const double phase = mode_phase(state, state->params.calibrate_s);
  if (state->mode.mode_tick == 0) hoap2_sense_calibrate_begin(&state->sense);
  if (good && phase > CALIBRATION_REST) hoap2_sense_calibrate_add(&state->held, &state->sense);
  copy_joints(state->stance_q_rad, q_ref_rad);
  if (phase >= 1.0) {
    hoap2_sense_calibrate_end(&state->sense);
    state->gait.feedback = 1;
    if (state->gait.request.walk == HOAP2_WALK_REQUEST_AS_PLANNED)
      hoap2_behaviour(state->params.behaviour)->start(state);
    enter(state, HOAP2_MODE_STAND);
  }
}

/* Standing, or walking: a walk that the operator asks for begins from standing. */
static void behave(hoap2_state_t *state, double q_ref_rad[]) {
  hoap2_gait_t *gait = &state->gait;
  if (!gait->walking && gait->request.walk == HOAP2_WALK_REQUEST_WALK && hoap2_requests_may_walk(state))
    hoap2_gait_start(&state->params, gait);
  hoap2_behaviour(state->params.behaviour)->step(state, q_ref_rad);
  state->mode.mode = gait->walking ? HOAP2_MODE_WALK : HOAP2_MODE_STAND;
}

/* After a fault: the step under way is finished without feedback, then a rest, then the crouch. */
static void hold(hoap2_state_t *state, double q_ref_rad[]) {
  state->gait.feedback = 0;
  state->gait.stop_requested = 1;
  hoap2_gait_step(&state->params, &state->sense, &state->gait);
  copy_joints(state->gait.q_ref_rad, q_ref_rad);
  if (state->gait.walking) {
    state->mode.mode_tick = 0;
    return;
  }
  if (mode_phase(state, state->params.hold_s + TICK_S) >= 1.0) {
    copy_joints(q_ref_rad, state->mode.safe_from_rad);
    enter(state, HOAP2_MODE_CROUCH);
  }
}

/* A fault before the walk: from where the references are. */
static void hold_posture(hoap2_state_t *state, double q_ref_rad[]) {
  copy_joints(state->out.q_ref_rad, q_ref_rad);
  copy_joints(state->out.q_ref_rad, state->mode.safe_from_rad);
  enter(state, HOAP2_MODE_CROUCH);
}

static void crouch(hoap2_state_t *state, double q_ref_rad[]) {
  const double phase = mode_phase(state, state->params.crouch_s);
  blend_joints(state->mode.safe_from_rad, state->params.crouch_posture_rad, phase, q_ref_rad);
  if (phase >= 1.0) enter(state, HOAP2_MODE_SAFE);
}

static void react_to_faults(hoap2_state_t *state, double q_ref_rad[]) {
  const int32_t mode = state->mode.mode;
  if (!(state->mode.fault & STOPPING_FAULTS)) return;
  if (mode == HOAP2_MODE_START_UP || mode == HOAP2_MODE_CALIBRATE) hold_posture(state, q_ref_rad);
  if (mode == HOAP2_MODE_STAND || mode == HOAP2_MODE_WALK) enter(state, HOAP2_MODE_HOLD);
}

void hoap2_mode_step(hoap2_state_t *state, int good, double q_ref_rad[HOAP2_SIZE_JOINT]) {
  react_to_faults(state, q_ref_rad);
  const int32_t mode = state->mode.mode;
  switch (mode) {
    case HOAP2_MODE_START_UP: start_up(state, q_ref_rad); break;
    case HOAP2_MODE_CALIBRATE: calibrate(state, good, q_ref_rad); break;
    case HOAP2_MODE_STAND:
    case HOAP2_MODE_WALK: behave(state, q_ref_rad); break;
    case HOAP2_MODE_HOLD: hold(state, q_ref_rad); break;
    case HOAP2_MODE_CROUCH: crouch(state, q_ref_rad); break;
    default: copy_joints(state->out.q_ref_rad, q_ref_rad); break;
  }
  if (state->mode.mode == mode && state->mode.mode_tick < INT32_MAX) ++state->mode.mode_tick;
}
