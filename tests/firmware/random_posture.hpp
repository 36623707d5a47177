// Random joint angles and poses for the property tests; the seed makes every run the same.
#ifndef HOAP2_TESTS_RANDOM_POSTURE_HPP
#define HOAP2_TESTS_RANDOM_POSTURE_HPP

#include <array>
#include <random>

#include "robot/kinematics.hpp"

namespace hoap2_tests {

using JointAngles = std::array<double, HOAP2_JOINTS>;

class RandomPosture {
 public:
  explicit RandomPosture(unsigned seed) : engine_(seed) {}

  double uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(engine_);
  }

  // Anywhere within the soft limits.
  JointAngles joints() {
    JointAngles q_rad;
    for (size_t j = 0; j < q_rad.size(); ++j) {
      q_rad[j] = uniform(HOAP2_JOINT[j].limit_soft_rad[0], HOAP2_JOINT[j].limit_soft_rad[1]);
    }
    return q_rad;
  }

  hoap2::Vec3 vector(double size) {
    const double x = uniform(-size, size);
    const double y = uniform(-size, size);
    const double z = uniform(-size, size);
    return hoap2::Vec3(x, y, z);
  }

  hoap2::Mat3 rotation() {
    hoap2::Vec4 quat;
    for (int i = 0; i < 4; ++i) {
      quat(i) = std::normal_distribution<double>()(engine_);
    }
    return hoap2::matrix_from_quat(quat);
  }

  hoap2::Pose pose(double size) {
    hoap2::Pose pose;
    pose.R = rotation();
    pose.p = vector(size);
    return pose;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace hoap2_tests
#endif
