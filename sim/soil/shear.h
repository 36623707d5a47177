// Shear of a patch of a face against the ground: Janosi-Hanamoto in rate form, with an
// elastic way back (docs/soil.md, "Shear").
#ifndef HOAP2_SIM_SOIL_SHEAR_H
#define HOAP2_SIM_SOIL_SHEAR_H

#include <algorithm>
#include <cmath>

namespace hoap2_sim {

// What a patch remembers: the shear force on the link in the face's axes, and the largest
// limit since it touched, which is the stiffness of the way back (times K).
struct PatchShear {
  double force_a_N = 0.0, force_b_N = 0.0, peak_N = 0.0;
};

// Force at the tick's start and its symmetric slope over the tick, against velocity.
struct ShearAnswer {
  double force_a_N, force_b_N;
  double aa_Ns_m, ab_Ns_m, bb_Ns_m;
};

class ShearLaw {
 public:
  void build(double shear_m, double tick_s) {
    per_shear_m_ = 1.0 / shear_m;
    tick_s_ = tick_s;
  }

  // limit_N: what the ground under the patch bears now. First the patch is moved by the
  // tick that led here, with these velocities; then it answers the tick to come.
  ShearAnswer step(PatchShear *patch, double limit_N, double vel_a_m_s, double vel_b_m_s,
                   double turn_rad_s) const {
    if (patch->peak_N > 0.0) {
      move(patch, limit_N, tick_s_ * vel_a_m_s, tick_s_ * vel_b_m_s, tick_s_ * turn_rad_s);
    } else {  // just touched
      *patch = {0.0, 0.0, limit_N};
    }
    const double a_N = patch->force_a_N, b_N = patch->force_b_N;
    const double square = a_N * a_N + b_N * b_N, per_m = tick_s_ * per_shear_m_;
    const double across = limit_N * per_m;
    if (!(square > 0.0)) return {0.0, 0.0, across, 0.0, across};
    // The force acts against the displacement: motion along it is the way back.
    const bool is_back = a_N * vel_a_m_s + b_N * vel_b_m_s > 0.0;
    const double size_N = std::sqrt(square);
    const double along = per_m * (is_back ? patch->peak_N + size_N : limit_N - size_N);
    const double more = (along - across) / square;
    return {a_N, b_N, across + more * a_N * a_N, more * a_N * b_N, across + more * b_N * b_N};
  }

 private:
  void move(PatchShear *patch, double limit_N, double a_m, double b_m, double turn_rad) const {
    double a_N = patch->force_a_N + turn_rad * patch->force_b_N;  // fixed in the ground
    double b_N = patch->force_b_N - turn_rad * patch->force_a_N;
    clip(limit_N, &a_N, &b_N);
    const double peak_N = std::max(patch->peak_N, limit_N);
    const double way_m = std::sqrt(a_m * a_m + b_m * b_m);
    if (way_m > 0.0) {
      const double gone = fade(way_m * per_shear_m_);
      const double bound_N_m = (a_N * a_m + b_N * b_m > 0.0 ? peak_N : limit_N) / way_m;
      a_N -= gone * (bound_N_m * a_m + a_N);
      b_N -= gone * (bound_N_m * b_m + b_N);
      clip(limit_N, &a_N, &b_N);
    }
    *patch = {a_N, b_N, peak_N};
  }
  // 1 - exp(-x)
  static double fade(double x) {
    if (x > 1e-2) return -std::expm1(-x);
    return x * (1.0 - x * (0.5 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x / 120.0))));
  }
  static void clip(double limit_N, double *a_N, double *b_N) {
    const double square = *a_N * *a_N + *b_N * *b_N;
    if (square <= limit_N * limit_N) return;
    const double part = limit_N / std::sqrt(square);
    *a_N *= part;
    *b_N *= part;
  }

  double per_shear_m_ = 0.0, tick_s_ = 0.0;
};

}  // namespace hoap2_sim
#endif
