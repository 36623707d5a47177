#include "soil/pressure_law.h"

#include <algorithm>

#include "hoap2/generated/robot_model.h"
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
  if (memory_m > 0.0) return stiffness_Pa_m(memory_m, virgin_Pa(memory_m));
  return std::max(unload_Pa_m_, stiffness_Pa_m(kFirstDepth_m, virgin_Pa(kFirstDepth_m)));
}

// Resistance of a column that the plate does not touch yet but reaches within the tick,
// as a pure damper: without it the first tick of a landing would be free of charge.
double PressureLaw::approach(const Cell &cell, double reach_m, double down_m_s, double share) const {
  const double room_m = cell.memory_m - cell.rut_m;
  double end_Pa = cell.stiffness_Pa_m * reach_m;
  if (cell.memory_m <= 0.0) {
    end_Pa = virgin_Pa(reach_m, share);
  } else if (reach_m > room_m) {
    const double held_Pa = cell.held_Pa();
    end_Pa = held_Pa + exponent_ * held_Pa / cell.memory_m * (reach_m - room_m);
  }
  return (end_Pa + damping_Pas_m_ * reach_m / kTick_s) / down_m_s;
}

void PressureLaw::lay(Cell *cell, double height_m) const {
  const double surface_m = cell->surface_m() + height_m;
  if (height_m > 0.0 && cell->memory_m > 0.0) {  // fills the rut first
    const double left = height_m < cell->rut_m ? (cell->rut_m - height_m) / cell->rut_m : 0.0;
    const double held_Pa = depends_on_direction_ ? left * cell->held_Pa() : virgin_Pa(left * cell->memory_m);
    cell->memory_m *= left;
    cell->stiffness_Pa_m = stiffness_Pa_m(cell->memory_m);
    cell->rut_m = cell->memory_m - held_Pa / cell->stiffness_Pa_m;
  }
  cell->level_m = surface_m + cell->rut_m;
}

}  // namespace hoap2_sim
