// The robot's tree for one tick: eliminates the joints from the leaves to the pelvis and
// gives the velocities back from the pelvis to the leaves, in O(links). The equations are
// those of docs/solver.md: rigid bodies, hinge rows with their error feedback, motor rows,
// and any linear law impulse = a - K velocity at points of links.
#ifndef HOAP2_SIM_SOLVER_BODY_TREE_H
#define HOAP2_SIM_SOLVER_BODY_TREE_H

#include "solver/solver.h"
#include "solver/spatial.h"

namespace hoap2_sim {

class BodyTree {
 public:
  // Where the hinges sit; depends on the parameters alone.
  void build(const hoap2_plant_params_t &params);
  // Inertias, momenta and hinge errors of this tick. `touched`: links that points act on.
  void begin(const TickProblem &problem, const bool touched[HOAP2_LINKS]);
  // Takes the motor rows and eliminates all links that carry no touched link.
  void set_motors(const MotorRow row[HOAP2_JOINTS]);

  // Removes all point laws, keeps what set_motors() prepared.
  void clear_points();
  // Impulse `impulse_Ns - k velocity` at a point of a touched link, `arm` from its reference point.
  void add_point(int link, const Vector3 &arm_W_m, const Matrix3 &k_W_Ns2_m, const Vector3 &impulse_W_Ns);
  // Velocities of the touched links and of the links that carry them.
  void solve_touched();
  // Velocities of all other links.
  void solve_rest();

  // Reference point of a link: its hinge's anchor (pelvis: its CoM).
  const Vector3 &reference_W_m(int link) const { return link_[link].reference_W_m; }
  // Motion of a link after the tick, about its reference point.
  const SpatialVector &motion(int link) const { return link_[link].motion; }
  double rate_rad_s(int link) const { return link_[link].rate_rad_s; }
  Vector3 com_velocity_W_m_s(int link) const;

 private:
  struct Link {
    // of the tick
    Vector3 reference_W_m, com_arm_W_m;  // reference point to CoM
    Vector3 from_parent_W_m;             // parent's reference point to the hinge's anchor in the parent
    Vector3 axis_W;
    SpatialVector bias;  // velocity that takes the hinge's error back
    SpatialInertia own_inertia;
    SpatialVector own_momentum;
    bool shifted, carries;  // anchor away from the parent's reference point; carries a touched link
    // of the motor rows
    double motor_Ns, target_rad_s;
    SpatialInertia base_inertia;
    SpatialVector base_momentum;
    // of the sweep
    SpatialInertia inertia;
    SpatialVector momentum;
    SpatialVector reaction;  // articulated inertia times the hinge's axis
    double pivot_inverse, free_rate;
    SpatialVector motion;
    double rate_rad_s;
  };
  struct Anchors {
    Vector3 child_com_L_m;  // reference point to CoM, link frame
    Vector3 in_parent_L_m;  // parent's reference point to the anchor, parent frame
  };

  void begin_link(const TickProblem &problem, int i);
  void add_soil(const SoilLoad &soil, Link *link);
  void begin_hinge(const TickProblem &problem, int i);
  void eliminate(Link *link, SpatialInertia *inertia, SpatialVector *momentum);
  void solve_root();
  void descend(int i);

  Anchors anchors_[HOAP2_LINKS];
  Link link_[HOAP2_LINKS];
  int carrier_[HOAP2_LINKS] = {};  // links that carry a touched link, pelvis first
  int carriers_ = 0;
};

// Joint above each link, -1 for the pelvis; links come after their parents.
int joint_above(int link);
int parent_of(int link);

}  // namespace hoap2_sim
#endif
