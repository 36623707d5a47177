// Closed-form inverse kinematics of a leg: hip yaw, roll, pitch, knee, ankle pitch, ankle roll.
#ifndef HOAP2_ROBOT_LEG_IK_HPP
#define HOAP2_ROBOT_LEG_IK_HPP

#include <stdint.h>

#include "robot/rotation.hpp"

namespace hoap2 {

enum class LegIk : int32_t {
  ok,
  pulled_back,  // out of reach: the ankle was drawn towards the hip, the foot keeps its orientation
  joint_limit   // a soft limit clips an angle: the foot is not where it was asked to be
};

struct LegIkResult {
  LegIk status = LegIk::ok;
  double q_rad[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};  // in the joint order of a leg
  double excess_m = 0.0;                             // how far the ankle was drawn back
};

// The straight leg is a singularity: the knee's rate grows without bound as it is approached. The reach
// ends this much before it (0.1 mm keeps the knee above 3.6 deg).
constexpr double kLegReachMargin_m = 1e-4;

// Index of a leg's first joint (hip yaw) in the joint arrays; the other five follow. foot: 0 right, 1 left.
constexpr int leg_first_joint(int foot) { return foot == 0 ? HOAP2_J_R_HIP_YAW : HOAP2_J_L_HIP_YAW; }

// sole_B: the wanted pose of the sole frame (see kinematics.hpp) in the pelvis frame. The answer is always
// finite and within the soft limits, with the knee bent forward. Joint limits win over pulled_back in the
// status; excess_m tells of the latter in any case.
void leg_ik(int foot, const Pose& sole_B, LegIkResult& result, double reach_margin_m = kLegReachMargin_m);

}  // namespace hoap2
#endif
