// Pushes: a force in the world at a point of a link, over a time (of the scenario) or while the input is
// held.
#ifndef HOAP2_SIM_PUSH_PUSH_H
#define HOAP2_SIM_PUSH_PUSH_H

#include "plant_state.h"

namespace hoap2_sim {

constexpr int kPushes = 8;

// Share of the full force at a time after the start (0..1). Rectangular, or with a
// quintic ramp at each end (10 s^3 - 15 s^4 + 6 s^5).
double push_profile(double after_start_s, double duration_s, double ramp_s);

// Force of push i over the tick that starts at the state's time.
void push_force(const hoap2_plant_params_t &params, std::int64_t tick, int i, double force_W_N[3]);

}  // namespace hoap2_sim
#endif
