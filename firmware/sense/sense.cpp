#include "sense/sense.h"

#include <string.h>

#include "robot/kinematics.hpp"
#include "sense/attitude.hpp"

namespace hoap2 {
namespace {

constexpr double kTick_s = 1e-6 * HOAP2_TICK_US;
constexpr double kMinLoad_N = 1.0;  // below this total the loads of the feet say nothing

using MapVec3 = Eigen::Map<Vec3>;

// Contact of each foot with hysteresis, its force, and the net CoP of the feet in contact: (7.65) with the
// moments of the vertical cell forces, f_z-weighted over the feet.
void cells_step(const hoap2_params_t& params, const hoap2_inputs_t& inputs, const hoap2_feet_t& feet,
                hoap2_sense_t& sense) {
  double total_N = 0.0;
  double moment_Nm[2] = {0.0, 0.0};
  for (int foot = 0; foot < 2; ++foot) {
    const double cos_yaw = hoap2_cos(feet.yaw_O_rad[foot]);
    const double sin_yaw = hoap2_sin(feet.yaw_O_rad[foot]);
    double force_N = 0.0;
    double about_ankle_Nm[2] = {0.0, 0.0};
    for (int cell = 0; cell < 4; ++cell) {
      const double f_N = inputs.cell_force_N[4 * foot + cell];
      force_N += f_N;
      about_ankle_Nm[0] += f_N * HOAP2_CELL_POS_L_M[cell][0];
      about_ankle_Nm[1] += f_N * HOAP2_CELL_POS_L_M[cell][1];
    }
    sense.foot_force_N[foot] = force_N;
    if (force_N > params.contact_on_N) sense.contact[foot] = 1;
    if (force_N < params.contact_off_N) sense.contact[foot] = 0;
    if (!sense.contact[foot]) continue;
    total_N += force_N;
    moment_Nm[0] +=
        force_N * feet.pos_O_m[foot][0] + cos_yaw * about_ankle_Nm[0] - sin_yaw * about_ankle_Nm[1];
    moment_Nm[1] +=
        force_N * feet.pos_O_m[foot][1] + sin_yaw * about_ankle_Nm[0] + cos_yaw * about_ankle_Nm[1];
  }
  if (total_N < kMinLoad_N) return;
  sense.cop_O_m[0] = moment_Nm[0] / total_N;
  sense.cop_O_m[1] = moment_Nm[1] / total_N;
}

// Share of each foot in the support: by load among the feet that are planned to stand.
void support_share(const hoap2_feet_t& feet, const hoap2_sense_t& sense, double share[2]) {
  double load_N[2];
  for (int foot = 0; foot < 2; ++foot) load_N[foot] = feet.support[foot] ? sense.foot_force_N[foot] : 0.0;
  const double total_N = load_N[0] + load_N[1];
  if (total_N < kMinLoad_N) {
    const double count = feet.support[0] && feet.support[1] ? 2.0 : 1.0;
    for (int foot = 0; foot < 2; ++foot) share[foot] = feet.support[foot] ? 1.0 / count : 0.0;
    if (!feet.support[0] && !feet.support[1]) share[0] = share[1] = 0.5;
    return;
  }
  for (int foot = 0; foot < 2; ++foot) share[foot] = load_N[foot] / total_N;
}

// Orientation of the pelvis in O: roll and pitch from the vertical, yaw from the foot it stands on.
Mat3 base_rotation(const Vec3& up_B, const Mat3& sole_rot_B, double foot_yaw_rad) {
  const Vec3 toe_B = sole_rot_B.col(0);
  Vec3 x_B = toe_B - toe_B.dot(up_B) * up_B;
  x_B /= hoap2_sqrt(x_B.squaredNorm() + 1e-300);
  const Vec3 y_B = up_B.cross(x_B);
  Mat3 level;
  level.row(0) = x_B.transpose();
  level.row(1) = y_B.transpose();
  level.row(2) = up_B.transpose();
  return rot_z(foot_yaw_rad) * level;
}

// Base, CoM and its rate from the legs and the attitude. The rate is that of the CoM against each sole
// point, so a change of the supporting foot does not look like motion.
void com_step(const hoap2_params_t& params, const hoap2_inputs_t& inputs, const hoap2_feet_t& feet,
              hoap2_sense_t& sense) {
  Kinematics kin;
  forward_kinematics(inputs.q_enc_rad, kin);
  const Vec3 up_B = chest_rot_B(kin) * MapVec3(sense.up_S);
  double share[2];
  support_share(feet, sense, share);
  const int main_foot = share[1] > share[0] ? 1 : 0;
  const Mat3 R_O_B = base_rotation(up_B, sole_pose_B(kin, main_foot).R, feet.yaw_O_rad[main_foot]);

  Vec3 com_O = Vec3::Zero();
  Vec3 rate_O = Vec3::Zero();
  for (int foot = 0; foot < 2; ++foot) {
    const Vec3 over_foot_O = R_O_B * (kin.com_B - sole_pose_B(kin, foot).p);
    MapVec3 last_O(sense.com_over_foot_O_m[foot]);
    if (sense.started) rate_O += share[foot] * (over_foot_O - last_O) / kTick_s;
    last_O = over_foot_O;
    com_O += share[foot] * (Eigen::Map<const Vec3>(feet.pos_O_m[foot]) + over_foot_O);
  }
  MapVec3(sense.com_O_m) = com_O;
  MapVec3 rate(sense.com_rate_O_m_s);
  rate += kTick_s / (params.com_rate_filter_s + kTick_s) * (rate_O - rate);
  MapVec3(sense.base_pos_O_m) = com_O - R_O_B * kin.com_B;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) sense.base_rot_O[i][j] = R_O_B(i, j);
}

}  // namespace
}  // namespace hoap2

extern "C" {

void hoap2_sense_reset(hoap2_sense_t* sense) {
  memset(sense, 0, sizeof *sense);
  sense->up_S[2] = 1.0;
  for (int i = 0; i < 3; ++i) sense->base_rot_O[i][i] = 1.0;
}

void hoap2_sense_step(const hoap2_params_t* params, const hoap2_inputs_t* inputs, const hoap2_feet_t* feet,
                      double omega_1_s, hoap2_sense_t* sense) {
  hoap2::cells_step(*params, *inputs, *feet, *sense);
  hoap2::attitude_step(*inputs, params->attitude_tau_s, *sense);
  hoap2::com_step(*params, *inputs, *feet, *sense);
  for (int i = 0; i < 2; ++i)  // (7.1)
    sense->cp_O_m[i] = sense->com_O_m[i] + sense->com_rate_O_m_s[i] / omega_1_s;
  sense->started = 1;
}

}  // extern "C"
