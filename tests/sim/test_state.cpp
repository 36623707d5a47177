// State, threads, bad input, and independence of place and heading.
#include <gtest/gtest.h>
#include <ode/ode.h>

#include <limits>
#include <thread>
#include <vector>

#include "drive/drive.h"
#include "ode_runtime.h"
#include "rig.h"

namespace hoap2_sim {
namespace {

// A motion that uses everything: noise, contacts, swinging joints, a push.
void lively(Rig *rig) {
  rig->params.sensor_preset = 1;
  rig->params.seed = 5;
  rig->params.roll_stiffness_Nm_rad = 100.0;
  rig->params.push_link[0] = HOAP2_L_CHEST;
  rig->params.push_force_W_N[0][0] = 6.0;
  rig->params.push_start_s[0] = 0.1;
  rig->params.push_duration_s[0] = 0.3;
  rig->params.push_ramp_s[0] = 0.05;
}

void swing(Rig *rig, int tick) {
  const double t = kTick_s * tick;
  const double *const q0 = rig->params.start_posture_rad;
  rig->inputs.q_ref_rad[HOAP2_J_R_SHOULDER_PITCH] =
      q0[HOAP2_J_R_SHOULDER_PITCH] - 0.4 * (1.0 - std::cos(7.0 * t));
  rig->inputs.q_ref_rad[HOAP2_J_L_HIP_YAW] = q0[HOAP2_J_L_HIP_YAW] + 0.05 * std::sin(9.0 * t);
  rig->inputs.q_ref_rad[HOAP2_J_WAIST_PITCH] = q0[HOAP2_J_WAIST_PITCH] + 0.03 * (1.0 - std::cos(11.0 * t));
}

bool same_bytes(const hoap2_plant_outputs_t &a, const hoap2_plant_outputs_t &b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

class StateOfEachSolver : public WithEachSolver {};

TEST_P(StateOfEachSolver, RestoreContinuesBitForBit) {
  Rig rig, other;
  lively(&rig);
  rig.start();
  other.params.floor_tilt_rad[0] = 0.1;  // another world: the block brings its own
  other.start();
  for (int i = 0; i < 250; ++i) {
    swing(&rig, i);
    rig.step();
  }
  const State saved = rig.state();
  std::vector<hoap2_plant_outputs_t> first;
  for (int i = 250; i < 450; ++i) {
    swing(&rig, i);
    rig.step();
    first.push_back(rig.out());
  }
  for (Rig *again : {&rig, &other}) {
    again->params = rig.params;
    ASSERT_EQ(0, again->restore(saved));
    EXPECT_TRUE(same_bytes(again->out(), again->out()));
    for (int i = 250; i < 450; ++i) {
      again->inputs = rig.inputs;
      swing(again, i);
      again->step();
      ASSERT_TRUE(same_bytes(first[static_cast<std::size_t>(i - 250)], again->out())) << "tick " << i;
    }
  }
  const State a = rig.state(), b = other.state();
  EXPECT_EQ(0, std::memcmp(&a, &b, sizeof a));
}

TEST_P(StateOfEachSolver, TwoRunsAreEqual) {
  Rig a, b;
  for (Rig *rig : {&a, &b}) {
    lively(rig);
    rig->start();
  }
  for (int i = 0; i < 300; ++i) {
    swing(&a, i);
    swing(&b, i);
    a.step();
    b.step();
  }
  const State sa = a.state(), sb = b.state();
  EXPECT_EQ(0, std::memcmp(&sa, &sb, sizeof sa));
}

TEST_P(StateOfEachSolver, SeedChangesTheNoiseOnly) {
  Rig a, b;
  for (Rig *rig : {&a, &b}) lively(rig);
  b.params.seed = 6;
  a.start();
  b.start();
  a.step(20);
  b.step(20);
  EXPECT_NE(a.out().accel_S_m_s2[0] + a.out().cell_force_N[1],
            b.out().accel_S_m_s2[0] + b.out().cell_force_N[1]);
  EXPECT_EQ(a.out().true_com_W_m[2], b.out().true_com_W_m[2]);
}

TEST(StateBlock, ForeignOrDamagedBlocksAreRefused) {
  Rig rig;
  rig.start();
  rig.step(10);
  const State good = rig.state();
  State bad = good;
  bad.version += 1;
  EXPECT_NE(0, rig.restore(bad));
  bad = good;
  bad.magic = 0;
  EXPECT_NE(0, rig.restore(bad));
  bad = good;
  bad.body[3].quat_W[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(0, rig.restore(bad));
  for (double *value : {&bad.drive[4].link_q_rad, &bad.drive[9].tau_Nm, &bad.sensors.shown.cell_force_N[2],
                        &bad.sensors.gyro_lp_S_rad_s[1], &bad.foot[1].moment_W_Nm[0], &bad.cop_W_m[1]}) {
    bad = good;
    *value = std::numeric_limits<double>::infinity();
    EXPECT_NE(0, rig.restore(bad));
  }
  bad = good;
  bad.params.block_count = 1000;
  EXPECT_NE(0, rig.restore(bad));
  EXPECT_STRNE("", hoap2_plant_error(rig.plant()));
  const State kept = rig.state();
  EXPECT_EQ(0, std::memcmp(&good, &kept, sizeof good));
  rig.step(1);
}

TEST_P(StateOfEachSolver, InstancesOnTwoThreadsGiveTheSingleThreadsResult) {
  const auto run = [](Rig *rig) {
    for (int i = 0; i < 200; ++i) {
      swing(rig, i);
      ASSERT_EQ(0, hoap2_plant_step(rig->plant(), &rig->inputs));
    }
  };
  Rig rigs[3];
  for (Rig &rig : rigs) {
    lively(&rig);
    rig.start();
  }
  run(&rigs[0]);
  std::thread one([&] { run(&rigs[1]); });
  std::thread two([&] { run(&rigs[2]); });
  one.join();
  two.join();
  const State a = rigs[0].state(), b = rigs[1].state(), c = rigs[2].state();
  EXPECT_EQ(0, std::memcmp(&a, &b, sizeof a));
  EXPECT_EQ(0, std::memcmp(&a, &c, sizeof a));
}

TEST_P(StateOfEachSolver, IsKeptWhenAnInputIsRefusedByName) {
  Rig rig;
  rig.start();
  rig.step(5);
  const State before = rig.state();
  const hoap2_plant_inputs_t good = rig.inputs;
  const auto refused = [&](const char *name) {
    EXPECT_NE(0, hoap2_plant_step(rig.plant(), &rig.inputs));
    EXPECT_NE(nullptr, std::strstr(hoap2_plant_error(rig.plant()), name)) << hoap2_plant_error(rig.plant());
    const State after = rig.state();
    EXPECT_EQ(0, std::memcmp(&before, &after, sizeof before));
    rig.inputs = good;
  };
  rig.inputs.q_ref_rad[3] = std::numeric_limits<double>::quiet_NaN();
  refused("r_knee");
  rig.inputs.tau_ff_Nm[13] = std::numeric_limits<double>::infinity();
  refused("l_knee");
  rig.inputs.kp_Nm_rad[0] = -1.0;
  refused("kp_Nm_rad");
  rig.inputs.drive_mode[0] = 9;
  refused("drive_mode");
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), 200.1, -200.1}) {
    rig.inputs.push_now_force_W_N[1] = bad;
    refused("push_now_force_W_N");
  }
  rig.inputs.push_now_point_L_m[0] = std::numeric_limits<double>::infinity();
  refused("push_now_point_L_m");
  for (int bad : {-1, 26}) {
    rig.inputs.push_now_link = bad;
    refused("push_now_link");
  }
  rig.step(1);
  EXPECT_STREQ("", hoap2_plant_error(rig.plant()));
}

TEST(BadInput, ParametersAreRefusedByName) {
  Rig rig;
  const auto refused = [&](const char *name) {
    EXPECT_NE(0, hoap2_plant_init(rig.plant(), &rig.params));
    EXPECT_NE(nullptr, std::strstr(hoap2_plant_error(rig.plant()), name)) << hoap2_plant_error(rig.plant());
    hoap2_plant_params_defaults(&rig.params);
  };
  rig.params.friction_mu = -0.1;
  refused("friction_mu");
  rig.params.push_link[4] = 26;
  refused("push_link");
  rig.params.gravity_m_s2 = std::numeric_limits<double>::quiet_NaN();
  refused("gravity_m_s2");
  rig.params.start_posture_rad[HOAP2_J_R_KNEE] = -1.0;
  refused("r_knee");
}

TEST(BadInput, StepBeforeInitIsAnError) {
  Rig rig;
  EXPECT_NE(0, hoap2_plant_step(rig.plant(), &rig.inputs));
}

TEST(BadInput, EngineChecksBecomeExceptions) {
  use_ode_on_this_thread();
  EXPECT_THROW(dDebug(1, "a check of %d", 3), OdeFailure);
  const dWorldID world = dWorldCreate();
  const dBodyID body = dBodyCreate(world);
  dMass broken;
  dMassSetZero(&broken);
  EXPECT_THROW(dBodySetMass(body, &broken), OdeFailure) << "thrown through the library's own frames";
  dWorldDestroy(world);
}

TEST_P(StateOfEachSolver, FarAwayAndTurnedTheJointsMoveTheSame) {
  Rig here, there;
  const double yaw = 130.0 * std::acos(-1.0) / 180.0;
  for (Rig *rig : {&here, &there}) {
    rig->params.push_link[0] = HOAP2_L_CHEST;
    rig->params.push_start_s[0] = 0.1;
    rig->params.push_duration_s[0] = 0.2;
  }
  here.params.push_force_W_N[0][0] = 5.0;
  there.params.push_force_W_N[0][0] = 5.0 * std::cos(yaw);
  there.params.push_force_W_N[0][1] = 5.0 * std::sin(yaw);
  there.params.start_pos_W_m[0] = 1000.0;
  there.params.start_pos_W_m[1] = -500.0;
  there.params.start_yaw_W_rad = yaw;
  here.start();
  there.start();
  double largest = 0.0;
  for (int i = 0; i < 1500; ++i) {
    swing(&here, i);
    swing(&there, i);
    here.step();
    there.step();
    for (int j = 0; j < HOAP2_JOINTS; ++j) {
      largest = std::fmax(largest, std::fabs(here.out().true_q_rad[j] - there.out().true_q_rad[j]));
    }
  }
  EXPECT_LT(largest, 1e-7);
  const Vec3 moved = vec(there.out().true_com_W_m) - Vec3{1000.0, -500.0, 0.0};
  const Vec3 expected = rotation(2, yaw) * vec(here.out().true_com_W_m);
  EXPECT_LT(norm(moved - expected), 1e-7);
}

INSTANTIATE_WITH_EACH_SOLVER(StateOfEachSolver);

}  // namespace
}  // namespace hoap2_sim
