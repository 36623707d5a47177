// What the plant refuses, with a text that names it. "" when all is well.
#ifndef HOAP2_SIM_CHECKS_H
#define HOAP2_SIM_CHECKS_H

#include <string>

#include "plant_state.h"

namespace hoap2_sim {

std::string fault_of_params(const hoap2_plant_params_t &params);
std::string fault_of_inputs(const hoap2_plant_inputs_t &inputs);
std::string fault_of_bodies(const State &state);
// Everything else of a saved state.
std::string fault_of_memory(const State &state);

}  // namespace hoap2_sim
#endif
