#include "soil_tiles.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hoap2 {
namespace {

constexpr float kTolerance_m = 0.00015F;
constexpr float kSheetBelow_m = 0.0003F;

struct Tile {
  std::size_t left, right, first, last;  // columns and rows of vertices, inclusive
};

class Tiling {
 public:
  explicit Tiling(const SoilSurface &soil)
      : soil_(soil), across_(tiles(soil.columns())), along_(tiles(soil.rows())) {}

  std::size_t across() const { return across_; }
  std::size_t along() const { return along_; }
  Tile tile(std::size_t ix, std::size_t iy) const {
    return {ix * kTile, std::min((ix + 1) * kTile, soil_.columns() - 1), iy * kTile,
            std::min((iy + 1) * kTile, soil_.rows() - 1)};
  }
  const SoilVertex &at(std::size_t row, std::size_t column) const {
    return soil_.vertices()[row * soil_.columns() + column];
  }
  bool fits(const Tile &cell) const;
  float lowest_m(const Tile &tile) const;

 private:
  static std::size_t tiles(std::size_t vertices) { return (vertices - 1 + kTile - 1) / kTile; }

  const SoilSurface &soil_;
  std::size_t across_, along_;
};

// Whether the four corners stand for all vertices between them.
bool Tiling::fits(const Tile &cell) const {
  const SoilVertex &a = at(cell.first, cell.left), &b = at(cell.first, cell.right);
  const SoilVertex &c = at(cell.last, cell.right), &d = at(cell.last, cell.left);
  const float width = static_cast<float>(cell.right - cell.left),
              height = static_cast<float>(cell.last - cell.first);
  for (std::size_t row = cell.first; row <= cell.last; ++row) {
    const float v = static_cast<float>(row - cell.first) / height;
    for (std::size_t column = cell.left; column <= cell.right; ++column) {
      const float u = static_cast<float>(column - cell.left) / width;
      const auto between = [&](float at_a, float at_b, float at_c, float at_d) {
        return (1.0F - v) * ((1.0F - u) * at_a + u * at_b) + v * ((1.0F - u) * at_d + u * at_c);
      };
      const SoilVertex &p = at(row, column);
      if (std::abs(between(a.pos.z, b.pos.z, c.pos.z, d.pos.z) - p.pos.z) > kTolerance_m) return false;
      const float change_m = between(a.change_m, b.change_m, c.change_m, d.change_m);
      if (std::abs(change_m - p.change_m) > kTolerance_m) return false;
    }
  }
  return true;
}

// The two halves of a tile, side by side or one behind the other.
std::array<Tile, 2> halves(const Tile &tile, bool across) {
  std::array<Tile, 2> half = {tile, tile};
  if (across) {
    half[0].right = half[1].left = (tile.left + tile.right) / 2;
  } else {
    half[0].last = half[1].first = (tile.first + tile.last) / 2;
  }
  return half;
}

// Calls visit(Tile) for rectangles that cover the tile and fit. It is divided where that leaves most
// that fits; along a rut so that few and long ones do.
template <class Visit>
void each_fitting(const Tiling &tiling, const Tile &tile, Visit &&visit) {
  const std::size_t width = tile.right - tile.left, length = tile.last - tile.first;
  if ((width == 1 && length == 1) || tiling.fits(tile)) {
    visit(tile);
    return;
  }
  bool across = width >= length;
  if (width > 1 && length > 1) {
    const auto fitting = [&](bool side) {
      const std::array<Tile, 2> half = halves(tile, side);
      return static_cast<int>(tiling.fits(half[0])) + static_cast<int>(tiling.fits(half[1]));
    };
    const int in_width = fitting(true), in_length = fitting(false);
    if (in_width != in_length) across = in_width > in_length;
  }
  for (const Tile &half : halves(tile, across)) each_fitting(tiling, half, visit);
}

float Tiling::lowest_m(const Tile &tile) const {
  float lowest = at(tile.first, tile.left).pos.z;
  for (std::size_t row = tile.first; row <= tile.last; ++row) {
    for (std::size_t column = tile.left; column <= tile.right; ++column) {
      lowest = std::min(lowest, at(row, column).pos.z);
    }
  }
  return lowest;
}

void add_rectangle(std::vector<uint32_t> &indices, std::size_t a, std::size_t b, std::size_t c,
                   std::size_t d) {
  for (const std::size_t k : {a, b, c, a, c, d}) indices.push_back(static_cast<uint32_t>(k));
}

// One vertex at each corner of the tiles, below all of the tiles that meet there.
void add_sheet(const Tiling &tiling, SoilMesh &mesh) {
  const std::size_t first = mesh.vertices.size(), corners = tiling.across() + 1;
  for (std::size_t iy = 0; iy <= tiling.along(); ++iy) {
    for (std::size_t ix = 0; ix <= tiling.across(); ++ix) {
      const Tile at = tiling.tile(std::min(ix, tiling.across() - 1), std::min(iy, tiling.along() - 1));
      mesh.vertices.push_back(
          tiling.at(iy < tiling.along() ? at.first : at.last, ix < tiling.across() ? at.left : at.right));
    }
  }
  for (std::size_t iy = 0; iy < tiling.along(); ++iy) {
    for (std::size_t ix = 0; ix < tiling.across(); ++ix) {
      const float height_m = tiling.lowest_m(tiling.tile(ix, iy)) - kSheetBelow_m;
      const std::size_t a = first + iy * corners + ix, b = a + 1, d = a + corners, c = d + 1;
      for (const std::size_t k : {a, b, c, d}) {
        mesh.vertices[k].pos.z = std::min(mesh.vertices[k].pos.z, height_m);
      }
      add_rectangle(mesh.indices, a, b, c, d);
    }
  }
}

}  // namespace

SoilMesh soil_mesh(const SoilSurface &soil) {
  SoilMesh mesh = {soil.vertices(), {}};
  const Tiling tiling(soil);
  for (std::size_t iy = 0; iy < tiling.along(); ++iy) {
    for (std::size_t ix = 0; ix < tiling.across(); ++ix) {
      each_fitting(tiling, tiling.tile(ix, iy), [&](const Tile &cell) {
        const std::size_t low = cell.first * soil.columns(), high = cell.last * soil.columns();
        add_rectangle(mesh.indices, low + cell.left, low + cell.right, high + cell.right, high + cell.left);
      });
    }
  }
  add_sheet(tiling, mesh);
  return mesh;
}

}  // namespace hoap2
