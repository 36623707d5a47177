// The ground as a grid of square columns in the pool's frame (docs/soil.md, "Ground").
#ifndef HOAP2_SIM_SOIL_HEIGHT_FIELD_H
#define HOAP2_SIM_SOIL_HEIGHT_FIELD_H

#include <cstddef>
#include <string>
#include <vector>

#include "hoap2_plant/plant.h"

namespace hoap2_sim {

// One column of ground. Heights above the untouched surface.
struct Cell {
  double level_m;         // where the surface would be, had nothing pressed on it
  double memory_m;        // largest depth below the level that was pressed so far
  double rut_m;           // depth of the surface now, without load: less than that, it springs back
  double stiffness_Pa_m;  // of unloading and reloading between the two

  double surface_m() const { return level_m - rut_m; }
  double held_Pa() const { return stiffness_Pa_m * (memory_m - rut_m); }  // at the remembered depth
};

class HeightField {
 public:
  // Error text, or "".
  std::string build(const hoap2_plant_params_t &params);
  // All cells at level 0 plus the roughness, without memory.
  void start(const hoap2_plant_params_t &params, double virgin_stiffness_Pa_m);

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  double cell_m() const { return cell_m_; }
  // Corner of cell (0, 0); the walls are there and nx, ny cells on.
  double low_x_m() const { return low_x_m_; }
  double low_y_m() const { return low_y_m_; }
  double high_x_m() const { return low_x_m_ + nx_ * cell_m_; }
  double high_y_m() const { return low_y_m_ + ny_ * cell_m_; }
  double depth_m() const { return depth_m_; }
  double centre_x_m(int ix) const { return low_x_m_ + (ix + 0.5) * cell_m_; }
  double centre_y_m(int iy) const { return low_y_m_ + (iy + 0.5) * cell_m_; }
  bool is_within_walls(double x_m, double y_m) const {
    return x_m >= low_x_m_ && x_m <= high_x_m() && y_m >= low_y_m_ && y_m <= high_y_m();
  }

  std::size_t index(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(ix);
  }
  std::size_t size() const { return cells_.size(); }
  const Cell *cells() const { return cells_.data(); }
  const Cell &cell(std::size_t i) const { return cells_[i]; }
  Cell &cell(std::size_t i) { return cells_[i]; }
  double surface_m(int ix, int iy) const { return cells_[index(ix, iy)].surface_m(); }
  double memory_m(int ix, int iy) const { return cells_[index(ix, iy)].memory_m; }

  // Not below any surface: nothing above it touches.
  double top_m() const { return top_m_; }
  void raise_top(double level_m) {
    if (level_m > top_m_) top_m_ = level_m;
  }
  void find_top();

  // Of the unloaded surface above the pool's bottom.
  double volume_m3() const;

 private:
  void add_roughness(const hoap2_plant_params_t &params);

  std::vector<Cell> cells_;
  int nx_ = 0, ny_ = 0;
  double cell_m_ = 0.0, low_x_m_ = 0.0, low_y_m_ = 0.0, depth_m_ = 0.0, top_m_ = 0.0;
};

}  // namespace hoap2_sim
#endif
