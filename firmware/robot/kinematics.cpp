#include "robot/kinematics.hpp"

namespace hoap2 {

namespace {

// Places the child link of joint J after its parent. Every joint axis is a frame axis, so the turn mixes
// two columns of the parent's rotation; J is a template argument so that the joint's data (axis, zeros in
// its origin) become constants of straight-line code.
template <int J>
inline void place_child(const double q_rad[HOAP2_JOINTS], Kinematics& kin) {
  const hoap2_joint_data_t& joint = HOAP2_JOINT[J];
  const Pose& parent = kin.link_B[joint.parent_link];
  Pose& child = kin.link_B[joint.child_link];
  const double c = hoap2_cos(q_rad[J]);
  const double s = hoap2_sin(q_rad[J]);
  const int axis = joint.axis;
  const int second = axis == 2 ? 0 : axis + 1;
  const int third = axis == 0 ? 2 : axis - 1;
  child.R.col(axis) = parent.R.col(axis);
  child.R.col(second) = c * parent.R.col(second) + s * parent.R.col(third);
  child.R.col(third) = c * parent.R.col(third) - s * parent.R.col(second);
  child.p = parent.p;
  for (int i = 0; i < 3; ++i) {
    if (joint.origin_parent_m[i] != 0.0) {
      child.p += parent.R.col(i) * joint.origin_parent_m[i];
    }
  }
}

// The joints one after the other, parents first.
template <int... J>
inline void place_chain(const double q_rad[HOAP2_JOINTS], Kinematics& kin) {
  (place_child<J>(q_rad, kin), ...);
}

inline Vec3 link_com_B(const Kinematics& kin, int link) {
  const double* com = HOAP2_LINK[link].com_L_m;
  const Pose& pose = kin.link_B[link];
  return pose.p + pose.R.col(0) * com[0] + pose.R.col(1) * com[1] + pose.R.col(2) * com[2];
}

}  // namespace

void forward_kinematics(const double q_rad[HOAP2_JOINTS], Kinematics& kin) {
  kin.link_B[HOAP2_L_PELVIS].R.setIdentity();
  kin.link_B[HOAP2_L_PELVIS].p.setZero();
  place_chain<HOAP2_J_R_HIP_YAW, HOAP2_J_R_HIP_ROLL, HOAP2_J_R_HIP_PITCH, HOAP2_J_R_KNEE,
              HOAP2_J_R_ANKLE_PITCH, HOAP2_J_R_ANKLE_ROLL>(q_rad, kin);
  place_chain<HOAP2_J_L_HIP_YAW, HOAP2_J_L_HIP_ROLL, HOAP2_J_L_HIP_PITCH, HOAP2_J_L_KNEE,
              HOAP2_J_L_ANKLE_PITCH, HOAP2_J_L_ANKLE_ROLL>(q_rad, kin);
  place_chain<HOAP2_J_WAIST_PITCH, HOAP2_J_HEAD_PAN, HOAP2_J_HEAD_TILT>(q_rad, kin);
  place_chain<HOAP2_J_R_SHOULDER_PITCH, HOAP2_J_R_SHOULDER_ROLL, HOAP2_J_R_SHOULDER_YAW, HOAP2_J_R_ELBOW,
              HOAP2_J_R_HAND>(q_rad, kin);
  place_chain<HOAP2_J_L_SHOULDER_PITCH, HOAP2_J_L_SHOULDER_ROLL, HOAP2_J_L_SHOULDER_YAW, HOAP2_J_L_ELBOW,
              HOAP2_J_L_HAND>(q_rad, kin);

  // The sum of the links' masses, not the rounded total of the data sheet.
  double total_kg = 0.0;
  Vec3 moment_B = Vec3::Zero();
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    total_kg += HOAP2_LINK[link].mass_kg;
    moment_B += HOAP2_LINK[link].mass_kg * link_com_B(kin, link);
  }
  kin.com_B = moment_B / total_kg;
}

Pose sole_pose_B(const Kinematics& kin, int foot) {
  const Pose& link = kin.link_B[foot == 0 ? HOAP2_L_R_FOOT : HOAP2_L_L_FOOT];
  Pose sole;
  sole.R = link.R;
  sole.p = link.p - link.R.col(2) * HOAP2_SOLE_BELOW_ANKLE_M;
  return sole;
}

// A joint moves the CoM of all that hangs on it: J_j = a_j x (sum m_i (c_i - o_j)) / M, with a_j the joint's
// axis and o_j a point on it. The sums grow from the leaves to the pelvis.
void com_jacobian_B(const Kinematics& kin, ComJacobian& jacobian) {
  double mass_kg[HOAP2_LINKS];
  Vec3 moment_B[HOAP2_LINKS];
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    mass_kg[link] = HOAP2_LINK[link].mass_kg;
    moment_B[link] = mass_kg[link] * link_com_B(kin, link);
  }
  for (int i = HOAP2_JOINTS - 1; i >= 0; --i) {
    const int j = HOAP2_TREE_ORDER[i];
    const hoap2_joint_data_t& joint = HOAP2_JOINT[j];
    const Pose& pose = kin.link_B[joint.child_link];
    const Vec3 lever_B = moment_B[joint.child_link] - mass_kg[joint.child_link] * pose.p;
    jacobian.col(j) = pose.R.col(joint.axis).cross(lever_B);
    mass_kg[joint.parent_link] += mass_kg[joint.child_link];
    moment_B[joint.parent_link] += moment_B[joint.child_link];
  }
  jacobian /= mass_kg[HOAP2_L_PELVIS];
}

// From the link down to the pelvis: in reversed tree order every joint comes before those that carry it, so
// one pass meets the whole path.
void point_jacobian_B(const Kinematics& kin, int link, const Vec3& point_B, PointJacobian& jacobian) {
  jacobian.setZero();
  int on_path = link;
  for (int i = HOAP2_JOINTS - 1; i >= 0; --i) {
    const int j = HOAP2_TREE_ORDER[i];
    const hoap2_joint_data_t& joint = HOAP2_JOINT[j];
    if (joint.child_link != on_path) {
      continue;
    }
    const Pose& pose = kin.link_B[on_path];
    const Vec3 axis_B = pose.R.col(joint.axis);
    jacobian.col(j).head<3>() = axis_B.cross(point_B - pose.p);
    jacobian.col(j).tail<3>() = axis_B;
    on_path = joint.parent_link;
  }
}

}  // namespace hoap2
