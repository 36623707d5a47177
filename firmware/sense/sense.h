/* Sensing: attitude, base, CoM, CoP, contact, capture point. */
#ifndef HOAP2_SENSE_SENSE_H
#define HOAP2_SENSE_SENSE_H

#include "hoap2/generated/signals.h"
#include "sense/sense_state.h"

#ifdef __cplusplus
extern "C" {
#endif

void hoap2_sense_reset(hoap2_sense_t *sense);

/* One frame of valid sensor values. feet: where the gait had the feet in this frame.
 * omega_1_s: natural frequency of the pendulum, for the capture point (7.1). */
void hoap2_sense_step(const hoap2_params_t *params, const hoap2_inputs_t *inputs, const hoap2_feet_t *feet,
                      double omega_1_s, hoap2_sense_t *sense);

/* Calibration while the robot stands still: begin, add the frame just sensed, end.
 * The means give the gyro bias and the attitude. */
void hoap2_sense_calibrate_begin(hoap2_sense_t *sense);
void hoap2_sense_calibrate_add(const hoap2_inputs_t *inputs, hoap2_sense_t *sense);
void hoap2_sense_calibrate_end(hoap2_sense_t *sense);

#ifdef __cplusplus
}
#endif
#endif
