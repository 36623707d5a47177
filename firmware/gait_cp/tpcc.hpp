// Torso position compliance control, the simplified form of (5.43), (5.44) used in section 7.3.
#ifndef HOAP2_GAIT_CP_TPCC_HPP
#define HOAP2_GAIT_CP_TPCC_HPP

#include "gait_cp/gait_state.h"

namespace hoap2 {

// One tick. The CoM reference yields in the direction of the CoP error and springs back:
//   shift'' = K_p (cop - cop_des) - K_v shift' - K_x shift.
// Departures: the error is clipped and low-passed (the measured CoP contains shift'' itself), the shift is
// bounded. With feedback off the error is taken as zero and the shift decays.
void tpcc_step(const hoap2_params_t& params, const double cop_est_m[2], bool feedback, hoap2_gait_t& gait);

}  // namespace hoap2
#endif
