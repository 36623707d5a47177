// Overlays: CoM, CoP, capture point, footprints, push arrow, as coloured triangles.
#ifndef HOAP2_RENDER_MARKS_H
#define HOAP2_RENDER_MARKS_H

#include <array>
#include <vector>

#include "hoap2_render/render.h"
#include "soil_surface.h"
#include "vec.h"

namespace hoap2 {

struct Colour {
  float r, g, b, a;
};

struct MarkVertex {
  Vec3 pos;
  Vec3 normal;
  Colour colour;
};

// Triangles, in drawing coordinates (world less origin).
using Marks = std::vector<MarkVertex>;

// The tilted floor, the blocks on it and the soil in it, in drawing coordinates.
class Ground {
 public:
  Ground(const hoap2_scene_t &scene, const std::array<double, 3> &origin_W_m, const SoilSurface &soil);
  Vec3 normal() const { return normal_; }
  bool is_soil() const { return soil_.exists(); }
  // Point of the floor plane below x, y.
  Vec3 floor_point(float x, float y) const;
  // The same on top of a block or of the soil, where one is.
  Vec3 point(float x, float y) const;
  // From and to the pool's frame.
  Vec3 pool_point(Vec3 p_P_m) const;
  Vec3 pool_place(Vec3 p) const;

 private:
  struct Block {
    Vec3 centre, half;
    float yaw;
  };
  Vec3 through_;
  Vec3 normal_;
  std::vector<Block> blocks_;
  const SoilSurface &soil_;
  std::array<float, 12> pool_;  // rows of [R | p]
};

// Footprints, oldest first.
Marks footprint_marks(const hoap2_scene_t &scene, const Ground &ground,
                      const std::array<double, 3> &origin_W_m);
// Points on the ground: below the CoM, CoP, capture point. They also shine faintly through the feet.
Marks point_marks(const hoap2_scene_t &scene, const Ground &ground, const std::array<double, 3> &origin_W_m);
// Marks in the air; they also shine faintly through the robot.
Marks air_marks(const hoap2_scene_t &scene, const Ground &ground, const std::array<double, 3> &origin_W_m);

}  // namespace hoap2
#endif
