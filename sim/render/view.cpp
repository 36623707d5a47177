#include "view.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "hoap2/generated/robot_model.h"

namespace hoap2 {
namespace {

Vec3 from_angles(double azimuth_rad, double elevation_rad) {
  return {static_cast<float>(std::cos(elevation_rad) * std::cos(azimuth_rad)),
          static_cast<float>(std::cos(elevation_rad) * std::sin(azimuth_rad)),
          static_cast<float>(std::sin(elevation_rad))};
}

bool all_finite(const double *values, int count) {
  return std::all_of(values, values + count, [](double v) { return std::isfinite(v); });
}

}  // namespace

View make_view(const hoap2_scene_t &scene, float aspect) {
  View view{};
  view.origin_W_m = {std::floor(scene.camera_target_W_m[0]), std::floor(scene.camera_target_W_m[1]), 0.0};
  const auto local = [&](const double *p) {
    return Vec3{static_cast<float>(p[0] - view.origin_W_m[0]), static_cast<float>(p[1] - view.origin_W_m[1]),
                static_cast<float>(p[2] - view.origin_W_m[2])};
  };
  const auto distance = static_cast<float>(scene.camera_distance_m);
  view.target = local(scene.camera_target_W_m);
  view.eye = view.target + from_angles(scene.camera_azimuth_rad, scene.camera_elevation_rad) * distance;
  // Over the photographer's left shoulder, whatever side the picture is taken from.
  view.light = from_angles(scene.camera_azimuth_rad - 0.85, 0.95);
  view.fade_m = std::max(4.0F, 5.0F * distance);
  // Straight from above, "up" would be undefined: then the picture's top is where the camera looks.
  const Vec3 up =
      std::abs(scene.camera_elevation_rad) < 1.55
          ? Vec3{0.0F, 0.0F, 1.0F}
          : from_angles(scene.camera_azimuth_rad, 0.0) * (scene.camera_elevation_rad > 0 ? -1.0F : 1.0F);
  const float near_m = std::max(0.01F, 0.08F * distance);
  view.camera = perspective(static_cast<float>(HOAP2_RENDER_FOV_Y_RAD), aspect, near_m, 4.0F * view.fade_m) *
                look_at(view.eye, view.target, up);
  // The lamp sees the robot: 0.42 m about a point a little above the hips.
  const Vec3 middle = local(scene.base_pos_W_m) + Vec3{0.0F, 0.0F, 0.03F};
  view.shadow_clip =
      orthographic(0.42F, 0.2F, 2.8F) * look_at(middle + view.light * 1.5F, middle, {0.0F, 0.0F, 1.0F});
  Mat4 to_texture;
  for (int i = 0; i < 3; ++i) {
    to_texture.at(i, i) = 0.5F;
    to_texture.at(i, 3) = 0.5F;
  }
  to_texture.at(3, 3) = 1.0F;
  view.shadow_map = to_texture * view.shadow_clip;
  return view;
}

void check(const hoap2_scene_t &scene) {
  if (!all_finite(scene.base_pos_W_m, 3) || !all_finite(scene.base_quat_W, 4)) {
    throw std::runtime_error("scene: the pose of the base is not finite");
  }
  if (!all_finite(scene.q_rad, HOAP2_JOINTS)) throw std::runtime_error("scene: a joint angle is not finite");
  if (!all_finite(scene.camera_target_W_m, 3) || !std::isfinite(scene.camera_azimuth_rad) ||
      !std::isfinite(scene.camera_elevation_rad) || !(scene.camera_distance_m > 0.05) ||
      !(scene.camera_distance_m < 1000.0)) {
    throw std::runtime_error("scene: the camera must be finite and 0.05 to 1000 m away");
  }
  if (!all_finite(scene.floor_tilt_rad, 2) || !all_finite(scene.floor_origin_W_m, 3) ||
      std::abs(scene.floor_tilt_rad[0]) > 1.0 || std::abs(scene.floor_tilt_rad[1]) > 1.0) {
    throw std::runtime_error("scene: floor tilt beyond 1 rad");
  }
  if (scene.footprint_count < 0 || scene.footprint_count > HOAP2_RENDER_MAX_FOOTPRINTS ||
      scene.block_count < 0 || scene.block_count > HOAP2_RENDER_MAX_BLOCKS) {
    throw std::runtime_error("scene: too many footprints or blocks");
  }
  for (int i = 0; i < scene.block_count; ++i) {
    const double *size = scene.block_size_m[i];
    if (!all_finite(scene.block_centre_W_m[i], 3) || !all_finite(size, 3) ||
        !std::isfinite(scene.block_yaw_W_rad[i]) || !(size[0] > 0.0 && size[1] > 0.0 && size[2] > 0.0)) {
      throw std::runtime_error("scene: block " + std::to_string(i) + " has no finite, positive size");
    }
  }
}

}  // namespace hoap2
