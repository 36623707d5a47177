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

  // limit_N: what the ground under the patch bears now.
  ShearAnswer respond(const PatchShear &patch, double limit_N, double vel_a_m_s, double vel_b_m_s) const {
    const double per_m = tick_s_ * per_shear_m_;
    double a_N = patch.force_a_N, b_N = patch.force_b_N;
    const double size_N = clip(limit_N, &a_N, &b_N);
    const double across = limit_N * per_m;
    if (!(size_N > 0.0)) return {0.0, 0.0, across, 0.0, across};
    // The force acts against the displacement: motion along it is the way back.
    const bool is_back = a_N * vel_a_m_s + b_N * vel_b_m_s > 0.0;
    const double along = per_m * (is_back ? std::max(patch.peak_N, limit_N) + size_N : limit_N - size_N);
    const double ea = a_N / size_N, eb = b_N / size_N, more = along - across;
    return {a_N, b_N, across + more * ea * ea, more * ea * eb, across + more * eb * eb};
  }

  // After a tick in which the patch moved by (a, b) and its face turned by turn_rad.
  void move(PatchShear *patch, double limit_N, double a_m, double b_m, double turn_rad) const {
    if (!(limit_N > 0.0)) {
      *patch = PatchShear{};
      return;
    }
    double a_N = patch->force_a_N + turn_rad * patch->force_b_N;  // fixed in the ground
    double b_N = patch->force_b_N - turn_rad * patch->force_a_N;
    clip(limit_N, &a_N, &b_N);
    const double peak_N = std::max(patch->peak_N, limit_N);
    const double way_m = std::sqrt(a_m * a_m + b_m * b_m);
    if (way_m > 0.0) {
      const double gone = fade(way_m * per_shear_m_);
      const double bound_N = a_N * a_m + b_N * b_m > 0.0 ? peak_N : limit_N;
      a_N -= gone * (bound_N * a_m / way_m + a_N);
      b_N -= gone * (bound_N * b_m / way_m + b_N);
      clip(limit_N, &a_N, &b_N);
    }
    *patch = {a_N, b_N, peak_N};
  }

 private:
  // 1 - exp(-x)
  static double fade(double x) {
    if (x > 1e-2) return -std::expm1(-x);
    return x * (1.0 - x * (0.5 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x / 120.0))));
  }
  static double clip(double limit_N, double *a_N, double *b_N) {
    const double square = *a_N * *a_N + *b_N * *b_N;
    if (square <= limit_N * limit_N) return std::sqrt(square);
    const double part = limit_N / std::sqrt(square);
    *a_N *= part;
    *b_N *= part;
    return limit_N;
  }

  double per_shear_m_ = 0.0, tick_s_ = 0.0;
};

}  // namespace hoap2_sim
#endif
