// The floor: one plane through the start point, tilted about the world's x and y.
#ifndef HOAP2_SIM_TERRAIN_FLOOR_H
#define HOAP2_SIM_TERRAIN_FLOOR_H

#include "geometry.h"
#include "plant_state.h"

namespace hoap2_sim {

class Floor {
 public:
  explicit Floor(const hoap2_plant_params_t &params)
      : axes_W_(rotation(0, params.floor_tilt_rad[0]) * rotation(1, params.floor_tilt_rad[1])),
        start_W_m_{params.start_pos_W_m[0], params.start_pos_W_m[1], 0.0} {}

  const Mat3 &axes_W() const { return axes_W_; }
  const Vec3 &normal_W() const { return axes_W_.cz; }
  const Vec3 &start_point_W_m() const { return start_W_m_; }
  double height_m(const Vec3 &point_W_m) const { return dot(axes_W_.cz, point_W_m - start_W_m_); }

 private:
  Mat3 axes_W_;
  Vec3 start_W_m_;
};

}  // namespace hoap2_sim
#endif
