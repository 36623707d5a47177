// Force of a contact point as a function of its velocity after the tick, with the friction
// bound held: the derivative of a convex function, so the tick is a convex problem.
#ifndef HOAP2_SIM_SOLVER_CONTACT_LAW_H
#define HOAP2_SIM_SOLVER_CONTACT_LAW_H

#include "solver/spatial.h"

namespace hoap2_sim {

enum class FrictionShape { kDisc, kSquare };

// Contact axes: 0 normal (out of the ground), 1 and 2 along the ground.
struct ContactLaw {
  double target_m_s;       // of the normal row
  double compliance_m_Ns;  // of the normal row
  double slip_m_Ns;        // of the friction rows
  double bound_N;          // largest friction force (square: in each direction)
  FrictionShape shape;

  Vector3 force_N(const Vector3 &velocity_m_s) const;
  // Minus the derivative of force_N: symmetric, positive semidefinite.
  Matrix3 stiffness_Ns_m(const Vector3 &velocity_m_s) const;
};

}  // namespace hoap2_sim
#endif
