#include "soil/face.h"

#include "robot/kinematics.h"
#include "terrain/floor.h"

namespace hoap2_sim {
namespace {

constexpr double kPatch_m = 0.0175;  // of faces that are not soles
constexpr int kSoleFace = 4;         // looks along -z

int patches_along(double half_m) {
  return std::max(1, static_cast<int>(std::lround(2.0 * half_m / kPatch_m)));
}

// Face 0..5 of a link's box looks along +x, -x, +y, -y, -z, +z.
Face box_face(const hoap2_plant_params_t &params, int link, int side) {
  static constexpr int kAxis[6] = {0, 0, 1, 1, 2, 2};
  static constexpr double kLooks[6] = {1.0, -1.0, 1.0, -1.0, -1.0, 1.0};
  const hoap2_link_data_t &data = HOAP2_LINK[link];
  const Vec3 low_m = vec(data.box_min_L_m), high_m = vec(data.box_max_L_m);
  const Vec3 half_m = 0.5 * (high_m - low_m);
  const int axis = kAxis[side], first = (axis + 1) % 3, second = (axis + 2) % 3;
  Face face;
  face.link = link;
  face.m_L = -kLooks[side] * unit_axis(axis);
  face.a_L = unit_axis(first);
  face.b_L = -kLooks[side] * unit_axis(second);
  face.arm_L_m = 0.5 * (low_m + high_m) - half_m[axis] * face.m_L - link_com_L_m(params, link);
  face.half_a_m = half_m[first];
  face.half_b_m = half_m[second];
  face.patches_a = patches_along(face.half_a_m);
  face.patches_b = patches_along(face.half_b_m);
  return face;
}

}  // namespace

std::vector<Face> list_faces(const hoap2_plant_params_t &params) {
  std::vector<Face> faces;
  for (int foot = 0; foot < 2; ++foot) {
    Face sole = box_face(params, kFootLink[foot], kSoleFace);
    sole.foot = foot;
    sole.patches_a = params.soil_patches[0];
    sole.patches_b = params.soil_patches[1];
    faces.push_back(sole);
  }
  for (int link = 0; params.soil_links == HOAP2_SOIL_LINKS_ALL && link < HOAP2_LINKS; ++link) {
    const bool is_foot = link == kFootLink[0] || link == kFootLink[1];
    for (int side = 0; side < 6; ++side) {
      if (!(is_foot && side == kSoleFace)) faces.push_back(box_face(params, link, side));
    }
  }
  int patches = 0;
  for (Face &face : faces) {
    face.first_patch = patches;
    face.per_patch_a_m = 0.5 * face.patches_a / face.half_a_m;
    face.per_patch_b_m = 0.5 * face.patches_b / face.half_b_m;
    patches += face.patches();
  }
  return faces;
}

PoolFrame pool_frame(const hoap2_plant_params_t &params) {
  const Floor floor(params);
  return {floor.start_point_W_m(), floor.axes_W() * rotation(2, params.start_yaw_W_rad)};
}

CellsUnder::CellsUnder(const HeightField &field, const Face &face, const FacePose &pose, double margin_m)
    : field_(field),
      half_a_(face.half_a_m + margin_m),
      half_b_(face.half_b_m + margin_m),
      centre_(pose.centre_m) {
  const double cell_m = field.cell_m(), slant_m = cell_m / pose.m.z;
  u_x_ = pose.b.y * slant_m;
  u_y_ = -pose.b.x * slant_m;
  v_x_ = -pose.a.y * slant_m;
  v_y_ = pose.a.x * slant_m;
  step_a_ = std::max(std::fabs(u_x_), std::fabs(u_y_));
  step_b_ = std::max(std::fabs(v_x_), std::fabs(v_y_));
  per_a_ = 1.0 / step_a_;
  per_b_ = 1.0 / step_b_;
  const double reach_x_m = std::fabs(pose.a.x) * half_a_ + std::fabs(pose.b.x) * half_b_;
  const double reach_y_m = std::fabs(pose.a.y) * half_a_ + std::fabs(pose.b.y) * half_b_;
  const auto cell_of = [cell_m](double m, double low_m, int count) {
    return static_cast<int>(std::min(std::max((m - low_m) / cell_m, -1.0), static_cast<double>(count)));
  };
  first_x_ = std::max(0, cell_of(centre_.x - reach_x_m, field.low_x_m(), field.nx()));
  last_x_ = std::min(field.nx() - 1, cell_of(centre_.x + reach_x_m, field.low_x_m(), field.nx()));
  first_y_ = std::max(0, cell_of(centre_.y - reach_y_m, field.low_y_m(), field.ny()));
  last_y_ = std::min(field.ny() - 1, cell_of(centre_.y + reach_y_m, field.low_y_m(), field.ny()));
  // Entirely beside the grid: nothing to visit.
  if (centre_.x + reach_x_m < field.low_x_m() || centre_.y + reach_y_m < field.low_y_m()) last_x_ = -1;
}

}  // namespace hoap2_sim
