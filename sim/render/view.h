// A scene as the camera and the lamp see it, and whether it can be drawn at all.
#ifndef HOAP2_RENDER_VIEW_H
#define HOAP2_RENDER_VIEW_H

#include <array>

#include "hoap2_render/render.h"
#include "vec.h"

namespace hoap2 {

// Where the camera stands and how the picture is lit, in drawing coordinates.
struct View {
  std::array<double, 3> origin_W_m;  // whole metres, so that the grid of the floor stays in step
  Vec3 eye, target, light;
  float fade_m;
  Mat4 camera, shadow_clip, shadow_map;
};

View make_view(const hoap2_scene_t &scene, float aspect);

// Throws std::runtime_error that names what cannot be drawn.
void check(const hoap2_scene_t &scene);

}  // namespace hoap2
#endif
