#include "drive/drive.h"

#include <cmath>

#include "robot/kinematics.h"

namespace hoap2_sim {
namespace {

// Below this rate Coulomb friction turns into a steep viscous one.
constexpr double kFrictionRate_rad_s = 0.02;
constexpr double kCommandCounts = 32767.0;
// Mechanical stops at the hard limits.
constexpr double kStopStiffness_Nm_rad = 2000.0;
constexpr double kStopDamping_Nms_rad = 5.0;

double clip(double value, double limit) { return value > limit ? limit : (value < -limit ? -limit : value); }

// Position mode: position loop with a limited rate command around a rate loop,
//   tau = kd (clip(kp/kd e + qd_ref, +-limit) - qd) + tau_ff,
// with error and rate taken at the end of the tick.
DriveLaw position_law(double error_rad, double rate_rad_s, const hoap2_plant_inputs_t &in, int j) {
  const double kp = in.kp_Nm_rad[j], kd = in.kd_Nms_rad[j];
  const double limit_rad_s = HOAP2_JOINT[j].velocity_limit_rad_s;
  const double command_Nm = kp * (error_rad - kTick_s * rate_rad_s) + kd * in.qd_ref_rad_s[j];
  if (std::fabs(command_Nm) > kd * limit_rad_s && kd > 0.0) {
    return {std::copysign(kd * limit_rad_s, command_Nm) + in.tau_ff_Nm[j], kd};
  }
  return {kp * error_rad + kd * in.qd_ref_rad_s[j] + in.tau_ff_Nm[j], kd + kTick_s * kp};
}

}  // namespace

double quantised_rad(double angle_rad) {
  return HOAP2_RAD_PER_COUNT * std::nearbyint(angle_rad / HOAP2_RAD_PER_COUNT);
}

bool joint_is_compliant(const hoap2_plant_params_t &params, int joint) {
  const bool roll = joint == HOAP2_J_R_HIP_ROLL || joint == HOAP2_J_L_HIP_ROLL ||
                    joint == HOAP2_J_R_ANKLE_ROLL || joint == HOAP2_J_L_ANKLE_ROLL;
  return roll && params.roll_stiffness_Nm_rad > 0.0;
}

void Drive::begin(const State &state, const hoap2_plant_inputs_t &in, int j) {
  const hoap2_joint_data_t &joint = HOAP2_JOINT[j];
  const hoap2_plant_params_t &params = state.params;
  const double link_q_rad = state.drive[j].link_q_rad, link_qd_rad_s = state.drive[j].link_qd_rad_s;
  compliant_ = joint_is_compliant(params, j);
  rotor_q_rad_ = compliant_ ? state.drive[j].rotor_q_rad : link_q_rad;
  rotor_qd_rad_s_ = compliant_ ? state.drive[j].rotor_qd_rad_s : link_qd_rad_s;

  double q_ref_rad = in.q_ref_rad[j], q_measured_rad = rotor_q_rad_;
  if (params.sensor_preset == 1) {
    q_ref_rad = clip(quantised_rad(q_ref_rad), kCommandCounts * HOAP2_RAD_PER_COUNT);
    q_measured_rad = quantised_rad(q_measured_rad);
  }
  switch (in.drive_mode[j]) {
    case kDrivePosition: unlimited_ = position_law(q_ref_rad - q_measured_rad, rotor_qd_rad_s_, in, j); break;
    case kDriveTorque: unlimited_ = {in.tau_ff_Nm[j], 0.0}; break;
    case kDriveDampedTorque: unlimited_ = {in.tau_ff_Nm[j], in.kd_Nms_rad[j]}; break;
    default: unlimited_ = {0.0, 0.0}; break;
  }
  peak_Nm_ = joint.torque_peak_Nm;
  inertia_per_tick_ = joint.armature_kgm2 / kTick_s;
  // Coulomb friction as a coefficient of the rate after the tick: dissipates whatever
  // that rate is. A rotor that speeds up is met with its extrapolated speed, else the
  // friction would lag and look like inertia.
  const double extrapolated_rad_s = 2.0 * rotor_qd_rad_s_ - state.drive[j].rotor_qd_before_rad_s;
  const double speed_rad_s =
      std::fmax(std::fmax(std::fabs(rotor_qd_rad_s_), std::fabs(extrapolated_rad_s)), kFrictionRate_rad_s);
  friction_Nms_rad_ = params.joint_friction_scale *
                      (joint.friction_viscous_Nms_rad + joint.friction_coulomb_Nm / speed_rad_s);
  spring_now_Nm_ = params.roll_stiffness_Nm_rad * (rotor_q_rad_ - link_q_rad);
  spring_Nms_rad_ = kTick_s * params.roll_stiffness_Nm_rad + params.roll_damping_Nms_rad;
  set_stop(link_q_rad, link_qd_rad_s, joint);
  saturation_ = 0;
  const double predicted_Nm = unlimited_.base_Nm - unlimited_.slope_Nms_rad * rotor_qd_rad_s_;
  if (std::fabs(predicted_Nm) > peak_Nm_) saturation_ = predicted_Nm > 0.0 ? 1 : -1;
}

// Beyond a hard limit: spring back, damped as long as the sum still pushes back.
void Drive::set_stop(double link_q_rad, double link_qd_rad_s, const hoap2_joint_data_t &joint) {
  const double beyond_rad = link_q_rad > joint.limit_hard_rad[1]   ? link_q_rad - joint.limit_hard_rad[1]
                            : link_q_rad < joint.limit_hard_rad[0] ? link_q_rad - joint.limit_hard_rad[0]
                                                                   : 0.0;
  stop_ = {0.0, 0.0};
  if (beyond_rad == 0.0) return;
  const bool leaving = beyond_rad * link_qd_rad_s < 0.0;
  stop_.base_Nm = -kStopStiffness_Nm_rad * beyond_rad;
  stop_.slope_Nms_rad = kTick_s * kStopStiffness_Nm_rad + (leaving ? 0.0 : kStopDamping_Nms_rad);
}

DriveLaw Drive::law() const {
  if (saturation_ == 0) return unlimited_;
  return {saturation_ * peak_Nm_, 0.0};
}

// Rotor of a compliant joint, from its own balance over the tick with the spring
// torque s0 + S (w_m - w_l):  (Ia/h + slope + friction + S) w_m = Ia/h w_m0 + base - s0 + S w_l.
double Drive::rotor_rate_next_rad_s(const DriveLaw &law, double link_qd_next_rad_s) const {
  if (!compliant_) return link_qd_next_rad_s;
  const double p = inertia_per_tick_ + law.slope_Nms_rad + friction_Nms_rad_;
  const double n = inertia_per_tick_ * rotor_qd_rad_s_ + law.base_Nm - spring_now_Nm_;
  return (n + spring_Nms_rad_ * link_qd_next_rad_s) / (p + spring_Nms_rad_);
}

MotorRow Drive::row() const {
  const DriveLaw drive = law();
  const double p = inertia_per_tick_ + drive.slope_Nms_rad + friction_Nms_rad_;
  double base_Nm = inertia_per_tick_ * rotor_qd_rad_s_ + drive.base_Nm, slope_Nms_rad = p;
  if (compliant_) {  // the rotor eliminated: the link feels s0 + S (w_m - w_l)
    const double s = spring_Nms_rad_;
    base_Nm = spring_now_Nm_ + s * (base_Nm - spring_now_Nm_) / (p + s);
    slope_Nms_rad = s * p / (p + s);
  }
  base_Nm += stop_.base_Nm;
  slope_Nms_rad += stop_.slope_Nms_rad;
  return {slope_Nms_rad, base_Nm / slope_Nms_rad};
}

int Drive::wanted_saturation(double link_qd_next_rad_s) const {
  const double rate_rad_s = rotor_rate_next_rad_s(law(), link_qd_next_rad_s);
  const double tau_Nm = unlimited_.base_Nm - unlimited_.slope_Nms_rad * rate_rad_s;
  if (std::fabs(tau_Nm) <= peak_Nm_) return 0;
  return tau_Nm > 0.0 ? 1 : -1;
}

DriveState Drive::finish(double link_q_next_rad, double link_qd_next_rad_s, double row_rate_rad_s) const {
  const DriveLaw drive = law();
  const double rate_rad_s = rotor_rate_next_rad_s(drive, row_rate_rad_s);
  DriveState next;
  next.link_q_rad = link_q_next_rad;
  next.link_qd_rad_s = link_qd_next_rad_s;
  next.rotor_q_rad = compliant_ ? rotor_q_rad_ + kTick_s * rate_rad_s : link_q_next_rad;
  next.rotor_qd_rad_s = rate_rad_s;
  next.rotor_qd_before_rad_s = rotor_qd_rad_s_;
  next.tau_Nm = drive.base_Nm - drive.slope_Nms_rad * rate_rad_s;
  return next;
}

}  // namespace hoap2_sim
