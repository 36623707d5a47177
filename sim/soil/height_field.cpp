#include "soil/height_field.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "hoap2/generated/robot_model.h"
#include "sensors/noise.h"

namespace hoap2_sim {
namespace {

constexpr double kMostCells = 4e6;
// Narrower than this many cells a sole is not resolved.
constexpr double kCellsAcrossSole = 3.0;
// Nodes of the roughness per correlation length, and reach of one node's bump.
constexpr double kNodesPerLength = 4.0;
constexpr double kReach_lengths = 2.0;

int whole_cells(double size_m, double cell_m) {
  return std::max(1, static_cast<int>(std::ceil(size_m / cell_m - 1e-6)));
}

// The bump whose random sum has the correlation exp(-(r/length)^2).
double bump(double distance_m, double length_m) {
  const double ratio = distance_m / length_m;
  return std::exp(-2.0 * ratio * ratio);
}

struct Axis {
  int nodes, first, reach;
  double spacing_m;
};

Axis node_axis(double size_m, double length_m) {
  const double spacing_m = length_m / kNodesPerLength;
  const int reach = static_cast<int>(std::ceil(kReach_lengths * kNodesPerLength));
  return {static_cast<int>(std::ceil(size_m / spacing_m)) + 2 * reach + 1, -reach, reach, spacing_m};
}

// out(i) = sum over the nodes k near cell i of bump * in(k), for one line of nodes.
void spread(const Axis &axis, double length_m, double cell_m, int cells, const double *in,
            std::size_t stride_in, double *out, std::size_t stride_out) {
  for (int i = 0; i < cells; ++i) {
    const double x_m = (i + 0.5) * cell_m;
    const int nearest = static_cast<int>(std::lround(x_m / axis.spacing_m));
    double sum = 0.0;
    for (int k = nearest - axis.reach; k <= nearest + axis.reach; ++k) {
      const int node = k - axis.first;
      if (node < 0 || node >= axis.nodes) continue;
      sum += bump(x_m - k * axis.spacing_m, length_m) * in[static_cast<std::size_t>(node) * stride_in];
    }
    out[static_cast<std::size_t>(i) * stride_out] = sum;
  }
}

}  // namespace

std::string HeightField::build(const hoap2_plant_params_t &params) {
  char text[200];
  const double cell_m = params.soil_cell_m;
  const double most_m = 2.0 * HOAP2_SOLE_HALF_WIDTH_M / kCellsAcrossSole;
  if (cell_m > most_m) {
    std::snprintf(text, sizeof text,
                  "parameter soil_cell_m = %g is too coarse for a sole of 63 mm; take at most %.3g", cell_m,
                  most_m);
    return text;
  }
  const double count = std::ceil(params.soil_size_m[0] / cell_m) * std::ceil(params.soil_size_m[1] / cell_m);
  if (count > kMostCells) {
    std::snprintf(
        text, sizeof text,
        "parameter soil_cell_m = %g gives a soil of %.3g cells, at most %.3g fit; take a larger soil_cell_m "
        "or a smaller soil_size_m",
        cell_m, count, kMostCells);
    return text;
  }
  nx_ = whole_cells(params.soil_size_m[0], cell_m);
  ny_ = whole_cells(params.soil_size_m[1], cell_m);
  cell_m_ = cell_m;
  low_x_m_ = params.soil_centre_m[0] - 0.5 * nx_ * cell_m;
  low_y_m_ = params.soil_centre_m[1] - 0.5 * ny_ * cell_m;
  depth_m_ = params.soil_size_m[2];
  cells_.assign(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_), Cell{});
  return "";
}

void HeightField::start(const hoap2_plant_params_t &params, double virgin_stiffness_Pa_m) {
  for (Cell &cell : cells_) cell = {0.0, 0.0, 0.0, virgin_stiffness_Pa_m};
  if (params.soil_roughness_m > 0.0) add_roughness(params);
  find_top();
}

// A random normal field with the given rms and correlation length. The random numbers
// belong to nodes that are tied to that length, so finer cells show the same ground.
void HeightField::add_roughness(const hoap2_plant_params_t &params) {
  const double length_m = params.soil_roughness_length_m;
  const Axis x = node_axis(nx_ * cell_m_, length_m), y = node_axis(ny_ * cell_m_, length_m);
  const auto across = static_cast<std::size_t>(x.nodes), along = static_cast<std::size_t>(y.nodes);
  std::vector<double> node(across * along + 1), rows(static_cast<std::size_t>(nx_) * along),
      column(cells_.size());
  std::uint64_t noise[4];
  noise_seed(noise, static_cast<std::uint64_t>(params.soil_seed));
  for (std::size_t k = 0; k + 1 < node.size(); k += 2) noise_normal_pair(noise, &node[k], &node[k + 1]);
  for (std::size_t j = 0; j < along; ++j) {
    spread(x, length_m, cell_m_, nx_, &node[j * across], 1, &rows[j * static_cast<std::size_t>(nx_)], 1);
  }
  for (int ix = 0; ix < nx_; ++ix) {
    const auto stride = static_cast<std::size_t>(nx_);
    spread(y, length_m, cell_m_, ny_, &rows[static_cast<std::size_t>(ix)], stride,
           &column[static_cast<std::size_t>(ix)], stride);
  }
  double mean = 0.0, square = 0.0;
  for (const double value : column) mean += value;
  mean /= static_cast<double>(column.size());
  for (const double value : column) square += (value - mean) * (value - mean);
  const double rms = std::sqrt(square / static_cast<double>(column.size()));
  if (!(rms > 0.0)) return;  // a single cell has no roughness
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    cells_[i].level_m = params.soil_roughness_m * (column[i] - mean) / rms;
  }
}

void HeightField::find_top() {
  top_m_ = cells_.empty() ? 0.0 : cells_[0].level_m;
  for (const Cell &cell : cells_) raise_top(cell.level_m);
}

double HeightField::volume_m3() const {
  double sum_m = 0.0;
  for (const Cell &cell : cells_) sum_m += cell.surface_m();
  return cell_m_ * cell_m_ * (sum_m + depth_m_ * static_cast<double>(cells_.size()));
}

}  // namespace hoap2_sim
