// Link poses of the drawn robot, straight from the generated joint table.
#ifndef HOAP2_RENDER_KINEMATICS_H
#define HOAP2_RENDER_KINEMATICS_H

#include <array>

#include "hoap2/generated/robot_model.h"
#include "hoap2_render/render.h"

namespace hoap2 {

struct Pose {
  std::array<double, 9> rot_W{1, 0, 0, 0, 1, 0, 0, 0, 1};  // row-major
  std::array<double, 3> pos_W_m{0, 0, 0};
};

using LinkPoses = std::array<Pose, HOAP2_LINKS>;

// Poses of all links in the world. A base quaternion of zero length counts as no rotation.
LinkPoses link_poses(const hoap2_scene_t &scene);

}  // namespace hoap2
#endif
