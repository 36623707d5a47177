// Pressure of the ground on one column under a plate: the virgin curve, unloading and
// reloading below the remembered depth, damping (docs/soil.md, "Pressure").
#ifndef HOAP2_SIM_SOIL_PRESSURE_LAW_H
#define HOAP2_SIM_SOIL_PRESSURE_LAW_H

#include <algorithm>

#include "hoap2_plant/plant.h"
#include "plant_state.h"
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

  // Pressure if the column only unloads and reloads; 0 and less: not touched.
  static double elastic_Pa(const Cell &cell, double depth_m) {
    return cell.stiffness_Pa_m * (depth_m - cell.rut_m);
  }
  // Whether the column gives way for good at this depth.
  bool yields(const Cell &cell, double depth_m, double share) const {
    if (!depends_on_direction_) return depth_m > cell.memory_m;
    const double elastic = elastic_Pa(cell, depth_m);
    return elastic > 0.0 && (depth_m > cell.memory_m || elastic > virgin_Pa(depth_m, share));
  }
  // The column after it was held at a depth at which it yields.
  Cell pressed(const Cell &cell, double depth_m, double share) const {
    const double virgin = virgin_Pa(depth_m);
    double held_Pa = virgin;
    // With a limit that moves with the direction of motion the way there can be elastic.
    if (depends_on_direction_) held_Pa = std::min(elastic_Pa(cell, depth_m), share * virgin);
    const bool deeper = depth_m > cell.memory_m;
    const double stiffness = deeper ? stiffness_Pa_m(depth_m, virgin) : cell.stiffness_Pa_m;
    return {cell.level_m, deeper ? depth_m : cell.memory_m, depth_m - held_Pa / stiffness, stiffness};
  }

  // A tick that starts at this depth with this downward velocity, on a column that
  // does not yield there any more.
  Response respond(const Cell &cell, double depth_m, double down_m_s, double share) const {
    const double elastic = elastic_Pa(cell, depth_m), step_m = kTick_s * down_m_s;
    if (elastic > 0.0) return hold(cell, depth_m, elastic, down_m_s, share);
    if (elastic + cell.stiffness_Pa_m * step_m <= 0.0) return {};
    return {0.0, approach(cell, step_m + elastic / cell.stiffness_Pa_m, down_m_s, share)};
  }

  // Loose soil laid on the column, or taken from it (negative); its surface moves by exactly that.
  void lay(Cell *cell, double height_m) const;

 private:
  // With the virgin pressure at that memory known.
  double stiffness_Pa_m(double memory_m, double virgin) const {
    return std::max(unload_Pa_m_ + unload_Pa_m2_ * memory_m, std::max(1.0, exponent_) * virgin / memory_m);
  }
  // Of a limit that the pressure was brought to: rounding must not hide that.
  static constexpr double kAtYield = 1.0 - 1e-9;

  Response hold(const Cell &cell, double depth_m, double elastic, double down_m_s, double share) const;
  double approach(const Cell &cell, double reach_m, double down_m_s, double share) const;

  double modulus_ = 0.0, exponent_ = 1.0;
  double unload_Pa_m_ = 0.0, unload_Pa_m2_ = 0.0, damping_Pas_m_ = 0.0;
  bool depends_on_direction_ = false;
  Power power_;
};

inline Response PressureLaw::hold(const Cell &cell, double depth_m, double elastic, double down_m_s,
                                  double share) const {
  const double stiff_Pas_m = kTick_s * cell.stiffness_Pa_m;
  if (down_m_s <= 0.0) {
    // The ground does not pull: first the damping goes, then the slope is what brings the
    // pressure to zero within the tick.
    if (-(stiff_Pas_m + damping_Pas_m_) * down_m_s <= elastic) return {elastic, stiff_Pas_m + damping_Pas_m_};
    return {elastic, std::min(stiff_Pas_m, -elastic / down_m_s)};
  }
  const bool at_yield = depends_on_direction_ && elastic >= kAtYield * virgin_Pa(depth_m, share);
  const double room_m = at_yield ? 0.0 : cell.memory_m - depth_m;
  if (kTick_s * down_m_s <= room_m) return {elastic, stiff_Pas_m + damping_Pas_m_};
  // Elastic until the remembered depth, then along the virgin curve.
  const double tangent_Pa_m = depends_on_direction_ ? share * modulus_ : exponent_ * elastic / depth_m;
  double slope_Pas_m = kTick_s * tangent_Pa_m;
  if (room_m > 0.0) slope_Pas_m += (cell.stiffness_Pa_m - tangent_Pa_m) * room_m / down_m_s;
  return {elastic, slope_Pas_m + damping_Pas_m_};
}

}  // namespace hoap2_sim
#endif
