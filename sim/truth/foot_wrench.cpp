#include "truth/foot_wrench.h"

#include "robot/kinematics.h"

namespace hoap2_sim {
namespace {

void add_to_foot(const State &before, int link, const Vec3 &force_W_N, const Vec3 &moment_com_W_Nm,
                 State *next) {
  const int foot = link == kFootLink[0] ? 0 : 1;
  const Vec3 arm_W_m = vec(before.body[link].com_pos_W_m) - sole_point_W_m(before, foot);
  FootWrench &wrench = next->foot[foot];
  put(vec(wrench.force_W_N) + force_W_N, wrench.force_W_N);
  put(vec(wrench.moment_W_Nm) + moment_com_W_Nm + cross(arm_W_m, force_W_N), wrench.moment_W_Nm);
}

// What the soil really gave: its linear law at the velocities after the tick.
void add_soil(const State &before, int link, const SoilLoad &soil, State *next) {
  const double *const w = next->body[link].omega_W_rad_s, *const v = next->body[link].com_vel_W_m_s;
  double force_W_N[3], moment_W_Nm[3];
  put(soil.force_W_N, force_W_N);
  put(soil.torque_com_W_Nm, moment_W_Nm);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      moment_W_Nm[r] -= soil.angular[r][c] * w[c] + soil.coupling[r][c] * v[c];
      force_W_N[r] -= soil.coupling[c][r] * w[c] + soil.linear[r][c] * v[c];
    }
  }
  add_to_foot(before, link, vec(force_W_N), vec(moment_W_Nm), next);
}

}  // namespace

void gather_foot_wrenches(const State &before, const ContactList &contacts, const TickSolver &solver,
                          const SoilLoad *soil, State *next) {
  next->other_contacts = 0;
  for (FootWrench &wrench : next->foot) wrench = FootWrench{};
  for (int link = 0; soil != nullptr && link < HOAP2_LINKS; ++link) {
    if (!soil[link].touches) continue;
    if (is_foot(link)) {
      add_soil(before, link, soil[link], next);
    } else {
      ++next->other_contacts;
    }
  }
  for (int i = 0; i < contacts.count; ++i) {
    const int link = contacts.at[i].link;
    if (!is_foot(link)) {
      ++next->other_contacts;
      continue;
    }
    double force_W_N[3], moment_com_W_Nm[3];
    solver.contact_load(i, force_W_N, moment_com_W_Nm);
    add_to_foot(before, link, vec(force_W_N), vec(moment_com_W_Nm), next);
  }
}

}  // namespace hoap2_sim
