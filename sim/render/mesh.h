// Procedural meshes: rounded boxes (also ellipsoids and capsules), bevelled cylinders, flat marks.
#ifndef HOAP2_RENDER_MESH_H
#define HOAP2_RENDER_MESH_H

#include <cstdint>
#include <vector>

#include "vec.h"

namespace hoap2 {

struct Material {
  Vec3 albedo;         // linear
  float gloss = 0.3F;  // 0 matt .. 1 lacquer
};

struct Vertex {
  Vec3 pos;
  Vec3 normal;
  Vec3 albedo;
  float gloss;
  float link;  // index into the table of poses
};

struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;
  // Counter-clockwise seen from outside; triangles without area are dropped.
  void triangle(uint32_t a, uint32_t b, uint32_t c);
};

// Where a primitive sits and how it is deformed. Turned by `turn_rad` (x, then y, then z) after the
// deformation: cross-sections along z grow by taper (relative, at z = +half) and slide by shear (m).
struct Placement {
  int link = 0;
  Vec3 centre;
  Vec3 turn_rad{};
  float taper_x = 0.0F, taper_y = 0.0F, shear_x = 0.0F;
  Material material{};
};

// Box of half sides `half` whose edges are quarter ellipses of half axes `radius`; radius = half makes
// an ellipsoid, radius = (r, r, r) with half = (r, r, h) a capsule. `cells` per quarter arc.
void add_rounded_box(Mesh &mesh, const Placement &at, Vec3 half, Vec3 radius, int cells);

// Cylinder about z with a bevelled rim; `sides` around.
void add_cylinder(Mesh &mesh, const Placement &at, float radius, float half_length, float bevel, int sides);

}  // namespace hoap2
#endif
