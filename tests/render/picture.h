// One small camera, the robot standing in front of it, and a projection worked out a second time.
#ifndef HOAP2_TESTS_RENDER_PICTURE_H
#define HOAP2_TESTS_RENDER_PICTURE_H

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#include "hoap2/generated/robot_model.h"
#include "hoap2_render/render.h"

namespace render_test {

inline constexpr int kWidth = 320;
inline constexpr int kHeight = 240;

struct Pixel {
  int r, g, b;
};

struct Picture {
  std::vector<uint8_t> rgb = std::vector<uint8_t>(3 * kWidth * kHeight, 0);
  Pixel at(int column, int row) const {
    const size_t i = 3 * (static_cast<size_t>(row) * kWidth + static_cast<size_t>(column));
    return {rgb[i], rgb[i + 1], rgb[i + 2]};
  }
};

class Camera {
 public:
  explicit Camera(int samples = 1) : handle(hoap2_render_create(kWidth, kHeight, samples)) {}
  ~Camera() { hoap2_render_destroy(handle); }
  Camera(const Camera &) = delete;
  Camera &operator=(const Camera &) = delete;
  Picture draw(const hoap2_scene_t &scene) {
    Picture picture;
    EXPECT_EQ(hoap2_render_draw(handle, &scene, picture.rgb.data()), 0) << hoap2_render_error(handle);
    return picture;
  }
  hoap2_render_t *handle;
};

// Legs straight, arms down, seen from the front.
inline hoap2_scene_t standing() {
  hoap2_scene_t scene{};
  scene.base_pos_W_m[2] = 0.237;
  scene.base_quat_W[0] = 1.0;
  scene.q_rad[HOAP2_J_R_SHOULDER_PITCH] = scene.q_rad[HOAP2_J_L_SHOULDER_PITCH] = 1.5707963;
  scene.com_W_m[2] = 0.267;
  scene.camera_target_W_m[2] = 0.25;
  scene.camera_distance_m = 1.4;
  scene.camera_elevation_rad = 0.1;
  scene.show = 0;
  return scene;
}

inline bool differ(Pixel a, Pixel b, int by) {
  return std::abs(a.r - b.r) > by || std::abs(a.g - b.g) > by || std::abs(a.b - b.b) > by;
}

// The same view without the robot: it stands behind the camera.
inline Picture backdrop(Camera &camera, hoap2_scene_t scene) {
  const double away_m = 50.0;
  scene.base_pos_W_m[0] += away_m * std::cos(scene.camera_azimuth_rad);
  scene.base_pos_W_m[1] += away_m * std::sin(scene.camera_azimuth_rad);
  return camera.draw(scene);
}

// A pinhole of the documented field of view, worked out here a second time: camera at azimuth 0.
inline void predict(const hoap2_scene_t &scene, const double point_W_m[3], double *column, double *row) {
  const double c = std::cos(scene.camera_elevation_rad), s = std::sin(scene.camera_elevation_rad);
  const double x = point_W_m[0] - scene.camera_target_W_m[0] - scene.camera_distance_m * c;
  const double y = point_W_m[1] - scene.camera_target_W_m[1];
  const double z = point_W_m[2] - scene.camera_target_W_m[2] - scene.camera_distance_m * s;
  const double depth = -c * x - s * z, up = -s * x + c * z;
  const double pixels_per_slope = 0.5 * kHeight / std::tan(0.5 * HOAP2_RENDER_FOV_Y_RAD);
  *column = 0.5 * kWidth + pixels_per_slope * y / depth;
  *row = 0.5 * kHeight - pixels_per_slope * up / depth;
}

}  // namespace render_test
#endif
