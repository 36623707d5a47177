// The step that the operator asks for, as far as the legs can do it.
#ifndef HOAP2_GAIT_CP_REQUESTED_STEP_HPP
#define HOAP2_GAIT_CP_REQUESTED_STEP_HPP

#include "gait_cp/gait_state.h"

namespace hoap2 {

// Lays the step that has just begun with the advance of gait.request, and says in gait.drawn_in whether it
// had to be drawn in. A step that is out of reach is drawn towards the step in place by four halvings; so the
// direction stays as requested and the walk goes on.
void lay_requested_step(const hoap2_params_t& params, hoap2_gait_t& gait);

}  // namespace hoap2
#endif
