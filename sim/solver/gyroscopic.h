// The torque that keeps a body's angular momentum over a tick.
#ifndef HOAP2_SIM_SOLVER_GYROSCOPIC_H
#define HOAP2_SIM_SOLVER_GYROSCOPIC_H

#include "geometry.h"
#include "plant_state.h"

namespace hoap2_sim {

Vec3 gyroscopic_torque_W_Nm(const BodyState &body, int link, const Mat3 &axes_W);

}  // namespace hoap2_sim
#endif
