#include "robot/rotation.hpp"

namespace hoap2 {

namespace {
constexpr double kPi = 3.14159265358979323846;
}

Mat3 rot_x(double angle_rad) {
  const double c = hoap2_cos(angle_rad);
  const double s = hoap2_sin(angle_rad);
  Mat3 R;
  R << 1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c;
  return R;
}

Mat3 rot_y(double angle_rad) {
  const double c = hoap2_cos(angle_rad);
  const double s = hoap2_sin(angle_rad);
  Mat3 R;
  R << c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c;
  return R;
}

Mat3 rot_z(double angle_rad) {
  const double c = hoap2_cos(angle_rad);
  const double s = hoap2_sin(angle_rad);
  Mat3 R;
  R << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return R;
}

Mat3 skew(const Vec3& a) {
  Mat3 S;
  S << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return S;
}

Mat3 matrix_from_rpy(const Vec3& rpy_rad) {
  const double cr = hoap2_cos(rpy_rad.x());
  const double sr = hoap2_sin(rpy_rad.x());
  const double cp = hoap2_cos(rpy_rad.y());
  const double sp = hoap2_sin(rpy_rad.y());
  const double cy = hoap2_cos(rpy_rad.z());
  const double sy = hoap2_sin(rpy_rad.z());
  Mat3 R;
  R << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,   //
      -sp, cp * sr, cp * cr;
  return R;
}

Vec3 rpy_from_matrix(const Mat3& R) {
  const double cos_pitch = hoap2_hypot(R(0, 0), R(1, 0));
  const double pitch = hoap2_atan2(-R(2, 0), cos_pitch);
  if (cos_pitch < 1e-9) {
    return Vec3(0.0, pitch, hoap2_atan2(-R(0, 1), R(1, 1)));
  }
  return Vec3(hoap2_atan2(R(2, 1), R(2, 2)), pitch, hoap2_atan2(R(1, 0), R(0, 0)));
}

Mat3 matrix_from_quat(const Vec4& quat_wxyz) {
  const double length2 = quat_wxyz.squaredNorm();
  if (!(length2 > 0.0)) {
    return Mat3::Identity();
  }
  const double scale = 2.0 / length2;
  const double w = quat_wxyz(0);
  const double x = quat_wxyz(1);
  const double y = quat_wxyz(2);
  const double z = quat_wxyz(3);
  Mat3 R;
  R << 1.0 - scale * (y * y + z * z), scale * (x * y - w * z), scale * (x * z + w * y),  //
      scale * (x * y + w * z), 1.0 - scale * (x * x + z * z), scale * (y * z - w * x),   //
      scale * (x * z - w * y), scale * (y * z + w * x), 1.0 - scale * (x * x + y * y);
  return R;
}

// The component that is largest is found from the diagonal, so no division by a small number occurs.
Vec4 quat_from_matrix(const Mat3& R) {
  const double trace = R(0, 0) + R(1, 1) + R(2, 2);
  Vec4 quat;
  if (trace >= R(0, 0) && trace >= R(1, 1) && trace >= R(2, 2)) {
    quat << 1.0 + trace, R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1);
  } else if (R(0, 0) >= R(1, 1) && R(0, 0) >= R(2, 2)) {
    quat << R(2, 1) - R(1, 2), 1.0 + R(0, 0) - R(1, 1) - R(2, 2), R(0, 1) + R(1, 0), R(0, 2) + R(2, 0);
  } else if (R(1, 1) >= R(2, 2)) {
    quat << R(0, 2) - R(2, 0), R(0, 1) + R(1, 0), 1.0 - R(0, 0) + R(1, 1) - R(2, 2), R(1, 2) + R(2, 1);
  } else {
    quat << R(1, 0) - R(0, 1), R(0, 2) + R(2, 0), R(1, 2) + R(2, 1), 1.0 - R(0, 0) - R(1, 1) + R(2, 2);
  }
  const double length = hoap2_sqrt(quat.squaredNorm());
  const double sign = quat(0) < 0.0 ? -1.0 : 1.0;
  return quat * (sign / length);
}

double wrap_angle(double angle_rad) {
  if (angle_rad > -kPi && angle_rad <= kPi) {
    return angle_rad;
  }
  return hoap2_atan2(hoap2_sin(angle_rad), hoap2_cos(angle_rad));
}

}  // namespace hoap2
