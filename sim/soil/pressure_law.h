// Pressure of the ground on one column under a plate: the virgin curve, unloading and
// reloading below the remembered depth, damping (docs/soil.md, "Pressure").
#ifndef HOAP2_SIM_SOIL_PRESSURE_LAW_H
#define HOAP2_SIM_SOIL_PRESSURE_LAW_H

#include "hoap2_plant/plant.h"
#include "soil/height_field.h"
#include "soil/power.h"

namespace hoap2_sim {

// Pressure after the tick = pressure_Pa + resistance_Pas_m * (downward velocity after it).
struct Response {
  double pressure_Pa = 0.0;
  double resistance_Pas_m = 0.0;
};

class PressureLaw {
 public:
  void build(const hoap2_plant_params_t &params);

  // On ground that was never pressed. `share`: what the present direction of motion
  // leaves of it (resistive force theory), 1 for Bekker.
  double virgin_Pa(double depth_m, double share = 1.0) const {
    return depth_m > 0.0 ? share * modulus_ * power_(depth_m) : 0.0;
  }
  double stiffness_Pa_m(double memory_m) const;
  bool depends_on_direction() const { return depends_on_direction_; }

  // A tick that starts at this depth with this downward velocity.
  Response respond(const Cell &cell, double depth_m, double down_m_s, double share) const;
  // The column after it was held at this depth; true if it changed.
  bool press(Cell *cell, double depth_m, double share) const;
  // Loose soil laid on the column, or taken from it (negative); its surface moves by exactly that.
  void lay(Cell *cell, double height_m) const;

 private:
  double approach(const Cell &cell, double reach_m, double down_m_s, double share) const;

  double modulus_ = 0.0, exponent_ = 1.0;
  double unload_Pa_m_ = 0.0, unload_Pa_m2_ = 0.0, damping_Pas_m_ = 0.0;
  bool depends_on_direction_ = false;
  Power power_;
};

}  // namespace hoap2_sim
#endif
