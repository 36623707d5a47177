#include "truth/truth.h"

#include <cmath>
#include <cstring>

#include "robot/kinematics.h"
#include "terrain/floor.h"

namespace hoap2_sim {
namespace {

constexpr double kLoaded_N = 0.5;

double yaw_rad(const Mat3 &axes_W) { return std::atan2(axes_W.cx.y, axes_W.cx.x); }

void fill_base(const State &s, hoap2_plant_outputs_t *out) {
  put(point_W_m(s, HOAP2_L_PELVIS, Vec3{}), out->true_base_pos_W_m);
  put(point_vel_W_m_s(s, HOAP2_L_PELVIS, Vec3{}), out->true_base_vel_W_m_s);
  std::memcpy(out->true_base_quat_W, s.body[HOAP2_L_PELVIS].quat_W, sizeof out->true_base_quat_W);
  std::memcpy(out->true_base_omega_W_rad_s, s.body[HOAP2_L_PELVIS].omega_W_rad_s,
              sizeof out->true_base_omega_W_rad_s);
  Vec3 com_W_m, com_rate_W_m_s;
  total_com(s, &com_W_m, &com_rate_W_m_s);
  put(com_W_m, out->true_com_W_m);
  put(com_rate_W_m_s, out->true_com_rate_W_m_s);
  const Mat3 chest = link_axes_W(s, HOAP2_L_CHEST);
  out->true_chest_rpy_rad[0] = std::atan2(chest.cy.z, chest.cz.z);
  out->true_chest_rpy_rad[1] = std::atan2(-chest.cx.z, std::hypot(chest.cy.z, chest.cz.z));
  out->true_chest_rpy_rad[2] = yaw_rad(chest);
}

void fill_feet(const State &s, hoap2_plant_outputs_t *out) {
  for (int foot = 0; foot < 2; ++foot) {
    put(sole_point_W_m(s, foot), out->true_foot_pos_W_m[foot]);
    out->true_foot_yaw_W_rad[foot] = yaw_rad(link_axes_W(s, kFootLink[foot]));
    out->true_sinkage_m[foot] = s.sinkage_m[foot];
    std::memcpy(out->true_foot_force_W_N[foot], s.foot[foot].force_W_N, sizeof s.foot[foot].force_W_N);
    std::memcpy(out->true_foot_moment_W_Nm[foot], s.foot[foot].moment_W_Nm, sizeof s.foot[foot].moment_W_Nm);
  }
}

}  // namespace

// With force F and moment M about a point of the floor, the tangential moment
// vanishes at r = n x M / (n . F), n the floor's normal.
void update_cop(State *s) {
  const Floor floor(s->params);
  const Vec3 about_W_m = sole_point_W_m(*s, 0) - floor.height_m(sole_point_W_m(*s, 0)) * floor.normal_W();
  Vec3 force_W_N, moment_W_Nm;
  for (int foot = 0; foot < 2; ++foot) {
    const Vec3 f_W_N = vec(s->foot[foot].force_W_N);
    force_W_N = force_W_N + f_W_N;
    moment_W_Nm =
        moment_W_Nm + vec(s->foot[foot].moment_W_Nm) + cross(sole_point_W_m(*s, foot) - about_W_m, f_W_N);
  }
  const double normal_N = dot(floor.normal_W(), force_W_N);
  if (normal_N < kLoaded_N) return;
  const Vec3 cop_W_m = about_W_m + (1.0 / normal_N) * cross(floor.normal_W(), moment_W_Nm);
  s->cop_W_m[0] = cop_W_m.x;
  s->cop_W_m[1] = cop_W_m.y;
}

void fill_outputs(const State &s, hoap2_plant_outputs_t *out) {
  *out = hoap2_plant_outputs_t{};
  const SensorFrame &shown = s.sensors.shown;
  std::memcpy(out->q_enc_rad, shown.q_enc_rad, sizeof out->q_enc_rad);
  std::memcpy(out->gyro_S_rad_s, shown.gyro_S_rad_s, sizeof out->gyro_S_rad_s);
  std::memcpy(out->accel_S_m_s2, shown.accel_S_m_s2, sizeof out->accel_S_m_s2);
  std::memcpy(out->cell_force_N, shown.cell_force_N, sizeof out->cell_force_N);
  fill_base(s, out);
  fill_feet(s, out);
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    out->true_q_rad[j] = s.drive[j].link_q_rad;
    out->true_qd_rad_s[j] = s.drive[j].link_qd_rad_s;
    out->true_tau_Nm[j] = s.drive[j].tau_Nm;
  }
  std::memcpy(out->true_cop_W_m, s.cop_W_m, sizeof out->true_cop_W_m);
  std::memcpy(out->true_push_force_W_N, s.push_force_W_N, sizeof out->true_push_force_W_N);
  out->sensor_tick = static_cast<std::int32_t>(shown.number);
  out->plant_tick = static_cast<std::int32_t>(s.tick);
  out->other_contacts = static_cast<std::int32_t>(s.other_contacts);
}

}  // namespace hoap2_sim
