// A pool of soil with one moved or free link in it: the others hang far above.
#ifndef HOAP2_TESTS_SIM_SOIL_RIG_H
#define HOAP2_TESTS_SIM_SOIL_RIG_H

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <string>
#include <vector>

#include "geometry.h"
#include "robot/kinematics.h"
#include "soil/soil.h"

namespace hoap2_sim {

constexpr double kSoleLength_m = HOAP2_ANKLE_TO_TOE_M + HOAP2_ANKLE_TO_HEEL_M;
constexpr double kSoleWidth_m = 2.0 * HOAP2_SOLE_HALF_WIDTH_M;
constexpr double kSole_m2 = kSoleLength_m * kSoleWidth_m;
constexpr double kGravity_m_s2 = 9.81;

// Wrench on a link in the tick, world axes, about its CoM.
struct Wrench {
  Vec3 force_W_N, torque_W_Nm;
};

class SoilRig {
 public:
  SoilRig() {
    hoap2_plant_params_defaults(&params);
    params.ground = HOAP2_GROUND_SOIL;
    // The tests' own ground, whatever the defaults are tuned to.
    params.soil_kc_N_m_n1 = 0.0;
    params.soil_kphi_N_m_n2 = 6e6;
    params.soil_n = 1.1;
    params.soil_cohesion_Pa = 200.0;
    params.soil_friction_rad = 0.5235987755982988;
    params.soil_shear_m = 0.008;
    params.soil_unload_Pa_m = 1e8;
    params.soil_unload_Pa_m2 = 0.0;
    params.soil_damping_Pas_m = 4e4;
    params.soil_edge_loss = 0.3;
    params.soil_edge_m = 0.01;
    params.soil_rft_zeta = 1.4;
    params.soil_heave = 0.25;
    params.soil_repose_rad = 0.5585053606381855;
    params.soil_roughness_m = 0.0;
    params.soil_roughness_length_m = 0.02;
    params.soil_cell_m = 0.005;
    params.soil_patches[0] = 10;
    params.soil_patches[1] = 6;
  }

  // Everything far above the pool, at rest.
  void build() {
    ASSERT_EQ("", soil.build(params));
    pool = pool_frame(params);
    state = State{};
    for (int link = 0; link < HOAP2_LINKS; ++link) {
      put_link(link, {0.0, 0.0, 50.0}, Mat3{});
    }
    find_axes();
  }

  // Link with its CoM and axes given in the pool's frame, at rest.
  void put_link(int link, const Vec3 &com_P_m, const Mat3 &axes_P) {
    BodyState &body = state.body[link];
    put(pool.origin_W_m + pool.axes_W * com_P_m, body.com_pos_W_m);
    put_quat(normalised(quat_of(pool.axes_W * axes_P)), &body);
    put(Vec3{}, body.com_vel_W_m_s);
    put(Vec3{}, body.omega_W_rad_s);
    find_axes();
  }

  // Arm from a foot's CoM to the middle of its sole.
  static Vec3 sole_arm_L_m() {
    const Vec3 com_L_m = vec(HOAP2_LINK[kRight].com_L_m);
    return Vec3{0.5 * (HOAP2_ANKLE_TO_TOE_M - HOAP2_ANKLE_TO_HEEL_M), 0.0, -HOAP2_SOLE_BELOW_ANKLE_M} -
           com_L_m;
  }
  // The middle of a sole there.
  void put_sole(const Vec3 &middle_P_m, const Mat3 &axes_P = Mat3{}, int link = kRight) {
    put_link(link, middle_P_m - axes_P * sole_arm_L_m(), axes_P);
  }

  // The wrench that the last loads give with these velocities after the tick.
  Wrench wrench(const Vec3 &vel_W, const Vec3 &omega_W = Vec3{}, int link = kRight) const {
    const SoilLoad &l = load[link];
    if (!l.touches) return {};
    double force[3], torque[3];
    for (int i = 0; i < 3; ++i) {
      force[i] = l.force_W_N[i];
      torque[i] = l.torque_com_W_Nm[i];
      for (int k = 0; k < 3; ++k) {
        force[i] -= l.coupling[k][i] * omega_W[k] + l.linear[i][k] * vel_W[k];
        torque[i] -= l.angular[i][k] * omega_W[k] + l.coupling[i][k] * vel_W[k];
      }
    }
    return {vec(force), vec(torque)};
  }

  // One tick in which the link is moved with these velocities of its CoM (pool axes).
  Wrench move(const Vec3 &vel_P, const Vec3 &omega_P = Vec3{}, int link = kRight) {
    EXPECT_EQ("", soil.find_loads(state, axes_W, load));
    const Vec3 vel_W = pool.axes_W * vel_P, omega_W = pool.axes_W * omega_P;
    const Wrench answer = wrench(vel_W, omega_W, link);
    integrate(vel_W, omega_W, link);
    soil.commit(state, axes_W);
    return {turn_back(pool.axes_W, answer.force_W_N), turn_back(pool.axes_W, answer.torque_W_Nm)};
  }

  // One tick of a free link: (M/h + Z) V+ = M/h V + F0 + gravity + pull.
  void fall(double mass_kg, const Vec3 &inertia_kgm2, const Wrench &pull = Wrench{}, int link = kRight) {
    EXPECT_EQ("", soil.find_loads(state, axes_W, load));
    const BodyState &body = state.body[link];
    Eigen::Matrix<double, 6, 6> a = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> b;
    const Vec3 down_N = (-mass_kg * kGravity_m_s2) * pool.axes_W.cz;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) {
        for (int j = 0; j < 3; ++j) {
          a(i, k) += axes_W[link].column(j)[i] * axes_W[link].column(j)[k] * inertia_kgm2[j] / kTick_s;
        }
      }
      a(3 + i, 3 + i) = mass_kg / kTick_s;
    }
    for (int i = 0; i < 3; ++i) {
      b(i) = pull.torque_W_Nm[i];
      for (int k = 0; k < 3; ++k) b(i) += a(i, k) * body.omega_W_rad_s[k];
      b(3 + i) = mass_kg / kTick_s * body.com_vel_W_m_s[i] + down_N[i] + pull.force_W_N[i];
    }
    const SoilLoad &l = load[link];
    if (l.touches) {
      for (int i = 0; i < 3; ++i) {
        b(i) += l.torque_com_W_Nm[i];
        b(3 + i) += l.force_W_N[i];
        for (int k = 0; k < 3; ++k) {
          a(i, k) += l.angular[i][k];
          a(i, 3 + k) += l.coupling[i][k];
          a(3 + k, i) += l.coupling[i][k];
          a(3 + i, 3 + k) += l.linear[i][k];
        }
      }
    }
    const Eigen::Matrix<double, 6, 1> v = a.ldlt().solve(b);
    integrate({v(3), v(4), v(5)}, {v(0), v(1), v(2)}, link);
    soil.commit(state, axes_W);
  }

  // Middle of the sole in the pool's frame.
  Vec3 sole_P_m(int link = kRight) const {
    const Vec3 sole_W_m = vec(state.body[link].com_pos_W_m) + axes_W[link] * sole_arm_L_m();
    return turn_back(pool.axes_W, sole_W_m - pool.origin_W_m);
  }
  Mat3 axes_P(int link = kRight) const { return transpose(pool.axes_W) * axes_W[link]; }

  std::vector<unsigned char> saved() const {
    std::vector<unsigned char> bytes(soil.state_bytes());
    soil.save(bytes.data());
    return bytes;
  }

  static constexpr int kRight = HOAP2_L_R_FOOT, kLeft = HOAP2_L_L_FOOT;
  hoap2_plant_params_t params = {};
  Soil soil;
  PoolFrame pool;
  State state = {};
  Mat3 axes_W[HOAP2_LINKS];
  SoilLoad load[HOAP2_LINKS];

 private:
  static void put_quat(const Quat &q, BodyState *body) {
    body->quat_W[0] = q.w;
    body->quat_W[1] = q.x;
    body->quat_W[2] = q.y;
    body->quat_W[3] = q.z;
  }
  void find_axes() { all_link_axes_W(state, axes_W); }

  void integrate(const Vec3 &vel_W, const Vec3 &omega_W, int link) {
    BodyState &body = state.body[link];
    put(vec(body.com_pos_W_m) + kTick_s * vel_W, body.com_pos_W_m);
    put(vel_W, body.com_vel_W_m_s);
    put(omega_W, body.omega_W_rad_s);
    const double turn_rad = kTick_s * norm(omega_W);
    if (turn_rad > 0.0) {
      const double s = std::sin(0.5 * turn_rad) / norm(omega_W);
      const Quat step = {std::cos(0.5 * turn_rad), s * omega_W.x, s * omega_W.y, s * omega_W.z};
      put_quat(normalised(step * quat(body.quat_W)), &body);
    }
    find_axes();
  }
};

}  // namespace hoap2_sim
#endif
