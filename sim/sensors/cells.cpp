#include "sensors/cells.h"

#include "hoap2/generated/robot_model.h"

namespace hoap2_sim {
namespace {

double clamp(double v, double low, double high) { return v < low ? low : (v > high ? high : v); }

}  // namespace

// With u, v in [-1, 1] the CoP in units of the half rectangle and sx, sy = +-1 the
// corner of a cell, a plate on four springs gives f = F/4 (1 + sx u + sy v). A CoP
// with |u| + |v| > 1 would make the far cell pull: it lifts off, and the other three
// follow from the balance of force and moments. Inside the rectangle those three
// never pull.
void plate_on_springs(double force_N, double cop_x_L_m, double cop_y_L_m, double cell_N[4]) {
  const double(&at)[4][3] = HOAP2_CELL_POS_L_M;
  double low[2] = {at[0][0], at[0][1]}, high[2] = {at[0][0], at[0][1]};
  for (int i = 1; i < 4; ++i) {
    for (int k = 0; k < 2; ++k) {
      if (at[i][k] < low[k]) low[k] = at[i][k];
      if (at[i][k] > high[k]) high[k] = at[i][k];
    }
  }
  const double u = clamp(2.0 * (cop_x_L_m - low[0]) / (high[0] - low[0]) - 1.0, -1.0, 1.0);
  const double v = clamp(2.0 * (cop_y_L_m - low[1]) / (high[1] - low[1]) - 1.0, -1.0, 1.0);
  const double f_N = force_N > 0.0 ? force_N : 0.0;
  int lifted = -1;
  double sx[4], sy[4];
  for (int i = 0; i < 4; ++i) {
    sx[i] = 2.0 * at[i][0] > low[0] + high[0] ? 1.0 : -1.0;
    sy[i] = 2.0 * at[i][1] > low[1] + high[1] ? 1.0 : -1.0;
    cell_N[i] = 0.25 * f_N * (1.0 + sx[i] * u + sy[i] * v);
    if (cell_N[i] < 0.0) lifted = i;
  }
  if (lifted < 0) return;
  for (int i = 0; i < 4; ++i) {
    const bool same_x = sx[i] == sx[lifted], same_y = sy[i] == sy[lifted];
    if (same_x && same_y) {
      cell_N[i] = 0.0;
    } else if (same_x) {  // carries the moment about y alone on its side
      cell_N[i] = 0.5 * f_N * (1.0 + sx[i] * u);
    } else if (same_y) {
      cell_N[i] = 0.5 * f_N * (1.0 + sy[i] * v);
    } else {
      cell_N[i] = 0.5 * f_N * (sx[i] * u + sy[i] * v);
    }
  }
}

}  // namespace hoap2_sim
