#include "gait_cp/capture_point.hpp"

#include "core/scalar_math.h"

namespace hoap2 {

double cop_for_ramp(double cp_des, double cp, double cop_from, double omega_1_s, double T_s, double ramp_s) {
  const double growth = hoap2_exp(omega_1_s * T_s);
  const double growth_after = hoap2_exp(omega_1_s * (T_s - ramp_s));
  const double growth_ramp = hoap2_exp(omega_1_s * ramp_s);
  const double s = growth_after * (1.0 - growth_ramp) / (omega_1_s * ramp_s);
  return (cp_des - growth * (cp - cop_from) + s * cop_from) / (1.0 + s);
}

}  // namespace hoap2
