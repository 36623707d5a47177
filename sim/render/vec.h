// Small vector algebra of the pictures. Float: everything is drawn relative to a point near the robot.
#ifndef HOAP2_RENDER_VEC_H
#define HOAP2_RENDER_VEC_H

#include <array>
#include <cmath>

namespace hoap2 {

struct Vec3 {
  float x = 0.0F, y = 0.0F, z = 0.0F;
};

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec3 scaled(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float norm(Vec3 a) { return std::sqrt(dot(a, a)); }
inline Vec3 unit(Vec3 a) {
  const float length = norm(a);
  return length > 0.0F ? a * (1.0F / length) : Vec3{0.0F, 0.0F, 1.0F};
}

// 4x4, column-major as OpenGL takes it.
struct Mat4 {
  std::array<float, 16> m{};
  float &at(int row, int column) { return m[static_cast<size_t>(4 * column + row)]; }
  float at(int row, int column) const { return m[static_cast<size_t>(4 * column + row)]; }
};

inline Mat4 operator*(const Mat4 &a, const Mat4 &b) {
  Mat4 c;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      float sum = 0.0F;
      for (int k = 0; k < 4; ++k) sum += a.at(row, k) * b.at(k, column);
      c.at(row, column) = sum;
    }
  }
  return c;
}

inline Mat4 perspective(float fov_y_rad, float aspect, float near_m, float far_m) {
  const float f = 1.0F / std::tan(0.5F * fov_y_rad);
  Mat4 p;
  p.at(0, 0) = f / aspect;
  p.at(1, 1) = f;
  p.at(2, 2) = (far_m + near_m) / (near_m - far_m);
  p.at(2, 3) = 2.0F * far_m * near_m / (near_m - far_m);
  p.at(3, 2) = -1.0F;
  return p;
}

// Cube of half side `half_m` about the view origin.
inline Mat4 orthographic(float half_m, float near_m, float far_m) {
  Mat4 p;
  p.at(0, 0) = 1.0F / half_m;
  p.at(1, 1) = 1.0F / half_m;
  p.at(2, 2) = -2.0F / (far_m - near_m);
  p.at(2, 3) = -(far_m + near_m) / (far_m - near_m);
  p.at(3, 3) = 1.0F;
  return p;
}

inline Mat4 look_at(Vec3 eye, Vec3 target, Vec3 up) {
  const Vec3 f = unit(target - eye);
  const Vec3 s = unit(cross(f, up));
  const Vec3 u = cross(s, f);
  Mat4 v;
  const std::array<Vec3, 3> rows = {s, u, f * -1.0F};
  for (int i = 0; i < 3; ++i) {
    const Vec3 r = rows[static_cast<size_t>(i)];
    v.at(i, 0) = r.x;
    v.at(i, 1) = r.y;
    v.at(i, 2) = r.z;
    v.at(i, 3) = -dot(r, eye);
  }
  v.at(3, 3) = 1.0F;
  return v;
}

}  // namespace hoap2
#endif
