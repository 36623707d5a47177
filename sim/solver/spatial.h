// Spatial vectors and inertias about a point, in world axes: motion (omega, velocity of the
// point), impulse (moment about the point, force part).
#ifndef HOAP2_SIM_SOLVER_SPATIAL_H
#define HOAP2_SIM_SOLVER_SPATIAL_H

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "geometry.h"

namespace hoap2_sim {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

inline Vector3 eigen(const Vec3 &v) { return {v.x, v.y, v.z}; }
inline Vector3 eigen(const double v[3]) { return {v[0], v[1], v[2]}; }
inline Vec3 plain(const Vector3 &v) { return {v.x(), v.y(), v.z()}; }

struct SpatialVector {
  Vector3 angular, linear;
};

// [r] m, column by column.
inline Matrix3 cross_left(const Vector3 &r, const Matrix3 &m) {
  Matrix3 out;
  for (int k = 0; k < 3; ++k) {
    out(0, k) = r[1] * m(2, k) - r[2] * m(1, k);
    out(1, k) = r[2] * m(0, k) - r[0] * m(2, k);
    out(2, k) = r[0] * m(1, k) - r[1] * m(0, k);
  }
  return out;
}

// m [r], row by row.
inline Matrix3 cross_right(const Matrix3 &m, const Vector3 &r) {
  Matrix3 out;
  for (int k = 0; k < 3; ++k) {
    out(k, 0) = m(k, 1) * r[2] - m(k, 2) * r[1];
    out(k, 1) = m(k, 2) * r[0] - m(k, 0) * r[2];
    out(k, 2) = m(k, 0) * r[1] - m(k, 1) * r[0];
  }
  return out;
}

// Symmetric 6x6 in blocks: [angular, coupling; coupling^T, linear]. The impulse of a
// motion (w, v) is (angular w + coupling v, coupling^T w + linear v).
struct SpatialInertia {
  Matrix3 angular, coupling, linear;

  SpatialInertia &operator+=(const SpatialInertia &other) {
    angular += other.angular;
    coupling += other.coupling;
    linear += other.linear;
    return *this;
  }

  SpatialVector operator*(const SpatialVector &v) const {
    return {angular * v.angular + coupling * v.linear, coupling.transpose() * v.angular + linear * v.linear};
  }

  // The same inertia about the point at -r, fixed in the same body.
  SpatialInertia shifted(const Vector3 &r) const {
    SpatialInertia out;
    out.linear = linear;
    out.coupling = coupling + cross_left(r, linear);
    out.angular = angular - cross_right(out.coupling, r) - cross_right(coupling, r).transpose();
    return out;
  }

  // Adds k at a point that lies at `arm` from the reference point: impulse k times its velocity.
  void add_at(const Vector3 &arm, const Matrix3 &k) {
    const Matrix3 arm_k = cross_left(arm, k);
    linear += k;
    coupling += arm_k;
    angular -= cross_right(arm_k, arm);
  }
};

inline SpatialVector &operator+=(SpatialVector &a, const SpatialVector &b) {
  a.angular += b.angular;
  a.linear += b.linear;
  return a;
}

}  // namespace hoap2_sim
#endif
