#include "solver/contact_law.h"

#include <algorithm>
#include <cmath>

namespace hoap2_sim {

Vector3 ContactLaw::force_N(const Vector3 &velocity_m_s) const {
  const double normal_N = std::max(0.0, (target_m_s - velocity_m_s[0]) / compliance_m_Ns);
  double stick_1_N = -velocity_m_s[1] / slip_m_Ns, stick_2_N = -velocity_m_s[2] / slip_m_Ns;
  if (shape == FrictionShape::kSquare) {
    return {normal_N, std::clamp(stick_1_N, -bound_N, bound_N), std::clamp(stick_2_N, -bound_N, bound_N)};
  }
  const double size_N = std::sqrt(stick_1_N * stick_1_N + stick_2_N * stick_2_N);
  if (size_N > bound_N) {
    stick_1_N *= bound_N / size_N;
    stick_2_N *= bound_N / size_N;
  }
  return {normal_N, stick_1_N, stick_2_N};
}

// Of a sliding disc: bound / |v| across the direction of sliding, nothing along it.
Matrix3 ContactLaw::stiffness_Ns_m(const Vector3 &velocity_m_s) const {
  Matrix3 k = Matrix3::Zero();
  if (velocity_m_s[0] < target_m_s) k(0, 0) = 1.0 / compliance_m_Ns;
  const double a = velocity_m_s[1], b = velocity_m_s[2];
  const double limit_m_s = slip_m_Ns * bound_N;
  if (shape == FrictionShape::kSquare) {
    if (std::fabs(a) < limit_m_s) k(1, 1) = 1.0 / slip_m_Ns;
    if (std::fabs(b) < limit_m_s) k(2, 2) = 1.0 / slip_m_Ns;
    return k;
  }
  const double square = a * a + b * b;
  if (square <= limit_m_s * limit_m_s) {
    if (bound_N > 0.0) k(1, 1) = k(2, 2) = 1.0 / slip_m_Ns;
    return k;
  }
  const double across = bound_N / (square * std::sqrt(square));
  k(1, 1) = across * b * b;
  k(2, 2) = across * a * a;
  k(1, 2) = k(2, 1) = -across * a * b;
  return k;
}

}  // namespace hoap2_sim
