// The joint drives: servo law, limits, friction, rotor inertia and the optional
// compliance behind the encoder, put into one implicit motor row a joint.
#ifndef HOAP2_SIM_DRIVE_DRIVE_H
#define HOAP2_SIM_DRIVE_DRIVE_H

#include "plant_state.h"
#include "solver/solver.h"

namespace hoap2_sim {

enum DriveMode : std::int32_t { kDriveOff = 0, kDrivePosition = 1, kDriveTorque = 2, kDriveDampedTorque = 3 };
constexpr std::int32_t kDriveModes = 4;

// Drive torque as a function of the rotor's rate after the tick: tau = base - slope * rate.
struct DriveLaw {
  double base_Nm;
  double slope_Nms_rad;
};

// Nearest encoder count.
double quantised_rad(double angle_rad);

class Drive {
 public:
  // Reads this tick's command and the state before the tick.
  void begin(const State &state, const hoap2_plant_inputs_t &inputs, int joint);

  // Row of the present saturation (-1, 0, +1 times the peak torque).
  MotorRow row() const;
  int saturation() const { return saturation_; }
  void saturate(int sign) { saturation_ = sign; }
  // Saturation that the law asks for, given the link's rate after the tick.
  int wanted_saturation(double link_qd_next_rad_s) const;

  // The joint's drive state after the tick; row_rate: the rate that the motor row was solved with,
  // along the axis of the tick's start.
  DriveState finish(double link_q_next_rad, double link_qd_next_rad_s, double row_rate_rad_s) const;

 private:
  DriveLaw law() const;
  double rotor_rate_next_rad_s(const DriveLaw &law, double link_qd_next_rad_s) const;
  void set_stop(double link_q_rad, double link_qd_rad_s, const hoap2_joint_data_t &joint);

  DriveLaw unlimited_{};
  double peak_Nm_ = 0.0;
  int saturation_ = 0;
  double rotor_q_rad_ = 0.0, rotor_qd_rad_s_ = 0.0;
  double inertia_per_tick_ = 0.0;  // Ia / h
  double friction_Nms_rad_ = 0.0;  // friction torque over the rotor's rate after the tick
  bool compliant_ = false;
  double spring_now_Nm_ = 0.0;   // k (q_rotor - q_link)
  double spring_Nms_rad_ = 0.0;  // h k + c
  DriveLaw stop_{0.0, 0.0};      // mechanical stop, acts on the link
};

// Roll joints of hips and ankles, when the run makes them compliant.
bool joint_is_compliant(const hoap2_plant_params_t &params, int joint);

}  // namespace hoap2_sim
#endif
