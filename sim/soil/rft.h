// Resistive force theory: stress per metre of depth on a small plate in dry granular
// ground, by its tilt and its direction of motion (docs/soil.md, "Resistive force theory").
#ifndef HOAP2_SIM_SOIL_RFT_H
#define HOAP2_SIM_SOIL_RFT_H

#include "geometry.h"

namespace hoap2_sim {

// Generic vertical stress of a level plate that moves straight down: 1 N/cm3.
constexpr double kRftVertical_N_m3 = 1e6;

// In units of kRftVertical_N_m3, against the motion: up, and backward along the ground.
struct RftStress {
  double vertical, horizontal;
};
// tilt_rad > 0: the face that meets the ground leans forward. dive_rad: of the velocity
// below the horizontal.
RftStress rft_stress(double tilt_rad, double dive_rad);

// The same on a face: normal to it, and the limit of the shear in it per normal stress.
struct RftShare {
  double normal = 1.0, shear_ratio = 0.0;
};
// up: unit vector out of the ground normal to the face, up.z > 0; velocity of the patch, z up.
RftShare rft_share(const Vec3 &up, const Vec3 &velocity_m_s);

}  // namespace hoap2_sim
#endif
