#include "soil/pressure_law.h"

#include <algorithm>

#include "hoap2/generated/robot_model.h"
#include "plant_state.h"
#include "soil/rft.h"

namespace hoap2_sim {
namespace {

// Depth whose stiffness stands for ground that was never pressed: its true one is 0 or infinite.
constexpr double kFirstDepth_m = 1e-4;

}  // namespace

void PressureLaw::build(const hoap2_plant_params_t &params) {
  depends_on_direction_ = params.soil_law == HOAP2_SOIL_LAW_RFT;
  if (depends_on_direction_) {
    modulus_ = params.soil_rft_zeta * kRftVertical_N_m3;
    exponent_ = 1.0;
  } else {
    modulus_ = params.soil_kc_N_m_n1 / (2.0 * HOAP2_SOLE_HALF_WIDTH_M) + params.soil_kphi_N_m_n2;
    exponent_ = params.soil_n;
  }
  power_.build(exponent_);
  unload_Pa_m_ = params.soil_unload_Pa_m;
  unload_Pa_m2_ = params.soil_unload_Pa_m2;
  damping_Pas_m_ = params.soil_damping_Pas_m;
}

// Never softer than the virgin tangent, nor than the virgin secant (n < 1): so the
// unloaded surface is not above the level and unloading returns less than was put in.
double PressureLaw::stiffness_Pa_m(double memory_m) const {
  const double depth_m = memory_m > 0.0 ? memory_m : kFirstDepth_m;
  return std::max(unload_Pa_m_ + unload_Pa_m2_ * memory_m,
                  std::max(1.0, exponent_) * virgin_Pa(depth_m) / depth_m);
}

// Resistance of a column that the plate does not touch yet but reaches within the tick,
// as a pure damper: without it the first tick of a landing would be free of charge.
double PressureLaw::approach(const Cell &cell, double reach_m, double down_m_s, double share) const {
  const double room_m = cell.rebound_m();
  double end_Pa = cell.stiffness_Pa_m * reach_m;
  if (cell.memory_m <= 0.0) {
    end_Pa = virgin_Pa(reach_m, share);
  } else if (reach_m > room_m) {
    const double tangent_Pa_m = exponent_ * cell.pressure_Pa / cell.memory_m;
    end_Pa = cell.pressure_Pa + tangent_Pa_m * (reach_m - room_m);
  }
  return (end_Pa + damping_Pas_m_ * reach_m / kTick_s) / down_m_s;
}

Response PressureLaw::respond(const Cell &cell, double depth_m, double down_m_s, double share) const {
  const double elastic_Pa = cell.pressure_Pa - cell.stiffness_Pa_m * (cell.memory_m - depth_m);
  const double step_m = kTick_s * down_m_s;
  if (elastic_Pa <= 0.0) {
    if (elastic_Pa + cell.stiffness_Pa_m * step_m <= 0.0) return {};
    return {0.0, approach(cell, step_m + elastic_Pa / cell.stiffness_Pa_m, down_m_s, share)};
  }
  Response answer;
  answer.pressure_Pa = elastic_Pa;
  if (depends_on_direction_) {
    answer.pressure_Pa = std::min(elastic_Pa, virgin_Pa(depth_m, share));
  } else if (depth_m > cell.memory_m) {
    answer.pressure_Pa = virgin_Pa(depth_m);
  }
  if (down_m_s > 0.0) {
    const double room_m = cell.memory_m - depth_m;
    if (step_m <= room_m) {
      answer.resistance_Pas_m = kTick_s * cell.stiffness_Pa_m + damping_Pas_m_;
      return answer;
    }
    const double tangent_Pa_m =
        depends_on_direction_ ? share * modulus_ : exponent_ * answer.pressure_Pa / depth_m;
    double slope_Pas_m = kTick_s * tangent_Pa_m;
    if (room_m > 0.0) slope_Pas_m += (cell.stiffness_Pa_m - tangent_Pa_m) * room_m / down_m_s;
    answer.resistance_Pas_m = slope_Pas_m + damping_Pas_m_;
    return answer;
  }
  // On the way up the ground does not pull: first the damping goes, then the slope is
  // what brings the pressure to zero within the tick.
  const double slope_Pas_m = kTick_s * cell.stiffness_Pa_m;
  answer.resistance_Pas_m = slope_Pas_m + damping_Pas_m_;
  if (-answer.resistance_Pas_m * down_m_s > answer.pressure_Pa) {
    answer.resistance_Pas_m = std::min(slope_Pas_m, -answer.pressure_Pa / down_m_s);
  }
  return answer;
}

bool PressureLaw::press(Cell *cell, double depth_m, double share) const {
  if (!depends_on_direction_) {
    if (!(depth_m > cell->memory_m)) return false;
    cell->memory_m = depth_m;
    cell->pressure_Pa = virgin_Pa(depth_m);
    cell->stiffness_Pa_m = stiffness_Pa_m(depth_m);
    return true;
  }
  // An elastic column whose limit moves with the direction of motion.
  const double elastic_Pa = cell->pressure_Pa - cell->stiffness_Pa_m * (cell->memory_m - depth_m);
  const double limit_Pa = virgin_Pa(depth_m, share);
  if (depth_m > cell->memory_m) {
    cell->memory_m = depth_m;
    cell->pressure_Pa = std::min(elastic_Pa, limit_Pa);
    cell->stiffness_Pa_m = stiffness_Pa_m(depth_m);
    return true;
  }
  if (elastic_Pa <= limit_Pa || elastic_Pa <= 0.0) return false;
  cell->pressure_Pa -= elastic_Pa - limit_Pa;
  return true;
}

void PressureLaw::lay(Cell *cell, double height_m) const {
  const double surface_m = cell->surface_m() + height_m;
  if (height_m > 0.0 && cell->memory_m > 0.0) {  // fills the rut first
    const double rut_m = cell->memory_m - cell->rebound_m();
    const double left = height_m < rut_m ? (rut_m - height_m) / rut_m : 0.0;
    cell->memory_m *= left;
    cell->pressure_Pa = depends_on_direction_ ? left * cell->pressure_Pa : virgin_Pa(cell->memory_m);
    cell->stiffness_Pa_m = stiffness_Pa_m(cell->memory_m);
  }
  cell->level_m = surface_m + cell->memory_m - cell->rebound_m();
}

}  // namespace hoap2_sim
