#include "solver/contact_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hoap2_sim {
namespace {

// Forces of the law and of the answer agree to this: 1e-10 of the robot's weight.
constexpr double kForceTolerance_N = 1e-8;
constexpr int kMaxSweeps = 200;
constexpr int kMaxBoundUpdates = 100;
constexpr int kLineSearchSteps = 60;
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

}  // namespace

ContactRow contact_row(const hoap2_plant_params_t &params) {
  const double spring_Ns_m = kTick_s * params.contact_stiffness_N_m;
  const double row_Ns_m = spring_Ns_m + params.contact_damping_Ns_m;
  return {spring_Ns_m / row_Ns_m, 1.0 / row_Ns_m};
}

void ContactProblem::begin(const TickProblem &problem) {
  const ContactList &contacts = *problem.contacts;
  const hoap2_plant_params_t &params = problem.state->params;
  const ContactRow spring = contact_row(params);
  pyramid_ = params.friction_law == HOAP2_FRICTION_LAW_PYRAMID;
  count_ = contacts.count;
  std::fill(touched_, touched_ + HOAP2_LINKS, false);
  for (int i = 0; i < count_; ++i) {
    const Contact &at = contacts.at[i];
    Row &row = row_[i];
    const BodyState &body = problem.state->body[at.link];
    touched_[at.link] = true;
    row.link = at.link;
    row.point_W_m = eigen(at.point_W_m);
    row.axes_W.col(0) = eigen(at.normal_W);
    row.axes_W.col(1) = eigen(at.along_W);
    row.axes_W.col(2) = row.axes_W.col(0).cross(row.axes_W.col(1));
    row.friction = params.friction_mu;
    row.law = {spring.erp * at.depth_m / kTick_s, spring.compliance_m_Ns, kContactSlip_m_Ns, 0.0,
               pyramid_ ? FrictionShape::kSquare : FrictionShape::kDisc};
    const Vector3 arm_com_W_m = row.point_W_m - eigen(body.com_pos_W_m);
    const Vector3 velocity_W_m_s = eigen(body.com_vel_W_m_s) + eigen(body.omega_W_rad_s).cross(arm_com_W_m);
    row.guess_m_s = row.axes_W.transpose() * velocity_W_m_s;
  }
}

// Before anything is known: what moves into the ground sticks, what leaves it is free.
void ContactProblem::guess_bounds() {
  for (int i = 0; i < count_; ++i) {
    Row &row = row_[i];
    row.law.bound_N = row.guess_m_s[0] < row.law.target_m_s && row.friction > 0.0 ? kUnbounded : 0.0;
    row.velocity_m_s = row.guess_m_s;
    row.velocity_m_s[1] = row.velocity_m_s[2] = 0.0;
  }
}

void ContactProblem::set_bounds(double friction_scale) {
  for (int i = 0; i < count_; ++i) {
    Row &row = row_[i];
    row.law.bound_N = friction_scale * row.friction * row.law.force_N(row.velocity_m_s)[0];
  }
}

double ContactProblem::force_error_N() const {
  double worst_N = 0.0;
  for (int i = 0; i < count_; ++i) {
    const Row &row = row_[i];
    const Vector3 error_N = row.law.force_N(row.velocity_m_s) - row.force_N;
    worst_N = std::max(worst_N, error_N.cwiseAbs().maxCoeff());
  }
  return worst_N;
}

// The laws linearised at the present velocities, put into the tree, and its answer.
void ContactProblem::sweep(BodyTree *tree) {
  ++effort_.sweeps;
  tree->clear_points();
  for (int i = 0; i < count_; ++i) {
    Row &row = row_[i];
    row.arm_W_m = row.point_W_m - tree->reference_W_m(row.link);
    // the tangent of the law: force = next_force - stiffness velocity
    row.stiffness_Ns_m = row.law.stiffness_Ns_m(row.velocity_m_s);
    row.next_force_N = row.law.force_N(row.velocity_m_s) + row.stiffness_Ns_m * row.velocity_m_s;
    const Matrix3 k_W = kTick_s * (row.axes_W * row.stiffness_Ns_m * row.axes_W.transpose());
    tree->add_point(row.link, row.arm_W_m, k_W, kTick_s * (row.axes_W * row.next_force_N));
  }
  tree->solve_touched();
  for (int i = 0; i < count_; ++i) {
    Row &row = row_[i];
    const SpatialVector &motion = tree->motion(row.link);
    row.next_velocity_m_s = row.axes_W.transpose() * (motion.linear + motion.angular.cross(row.arm_W_m));
    row.next_force_N -= row.stiffness_Ns_m * row.next_velocity_m_s;
  }
}

// Derivative of the tick's cost along the line from this iterate to the next. Its smooth
// part (bodies and motors) has the contact forces of the tree's answer as its gradient,
// and is linear between two answers: the tree is not needed.
double ContactProblem::slope_at(double step) const {
  double slope = 0.0;
  for (int i = 0; i < count_; ++i) {
    const Row &row = row_[i];
    const Vector3 along = row.next_velocity_m_s - row.velocity_m_s;
    const Vector3 force_N = row.force_N + step * (row.next_force_N - row.force_N);
    slope += along.dot(force_N - row.law.force_N(row.velocity_m_s + step * along));
  }
  return slope;
}

// Step (0..1] to the lowest cost: the slope rises along the line.
double ContactProblem::line_search() const {
  const double start = slope_at(0.0), end = slope_at(1.0);
  if (end <= 1e-9 * std::fabs(start)) return 1.0;
  double low = 0.0, high = 1.0, slope_low = start, slope_high = end;
  double step = 1.0;
  for (int i = 0; i < kLineSearchSteps; ++i) {
    step = slope_low < 0.0 ? low - slope_low * (high - low) / (slope_high - slope_low) : 0.5 * (low + high);
    const double slope = slope_at(step);
    if (std::fabs(slope) <= 1e-9 * std::fabs(start)) break;
    // Illinois: halves the slope of an end that stays twice
    if (slope < 0.0) {
      low = step;
      slope_low = slope;
      slope_high *= 0.5;
    } else {
      high = step;
      slope_high = slope;
      slope_low *= 0.5;
    }
  }
  return step;
}

void ContactProblem::accept(double step) {
  for (int i = 0; i < count_; ++i) {
    Row &row = row_[i];
    if (step == 1.0) {
      row.velocity_m_s = row.next_velocity_m_s;
      row.force_N = row.next_force_N;
    } else {
      row.velocity_m_s += step * (row.next_velocity_m_s - row.velocity_m_s);
      row.force_N += step * (row.next_force_N - row.force_N);
    }
  }
}

// Newton's method with an exact line search on the convex cost of fixed friction bounds.
bool ContactProblem::converge(BodyTree *tree) {
  while (force_error_N() > kForceTolerance_N) {
    if (effort_.sweeps >= kMaxSweeps) return false;
    sweep(tree);
    accept(line_search());
  }
  return true;
}

// A bound that friction does not reach, neither as it is nor as it should be, may be off.
bool ContactProblem::binds(const Row &row) {
  const Vector3 force_N = row.law.force_N(row.velocity_m_s);
  const double stick_N = std::hypot(row.velocity_m_s[1], row.velocity_m_s[2]) / row.law.slip_m_Ns;
  return stick_N >= std::min(row.friction * force_N[0], row.law.bound_N);
}

double ContactProblem::bound_error_N() const {
  double worst_N = 0.0;
  for (int i = 0; i < count_; ++i) {
    const Row &row = row_[i];
    const Vector3 force_N = row.law.force_N(row.velocity_m_s);
    const double bound_N = row.friction * force_N[0];
    if (binds(row)) worst_N = std::max(worst_N, std::fabs(bound_N - row.law.bound_N));
  }
  return worst_N;
}

// Coulomb's cone: friction bounds that are mu times the normal forces of the answer.
void ContactProblem::solve_cone(BodyTree *tree) {
  double bound_N[kMaxContacts], image_N[kMaxContacts];
  set_bounds(1.0);
  bounds_.start(count_);
  while (converge(tree) && bound_error_N() > kForceTolerance_N) {
    if (++effort_.bound_updates > kMaxBoundUpdates) return;
    for (int i = 0; i < count_; ++i) {
      const Row &row = row_[i];
      image_N[i] = row.friction * row.law.force_N(row.velocity_m_s)[0];
      bound_N[i] = binds(row) ? row.law.bound_N : image_N[i];
    }
    bounds_.next(image_N, bound_N);
    for (int i = 0; i < count_; ++i) row_[i].law.bound_N = bound_N[i];
  }
}

// As ODE does it: bounds from the normal forces without friction, then held.
void ContactProblem::solve_ode_pyramid(BodyTree *tree) {
  set_bounds(0.0);
  if (!converge(tree)) return;
  set_bounds(1.0);
  converge(tree);
}

void ContactProblem::solve(BodyTree *tree) {
  effort_ = ContactEffort{};
  if (count_ == 0) {
    tree->clear_points();
    tree->solve_touched();
    return;
  }
  guess_bounds();
  sweep(tree);
  accept(1.0);
  if (pyramid_) {
    solve_ode_pyramid(tree);
  } else {
    solve_cone(tree);
  }
  effort_.force_error_N = std::max(force_error_N(), pyramid_ ? 0.0 : bound_error_N());
}

}  // namespace hoap2_sim
