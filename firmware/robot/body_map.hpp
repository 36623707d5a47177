// Whole-body map of a position-controlled robot: CoM, pelvis and feet to joint angles.
#ifndef HOAP2_ROBOT_BODY_MAP_HPP
#define HOAP2_ROBOT_BODY_MAP_HPP

#include "robot/kinematics.hpp"
#include "robot/leg_ik.hpp"

namespace hoap2 {

struct BodyTarget {
  double com_O_m[2];       // horizontal CoM
  double hip_height_m;     // pelvis origin above O's floor; the pelvis stays level
  double heading_rad;      // yaw of the pelvis
  double foot_O_m[2][3];   // sole point under each ankle
  double foot_yaw_rad[2];  // soles are level
};

struct BodyMapResult {
  double com_error_m;  // what the fixed point left over, horizontal
  double excess_m;     // largest draw-back of a leg
  bool pulled_back;
  bool joint_limit;
};

// q_rad: in, the upper body and a start for the legs; out, with the legs solved.
// com_over_base_B_m: CoM against the pelvis in pelvis axes, in: the start of the fixed point (last tick's
// solution), out: that of the answer. The pelvis is placed so that the CoM meets its target:
// p_B = com - R com_over_base, iterated `passes` times (the map contracts by about five a pass).
BodyMapResult body_map(const BodyTarget& target, int passes, double com_over_base_B_m[3],
                       double q_rad[HOAP2_JOINTS]);

}  // namespace hoap2
#endif
