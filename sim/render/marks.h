// Overlays: CoM, CoP, capture point, footprints, push arrow, as coloured triangles.
#ifndef HOAP2_RENDER_MARKS_H
#define HOAP2_RENDER_MARKS_H

#include <array>
#include <vector>

#include "hoap2_render/render.h"
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

// The tilted floor and the blocks on it, in drawing coordinates.
class Ground {
 public:
  Ground(const hoap2_scene_t &scene, const std::array<double, 3> &origin_W_m);
  Vec3 normal() const { return normal_; }
  // Point of the floor plane below x, y.
  Vec3 floor_point(float x, float y) const;
  // The same on top of a block, where one is.
  Vec3 point(float x, float y) const;

 private:
  struct Block {
    Vec3 centre, half;
    float yaw;
  };
  Vec3 through_;
  Vec3 normal_;
  std::vector<Block> blocks_;
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
