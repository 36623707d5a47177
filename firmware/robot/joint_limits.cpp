#include "robot/joint_limits.hpp"

namespace hoap2 {

double clip_joint(int joint, double q_rad, bool& clipped) {
  const double lower_rad = HOAP2_JOINT[joint].limit_soft_rad[0];
  const double upper_rad = HOAP2_JOINT[joint].limit_soft_rad[1];
  // Written so that NaN fails both comparisons and is caught.
  if (!(q_rad >= lower_rad - kLimitTolerance_rad) || !(q_rad <= upper_rad + kLimitTolerance_rad)) {
    clipped = true;
  }
  if (!(q_rad >= lower_rad)) {
    return lower_rad;
  }
  return q_rad <= upper_rad ? q_rad : upper_rad;
}

int32_t clip_to_soft_limits(double q_rad[HOAP2_JOINTS]) {
  int32_t mask = 0;
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    bool clipped = false;
    q_rad[j] = clip_joint(j, q_rad[j], clipped);
    if (clipped) {
      mask |= (int32_t)1 << j;
    }
  }
  return mask;
}

}  // namespace hoap2
