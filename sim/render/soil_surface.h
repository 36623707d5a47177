// The soil of a pool as a mesh, and how high it is where.
#ifndef HOAP2_RENDER_SOIL_SURFACE_H
#define HOAP2_RENDER_SOIL_SURFACE_H

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "hoap2_render/render.h"
#include "mesh.h"
#include "vec.h"

namespace hoap2 {

// In the pool's frame.
struct SoilVertex {
  Vec3 pos;
  Vec3 normal;
  float change_m;  // against the untouched surface
  float open;      // 1 on a plane, less in a rut and at its sides, more on a rim
};

// One vertex in the middle of each cell and one more at the walls, in rows along x. Large grids are
// drawn with one vertex for a block of cells.
class SoilSurface {
 public:
  // Throws std::runtime_error when the grid cannot be drawn.
  void set(const hoap2_soil_grid_t &grid, const float *height_m, const float *change_m, double full_scale_m);
  void clear() { columns_ = rows_ = 0; }
  bool exists() const { return columns_ > 0; }

  const std::vector<SoilVertex> &vertices() const { return vertices_; }
  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  // Whether it differs from what was there at the last call.
  bool take_change() { return std::exchange(changed_, false); }

  // Rows of [R | p] from the pool's frame to drawing coordinates.
  std::array<float, 12> pose(const std::array<double, 3> &origin_W_m) const;
  // Highest soil above the pool's frame within reach of a point in the pool's frame.
  bool is_inside(float x, float y) const;
  float height_m(float x, float y, float reach_m) const;

  float low_x() const { return low_x_; }
  float low_y() const { return low_y_; }
  float high_x() const { return high_x_; }
  float high_y() const { return high_y_; }
  float depth_m() const { return depth_m_; }
  float per_full_scale() const { return per_full_scale_; }

 private:
  bool same_grid(const hoap2_soil_grid_t &grid) const;
  void lay_out(const hoap2_soil_grid_t &grid);
  std::size_t source(std::size_t row, std::size_t column) const;
  float at(std::size_t row, std::size_t column) const { return vertices_[row * columns_ + column].pos.z; }
  void find_shading(std::size_t first_row, std::size_t end_row);
  float surroundings_m(std::size_t row, std::size_t column) const;

  hoap2_soil_grid_t grid_{};
  std::size_t columns_ = 0, rows_ = 0;  // of vertices
  std::size_t block_ = 1;               // cells a vertex, along each side
  float low_x_ = 0.0F, low_y_ = 0.0F, high_x_ = 0.0F, high_y_ = 0.0F, depth_m_ = 0.0F;
  float per_full_scale_ = 0.0F;
  std::vector<SoilVertex> vertices_;
  bool changed_ = false;
};

// The walls around it, in the pool's frame; `link` names the pool's pose.
Mesh wall_mesh(const SoilSurface &soil, int link);

// How far the walls reach outwards, and over the floor.
constexpr float kWall_m = 0.012F, kWallOverFloor_m = 0.003F;

}  // namespace hoap2
#endif
