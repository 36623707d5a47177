// Where the links are: from joint angles, and from the plant's bodies.
#ifndef HOAP2_SIM_ROBOT_KINEMATICS_H
#define HOAP2_SIM_ROBOT_KINEMATICS_H

#include "geometry.h"
#include "plant_state.h"

namespace hoap2_sim {

constexpr int kFootLink[2] = {HOAP2_L_R_FOOT, HOAP2_L_L_FOOT};

struct LinkPose {
  Vec3 origin;
  Quat quat;
};

// CoM of a link in its frame, with the chest's shift of this run.
Vec3 link_com_L_m(const hoap2_plant_params_t &params, int link);

// Poses of all links relative to the pelvis.
void link_poses_in_pelvis(const double q_rad[HOAP2_JOINTS], LinkPose pose[HOAP2_LINKS]);

// Start: posture with the soles on the floor (see docs/plant.md, "Start").
void place_robot(State *state);

inline Mat3 link_axes_W(const State &s, int link) { return matrix(quat(s.body[link].quat_W)); }
void all_link_axes_W(const State &s, Mat3 axes_W[HOAP2_LINKS]);
// A point given in the link frame.
Vec3 point_W_m(const State &s, int link, const Vec3 &point_L_m);
Vec3 point_vel_W_m_s(const State &s, int link, const Vec3 &point_L_m);
Vec3 sole_point_W_m(const State &s, int foot);

// Angle and rate of a joint at the link side.
double joint_angle_rad(const State &s, int joint);
double joint_rate_rad_s(const State &s, const Mat3 axes_W[HOAP2_LINKS], int joint);

void total_com(const State &s, Vec3 *com_W_m, Vec3 *com_rate_W_m_s);

}  // namespace hoap2_sim
#endif
