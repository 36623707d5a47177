// Attitude of the chest from rate gyro and accelerometer.
#ifndef HOAP2_SENSE_ATTITUDE_HPP
#define HOAP2_SENSE_ATTITUDE_HPP

#include "hoap2/generated/signals.h"
#include "sense/sense_state.h"

namespace hoap2 {

// Turns the vertical direction up_S with the gyro and draws it towards the accelerometer's with the time
// constant tau_s, then states roll and pitch.
void attitude_step(const hoap2_inputs_t& inputs, double tau_s, hoap2_sense_t& sense);

// Roll and pitch of a frame in which the vertical is up (unit length).
void roll_pitch_from_up(const double up[3], double& roll_rad, double& pitch_rad);

}  // namespace hoap2
#endif
