#include "soil_surface.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace hoap2 {
namespace {

constexpr std::size_t kMostVertices = 600000;
constexpr int kMostCells = 8000000;

// How much darker the ground is a metre below its surroundings, which are this many vertices away.
constexpr float kDarkerPer_m = 45.0F, kDarkest = 0.68F, kBrightest = 1.06F;
constexpr std::size_t kSurroundings = 3;

void check(const hoap2_soil_grid_t &grid) {
  const auto finite = [](double v) { return std::isfinite(v); };
  const bool sizes = grid.nx > 0 && grid.ny > 0 && grid.nx <= kMostCells / grid.ny && grid.cell_m > 0.0 &&
                     grid.depth_m > 0.0 && finite(grid.cell_m) && finite(grid.depth_m);
  if (!sizes) throw std::runtime_error("soil: the grid has no cells, too many of them, or no finite size");
  if (!std::all_of(grid.origin_W_m, grid.origin_W_m + 3, finite) ||
      !std::all_of(grid.axes_W, grid.axes_W + 9, finite) || !finite(grid.low_x_m) || !finite(grid.low_y_m)) {
    throw std::runtime_error("soil: the pool's place is not finite");
  }
}

std::size_t blocks(int32_t cells, std::size_t block) {
  return (static_cast<std::size_t>(cells) + block - 1) / block;
}

}  // namespace

bool SoilSurface::same_grid(const hoap2_soil_grid_t &grid) const {
  return exists() && grid.nx == grid_.nx && grid.ny == grid_.ny && grid.cell_m == grid_.cell_m &&
         grid.low_x_m == grid_.low_x_m && grid.low_y_m == grid_.low_y_m;
}

// Where the vertices are; their heights come after.
void SoilSurface::lay_out(const hoap2_soil_grid_t &grid) {
  block_ = 1;
  while ((blocks(grid.nx, block_) + 2) * (blocks(grid.ny, block_) + 2) > kMostVertices) ++block_;
  columns_ = blocks(grid.nx, block_) + 2;
  rows_ = blocks(grid.ny, block_) + 2;
  low_x_ = static_cast<float>(grid.low_x_m);
  low_y_ = static_cast<float>(grid.low_y_m);
  high_x_ = static_cast<float>(grid.low_x_m + grid.nx * grid.cell_m);
  high_y_ = static_cast<float>(grid.low_y_m + grid.ny * grid.cell_m);
  vertices_.assign(columns_ * rows_, SoilVertex{});
  const auto place = [&](std::size_t k, std::size_t count, double low_m, float low, float high) {
    if (k == 0) return low;
    if (k + 1 == count) return high;
    return static_cast<float>(low_m + static_cast<double>((k - 1) * block_ + block_ / 2) * grid.cell_m +
                              0.5 * grid.cell_m);
  };
  for (std::size_t row = 0; row < rows_; ++row) {
    for (std::size_t column = 0; column < columns_; ++column) {
      Vec3 &pos = vertices_[row * columns_ + column].pos;
      pos.x = std::min(place(column, columns_, grid.low_x_m, low_x_, high_x_), high_x_);
      pos.y = std::min(place(row, rows_, grid.low_y_m, low_y_, high_y_), high_y_);
    }
  }
}

// The cell whose height a vertex has.
std::size_t SoilSurface::source(std::size_t row, std::size_t column) const {
  const auto cell = [&](std::size_t k, std::size_t count, int32_t cells) {
    const std::size_t inner = std::min(std::max<std::size_t>(k, 1), count - 2) - 1;
    return std::min(inner * block_ + block_ / 2, static_cast<std::size_t>(cells) - 1);
  };
  return cell(row, rows_, grid_.ny) * static_cast<std::size_t>(grid_.nx) + cell(column, columns_, grid_.nx);
}

void SoilSurface::set(const hoap2_soil_grid_t &grid, const float *height_m, const float *change_m,
                      double full_scale_m) {
  check(grid);
  if (!(full_scale_m > 0.0) || !std::isfinite(full_scale_m)) {
    throw std::runtime_error("soil: the full scale must be positive");
  }
  const std::size_t count = static_cast<std::size_t>(grid.nx) * static_cast<std::size_t>(grid.ny);
  for (const float *values : {height_m, change_m}) {
    if (!std::all_of(values, values + count, [](float v) { return std::isfinite(v); })) {
      throw std::runtime_error("soil: a height is not finite");
    }
  }
  const bool is_new = !same_grid(grid);
  if (is_new) lay_out(grid);
  grid_ = grid;
  depth_m_ = static_cast<float>(grid.depth_m);
  per_full_scale_ = static_cast<float>(1.0 / full_scale_m);
  std::size_t first = rows_, end = 0;
  for (std::size_t row = 0; row < rows_; ++row) {
    bool differs = is_new;
    for (std::size_t column = 0; column < columns_; ++column) {
      SoilVertex &vertex = vertices_[row * columns_ + column];
      const std::size_t cell = source(row, column);
      differs = differs || vertex.pos.z != height_m[cell] || vertex.change_m != change_m[cell];
      vertex.pos.z = height_m[cell];
      vertex.change_m = change_m[cell];
    }
    if (!differs) continue;
    first = std::min(first, row);
    end = row + 1;
  }
  if (first >= end) return;
  // A height also shades its neighbours.
  first -= std::min(first, kSurroundings);
  end = std::min(end + kSurroundings, rows_);
  find_shading(first, end);
  changed_ = true;
}

float SoilSurface::surroundings_m(std::size_t row, std::size_t column) const {
  const std::size_t below = row - std::min(row, kSurroundings),
                    above = std::min(row + kSurroundings, rows_ - 1);
  const std::size_t left = column - std::min(column, kSurroundings);
  const std::size_t right = std::min(column + kSurroundings, columns_ - 1);
  return 0.125F * (at(below, left) + at(below, column) + at(below, right) + at(row, left) + at(row, right) +
                   at(above, left) + at(above, column) + at(above, right));
}

void SoilSurface::find_shading(std::size_t first_row, std::size_t end_row) {
  for (std::size_t row = first_row; row < end_row; ++row) {
    const std::size_t below = row > 0 ? row - 1 : row, above = std::min(row + 1, rows_ - 1);
    for (std::size_t column = 0; column < columns_; ++column) {
      const std::size_t left = column > 0 ? column - 1 : column, right = std::min(column + 1, columns_ - 1);
      const float dx = vertices_[row * columns_ + right].pos.x - vertices_[row * columns_ + left].pos.x;
      const float dy =
          vertices_[above * columns_ + column].pos.y - vertices_[below * columns_ + column].pos.y;
      const float slope_x = (at(row, right) - at(row, left)) / std::max(dx, 1e-6F);
      const float slope_y = (at(above, column) - at(below, column)) / std::max(dy, 1e-6F);
      SoilVertex &vertex = vertices_[row * columns_ + column];
      vertex.normal = unit({-slope_x, -slope_y, 1.0F});
      const float below_m = surroundings_m(row, column) - vertex.pos.z;
      vertex.open = std::clamp(1.0F - kDarkerPer_m * below_m, kDarkest, kBrightest);
    }
  }
}

std::array<float, 12> SoilSurface::pose(const std::array<double, 3> &origin_W_m) const {
  std::array<float, 12> rows{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t k = 0; k < 3; ++k) rows[4 * row + k] = static_cast<float>(grid_.axes_W[3 * row + k]);
    rows[4 * row + 3] = static_cast<float>(grid_.origin_W_m[row] - origin_W_m[row]);
  }
  return rows;
}

bool SoilSurface::is_inside(float x, float y) const {
  return exists() && x >= low_x_ && x <= high_x_ && y >= low_y_ && y <= high_y_;
}

float SoilSurface::height_m(float x, float y, float reach_m) const {
  const float side = static_cast<float>(block_) * static_cast<float>(grid_.cell_m);
  const auto index = [&](float distance, std::size_t count) {
    return static_cast<std::size_t>(
        std::clamp(std::floor(distance / side) + 1.0F, 1.0F, static_cast<float>(count - 2)));
  };
  const std::size_t left = index(x - reach_m - low_x_, columns_),
                    right = index(x + reach_m - low_x_, columns_);
  const std::size_t first = index(y - reach_m - low_y_, rows_), last = index(y + reach_m - low_y_, rows_);
  float highest = at(first, left);
  for (std::size_t row = first; row <= last; ++row) {
    for (std::size_t column = left; column <= right; ++column) highest = std::max(highest, at(row, column));
  }
  return highest;
}

Mesh wall_mesh(const SoilSurface &soil, int link) {
  Mesh mesh;
  const float half_x = 0.5F * (soil.high_x() - soil.low_x()), half_y = 0.5F * (soil.high_y() - soil.low_y());
  const float middle_x = soil.low_x() + half_x, middle_y = soil.low_y() + half_y;
  const float half = 0.5F * kWall_m, half_z = 0.5F * (std::min(soil.depth_m(), 0.3F) + kWallOverFloor_m);
  Placement at;
  at.link = link;
  at.material = {{0.17F, 0.19F, 0.21F}, 0.25F};
  const Vec3 edge = {0.0012F, 0.0012F, 0.0012F};
  for (const float side : {-1.0F, 1.0F}) {
    at.centre = {middle_x, middle_y + side * (half_y + half), kWallOverFloor_m - half_z};
    add_rounded_box(mesh, at, {half_x + kWall_m, half, half_z}, edge, 1);
    at.centre = {middle_x + side * (half_x + half), middle_y, kWallOverFloor_m - half_z};
    add_rounded_box(mesh, at, {half, half_y, half_z}, edge, 1);
  }
  return mesh;
}

}  // namespace hoap2
