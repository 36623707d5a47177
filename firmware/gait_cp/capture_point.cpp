#include "gait_cp/capture_point.hpp"

#include "core/scalar_math.h"

namespace hoap2 {

namespace {

// Share of the ramp's target in the capture point's final place: cp_des = ... + (1 + s) cop_to; s ->
// -e^(omega T) for a ramp of no length.
double ramp_gain(double omega_1_s, double T_s, double ramp_s) {
  const double growth_after = hoap2_exp(omega_1_s * (T_s - ramp_s));
  const double growth_ramp = hoap2_exp(omega_1_s * ramp_s);
  return growth_after * (1.0 - growth_ramp) / (omega_1_s * ramp_s);
}

}  // namespace

double line_start_for_ramp(double cp, double cop_from, double omega_1_s, double T_s, double ramp_s) {
  return cop_from - hoap2_exp(omega_1_s * T_s) * (cp - cop_from) / ramp_gain(omega_1_s, T_s, ramp_s);
}

double cop_for_ramp(double cp_des, double cp, double cop_from, double omega_1_s, double T_s, double ramp_s) {
  const double start = line_start_for_ramp(cp, cop_from, omega_1_s, T_s, ramp_s);
  return start + (cp_des - start) / (1.0 + ramp_gain(omega_1_s, T_s, ramp_s));
}

}  // namespace hoap2
