// What the ground gave to each foot in a tick, rigid contacts and soil together.
#ifndef HOAP2_SIM_TRUTH_FOOT_WRENCH_H
#define HOAP2_SIM_TRUTH_FOOT_WRENCH_H

#include "soil/soil.h"
#include "solver/solver.h"
#include "terrain/contact.h"

namespace hoap2_sim {

// Fills next->foot (about the sole points of `before`) and counts the touches of all other links.
// soil: the loads of all links, or NULL on the rigid floor; next holds the velocities after the tick.
void gather_foot_wrenches(const State &before, const ContactList &contacts, const TickSolver &solver,
                          const SoilLoad *soil, State *next);

}  // namespace hoap2_sim
#endif
