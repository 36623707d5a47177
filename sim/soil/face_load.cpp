#include "soil/face_load.h"

namespace hoap2_sim {

void FaceLoad::find(const Face &face, const Mat3 &link_axes_W, SpatialVector *wrench_W,
                    SpatialInertia *slope_W) const {
  // About the face's centre, in the face's axes.
  const Vector3 force(along_a_, along_b_, force_), torque(force_v_, -force_u_, turn_);
  SpatialInertia slope;
  slope.angular << slope_vv_, -slope_uv_, 0.0, -slope_uv_, slope_uu_, 0.0, 0.0, 0.0, turn_turn_;
  slope.coupling << 0.0, 0.0, slope_v_, 0.0, 0.0, -slope_u_, a_turn_, b_turn_, 0.0;
  slope.linear << aa_, ab_, 0.0, ab_, bb_, 0.0, 0.0, 0.0, slope_;
  // About the CoM.
  const Vector3 arm(dot(face.a_L, face.arm_L_m), dot(face.b_L, face.arm_L_m), dot(face.m_L, face.arm_L_m));
  const SpatialInertia about_com = slope.shifted(arm);
  // World axes.
  Matrix3 axes;
  axes.col(0) = eigen(link_axes_W * face.a_L);
  axes.col(1) = eigen(link_axes_W * face.b_L);
  axes.col(2) = eigen(link_axes_W * face.m_L);
  wrench_W->linear = axes * force;
  wrench_W->angular = axes * (torque + arm.cross(force));
  slope_W->angular = axes * about_com.angular * axes.transpose();
  slope_W->coupling = axes * about_com.coupling * axes.transpose();
  slope_W->linear = axes * about_com.linear * axes.transpose();
}

}  // namespace hoap2_sim
