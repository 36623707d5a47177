// The four force cells of a foot: a rigid plate on four equal springs.
#ifndef HOAP2_SIM_SENSORS_CELLS_H
#define HOAP2_SIM_SENSORS_CELLS_H

namespace hoap2_sim {

// Spring forces for a normal force and its centre of pressure in the foot frame.
// The CoP is clamped to the rectangle of the cells; springs only push.
void plate_on_springs(double force_N, double cop_x_L_m, double cop_y_L_m, double cell_N[4]);

}  // namespace hoap2_sim
#endif
