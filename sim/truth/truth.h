// The simulator's truth, computed from the state alone.
#ifndef HOAP2_SIM_TRUTH_TRUTH_H
#define HOAP2_SIM_TRUTH_TRUTH_H

#include "plant_state.h"

namespace hoap2_sim {

// CoP of all sole contacts on the floor plane; keeps its last value in flight.
void update_cop(State *state);

void fill_outputs(const State &state, hoap2_plant_outputs_t *outputs);

}  // namespace hoap2_sim
#endif
