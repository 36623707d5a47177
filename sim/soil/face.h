// The faces of the links that the ground can carry, where they are in the pool, and the
// cells under them (docs/soil.md, "Faces and cells").
#ifndef HOAP2_SIM_SOIL_FACE_H
#define HOAP2_SIM_SOIL_FACE_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry.h"
#include "hoap2_plant/plant.h"
#include "plant_state.h"
#include "soil/height_field.h"

namespace hoap2_sim {

// A rectangle fixed in a link. Its axes a, b lie in it, m = a x b points into the link.
struct Face {
  int link = 0;
  int foot = -1;  // 0 right, 1 left sole; -1: not a sole
  Vec3 arm_L_m;   // centre from the link's CoM
  Vec3 a_L, b_L, m_L;
  double half_a_m = 0.0, half_b_m = 0.0;
  int patches_a = 1, patches_b = 1;
  int first_patch = 0;
  double per_patch_a_m = 0.0, per_patch_b_m = 0.0;  // 1 / size of a patch

  int patches() const { return patches_a * patches_b; }
  int patch_at(double u_m, double v_m) const {
    const int i = static_cast<int>((u_m + half_a_m) * per_patch_a_m);
    const int j = static_cast<int>((v_m + half_b_m) * per_patch_b_m);
    return std::min(i, patches_a - 1) * patches_b + std::min(j, patches_b - 1);
  }
  // A rectangle of the face by the patches it lies in: give(patch, part of the rectangle).
  // By area, not by its middle: else what a sliding patch bears would flicker.
  template <class Give>
  void share_out(double u_m, double v_m, double half_u_m, double half_v_m, Give &&give) const;
  double patch_u_m(int patch) const { return half_a_m * ((2 * (patch / patches_b) + 1.0) / patches_a - 1.0); }
  double patch_v_m(int patch) const { return half_b_m * ((2 * (patch % patches_b) + 1.0) / patches_b - 1.0); }
};

template <class Give>
void Face::share_out(double u_m, double v_m, double half_u_m, double half_v_m, Give &&give) const {
  const double low_a = (u_m - half_u_m + half_a_m) * per_patch_a_m,
               high_a = (u_m + half_u_m + half_a_m) * per_patch_a_m;
  const double low_b = (v_m - half_v_m + half_b_m) * per_patch_b_m,
               high_b = (v_m + half_v_m + half_b_m) * per_patch_b_m;
  const int i0 = std::max(0, static_cast<int>(low_a)), i1 = std::min(patches_a - 1, static_cast<int>(high_a));
  const int j0 = std::max(0, static_cast<int>(low_b)), j1 = std::min(patches_b - 1, static_cast<int>(high_b));
  if (i0 == i1 && j0 == j1) {
    give(i0 * patches_b + j0, 1.0);
    return;
  }
  const double per_area = 1.0 / ((high_a - low_a) * (high_b - low_b));
  for (int i = i0; i <= i1; ++i) {
    // The first and the last one take what sticks out of the face.
    const double part_a = ((i == i1 ? high_a : i + 1.0) - (i == i0 ? low_a : i)) * per_area;
    for (int j = j0; j <= j1; ++j) {
      give(i * patches_b + j, part_a * ((j == j1 ? high_b : j + 1.0) - (j == j0 ? low_b : j)));
    }
  }
}

// Soles first (right, left), then the other faces link by link.
std::vector<Face> list_faces(const hoap2_plant_params_t &params);

// The pool: origin at the start point, x ahead, y left, z up.
struct PoolFrame {
  Vec3 origin_W_m;
  Mat3 axes_W;
};
PoolFrame pool_frame(const hoap2_plant_params_t &params);

// Motion of a face in its own axes, at its centre.
struct FaceTwist {
  Vec3 omega_rad_s, vel_m_s;

  double normal_m_s(double u_m, double v_m) const {
    return vel_m_s.z + omega_rad_s.x * v_m - omega_rad_s.y * u_m;
  }
  double along_a_m_s(double v_m) const { return vel_m_s.x - omega_rad_s.z * v_m; }
  double along_b_m_s(double u_m) const { return vel_m_s.y + omega_rad_s.z * u_m; }
};

// A face in the pool's frame.
struct FacePose {
  Vec3 centre_m;
  Vec3 a, b, m;

  double height_m(double u_m, double v_m) const { return centre_m.z + u_m * a.z + v_m * b.z; }
};

// Faces steeper than about 84 deg carry nothing; their share grows to 1 at about 73 deg.
constexpr double kSteepest = 0.1, kFull = 0.3;
inline double slope_share(const FacePose &pose) {
  return std::min(1.0, std::max(0.0, (pose.m.z - kSteepest) / (kFull - kSteepest)));
}

// Columns and rows of cells, inclusive; empty while x0 > x1 or y0 > y1.
struct Window {
  std::int32_t x0 = 0, y0 = 0, x1 = -1, y1 = -1;

  bool empty() const { return x0 > x1 || y0 > y1; }
  void cover(int ax, int ay, int bx, int by) {
    *this = empty() ? Window{ax, ay, bx, by}
                    : Window{std::min(x0, ax), std::min(y0, ay), std::max(x1, bx), std::max(y1, by)};
  }
};

// Part of a cell under a face: (u, v) is the middle of that part in the face.
struct CellPart {
  std::size_t index;
  double u_m, v_m;
  double wide_a, wide_b;  // its size along a and b, in cells

  double cells() const { return wide_a * wide_b; }
};

// Cells whose centre is under the face; that at an edge stands also for what its outer
// neighbour has under the face. So areas and centroids are exact, and the cell that
// bears a load is the cell that remembers it. `visit(CellPart)` for each.
class CellsUnder {
 public:
  // margin_m widens the face on all sides.
  CellsUnder(const HeightField &field, const Face &face, const FacePose &pose, double margin_m = 0.0);
  template <class Visit>
  void each(Visit &&visit) const;
  double step_a_m() const { return step_a_; }
  double step_b_m() const { return step_b_; }
  // Cells that can be under the face.
  Window window() const { return {first_x_, first_y_, last_x_, last_y_}; }

 private:
  // A centre exactly on the edge counts as inside, whatever the last digit says.
  static constexpr double kOnEdge_m = 1e-9;

  static double edge(double distance_m, double per_step) {
    const double steps = distance_m * per_step;
    return steps < 1.0 - kOnEdge_m * per_step ? steps + 0.5 : 1.0;
  }
  static void clip(double value, double rate, double half, double *low, double *high);

  const HeightField &field_;
  double half_a_, half_b_;
  Vec3 centre_;
  double u_x_, u_y_, v_x_, v_y_;  // d(u, v) / d(x, y)
  double step_a_, step_b_;        // spacing of the cells along a and b
  int first_x_, last_x_, first_y_, last_y_;
};

// Interval of x in which |value + rate x| <= half.
inline void CellsUnder::clip(double value, double rate, double half, double *low, double *high) {
  if (std::fabs(rate) < 1e-12) {
    if (std::fabs(value) > half) *high = *low - 1.0;
    return;
  }
  const double one = (-half - value) / rate, two = (half - value) / rate;
  *low = std::max(*low, std::min(one, two));
  *high = std::min(*high, std::max(one, two));
}

template <class Visit>
void CellsUnder::each(Visit &&visit) const {
  const double cell_m = field_.cell_m();
  const double per_a = 1.0 / step_a_, per_b = 1.0 / step_b_;
  const double inner_a = half_a_ - step_a_, inner_b = half_b_ - step_b_;
  const double x0_m = field_.centre_x_m(0) - centre_.x;
  for (int iy = first_y_; iy <= last_y_; ++iy) {
    const double y_m = field_.centre_y_m(iy) - centre_.y;
    const double u0 = u_y_ * y_m, v0 = v_y_ * y_m;
    double low_m = x0_m + first_x_ * cell_m - 0.5 * cell_m, high_m = x0_m + last_x_ * cell_m + 0.5 * cell_m;
    clip(u0, u_x_, half_a_ + kOnEdge_m, &low_m, &high_m);
    clip(v0, v_x_, half_b_ + kOnEdge_m, &low_m, &high_m);
    if (low_m > high_m) continue;
    const int first = std::max(first_x_, static_cast<int>(std::ceil((low_m - x0_m) / cell_m)));
    const int last = std::min(last_x_, static_cast<int>(std::floor((high_m - x0_m) / cell_m)));
    const std::size_t row = field_.index(0, iy);
    for (int ix = first; ix <= last; ++ix) {
      const double x_m = x0_m + ix * cell_m;
      const double u = u0 + u_x_ * x_m, v = v0 + v_x_ * x_m;
      CellPart part = {row + static_cast<std::size_t>(ix), u, v, 1.0, 1.0};
      if (std::fabs(u) > inner_a || std::fabs(v) > inner_b) {
        const double ahead = edge(half_a_ - u, per_a), behind = edge(half_a_ + u, per_a);
        const double left = edge(half_b_ - v, per_b), right = edge(half_b_ + v, per_b);
        part.u_m += 0.5 * step_a_ * (ahead - behind);
        part.v_m += 0.5 * step_b_ * (left - right);
        part.wide_a = ahead + behind - 1.0;
        part.wide_b = left + right - 1.0;
      }
      visit(part);
    }
  }
}

}  // namespace hoap2_sim
#endif
