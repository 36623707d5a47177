#include "mesh.h"

#include <algorithm>

namespace hoap2 {
namespace {

constexpr float kPi = 3.14159265358979F;

Vec3 turned(Vec3 v, Vec3 angle) {
  const float cx = std::cos(angle.x), sx = std::sin(angle.x);
  v = {v.x, cx * v.y - sx * v.z, sx * v.y + cx * v.z};
  const float cy = std::cos(angle.y), sy = std::sin(angle.y);
  v = {cy * v.x + sy * v.z, v.y, -sy * v.x + cy * v.z};
  const float cz = std::cos(angle.z), sz = std::sin(angle.z);
  return {cz * v.x - sz * v.y, sz * v.x + cz * v.y, v.z};
}

// Deform, turn and shift a point of the primitive; normals go with the inverse transposed Jacobian.
Vertex placed(const Placement &at, Vec3 p, Vec3 n, float half_z) {
  const float h = p.z / half_z;
  const float grow_x = 1.0F + at.taper_x * h;
  const float grow_y = 1.0F + at.taper_y * h;
  const float slope_x = (at.taper_x * p.x + at.shear_x) / half_z;
  const float slope_y = at.taper_y * p.y / half_z;
  const Vec3 pos = {p.x * grow_x + at.shear_x * h, p.y * grow_y, p.z};
  Vec3 normal = {n.x / grow_x, n.y / grow_y, 0.0F};
  normal.z = n.z - normal.x * slope_x - normal.y * slope_y;
  return {turned(pos, at.turn_rad) + at.centre, turned(unit(normal), at.turn_rad), at.material.albedo,
          at.material.gloss, static_cast<float>(at.link)};
}

float component(Vec3 v, int i) { return i == 0 ? v.x : (i == 1 ? v.y : v.z); }

// One line of the grid over a face: which end the arc belongs to, and the tangent of its angle.
struct GridLine {
  float side;
  float tangent;
};

std::vector<GridLine> grid_lines(int cells) {
  std::vector<GridLine> lines;
  for (int i = 0; i <= cells; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(cells);
    lines.push_back({-1.0F, -std::tan((1.0F - t) * kPi / 4.0F)});
  }
  for (int i = 0; i <= cells; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(cells);
    lines.push_back({1.0F, std::tan(t * kPi / 4.0F)});
  }
  return lines;
}

void add_face(Mesh &mesh, const Placement &at, Vec3 half, Vec3 radius, int axis, float sign,
              const std::vector<GridLine> &lines) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  const auto count = static_cast<uint32_t>(lines.size());
  for (const GridLine &row : lines) {
    for (const GridLine &column : lines) {
      float corner[3];
      float direction[3];
      corner[axis] = sign;
      corner[u] = column.side;
      corner[v] = row.side;
      direction[axis] = sign;
      direction[u] = column.tangent;
      direction[v] = row.tangent;
      const Vec3 d = unit({direction[0], direction[1], direction[2]});
      const Vec3 core = scaled({corner[0], corner[1], corner[2]}, half - radius);
      const Vec3 normal = unit({d.x / radius.x, d.y / radius.y, d.z / radius.z});
      mesh.vertices.push_back(placed(at, core + scaled(d, radius), normal, half.z));
    }
  }
  for (uint32_t r = 0; r + 1 < count; ++r) {
    for (uint32_t c = 0; c + 1 < count; ++c) {
      const uint32_t a = first + r * count + c;
      const uint32_t b = a + 1, d = a + count, e = d + 1;
      if (sign > 0.0F) {
        mesh.triangle(a, b, e);
        mesh.triangle(a, e, d);
      } else {
        mesh.triangle(a, e, b);
        mesh.triangle(a, d, e);
      }
    }
  }
}

}  // namespace

void Mesh::triangle(uint32_t a, uint32_t b, uint32_t c) {
  const Vec3 ab = vertices[b].pos - vertices[a].pos;
  const Vec3 ac = vertices[c].pos - vertices[a].pos;
  if (norm(cross(ab, ac)) < 1e-10F) return;
  indices.insert(indices.end(), {a, b, c});
}

void add_rounded_box(Mesh &mesh, const Placement &at, Vec3 half, Vec3 radius, int cells) {
  // A radius of zero would leave the edge without a normal.
  const Vec3 r = {std::clamp(radius.x, 1e-4F, half.x), std::clamp(radius.y, 1e-4F, half.y),
                  std::clamp(radius.z, 1e-4F, half.z)};
  const std::vector<GridLine> lines = grid_lines(cells);
  for (int axis = 0; axis < 3; ++axis) {
    if (component(half, axis) <= 0.0F) continue;
    add_face(mesh, at, half, r, axis, 1.0F, lines);
    add_face(mesh, at, half, r, axis, -1.0F, lines);
  }
}

void add_cylinder(Mesh &mesh, const Placement &at, float radius, float half_length, float bevel, int sides) {
  struct Ring {
    float r, z, nr, nz;
  };
  const float b = std::min({bevel, radius, half_length});
  const float s = std::sqrt(0.5F);
  // Cap, bevel and wall keep their own normals, so that the rim catches light.
  const Ring rings[] = {{radius - b, half_length, 0, 1},   {radius - b, half_length, s, s},
                        {radius, half_length - b, s, s},   {radius, half_length - b, 1, 0},
                        {radius, b - half_length, 1, 0},   {radius, b - half_length, s, -s},
                        {radius - b, -half_length, s, -s}, {radius - b, -half_length, 0, -1}};
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  const auto n = static_cast<uint32_t>(sides);
  for (const Ring &ring : rings) {
    for (uint32_t i = 0; i < n; ++i) {
      const float angle = 2.0F * kPi * static_cast<float>(i) / static_cast<float>(n);
      const float c = std::cos(angle), sn = std::sin(angle);
      mesh.vertices.push_back(
          placed(at, {ring.r * c, ring.r * sn, ring.z}, {ring.nr * c, ring.nr * sn, ring.nz}, half_length));
    }
  }
  for (uint32_t ring = 0; ring < 8; ring += 2) {
    if (ring == 6) break;
    const uint32_t upper = first + (ring + 1) * n;
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t a = upper + i, d = upper + (i + 1) % n;
      mesh.triangle(a, a + n, d + n);
      mesh.triangle(a, d + n, d);
    }
  }
  for (uint32_t i = 1; i + 1 < n; ++i) {
    mesh.triangle(first, first + i, first + i + 1);
    mesh.triangle(first + 7 * n, first + 7 * n + i + 1, first + 7 * n + i);
  }
}

}  // namespace hoap2
