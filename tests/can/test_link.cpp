// The link: which tick a value arrives in, what a cut, a lost board or a second controller leads to.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "can/link_state.h"
#include "hoap2/generated/robot_model.h"
#include "hoap2_link/link.h"

namespace {

using namespace hoap2_sim;

struct Rig {
  LinkState link;
  hoap2_link_command_t asked = {}, to_plant = {};
  hoap2_link_measured_t measured = {}, to_controller = {};
  int tick = 0;

  explicit Rig(const hoap2_link_params_t &params = defaults()) {
    link_init(&link, params, 3);
    for (int j = 0; j < HOAP2_JOINTS; ++j) {
      const double *soft = HOAP2_JOINT[j].limit_soft_rad;
      asked.q_ref_rad[j] = measured.q_enc_rad[j] = 0.5 * (soft[0] + soft[1]);
      asked.kp_Nm_rad[j] = 1000.0;
      asked.kd_Nms_rad[j] = 5.0;
      asked.drive_mode[j] = HOAP2_DRIVE_MODE_POSITION;
    }
  }
  static hoap2_link_params_t defaults() {
    hoap2_link_params_t params;
    hoap2_link_params_defaults(&params);
    return params;
  }
  void exchange() {
    measured.sensor_tick = tick;
    link_boot(&link, asked, measured);
    link_exchange(&link, asked, measured, &to_plant, &to_controller);
    ++tick;
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) exchange();
  }
  int count(int mode) const {
    int boards = 0;
    for (const hoap2_can_board_t &b : link.board) boards += b.mode == mode;
    return boards;
  }
};

// A command given at tick k acts in tick k + 1; a measurement of tick k is there at tick k.
TEST(Link, CommandsTakeOneTickMeasurementsNone) {
  Rig rig;
  rig.run(10);
  double last_rad = rig.asked.q_ref_rad[HOAP2_J_R_KNEE];
  int last_sensor_tick = rig.to_controller.sensor_tick;
  for (int i = 0; i < 50; ++i) {
    const double now_rad = last_rad + 0.002 * std::sin(0.3 * i);
    rig.asked.q_ref_rad[HOAP2_J_R_KNEE] = now_rad;
    rig.measured.q_enc_rad[HOAP2_J_L_KNEE] = 1.0 + 0.01 * i;
    rig.measured.cell_force_N[5] = i;
    rig.measured.gyro_S_rad_s[1] = 0.01 * i;
    rig.exchange();
    EXPECT_NEAR(rig.to_plant.q_ref_rad[HOAP2_J_R_KNEE], last_rad, 2e-7) << i;
    EXPECT_NEAR(rig.to_controller.q_enc_rad[HOAP2_J_L_KNEE], 1.0 + 0.01 * i, 2e-7) << i;
    EXPECT_NEAR(rig.to_controller.cell_force_N[5], i, 6e-4);
    EXPECT_NEAR(rig.to_controller.gyro_S_rad_s[1], 0.01 * i, 2e-6);
    EXPECT_EQ(rig.to_controller.sensor_tick, last_sensor_tick + 1);
    last_rad = now_rad;
    last_sensor_tick = rig.to_controller.sensor_tick;
  }
}

// Switching on happens before the run: the first tick already follows the first command, and nothing is
// refused.
TEST(Link, TheFirstTickAlreadyFollows) {
  Rig rig;
  rig.exchange();
  EXPECT_EQ(rig.count(HOAP2_CAN_BOARD_MODE_FOLLOW), HOAP2_CAN_BOARDS);
  for (int j = 0; j < HOAP2_JOINTS; ++j) EXPECT_EQ(rig.to_plant.kp_Nm_rad[j], 1000.0) << j;
  rig.run(500);
  for (const std::uint32_t refused : rig.link.controller.refused) EXPECT_EQ(refused, 0U);
  for (const hoap2_can_board_t &board : rig.link.board) {
    for (const std::uint32_t refused : board.refused) EXPECT_EQ(refused, 0U);
  }
}

TEST(Link, ACutBringsBothSidesToTheirSafeModeInTheFifthTick) {
  hoap2_link_params_t params = Rig::defaults();
  params.cut_start_s = 0.1;
  params.cut_s = 0.05;
  Rig rig(params);
  rig.run(101);  // in this window nothing arrives any more
  const int stale_tick = rig.to_controller.sensor_tick;
  for (int missing = 1; missing < HOAP2_CAN_ALIVE_LIMIT_TICKS; ++missing) {
    rig.exchange();
    EXPECT_EQ(rig.count(HOAP2_CAN_BOARD_MODE_HOLD), 0) << missing;
    EXPECT_EQ(rig.to_controller.sensor_tick, stale_tick);
  }
  rig.exchange();
  EXPECT_EQ(rig.count(HOAP2_CAN_BOARD_MODE_HOLD), HOAP2_CAN_BOARDS);
  EXPECT_EQ(rig.to_controller.sensor_tick, stale_tick);
  rig.run(60);
  EXPECT_EQ(rig.count(HOAP2_CAN_BOARD_MODE_FOLLOW), HOAP2_CAN_BOARDS);
  EXPECT_GT(rig.to_controller.sensor_tick, stale_tick + 40);
}

// Whatever is lost, changed, late or spoiled: no drive is ever set beyond its stops, or moved faster than it
// can.
TEST(Link, NoDisturbanceTakesADriveBeyondItsLimits) {
  for (int seed = 1; seed <= 6; ++seed) {
    hoap2_link_params_t params = Rig::defaults();
    params.seed = seed;
    params.loss = 0.1;
    params.corrupt = 0.1;
    params.corrupt_at_one = 0.05;
    params.residual = 0.1;
    params.delay = 0.1;
    params.delay_s = 0.004;
    params.cut_start_s = 0.5;
    params.cut_s = 0.05;
    params.babble_start_s = 1.0;
    params.babble_s = 0.02;
    params.drop_start_s = 1.5;
    params.drop_s = 0.1;
    Rig rig(params);
    rig.exchange();
    hoap2_link_command_t last = rig.to_plant;
    double moved_rad = 0.0;
    for (int i = 0; i < 2500; ++i) {
      for (int j = 0; j < HOAP2_JOINTS; ++j) {
        const double *soft = HOAP2_JOINT[j].limit_soft_rad;
        rig.asked.q_ref_rad[j] =
            0.5 * (soft[0] + soft[1]) + 0.5 * (soft[1] - soft[0]) * std::sin(0.002 * i + j) * 0.9;
      }
      rig.exchange();
      for (int j = 0; j < HOAP2_JOINTS; ++j) {
        const hoap2_joint_data_t &joint = HOAP2_JOINT[j];
        const double q_rad = rig.to_plant.q_ref_rad[j], step_rad = std::fabs(q_rad - last.q_ref_rad[j]);
        ASSERT_GE(q_rad, joint.limit_hard_rad[0] - HOAP2_RAD_PER_COUNT);
        ASSERT_LE(q_rad, joint.limit_hard_rad[1] + HOAP2_RAD_PER_COUNT);
        ASSERT_LE(step_rad, 1e-3 * joint.velocity_limit_rad_s + HOAP2_RAD_PER_COUNT);
        ASSERT_LE(std::fabs(rig.to_plant.tau_ff_Nm[j]), joint.torque_peak_Nm);
        ASSERT_GE(rig.to_plant.kp_Nm_rad[j], 0.0);
        moved_rad += step_rad;
      }
      last = rig.to_plant;
    }
    EXPECT_GT(moved_rad, 10.0) << "they did move";
    std::uint32_t refused = 0;
    for (const hoap2_can_board_t &board : rig.link.board) refused += board.refused[HOAP2_CAN_REFUSED_CRC];
    EXPECT_GT(refused, 10U) << "changed frames were found";
  }
}

TEST(Link, ADroppedBoardStopsTheControllersSensorTickAndHolds) {
  hoap2_link_params_t params = Rig::defaults();
  params.drop_node = 6;  // left leg
  params.drop_start_s = 0.1;
  params.drop_s = 0.02;
  Rig rig(params);
  rig.run(107);
  const int stale_tick = rig.to_controller.sensor_tick;
  rig.run(5);
  EXPECT_EQ(rig.to_controller.sensor_tick, stale_tick);
  EXPECT_EQ(rig.link.board[HOAP2_CAN_B_L_LEG].mode, HOAP2_CAN_BOARD_MODE_HOLD);
  EXPECT_EQ(rig.count(HOAP2_CAN_BOARD_MODE_HOLD), 1);
  rig.run(20);
  EXPECT_EQ(rig.count(HOAP2_CAN_BOARD_MODE_HOLD), 0);
}

TEST(Link, AStopButtonReachesEveryBoardOnBothBusesThroughABabblingNode) {
  hoap2_link_params_t params = Rig::defaults();
  params.stop_start_s = 0.2;
  params.babble_start_s = 0.19;
  params.babble_s = 1.0;
  Rig rig(params);
  rig.run(204);
  EXPECT_EQ(rig.count(HOAP2_CAN_BOARD_MODE_STOPPED), HOAP2_CAN_BOARDS);
  rig.run(200);
  EXPECT_EQ(rig.count(HOAP2_CAN_BOARD_MODE_STOPPED), HOAP2_CAN_BOARDS);
  for (int j = 0; j < HOAP2_JOINTS; ++j)
    EXPECT_EQ(rig.to_plant.drive_mode[j], HOAP2_DRIVE_MODE_DAMPED_TORQUE);
}

// In step with the first they spoil each other's frames; between its frames they hear each other. Both ways
// are safe.
TEST(Link, ASecondControllerEndsInTheSafeMode) {
  for (const double late_s : {0.0, 0.0004}) {
    hoap2_link_params_t params = Rig::defaults();
    params.second_start_s = 0.1;
    params.second_late_s = late_s;
    Rig rig(params);
    rig.run(115);
    EXPECT_EQ(rig.count(HOAP2_CAN_BOARD_MODE_HOLD), HOAP2_CAN_BOARDS) << late_s;
  }
}

TEST(Link, ASavedStateGoesOnTheSame) {
  hoap2_link_params_t params = Rig::defaults();
  params.loss = 0.05;
  params.corrupt = 0.05;
  params.delay = 0.05;
  params.cut_start_s = 0.8;
  params.cut_s = 0.1;
  Rig rig(params);
  for (int i = 0; i < 25; ++i) {
    rig.run(100);
    ASSERT_TRUE(link_is_whole(rig.link)) << i;
  }
  const Rig saved = rig;
  rig.run(300);
  Rig again = saved;
  again.run(300);
  EXPECT_EQ(std::memcmp(&rig.link, &again.link, sizeof rig.link), 0);
  EXPECT_EQ(std::memcmp(&rig.to_plant, &again.to_plant, sizeof rig.to_plant), 0);
}

TEST(Link, RefusesParametersOutOfRangeAndForeignStates) {
  hoap2_link_t *link = hoap2_link_create();
  hoap2_link_params_t params = Rig::defaults();
  params.loss = 1.5;
  EXPECT_NE(hoap2_link_init(link, &params, 0), 0);
  params.loss = std::nan("");
  EXPECT_NE(hoap2_link_init(link, &params, 0), 0);
  params.loss = 0.0;
  EXPECT_EQ(hoap2_link_init(link, &params, 0), 0);
  std::vector<char> state(hoap2_link_state_size(link));
  hoap2_link_get_state(link, state.data());
  EXPECT_EQ(hoap2_link_set_state(link, state.data(), state.size()), 0);
  EXPECT_NE(hoap2_link_set_state(link, state.data(), state.size() - 1), 0);
  const auto damaged = [&](auto &&damage) {
    LinkState copy;
    std::memcpy(static_cast<void *>(&copy), state.data(), sizeof copy);
    damage(&copy);
    return hoap2_link_set_state(link, &copy, sizeof copy);
  };
  EXPECT_NE(damaged([](LinkState *s) { s->params.drop_node = 99; }), 0);
  EXPECT_NE(damaged([](LinkState *s) { s->bus[1].babbling_node = 16; }), 0);
  EXPECT_NE(damaged([](LinkState *s) { s->bus[0].node[3].side = 2; }), 0);
  EXPECT_NE(damaged([](LinkState *s) { s->bus[0].free_ns[0] = -(1LL << 60); }), 0);
  EXPECT_NE(damaged([](LinkState *s) { s->bus[0].node[1].box[2].frame.length = 200; }), 0);
  EXPECT_NE(damaged([](LinkState *s) { s->board[4].board = -3; }), 0);
  EXPECT_NE(damaged([](LinkState *s) { s->controller.request_board = 9; }), 0);
  EXPECT_EQ(damaged([](LinkState *) {}), 0);
  state[0] = static_cast<char>(state[0] ^ 1);
  EXPECT_NE(hoap2_link_set_state(link, state.data(), state.size()), 0);
  hoap2_link_destroy(link);
}

}  // namespace
