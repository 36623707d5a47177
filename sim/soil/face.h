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

// Which patch a point inside a face lies in.
struct PatchGrid {
  double half_a_m, half_b_m, per_patch_a_m, per_patch_b_m;
  int patches_b;

  int at(double u_m, double v_m) const {
    const int i = static_cast<int>((u_m + half_a_m) * per_patch_a_m);
    const int j = static_cast<int>((v_m + half_b_m) * per_patch_b_m);
    return i * patches_b + j;
  }
};

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
  PatchGrid patch_grid() const { return {half_a_m, half_b_m, per_patch_a_m, per_patch_b_m, patches_b}; }
  double patch_u_m(int patch) const { return (patch / patches_b + 0.5) / per_patch_a_m - half_a_m; }
  double patch_v_m(int patch) const { return (patch % patches_b + 0.5) / per_patch_b_m - half_b_m; }
  double patch_m2() const { return 1.0 / (per_patch_a_m * per_patch_b_m); }
};

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
  double cells;  // its size along the ground
};

// Whole cells in a row, all within the face: (u, v) is the middle of the first.
struct CellRun {
  std::size_t index;
  int count;
  double u_m, v_m;
  double u_step_m, v_step_m;
};

// Cells whose centre is under the face; that at an edge stands also for what its outer
// neighbour has under the face. So areas and centroids are exact, and the cell that
// bears a load is the cell that remembers it.
class CellsUnder {
 public:
  // margin_m widens the face on all sides.
  CellsUnder(const HeightField &field, const Face &face, const FacePose &pose, double margin_m = 0.0);
  // `visit(CellPart)` for each.
  template <class Visit>
  void each(Visit &&visit) const;
  // The same, with `visit_run(CellRun)` for the whole cells of a row.
  template <class Visit, class VisitRun>
  void each(Visit &&visit, VisitRun &&visit_run) const;
  // Cells that can be under the face.
  Window window() const { return {first_x_, first_y_, last_x_, last_y_}; }

 private:
  // A centre exactly on the edge counts as inside, whatever the last digit says.
  static constexpr double kOnEdge_m = 1e-9;

  struct Span {
    int first, last;
  };
  // Columns of a row whose centres lie in |u| <= half_a, |v| <= half_b.
  Span span(double u0, double v0, double half_a, double half_b) const;
  static void clip(double value, double rate, double half, double *low, double *high);
  CellPart part_at(std::size_t index, double u, double v) const;

  const HeightField &field_;
  double half_a_, half_b_;
  Vec3 centre_;
  double u_x_, u_y_, v_x_, v_y_;  // d(u, v) from cell to cell
  double step_a_, step_b_;        // spacing of the cells along a and b
  double per_a_, per_b_;          // 1 / that
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

inline CellsUnder::Span CellsUnder::span(double u0, double v0, double half_a, double half_b) const {
  double low = first_x_, high = last_x_;
  clip(u0, u_x_, half_a, &low, &high);
  clip(v0, v_x_, half_b, &low, &high);
  if (!(low <= high)) return {0, -1};
  return {static_cast<int>(std::ceil(low)), static_cast<int>(std::floor(high))};
}

// At an edge. `size`: of what a cell stands for towards an edge that is some steps away.
inline CellPart CellsUnder::part_at(std::size_t index, double u, double v) const {
  const auto size = [](double steps, double one) { return steps < one ? steps + 0.5 : 1.0; };
  const double one_a = 1.0 - kOnEdge_m * per_a_, one_b = 1.0 - kOnEdge_m * per_b_;
  const double ahead = size((half_a_ - u) * per_a_, one_a), behind = size((half_a_ + u) * per_a_, one_a);
  const double left = size((half_b_ - v) * per_b_, one_b), right = size((half_b_ + v) * per_b_, one_b);
  return {index, u + 0.5 * step_a_ * (ahead - behind), v + 0.5 * step_b_ * (left - right),
          (ahead + behind - 1.0) * (left + right - 1.0)};
}

template <class Visit, class VisitRun>
void CellsUnder::each(Visit &&visit, VisitRun &&visit_run) const {
  const double cells_x = (field_.centre_x_m(0) - centre_.x) / field_.cell_m();
  for (int iy = first_y_; iy <= last_y_; ++iy) {
    const double cells_y = (field_.centre_y_m(iy) - centre_.y) / field_.cell_m();
    const double u0 = u_x_ * cells_x + u_y_ * cells_y, v0 = v_x_ * cells_x + v_y_ * cells_y;
    const Span all = span(u0, v0, half_a_ + kOnEdge_m, half_b_ + kOnEdge_m);
    Span whole = span(u0, v0, half_a_ - step_a_, half_b_ - step_b_);
    if (whole.first > whole.last) whole = {all.last + 1, all.last};
    const std::size_t row = field_.index(0, iy);
    const auto visit_to = [&](int first, int end) {
      for (int ix = first; ix < end; ++ix) {
        visit(part_at(row + static_cast<std::size_t>(ix), u0 + u_x_ * ix, v0 + v_x_ * ix));
      }
    };
    visit_to(all.first, whole.first);
    if (whole.first <= whole.last) {
      visit_run(CellRun{row + static_cast<std::size_t>(whole.first), whole.last - whole.first + 1,
                        u0 + u_x_ * whole.first, v0 + v_x_ * whole.first, u_x_, v_x_});
    }
    visit_to(whole.last + 1, all.last + 1);
  }
}

template <class Visit>
void CellsUnder::each(Visit &&visit) const {
  each(visit, [&](const CellRun &run) {
    for (int k = 0; k < run.count; ++k) {
      visit(CellPart{run.index + static_cast<std::size_t>(k), run.u_m + k * run.u_step_m,
                     run.v_m + k * run.v_step_m, 1.0});
    }
  });
}

}  // namespace hoap2_sim
#endif
