#include "robot/leg_ik.hpp"

#include "robot/joint_limits.hpp"

namespace hoap2 {

namespace {

constexpr double kPi = 3.14159265358979323846;

// The links' lengths are the joint origins of the right leg; the left leg mirrors it (a test compares them).
inline double thigh_m() { return -HOAP2_JOINT[HOAP2_J_R_KNEE].origin_parent_m[2]; }
inline double shank_m() { return -HOAP2_JOINT[HOAP2_J_R_ANKLE_PITCH].origin_parent_m[2]; }

inline double clamp(double value, double lower, double upper) {
  return value < lower ? lower : (value > upper ? upper : value);
}

// Positions beyond this are out of reach anyway; the bound keeps squares and products finite.
constexpr double kFar_m = 1e6;

// The wanted hip centre seen from the ankle, in the foot's axes.
Vec3 hip_from_ankle_F(int foot, const Pose& sole_B) {
  const double* hip = HOAP2_JOINT[leg_first_joint(foot)].origin_parent_m;
  Vec3 hip_from_sole_B;
  for (int i = 0; i < 3; ++i) {
    hip_from_sole_B(i) = hip[i] - clamp(sole_B.p(i), -kFar_m, kFar_m);
  }
  Vec3 hip_F = sole_B.R.transpose() * hip_from_sole_B;
  hip_F.z() -= HOAP2_SOLE_BELOW_ANKLE_M;
  return hip_F;
}

// Knee angle from the hip-ankle distance: the half-angle form of the law of cosines,
// tan(q/2) = sqrt(((a+b)^2 - d^2) / (d^2 - (a-b)^2)), keeps its digits at the straight leg, where acos
// loses half of them.
double knee_angle(double distance_m) {
  const double sum_m = thigh_m() + shank_m();
  const double difference_m = thigh_m() - shank_m();
  const double beyond = (sum_m - distance_m) * (sum_m + distance_m);
  const double within = (distance_m - difference_m) * (distance_m + difference_m);
  return 2.0 * hoap2_atan2(hoap2_sqrt(beyond > 0.0 ? beyond : 0.0), hoap2_sqrt(within > 0.0 ? within : 0.0));
}

// Angle from the shank's axis to the hip-ankle line, about -y.
double shank_to_line_angle(double knee_rad) {
  return hoap2_atan2(thigh_m() * hoap2_sin(knee_rad), shank_m() + thigh_m() * hoap2_cos(knee_rad));
}

// Hip yaw, roll, pitch from their product rot_z(a) rot_x(b) rot_y(c).
void hip_angles(const Mat3& R, double angles_rad[3]) {
  angles_rad[0] = hoap2_atan2(-R(0, 1), R(1, 1));
  angles_rad[1] = hoap2_atan2(R(2, 1), hoap2_hypot(R(2, 0), R(2, 2)));
  angles_rad[2] = hoap2_atan2(-R(2, 0), R(2, 2));
}

}  // namespace

// The ankle sees the hip turned only by the ankle and knee joints:
//   rot_x(ankle_roll) hip_F = rot_y(-ankle_pitch) (shank e_z + rot_y(-knee) thigh e_z),
// whose right side has no y component. This gives the roll, the length of the line the knee, the line's
// slope the ankle pitch; what is left of the foot's orientation is the hip's.
void leg_ik(int foot, const Pose& sole_B, LegIkResult& result, double reach_margin_m) {
  Vec3 hip_F = hip_from_ankle_F(foot, sole_B);
  const double distance_m =
      clamp(hoap2_hypot(hoap2_hypot(hip_F.x(), hip_F.y()), hip_F.z()), 0.0, 4.0 * kFar_m);
  const double reach_m = thigh_m() + shank_m() - reach_margin_m;
  result.status = LegIk::ok;
  result.excess_m = 0.0;
  double used_distance_m = distance_m;
  if (distance_m > reach_m) {
    result.status = LegIk::pulled_back;
    result.excess_m = distance_m - reach_m;
    used_distance_m = reach_m;
  }

  // A hip below the ankle (z < 0) belongs to a foot bent back over a folded leg: the roll stays within a
  // right angle and the pitch takes the turn.
  const double side = hip_F.z() < 0.0 ? -1.0 : 1.0;
  const double ankle_roll = hoap2_atan2(side * hip_F.y(), side * hip_F.z());
  const double knee = knee_angle(used_distance_m);
  const double slope = hoap2_atan2(hip_F.x(), side * hoap2_hypot(hip_F.y(), hip_F.z()));
  double ankle_pitch = -shank_to_line_angle(knee) - slope;
  if (ankle_pitch < -kPi) {
    ankle_pitch += 2.0 * kPi;
  }

  const Mat3 hip_R = sole_B.R * rot_x(-ankle_roll) * rot_y(-(knee + ankle_pitch));
  hip_angles(hip_R, result.q_rad);
  result.q_rad[3] = knee;
  result.q_rad[4] = ankle_pitch;
  result.q_rad[5] = ankle_roll;

  bool clipped = false;
  for (int i = 0; i < 6; ++i) {
    result.q_rad[i] = clip_joint(leg_first_joint(foot) + i, result.q_rad[i], clipped);
  }
  if (clipped) {
    result.status = LegIk::joint_limit;
  }
}

}  // namespace hoap2
