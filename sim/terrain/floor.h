// The floor: one plane through the start point, tilted about the world's x and y, with a hole
// where the pool of soil is.
#ifndef HOAP2_SIM_TERRAIN_FLOOR_H
#define HOAP2_SIM_TERRAIN_FLOOR_H

#include "geometry.h"
#include "plant_state.h"

namespace hoap2_sim {

class Floor {
 public:
  explicit Floor(const hoap2_plant_params_t &params)
      : axes_W_(rotation(0, params.floor_tilt_rad[0]) * rotation(1, params.floor_tilt_rad[1])),
        start_W_m_{params.start_pos_W_m[0], params.start_pos_W_m[1], 0.0},
        has_pool_(params.ground == HOAP2_GROUND_SOIL),
        yaw_rad_(params.start_yaw_W_rad),
        pool_centre_m_{params.soil_centre_m[0], params.soil_centre_m[1], 0.0},
        pool_half_m_{0.5 * params.soil_size_m[0], 0.5 * params.soil_size_m[1], 0.0} {}

  const Mat3 &axes_W() const { return axes_W_; }
  const Vec3 &normal_W() const { return axes_W_.cz; }
  const Vec3 &start_point_W_m() const { return start_W_m_; }
  double height_m(const Vec3 &point_W_m) const { return dot(axes_W_.cz, point_W_m - start_W_m_); }
  // The floor has a hole there: the pool of soil, turned with the start's heading.
  bool is_over_pool(const Vec3 &point_W_m) const {
    if (!has_pool_) return false;
    const Vec3 at_m = turn_back(axes_W_ * rotation(2, yaw_rad_), point_W_m - start_W_m_) - pool_centre_m_;
    return std::fabs(at_m.x) < pool_half_m_.x && std::fabs(at_m.y) < pool_half_m_.y;
  }

 private:
  Mat3 axes_W_;
  Vec3 start_W_m_;
  bool has_pool_;
  double yaw_rad_;
  Vec3 pool_centre_m_, pool_half_m_;
};

}  // namespace hoap2_sim
#endif
