#include "robot/body_map.hpp"

namespace hoap2 {

BodyMapResult body_map(const BodyTarget& target, int passes, double com_over_base_B_m[3],
                       double q_rad[HOAP2_JOINTS]) {
  BodyMapResult result = {0.0, 0.0, false, false};
  const double c = hoap2_cos(target.heading_rad);
  const double s = hoap2_sin(target.heading_rad);
  Mat3 sole_rot_B[2];
  for (int foot = 0; foot < 2; ++foot)
    sole_rot_B[foot] = rot_z(target.foot_yaw_rad[foot] - target.heading_rad);

  Kinematics kin;
  for (int pass = 0; pass < passes; ++pass) {
    const double base_x = target.com_O_m[0] - (c * com_over_base_B_m[0] - s * com_over_base_B_m[1]);
    const double base_y = target.com_O_m[1] - (s * com_over_base_B_m[0] + c * com_over_base_B_m[1]);
    result.excess_m = 0.0;
    result.pulled_back = result.joint_limit = false;
    for (int foot = 0; foot < 2; ++foot) {
      const double dx = target.foot_O_m[foot][0] - base_x;
      const double dy = target.foot_O_m[foot][1] - base_y;
      Pose sole_B;
      sole_B.R = sole_rot_B[foot];
      sole_B.p = Vec3(c * dx + s * dy, -s * dx + c * dy, target.foot_O_m[foot][2] - target.hip_height_m);
      LegIkResult leg;
      leg_ik(foot, sole_B, leg);
      for (int i = 0; i < 6; ++i) q_rad[leg_first_joint(foot) + i] = leg.q_rad[i];
      if (leg.excess_m > result.excess_m) result.excess_m = leg.excess_m;
      result.pulled_back = result.pulled_back || leg.excess_m > 0.0;
      result.joint_limit = result.joint_limit || leg.status == LegIk::joint_limit;
    }
    forward_kinematics(q_rad, kin);
    const double error_x =
        c * (kin.com_B[0] - com_over_base_B_m[0]) - s * (kin.com_B[1] - com_over_base_B_m[1]);
    const double error_y =
        s * (kin.com_B[0] - com_over_base_B_m[0]) + c * (kin.com_B[1] - com_over_base_B_m[1]);
    result.com_error_m = hoap2_sqrt(error_x * error_x + error_y * error_y);
    for (int i = 0; i < 3; ++i) com_over_base_B_m[i] = kin.com_B[i];
  }
  return result;
}

}  // namespace hoap2
