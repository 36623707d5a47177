/* Walking by the capture point (section 7.2) on position-controlled joints.
 *
 * footprints -> capture point at the end of the step -> CoP (7.9) -> clamp -> CoM (7.13) -> torso position
 * compliance -> inverse kinematics. With CPS (7.11) or CPT (7.12) the CoP comes from the sensed capture
 * point.
 */
#ifndef HOAP2_GAIT_CP_GAIT_CP_H
#define HOAP2_GAIT_CP_GAIT_CP_H

#include "gait_cp/gait_state.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Standing with the CoM over the middle of the soles. Also finds the pendulum's constants from the stance's
 * CoM height, and the joint angles of the stance (gait->q_ref_rad). */
void hoap2_gait_reset(const hoap2_params_t *params, hoap2_gait_t *gait);

/* Simulates the first steps of the walk in open loop. Returns 0, or HOAP2_FAULT_FOOTPRINT_OUT_OF_REACH when a
 * leg would not reach, a joint limit would be met, or the feet would overlap, or HOAP2_FAULT_JOINT_TOO_FAST
 * when a joint would have to exceed its velocity limit by more than the reference limiter can smooth away. */
int32_t hoap2_gait_check_reach(const hoap2_params_t *params, const hoap2_gait_t *gait);

/* The same for steps in place, whatever the behaviour: any of the faults above, or 0 when a walk on request
 * may begin. */
int32_t hoap2_gait_check_in_place(const hoap2_params_t *params, const hoap2_gait_t *gait);

/* Begin the walk of params from standing, or one on request when gait->request.walk says so. */
void hoap2_gait_start(const hoap2_params_t *params, hoap2_gait_t *gait);

/* One tick: joint references in gait->q_ref_rad. sense is used only where gait->feedback is 1. */
void hoap2_gait_step(const hoap2_params_t *params, const hoap2_sense_t *sense, hoap2_gait_t *gait);

#ifdef __cplusplus
}
#endif
#endif
