// Small vectors, rotations and quaternions (w, x, y, z) for the plant.
#ifndef HOAP2_SIM_GEOMETRY_H
#define HOAP2_SIM_GEOMETRY_H

#include <cmath>

namespace hoap2_sim {

struct Vec3 {
  double x = 0.0, y = 0.0, z = 0.0;
  double operator[](int i) const { return i == 0 ? x : (i == 1 ? y : z); }
};

inline Vec3 vec(const double v[3]) { return {v[0], v[1], v[2]}; }
inline void put(const Vec3 &v, double out[3]) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}
inline Vec3 operator+(const Vec3 &a, const Vec3 &b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3 &a, const Vec3 &b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(double s, const Vec3 &a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Vec3 &a, const Vec3 &b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3 &a, const Vec3 &b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(const Vec3 &a) { return std::sqrt(dot(a, a)); }
inline Vec3 unit_axis(int axis) {
  return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
}

// Columns are the axes of the rotated frame.
struct Mat3 {
  Vec3 cx{1.0, 0.0, 0.0}, cy{0.0, 1.0, 0.0}, cz{0.0, 0.0, 1.0};
  Vec3 column(int i) const { return i == 0 ? cx : (i == 1 ? cy : cz); }
};
inline Vec3 operator*(const Mat3 &m, const Vec3 &v) { return v.x * m.cx + v.y * m.cy + v.z * m.cz; }
inline Mat3 operator*(const Mat3 &a, const Mat3 &b) { return {a * b.cx, a * b.cy, a * b.cz}; }
// m^T v
inline Vec3 turn_back(const Mat3 &m, const Vec3 &v) { return {dot(m.cx, v), dot(m.cy, v), dot(m.cz, v)}; }
inline Mat3 transpose(const Mat3 &m) {
  return {{m.cx.x, m.cy.x, m.cz.x}, {m.cx.y, m.cy.y, m.cz.y}, {m.cx.z, m.cy.z, m.cz.z}};
}

// Rotation about a coordinate axis (0 x, 1 y, 2 z).
inline Mat3 rotation(int axis, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  if (axis == 0) return {{1.0, 0.0, 0.0}, {0.0, c, s}, {0.0, -s, c}};
  if (axis == 1) return {{c, 0.0, -s}, {0.0, 1.0, 0.0}, {s, 0.0, c}};
  return {{c, s, 0.0}, {-s, c, 0.0}, {0.0, 0.0, 1.0}};
}

struct Quat {
  double w = 1.0, x = 0.0, y = 0.0, z = 0.0;
};
inline Quat quat(const double q[4]) { return {q[0], q[1], q[2], q[3]}; }
inline Quat conj(const Quat &q) { return {q.w, -q.x, -q.y, -q.z}; }
inline Quat operator*(const Quat &a, const Quat &b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
inline Quat about_axis(int axis, double angle_rad) {
  const double s = std::sin(0.5 * angle_rad);
  return {std::cos(0.5 * angle_rad), axis == 0 ? s : 0.0, axis == 1 ? s : 0.0, axis == 2 ? s : 0.0};
}
inline Quat normalised(const Quat &q) {
  const double n = 1.0 / std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {n * q.w, n * q.x, n * q.y, n * q.z};
}
inline Mat3 matrix(const Quat &q) {
  const double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
  return {{1.0 - 2.0 * (yy + zz), 2.0 * (q.x * q.y + q.w * q.z), 2.0 * (q.x * q.z - q.w * q.y)},
          {2.0 * (q.x * q.y - q.w * q.z), 1.0 - 2.0 * (xx + zz), 2.0 * (q.y * q.z + q.w * q.x)},
          {2.0 * (q.x * q.z + q.w * q.y), 2.0 * (q.y * q.z - q.w * q.x), 1.0 - 2.0 * (xx + yy)}};
}

// Quaternion of a rotation matrix, largest component first (no division by a small number).
inline Quat quat_of(const Mat3 &m) {
  const double t[4] = {m.cx.x + m.cy.y + m.cz.z, m.cx.x - m.cy.y - m.cz.z, m.cy.y - m.cx.x - m.cz.z,
                       m.cz.z - m.cx.x - m.cy.y};
  int k = 0;
  for (int i = 1; i < 4; ++i) {
    if (t[i] > t[k]) k = i;
  }
  const double r = std::sqrt(1.0 + t[k]);
  const double s = 0.5 / r;
  const double dx = s * (m.cy.z - m.cz.y), dy = s * (m.cz.x - m.cx.z), dz = s * (m.cx.y - m.cy.x);
  const double xy = s * (m.cx.y + m.cy.x), xz = s * (m.cx.z + m.cz.x), yz = s * (m.cy.z + m.cz.y);
  if (k == 0) return {0.5 * r, dx, dy, dz};
  if (k == 1) return {dx, 0.5 * r, xy, xz};
  if (k == 2) return {dy, xy, 0.5 * r, yz};
  return {dz, xz, yz, 0.5 * r};
}

}  // namespace hoap2_sim
#endif
