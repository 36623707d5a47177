// What the robot's sensors show. Preset ideal: the state at the end of the last
// tick. Preset hoap2: quantised, band-limited, noisy and one frame late.
#ifndef HOAP2_SIM_SENSORS_SENSORS_H
#define HOAP2_SIM_SENSORS_SENSORS_H

#include "plant_state.h"

namespace hoap2_sim {

constexpr std::int32_t kPresetIdeal = 0, kPresetHoap2 = 1;

// Sensors settled at the start state.
void sensors_start(State *state);
// One more frame, after the bodies, drives and foot wrenches of the tick are in the state.
void sensors_measure(State *state);

}  // namespace hoap2_sim
#endif
