// What the tick asks of a solver: the velocities and poses of all bodies after one tick
// of the plant's discrete equations. Two classes answer: ArticulatedSolver and OdeSolver.
#ifndef HOAP2_SIM_SOLVER_SOLVER_H
#define HOAP2_SIM_SOLVER_SOLVER_H

#include "geometry.h"
#include "plant_state.h"
#include "terrain/contact.h"

namespace hoap2_sim {

// Row of a joint: torque on the link = stiffness_Nms_rad * (target_rad_s - rate after the tick).
struct MotorRow {
  double stiffness_Nms_rad;
  double target_rad_s;
};

// Applied to a link during the tick, besides gravity, joints and contacts.
struct LinkLoad {
  Vec3 force_W_N, torque_com_W_Nm;
};

// A tick's problem without the motor rows. The pointers must outlive finish().
struct SoilLoad;

struct TickProblem {
  const State *state = nullptr;  // before the tick
  const Mat3 *axes_W = nullptr;  // of each link, from the state's quaternions
  const LinkLoad *load = nullptr;
  const ContactList *contacts = nullptr;
  const SoilLoad *soil = nullptr;  // of each link, or none
};

// Contact of a point with the ground as a spring and a damper, solved implicitly:
//   normal force = max(0, (target_m_s - v_n) / compliance_m_Ns),  v_n after the tick,
// with target = h k / (h k + d) depth / h and compliance = 1 / (h k + d).
struct ContactRow {
  double erp;
  double compliance_m_Ns;
};
ContactRow contact_row(const hoap2_plant_params_t &params);

// Creep of a loaded contact along the ground, per newton: regularises the friction
// rows of a flat sole, which are redundant otherwise.
constexpr double kContactSlip_m_Ns = 1e-6;
// Share of a hinge's error that its rows take back in a tick.
constexpr double kHingeErp = 0.2;

class TickSolver {
 public:
  TickSolver() = default;
  virtual ~TickSolver() = default;
  TickSolver(const TickSolver &) = delete;
  TickSolver &operator=(const TickSolver &) = delete;

  // Forgets a world that an OdeFailure left half-way. Its memory is lost on purpose:
  // freeing it could run into the same failure.
  virtual void abandon() = 0;

  virtual void begin(const TickProblem &problem) = 0;
  // Velocities after the tick with these motor rows; may be called again with others.
  // Gives the rate of each joint along the axis of the tick's start.
  virtual void solve(const MotorRow row[HOAP2_JOINTS], double rate_rad_s[HOAP2_JOINTS]) = 0;
  // Poses and velocities after the tick, from the last solve().
  virtual void finish(State *next) = 0;
  // Force of contact i on its link, and moment about the link's CoM (last solve).
  virtual void contact_load(int i, double force_W_N[3], double moment_com_W_Nm[3]) const = 0;
};

}  // namespace hoap2_sim
#endif
