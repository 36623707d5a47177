#include "hoap2_render/robot_mesh.h"

#include <algorithm>
#include <exception>

#include "robot_shape.h"

using hoap2::Detail;
using hoap2::Mesh;
using hoap2::Vec3;

namespace {

void copy(Vec3 from, float to[3]) {
  to[0] = from.x;
  to[1] = from.y;
  to[2] = from.z;
}

Mesh mesh_of(int32_t coarse) { return hoap2::robot_mesh(coarse != 0 ? Detail::shadow : Detail::picture); }

}  // namespace

extern "C" {

int hoap2_render_robot_mesh_size(int32_t coarse, int32_t *vertices, int32_t *indices) {
  try {
    const Mesh mesh = mesh_of(coarse);
    *vertices = static_cast<int32_t>(mesh.vertices.size());
    *indices = static_cast<int32_t>(mesh.indices.size());
    return 0;
  } catch (const std::exception &) {
    return 1;
  }
}

int hoap2_render_robot_mesh(int32_t coarse, hoap2_mesh_vertex_t *vertex, uint32_t *index) {
  try {
    const Mesh mesh = mesh_of(coarse);
    for (const hoap2::Vertex &from : mesh.vertices) {
      copy(from.pos, vertex->pos_L_m);
      copy(from.normal, vertex->normal_L);
      copy(from.albedo, vertex->albedo);
      vertex->gloss = from.gloss;
      vertex->link = from.link;
      ++vertex;
    }
    std::copy(mesh.indices.begin(), mesh.indices.end(), index);
    return 0;
  } catch (const std::exception &) {
    return 1;
  }
}

}  // extern "C"
