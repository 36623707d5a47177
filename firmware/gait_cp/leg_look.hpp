// A look ahead at the legs: can they do a swing of the step under way?
//
// Coarse: the CoM follows (7.13) with one CoP held, and its place in the pelvis is that of now, but for
// what legs that trail or lead move it.
#ifndef HOAP2_GAIT_CP_LEG_LOOK_HPP
#define HOAP2_GAIT_CP_LEG_LOOK_HPP

#include "gait_cp/gait_state.h"

namespace hoap2 {

// What a look assumes, and what it must leave over for being coarse.
struct Look {
  double cop_m[2];        // held over the whole step, O
  double mean_shift[2];   // both feet on average farther ahead under the CoM than now, O
  double reach_m;         // to spare of a leg's reach
  double rate_tolerance;  // joint rate against the limit
};

// From one footprint to another.
struct Swing {
  double from[3];
  double to[3];
};

// Parts of a step at which its swing is hardest: the knee is straightest at lift-off and after touchdown,
// bends fastest after a quarter and stretches fastest after three quarters of the swing.
struct SwingParts {
  double lifts;
  double bends;
  double stretches;
};

SwingParts swing_parts(const hoap2_params_t& params);

// CoM of the plan at a part of the step under way, in O.
void com_at(const hoap2_gait_t& gait, const double cop_m[2], double part, double com_m[2]);

// Joint angles of a leg with its sole at pose (x, y, z in m, yaw in rad; O) at a part of the step under way;
// false when the leg is too short or meets a joint limit.
bool leg_at(const hoap2_params_t& params, const hoap2_gait_t& gait, const Look& look, int foot,
            const double pose[4], double part, double q_rad[6]);

// The same for the swing leg.
bool swing_leg(const hoap2_params_t& params, const hoap2_gait_t& gait, const Look& look, const Swing& swing,
               double part, double q_rad[6]);

// The same, and the joint rates there within the tolerance.
bool swing_leg_in_time(const hoap2_params_t& params, const hoap2_gait_t& gait, const Look& look,
                       const Swing& swing, double part);

}  // namespace hoap2
#endif
