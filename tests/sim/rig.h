// A plant under test: parameters, inputs, steps and a look at its inside.
#ifndef HOAP2_TESTS_SIM_RIG_H
#define HOAP2_TESTS_SIM_RIG_H

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "geometry.h"
#include "hoap2_plant/plant.h"
#include "plant_state.h"
#include "robot/kinematics.h"

namespace hoap2_sim {

constexpr double kMg_N = HOAP2_TOTAL_MASS_KG * 9.81;

// Solver of the rigs that a test makes; WithEachSolver changes it.
inline std::int32_t solver_of_rigs = HOAP2_SOLVER_ARTICULATED;

class Rig {
 public:
  Rig() : plant_(hoap2_plant_create()) {
    hoap2_plant_params_defaults(&params);
    hoap2_plant_inputs_defaults(&inputs);
    params.sensor_preset = 0;
    params.solver = solver_of_rigs;
  }
  ~Rig() { hoap2_plant_destroy(plant_); }
  Rig(const Rig &) = delete;
  Rig &operator=(const Rig &) = delete;

  // Start, with the position references at the start posture.
  void start() {
    for (int j = 0; j < HOAP2_JOINTS; ++j) inputs.q_ref_rad[j] = params.start_posture_rad[j];
    ASSERT_EQ(0, hoap2_plant_init(plant_, &params)) << hoap2_plant_error(plant_);
  }
  void step(int ticks = 1) {
    for (int i = 0; i < ticks; ++i)
      ASSERT_EQ(0, hoap2_plant_step(plant_, &inputs)) << hoap2_plant_error(plant_);
  }
  hoap2_plant_outputs_t out() const {
    hoap2_plant_outputs_t outputs;
    hoap2_plant_get_outputs(plant_, &outputs);
    return outputs;
  }
  State state() const {
    State s;
    hoap2_plant_get_state(plant_, &s);
    return s;
  }
  int restore(const State &s) { return hoap2_plant_set_state(plant_, &s, sizeof s); }
  hoap2_plant_t *plant() { return plant_; }

  void posture(std::initializer_list<std::pair<int, double>> joints_deg) {
    for (double &q : params.start_posture_rad) q = 0.0;
    for (const auto &joint : joints_deg)
      params.start_posture_rad[joint.first] = joint.second * std::acos(-1.0) / 180.0;
  }
  void mode_of_all(std::int32_t mode) {
    for (std::int32_t &m : inputs.drive_mode) m = mode;
  }
  // Floating without weight, far above the floor, without joint friction.
  void float_free() {
    params.gravity_m_s2 = 0.0;
    params.start_height_m = 50.0;
    params.joint_friction_scale = 0.0;
  }

  hoap2_plant_params_t params = {};
  hoap2_plant_inputs_t inputs = {};

 private:
  hoap2_plant_t *plant_;
};

// Base of tests that must hold with either solver (INSTANTIATE_WITH_EACH_SOLVER below the tests).
class WithEachSolver : public ::testing::TestWithParam<std::int32_t> {
 protected:
  WithEachSolver() { solver_of_rigs = GetParam(); }
  ~WithEachSolver() override { solver_of_rigs = HOAP2_SOLVER_ARTICULATED; }
};
#define INSTANTIATE_WITH_EACH_SOLVER(suite)                                                                \
  INSTANTIATE_TEST_SUITE_P(Solver, suite, ::testing::Values(HOAP2_SOLVER_ARTICULATED, HOAP2_SOLVER_ODE),   \
                           [](const ::testing::TestParamInfo<std::int32_t> &tested) {                      \
                             return std::string(tested.param == HOAP2_SOLVER_ODE ? "Ode" : "Articulated"); \
                           })

struct Momentum {
  Vec3 linear_W_Ns, angular_com_W_Nms;
};

// From the bodies alone. Rotors carry no momentum of their own in this model.
inline Momentum momentum(const State &s) {
  Momentum m;
  Vec3 com_W_m, rate_W_m_s;
  total_com(s, &com_W_m, &rate_W_m_s);
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    const double(&i)[6] = HOAP2_LINK[link].inertia_C_kgm2;
    const Mat3 axes = link_axes_W(s, link);
    const Vec3 w = turn_back(axes, vec(s.body[link].omega_W_rad_s));
    const Vec3 spin = {i[0] * w.x + i[3] * w.y + i[4] * w.z, i[3] * w.x + i[1] * w.y + i[5] * w.z,
                       i[4] * w.x + i[5] * w.y + i[2] * w.z};
    const Vec3 p = HOAP2_LINK[link].mass_kg * vec(s.body[link].com_vel_W_m_s);
    m.linear_W_Ns = m.linear_W_Ns + p;
    m.angular_com_W_Nms =
        m.angular_com_W_Nms + axes * spin + cross(vec(s.body[link].com_pos_W_m) - com_W_m, p);
  }
  return m;
}

// Motion energy of links and rotors.
inline double kinetic_energy_J(const State &s) {
  double energy_J = 0.0;
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    const double(&i)[6] = HOAP2_LINK[link].inertia_C_kgm2;
    const Vec3 w = turn_back(link_axes_W(s, link), vec(s.body[link].omega_W_rad_s));
    const Vec3 v = vec(s.body[link].com_vel_W_m_s);
    energy_J += 0.5 * HOAP2_LINK[link].mass_kg * dot(v, v) +
                0.5 * (i[0] * w.x * w.x + i[1] * w.y * w.y + i[2] * w.z * w.z) + i[3] * w.x * w.y +
                i[4] * w.x * w.z + i[5] * w.y * w.z;
  }
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    energy_J += 0.5 * HOAP2_JOINT[j].armature_kgm2 * s.drive[j].rotor_qd_rad_s * s.drive[j].rotor_qd_rad_s;
  }
  return energy_J;
}

}  // namespace hoap2_sim
#endif
