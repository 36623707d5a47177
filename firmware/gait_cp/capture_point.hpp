// Capture point and pendulum relations of section 7.2, per horizontal axis.
#ifndef HOAP2_GAIT_CP_CAPTURE_POINT_HPP
#define HOAP2_GAIT_CP_CAPTURE_POINT_HPP

namespace hoap2 {

// (7.5): the CoP that carries the capture point from cp to cp_des within a time dT, growth = e^(omega dT)
// > 1.
inline double cop_for_capture_point(double cp_des, double cp, double growth) {
  return (cp_des - growth * cp) / (1.0 - growth);
}

// (7.10): the capture point after a time dT with the CoP held, growth = e^(omega dT).
inline double capture_point_after(double cp, double cop, double growth) { return growth * (cp - cop) + cop; }

// (7.13): CoM and rate after a time dT with the CoP held; cosh and sinh of omega dT.
inline void pendulum_after(double cop, double omega_1_s, double cosh_dT, double sinh_dT, double& com,
                           double& com_rate) {
  const double over = com - cop;
  const double next = cop + cosh_dT * over + sinh_dT / omega_1_s * com_rate;
  com_rate = omega_1_s * sinh_dT * over + cosh_dT * com_rate;
  com = next;
}

// The CoP to which a ramp of ramp_s, beginning at cop_from and followed by a constant, must lead so that the
// capture point goes from cp to cp_des in the time T (solution of (7.2) with a linear, then constant CoP).
double cop_for_ramp(double cp_des, double cp, double cop_from, double omega_1_s, double T_s, double ramp_s);

// The capture point from which a constant CoP would have to start so that all CoPs of such a plan lie on the
// line through it and the end-of-step capture point: the start of the line along which the clamp shifts the
// CoP.
double line_start_for_ramp(double cp, double cop_from, double omega_1_s, double T_s, double ramp_s);

}  // namespace hoap2
#endif
