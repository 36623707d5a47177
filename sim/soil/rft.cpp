#include "soil/rft.h"

#include <algorithm>
#include <cmath>

namespace hoap2_sim {
namespace {

// Generic coefficients (N/cm3): C. Li, T. Zhang, D. I. Goldman, "A terradynamics of legged
// locomotion on granular media", Science 339 (2013), supplement.
constexpr double kA00 = 0.206, kA10 = 0.169, kB11 = 0.212, kB01 = 0.358, kB11n = 0.055;
constexpr double kC11 = -0.124, kC01 = 0.253, kC11n = 0.007, kD10 = 0.088;
// Below this speed the direction of motion fades to straight down.
constexpr double kSlow_m_s = 1e-3;
constexpr double kLeastNormal = 0.05;

struct Turn {
  double cos, sin;
};

RftStress stress(const Turn &tilt, const Turn &dive) {
  const double c2 = tilt.cos * tilt.cos - tilt.sin * tilt.sin, s2 = 2.0 * tilt.sin * tilt.cos;
  const double c = dive.cos, s = dive.sin;
  const double vertical = kA00 + kA10 * c2 + kB11 * (s2 * c + c2 * s) + kB01 * s + kB11n * (c2 * s - s2 * c);
  const double horizontal = kC11 * (c2 * c - s2 * s) + kC01 * c + kC11n * (c2 * c + s2 * s) + kD10 * s2;
  return {vertical, horizontal};
}

}  // namespace

RftStress rft_stress(double tilt_rad, double dive_rad) {
  return stress({std::cos(tilt_rad), std::sin(tilt_rad)}, {std::cos(dive_rad), std::sin(dive_rad)});
}

RftShare rft_share(const Vec3 &up, const Vec3 &velocity_m_s) {
  // Forward along the ground; for a patch at rest the way the face leans.
  double forward_x = velocity_m_s.x - kSlow_m_s * up.x, forward_y = velocity_m_s.y - kSlow_m_s * up.y;
  const double length = std::sqrt(forward_x * forward_x + forward_y * forward_y);
  forward_x = length > 0.0 ? forward_x / length : 1.0;
  forward_y = length > 0.0 ? forward_y / length : 0.0;

  const double lean = -(up.x * forward_x + up.y * forward_y);
  const double scale = 1.0 / std::sqrt(lean * lean + up.z * up.z);
  const Turn tilt = {scale * up.z, scale * lean};

  const double ahead_m_s = velocity_m_s.x * forward_x + velocity_m_s.y * forward_y;
  const double down_m_s = std::sqrt(velocity_m_s.z * velocity_m_s.z + kSlow_m_s * kSlow_m_s);
  const double speed = std::sqrt(ahead_m_s * ahead_m_s + down_m_s * down_m_s);
  const RftStress found = stress(tilt, {ahead_m_s / speed, down_m_s / speed});

  const double normal = std::max(0.0, found.vertical * tilt.cos + found.horizontal * tilt.sin);
  const double along = std::max(0.0, found.horizontal * tilt.cos - found.vertical * tilt.sin);
  return {normal, along / std::max(normal, kLeastNormal)};
}

}  // namespace hoap2_sim
