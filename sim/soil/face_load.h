// Sums the pressure of the cells and the shear of the patches under a face into one
// wrench that is linear in the link's velocities after the tick.
#ifndef HOAP2_SIM_SOIL_FACE_LOAD_H
#define HOAP2_SIM_SOIL_FACE_LOAD_H

#include "geometry.h"
#include "soil/face.h"
#include "soil/shear.h"
#include "solver/spatial.h"

namespace hoap2_sim {

class FaceLoad {
 public:
  // A normal force at (u, v) on the face: force_N - slope_Ns_m * (normal velocity there).
  void press(double u_m, double v_m, double force_N, double slope_Ns_m) {
    force_ += force_N;
    force_u_ += force_N * u_m;
    force_v_ += force_N * v_m;
    const double slope_u = slope_Ns_m * u_m, slope_v = slope_Ns_m * v_m;
    slope_ += slope_Ns_m;
    slope_u_ += slope_u;
    slope_v_ += slope_v;
    slope_uu_ += slope_u * u_m;
    slope_uv_ += slope_u * v_m;
    slope_vv_ += slope_v * v_m;
  }

  // A row of normal forces at (u, v) + k (u_step, v_step): sums over k, with their moments in k.
  struct Row {
    double force = 0.0, force_k = 0.0;
    double slope = 0.0, slope_k = 0.0, slope_kk = 0.0;

    void press(double k, double force_N, double slope_Ns_m) {
      force += force_N;
      force_k += force_N * k;
      slope += slope_Ns_m;
      slope_k += slope_Ns_m * k;
      slope_kk += slope_Ns_m * k * k;
    }
  };
  void press(double u_m, double v_m, double u_step_m, double v_step_m, const Row &row) {
    force_ += row.force;
    force_u_ += u_m * row.force + u_step_m * row.force_k;
    force_v_ += v_m * row.force + v_step_m * row.force_k;
    slope_ += row.slope;
    slope_u_ += u_m * row.slope + u_step_m * row.slope_k;
    slope_v_ += v_m * row.slope + v_step_m * row.slope_k;
    slope_uu_ +=
        u_m * u_m * row.slope + 2.0 * u_m * u_step_m * row.slope_k + u_step_m * u_step_m * row.slope_kk;
    slope_uv_ += u_m * v_m * row.slope + (u_m * v_step_m + v_m * u_step_m) * row.slope_k +
                 u_step_m * v_step_m * row.slope_kk;
    slope_vv_ +=
        v_m * v_m * row.slope + 2.0 * v_m * v_step_m * row.slope_k + v_step_m * v_step_m * row.slope_kk;
  }

  void shear(double u_m, double v_m, const ShearAnswer &answer) {
    along_a_ += answer.force_a_N;
    along_b_ += answer.force_b_N;
    turn_ += u_m * answer.force_b_N - v_m * answer.force_a_N;
    const double a_turn = u_m * answer.ab_Ns_m - v_m * answer.aa_Ns_m;
    const double b_turn = u_m * answer.bb_Ns_m - v_m * answer.ab_Ns_m;
    aa_ += answer.aa_Ns_m;
    ab_ += answer.ab_Ns_m;
    bb_ += answer.bb_Ns_m;
    a_turn_ += a_turn;
    b_turn_ += b_turn;
    turn_turn_ += u_m * b_turn - v_m * a_turn;
  }

  bool any() const { return slope_ > 0.0 || force_ > 0.0; }
  bool presses() const { return force_ > 0.0; }

  // Wrench and slope about the link's CoM, world axes.
  void find(const Face &face, const Mat3 &link_axes_W, SpatialVector *wrench_W,
            SpatialInertia *slope_W) const;

 private:
  double force_ = 0.0, force_u_ = 0.0, force_v_ = 0.0;
  double slope_ = 0.0, slope_u_ = 0.0, slope_v_ = 0.0, slope_uu_ = 0.0, slope_uv_ = 0.0, slope_vv_ = 0.0;
  double along_a_ = 0.0, along_b_ = 0.0, turn_ = 0.0;
  double aa_ = 0.0, ab_ = 0.0, bb_ = 0.0, a_turn_ = 0.0, b_turn_ = 0.0, turn_turn_ = 0.0;
};

}  // namespace hoap2_sim
#endif
