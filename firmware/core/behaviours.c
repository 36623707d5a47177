#include "core/behaviours.h"

#include "gait_cp/gait_cp.h"

static void stand_start(hoap2_state_t *state) { state->gait.walk_done = 1; }

static void gait_step(hoap2_state_t *state, double q_ref_rad[]) {
  hoap2_gait_step(&state->params, &state->sense, &state->gait);
  for (int i = 0; i < HOAP2_SIZE_JOINT; ++i) q_ref_rad[i] = state->gait.q_ref_rad[i];
}

static void walk_start(hoap2_state_t *state) { hoap2_gait_start(&state->params, &state->gait); }

/* in the order of HOAP2_BEHAVIOUR_* */
static const hoap2_behaviour_t BEHAVIOURS[] = {
    {stand_start, gait_step},
    {walk_start, gait_step},
};

const hoap2_behaviour_t *hoap2_behaviour(int32_t index) {
  const int32_t count = (int32_t)(sizeof BEHAVIOURS / sizeof BEHAVIOURS[0]);
  return &BEHAVIOURS[index >= 0 && index < count ? index : 0];
}
