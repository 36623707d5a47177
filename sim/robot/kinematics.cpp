#include "robot/kinematics.h"

#include "terrain/floor.h"

namespace hoap2_sim {

Vec3 link_com_L_m(const hoap2_plant_params_t &params, int link) {
  const Vec3 com_L_m = vec(HOAP2_LINK[link].com_L_m);
  return link == HOAP2_L_CHEST ? com_L_m + vec(params.chest_com_shift_L_m) : com_L_m;
}

void link_poses_in_pelvis(const double q_rad[HOAP2_JOINTS], LinkPose pose[HOAP2_LINKS]) {
  pose[HOAP2_L_PELVIS] = LinkPose{};
  for (const int j : HOAP2_TREE_ORDER) {
    const hoap2_joint_data_t &joint = HOAP2_JOINT[j];
    const LinkPose &parent = pose[joint.parent_link];
    pose[joint.child_link].origin = parent.origin + matrix(parent.quat) * vec(joint.origin_parent_m);
    pose[joint.child_link].quat = normalised(parent.quat * about_axis(joint.axis, q_rad[j]));
  }
}

namespace {

// Axes of the mean sole in the pelvis frame: z is the mean of the two sole normals,
// x the mean of the two toe directions. Falls back to the pelvis when the soles
// face opposite ways.
Mat3 mean_sole_axes(const LinkPose pose[HOAP2_LINKS]) {
  const Mat3 right = matrix(pose[kFootLink[0]].quat), left = matrix(pose[kFootLink[1]].quat);
  Vec3 z = right.cz + left.cz;
  if (norm(z) < 0.1) return Mat3{};
  z = (1.0 / norm(z)) * z;
  Vec3 x = right.cx + left.cx;
  x = x - dot(x, z) * z;
  if (norm(x) < 0.1) return Mat3{};
  x = (1.0 / norm(x)) * x;
  return {x, cross(z, x), z};
}

// Lowest corner of both soles along a direction, in the frame of the poses.
double lowest_sole_corner_m(const LinkPose pose[HOAP2_LINKS], const Vec3 &up) {
  double lowest_m = 1e9;
  for (const int link : kFootLink) {
    for (int corner = 0; corner < 4; ++corner) {
      const Vec3 corner_L_m = {(corner & 1) != 0 ? HOAP2_ANKLE_TO_TOE_M : -HOAP2_ANKLE_TO_HEEL_M,
                               (corner & 2) != 0 ? HOAP2_SOLE_HALF_WIDTH_M : -HOAP2_SOLE_HALF_WIDTH_M,
                               -HOAP2_SOLE_BELOW_ANKLE_M};
      const double height_m = dot(up, pose[link].origin + matrix(pose[link].quat) * corner_L_m);
      if (height_m < lowest_m) lowest_m = height_m;
    }
  }
  return lowest_m;
}

void set_start_velocities(State *state) {
  Vec3 com_W_m, rate_W_m_s;
  for (BodyState &body : state->body) {
    put(Vec3{}, body.com_vel_W_m_s);
    put(Vec3{}, body.omega_W_rad_s);
  }
  total_com(*state, &com_W_m, &rate_W_m_s);
  const Vec3 omega_W_rad_s = vec(state->params.start_omega_W_rad_s);
  for (BodyState &body : state->body) {
    const Vec3 arm_W_m = vec(body.com_pos_W_m) - com_W_m;
    put(vec(state->params.start_vel_W_m_s) + cross(omega_W_rad_s, arm_W_m), body.com_vel_W_m_s);
    put(omega_W_rad_s, body.omega_W_rad_s);
    put(omega_W_rad_s, body.omega_before_W_rad_s);
  }
}

}  // namespace

void place_robot(State *state) {
  const hoap2_plant_params_t &params = state->params;
  LinkPose pose[HOAP2_LINKS];
  link_poses_in_pelvis(params.start_posture_rad, pose);
  const Mat3 sole_axes = mean_sole_axes(pose);
  const Vec3 sole_point_L_m = {0.0, 0.0, -HOAP2_SOLE_BELOW_ANKLE_M};
  Vec3 middle;
  for (const int link : kFootLink) {
    middle = middle + 0.5 * (pose[link].origin + matrix(pose[link].quat) * sole_point_L_m);
  }
  // The mean sole lies on the floor, heading start_yaw about the floor's normal.
  const Floor floor(params);
  const Mat3 axes_W = floor.axes_W() * rotation(2, params.start_yaw_W_rad) * transpose(sole_axes);
  const Quat quat_W = normalised(quat_of(axes_W));
  const double drop_m = dot(sole_axes.cz, middle) - lowest_sole_corner_m(pose, sole_axes.cz);
  const Vec3 middle_W_m = floor.start_point_W_m() + (params.start_height_m + drop_m) * floor.normal_W();
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    const Vec3 com_P_m = pose[link].origin + matrix(pose[link].quat) * link_com_L_m(params, link);
    const Quat link_quat_W = normalised(quat_W * pose[link].quat);
    BodyState &body = state->body[link];
    put(middle_W_m + matrix(quat_W) * (com_P_m - middle), body.com_pos_W_m);
    body.quat_W[0] = link_quat_W.w;
    body.quat_W[1] = link_quat_W.x;
    body.quat_W[2] = link_quat_W.y;
    body.quat_W[3] = link_quat_W.z;
  }
  set_start_velocities(state);
}

void all_link_axes_W(const State &s, Mat3 axes_W[HOAP2_LINKS]) {
  for (int link = 0; link < HOAP2_LINKS; ++link) axes_W[link] = link_axes_W(s, link);
}

Vec3 point_W_m(const State &s, int link, const Vec3 &point_L_m) {
  return vec(s.body[link].com_pos_W_m) + link_axes_W(s, link) * (point_L_m - link_com_L_m(s.params, link));
}

Vec3 point_vel_W_m_s(const State &s, int link, const Vec3 &point_L_m) {
  const Vec3 arm_W_m = link_axes_W(s, link) * (point_L_m - link_com_L_m(s.params, link));
  return vec(s.body[link].com_vel_W_m_s) + cross(vec(s.body[link].omega_W_rad_s), arm_W_m);
}

Vec3 sole_point_W_m(const State &s, int foot) {
  return point_W_m(s, kFootLink[foot], Vec3{0.0, 0.0, -HOAP2_SOLE_BELOW_ANKLE_M});
}

double joint_angle_rad(const State &s, int joint) {
  const hoap2_joint_data_t &data = HOAP2_JOINT[joint];
  const Quat relative = conj(quat(s.body[data.parent_link].quat_W)) * quat(s.body[data.child_link].quat_W);
  const double along = data.axis == 0 ? relative.x : (data.axis == 1 ? relative.y : relative.z);
  // The hard stops lie within +-pi, so the principal value is the angle.
  return 2.0 * (relative.w >= 0.0 ? std::atan2(along, relative.w) : std::atan2(-along, -relative.w));
}

double joint_rate_rad_s(const State &s, const Mat3 axes_W[HOAP2_LINKS], int joint) {
  const hoap2_joint_data_t &data = HOAP2_JOINT[joint];
  return dot(axes_W[data.child_link].column(data.axis),
             vec(s.body[data.child_link].omega_W_rad_s) - vec(s.body[data.parent_link].omega_W_rad_s));
}

void total_com(const State &s, Vec3 *com_W_m, Vec3 *com_rate_W_m_s) {
  double mass_kg = 0.0;
  Vec3 first, momentum;
  // Relative to the pelvis: far from the world's origin the sum keeps its digits.
  const Vec3 reference_W_m = vec(s.body[HOAP2_L_PELVIS].com_pos_W_m);
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    const double m_kg = HOAP2_LINK[link].mass_kg;
    mass_kg += m_kg;
    first = first + m_kg * (vec(s.body[link].com_pos_W_m) - reference_W_m);
    momentum = momentum + m_kg * vec(s.body[link].com_vel_W_m_s);
  }
  *com_W_m = reference_W_m + (1.0 / mass_kg) * first;
  *com_rate_W_m_s = (1.0 / mass_kg) * momentum;
}

}  // namespace hoap2_sim
