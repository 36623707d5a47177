#include "kinematics.h"

#include <cmath>

namespace hoap2 {
namespace {

using Rotation = std::array<double, 9>;

Rotation product(const Rotation &a, const Rotation &b) {
  Rotation c{};
  for (size_t row = 0; row < 3; ++row) {
    for (size_t column = 0; column < 3; ++column) {
      c[3 * row + column] =
          a[3 * row] * b[column] + a[3 * row + 1] * b[3 + column] + a[3 * row + 2] * b[6 + column];
    }
  }
  return c;
}

Rotation about_axis(int axis, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  if (axis == 0) return {1, 0, 0, 0, c, -s, 0, s, c};
  if (axis == 1) return {c, 0, s, 0, 1, 0, -s, 0, c};
  return {c, -s, 0, s, c, 0, 0, 0, 1};
}

Rotation from_quaternion(const double quat[4]) {
  const double length =
      std::sqrt(quat[0] * quat[0] + quat[1] * quat[1] + quat[2] * quat[2] + quat[3] * quat[3]);
  if (!(length > 0.0)) return {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const double w = quat[0] / length, x = quat[1] / length, y = quat[2] / length, z = quat[3] / length;
  return {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
          2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
          2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
}

}  // namespace

LinkPoses link_poses(const hoap2_scene_t &scene) {
  LinkPoses poses;
  poses[HOAP2_L_PELVIS].rot_W = from_quaternion(scene.base_quat_W);
  for (size_t i = 0; i < 3; ++i) poses[HOAP2_L_PELVIS].pos_W_m[i] = scene.base_pos_W_m[i];
  for (const int joint : HOAP2_TREE_ORDER) {
    const hoap2_joint_data_t &data = HOAP2_JOINT[joint];
    const Pose &parent = poses[static_cast<size_t>(data.parent_link)];
    Pose &child = poses[static_cast<size_t>(data.child_link)];
    child.rot_W = product(parent.rot_W, about_axis(data.axis, scene.q_rad[joint]));
    for (size_t row = 0; row < 3; ++row) {
      child.pos_W_m[row] = parent.pos_W_m[row];
      for (size_t k = 0; k < 3; ++k) {
        child.pos_W_m[row] += parent.rot_W[3 * row + k] * data.origin_parent_m[k];
      }
    }
  }
  return poses;
}

}  // namespace hoap2
