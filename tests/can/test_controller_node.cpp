// The controller's side: frames of its outputs, inputs from frames, and what it makes of silence and of
// strangers.
#include <gtest/gtest.h>

#include <map>

#include "can/board.h"
#include "can/controller_node.h"
#include "frames.hpp"
#include "hoap2/generated/robot_model.h"

namespace {

// All boards on wires without delay or loss; what each tick carries may be changed by a test.
struct Robot {
  hoap2_can_controller_t controller;
  hoap2_can_board_t board[HOAP2_CAN_BOARDS];
  hoap2_outputs_t outputs = {};
  hoap2_inputs_t inputs = {};
  int silent = -1;  // a board that is not heard
  int sample = 0;
  int kinds[HOAP2_CAN_KINDS] = {};  // frames of the controller, by message, in the last tick
  bool lose_answers = false;

  Robot() {
    hoap2_can_controller_init(&controller);
    for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) hoap2_can_board_init(&board[b], b);
    for (int j = 0; j < HOAP2_JOINTS; ++j) {
      outputs.drive_mode[j] = HOAP2_DRIVE_MODE_POSITION;
      outputs.kp_Nm_rad[j] = 1753.125;
      outputs.kd_Nms_rad[j] = 9.35;
    }
  }
  hoap2_can_sensed_t sensed(int b) const {
    hoap2_can_sensed_t s = {};
    s.sample = sample;
    for (int j = 0; j < HOAP2_CAN_BOARD_JOINTS; ++j) s.q_enc_rad[j] = 0.01 * b + 0.001 * j;
    for (int i = 0; i < 4; ++i) s.cell_force_N[i] = 10.0 * b + i;
    for (int i = 0; i < 3; ++i) s.gyro_S_rad_s[i] = 0.1 * i, s.accel_S_m_s2[i] = 9.0 + i;
    return s;
  }
  void tick() {
    ++sample;
    hoap2_can_outbox_t from_board[HOAP2_CAN_BOARDS], out[HOAP2_CAN_BUSES];
    for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) {
      from_board[b].count = 0;
      const hoap2_can_sensed_t s = sensed(b);
      hoap2_can_board_tick(&board[b], &s, &from_board[b]);
    }
    out[0].count = out[1].count = 0;
    hoap2_can_controller_send(&controller, &outputs, out);
    for (int &count : kinds) count = 0;
    for (int bus = 0; bus < HOAP2_CAN_BUSES; ++bus) {
      for (int i = 0; i < out[bus].count; ++i) {
        ++kinds[out[bus].frame[i].identifier >> 5];
        for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) {
          if (HOAP2_CAN_BOARD[b].bus == bus) hoap2_can_board_receive(&board[b], &out[bus].frame[i]);
        }
      }
    }
    for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) {
      for (int i = 0; b != silent && i < from_board[b].count; ++i) {
        if (lose_answers && from_board[b].frame[i].identifier >> 5 == unsigned{HOAP2_CAN_K_ANSWER}) continue;
        hoap2_can_controller_receive(&controller, HOAP2_CAN_BOARD[b].bus, &from_board[b].frame[i]);
      }
    }
    hoap2_can_controller_inputs(&controller, &inputs);
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) tick();
  }
};

TEST(ControllerNode, MeasurementsArriveAtTheirPlaces) {
  Robot robot;
  robot.run(30);
  EXPECT_EQ(robot.controller.state, HOAP2_CAN_CONTROLLER_STATE_RUN);
  for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) {
    const hoap2_can_board_data_t &data = HOAP2_CAN_BOARD[b];
    for (int j = 0; j < data.joints; ++j) {
      EXPECT_NEAR(robot.inputs.q_enc_rad[data.joint[j]], 0.01 * b + 0.001 * j, 2e-7);
    }
  }
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(robot.inputs.cell_force_N[i], 10.0 * HOAP2_CAN_B_R_FOOT + i, 5e-4);
    EXPECT_NEAR(robot.inputs.cell_force_N[4 + i], 10.0 * HOAP2_CAN_B_L_FOOT + i, 5e-4);
  }
  EXPECT_NEAR(robot.inputs.accel_S_m_s2[2], 11.0, 1e-3);
  EXPECT_NEAR(robot.inputs.gyro_S_rad_s[1], 0.1, 1e-5);
  for (const std::uint32_t refused : robot.controller.refused) EXPECT_EQ(refused, 0U);
}

TEST(ControllerNode, CommandsReachTheirJoints) {
  Robot robot;
  for (int j = 0; j < HOAP2_JOINTS; ++j) {
    const double *soft = HOAP2_JOINT[j].limit_soft_rad;
    robot.outputs.q_ref_rad[j] = 0.5 * (soft[0] + soft[1]) + 0.001 * j;
    robot.outputs.tau_ff_Nm[j] = 0.01 * j;
  }
  robot.run(2000);  // the boards approach the references at the drives' speed
  for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) {
    const hoap2_can_board_data_t &data = HOAP2_CAN_BOARD[b];
    for (int j = 0; j < data.joints; ++j) {
      const hoap2_can_drives_t &drives = robot.board[b].drives;
      EXPECT_NEAR(drives.q_ref_rad[j], robot.outputs.q_ref_rad[data.joint[j]], 2e-7);
      EXPECT_NEAR(drives.tau_ff_Nm[j], robot.outputs.tau_ff_Nm[data.joint[j]], 1.1e-4);
      EXPECT_EQ(drives.kp_Nm_rad[j], 1753.125);
      EXPECT_NEAR(drives.kd_Nms_rad[j], 9.35, 1e-12);
    }
    EXPECT_EQ(robot.board[b].mode, HOAP2_CAN_BOARD_MODE_FOLLOW);
  }
  EXPECT_EQ(robot.controller.clipped, 0U);
}

TEST(ControllerNode, SettingsGoOnChangeEveryHundredTicksAndUntilAnswered) {
  Robot robot;
  robot.run(10);
  int sent = 0;
  for (int i = 0; i < 100; ++i, sent += robot.kinds[HOAP2_CAN_K_SETTINGS]) robot.tick();
  EXPECT_NEAR(sent, 6, 1) << "one for each of the six drive boards";
  robot.outputs.kp_Nm_rad[HOAP2_J_L_KNEE] = 1000.0;
  robot.tick();
  EXPECT_GE(robot.kinds[HOAP2_CAN_K_SETTINGS], 1);
  robot.run(3);
  EXPECT_EQ(robot.board[HOAP2_CAN_B_L_LEG].drives.kp_Nm_rad[3], 1000.0);
  EXPECT_EQ(robot.controller.peer[HOAP2_CAN_B_L_LEG].settings_open, 0);
  robot.lose_answers = true;
  robot.outputs.kp_Nm_rad[HOAP2_J_L_KNEE] = 1100.0;
  sent = 0;
  for (int i = 0; i < 40; ++i, sent += robot.kinds[HOAP2_CAN_K_SETTINGS]) robot.tick();
  EXPECT_GE(sent, 7) << "again and again";
  EXPECT_LE(sent, 30);
}

// sensor_tick is what the controller's watchdog looks at: it stands still while one board is not heard.
TEST(ControllerNode, ASilentBoardStopsTheSensorTickAtOnce) {
  for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) {
    Robot robot;
    robot.run(40);
    const int before = robot.inputs.sensor_tick;
    robot.tick();
    EXPECT_EQ(robot.inputs.sensor_tick, before + 1);
    robot.silent = b;
    int moved = 0;
    for (int i = 0, last = robot.inputs.sensor_tick; i < 90; ++i, last = robot.inputs.sensor_tick) {
      robot.tick();
      moved += robot.inputs.sensor_tick != last;
    }
    // head and hands speak every ten ticks, and are given six of them less the watchdog's own five
    const bool slow = HOAP2_CAN_BOARD[b].kind == HOAP2_CAN_BOARD_RC;
    EXPECT_GE(moved, slow ? 45 : 0) << b;
    EXPECT_LE(moved, slow ? 55 : 0) << b;
  }
}

TEST(ControllerNode, ALostFrameIsBridgedAndOneTickOld) {
  Robot robot;
  robot.run(40);
  const int before = robot.inputs.sensor_tick;
  robot.silent = HOAP2_CAN_B_L_FOOT;
  robot.tick();
  EXPECT_EQ(robot.inputs.sensor_tick, before);
  EXPECT_NEAR(robot.inputs.cell_force_N[4], 10.0 * HOAP2_CAN_B_L_FOOT, 5e-4) << "held";
  robot.silent = -1;
  robot.tick();
  EXPECT_EQ(robot.inputs.sensor_tick, before + 2);
}

TEST(ControllerNode, RefusesMeasurementsOfAnotherProtocolAndOldOnes) {
  Robot robot;
  robot.run(20);
  const auto status = [&](int counter) {
    return can_test::frame_of(0, HOAP2_CAN_K_STATUS, 1, counter, [](std::int32_t *) {});
  };
  const int counter = robot.controller.peer[0].measured.counter;
  const auto receive = [&](const hoap2_can_frame_t &frame) {
    return hoap2_can_controller_receive(&robot.controller, 0, &frame);
  };
  EXPECT_EQ(receive(status(counter)), HOAP2_CAN_REFUSED_COUNTER);
  EXPECT_EQ(receive(status(counter - 2)), HOAP2_CAN_REFUSED_COUNTER);
  const auto other = can_test::frame_of(0, HOAP2_CAN_K_BOARD_BEAT, 1, 200, [](std::int32_t *raw) {
    raw[HOAP2_CAN_BOARD_BEAT_PROTOCOL] = HOAP2_CAN_PROTOCOL ^ 0x8000;
  });
  EXPECT_EQ(receive(other), HOAP2_CAN_REFUSED_VERSION);
  EXPECT_EQ(receive(status(counter + 1)), HOAP2_CAN_REFUSED_VERSION);
  const auto left_on_right = can_test::frame_of(1, HOAP2_CAN_K_STATUS, 6, counter + 1, [](std::int32_t *) {});
  EXPECT_EQ(receive(left_on_right), HOAP2_CAN_REFUSED_UNKNOWN) << "a board of the other bus";
}

TEST(ControllerNode, TwoControllersOnOneBusBothFallSilent) {
  Robot robot;
  robot.run(20);
  for (int i = 0; i < 3; ++i) {
    const hoap2_can_frame_t frame = can_test::beat(1, i);
    EXPECT_EQ(hoap2_can_controller_receive(&robot.controller, 1, &frame), HOAP2_CAN_REFUSED_NODE);
  }
  EXPECT_EQ(robot.controller.state, HOAP2_CAN_CONTROLLER_STATE_DOUBLED);
  const int before = robot.inputs.sensor_tick;
  robot.run(6);
  for (const int count : robot.kinds) EXPECT_EQ(count, 0);
  EXPECT_EQ(robot.inputs.sensor_tick, before) << "its own watchdog sees nothing new";
  for (const hoap2_can_board_t &board : robot.board) EXPECT_EQ(board.mode, HOAP2_CAN_BOARD_MODE_HOLD);
}

TEST(ControllerNode, ABoardsEmergencyStopIsRelayedToTheOtherBus) {
  Robot robot;
  robot.run(20);
  hoap2_can_board_stop(&robot.board[HOAP2_CAN_B_R_FOOT]);
  robot.run(3);
  for (const hoap2_can_board_t &board : robot.board) EXPECT_EQ(board.mode, HOAP2_CAN_BOARD_MODE_STOPPED);
  EXPECT_EQ(robot.controller.state, HOAP2_CAN_CONTROLLER_STATE_STOPPED);
  EXPECT_EQ(robot.kinds[HOAP2_CAN_K_COMMAND], 0);
  EXPECT_GT(robot.kinds[HOAP2_CAN_K_STOP], 0);
}

TEST(ControllerNode, ParametersOfABoardCanBeAskedFor) {
  Robot robot;
  robot.run(10);
  EXPECT_EQ(hoap2_can_controller_request(&robot.controller, HOAP2_CAN_B_WAIST, HOAP2_CAN_OPERATION_WRITE,
                                         HOAP2_CAN_P_ALIVE_LIMIT_TICKS, 0, 7.0F),
            0);
  EXPECT_EQ(hoap2_can_controller_request(&robot.controller, HOAP2_CAN_B_WAIST, 0, 0, 0, 0.0F), 1)
      << "one at a time";
  EXPECT_EQ(hoap2_can_controller_request(&robot.controller, HOAP2_CAN_BOARDS, 0, 0, 0, 0.0F), 1);
  robot.run(3);
  const hoap2_can_peer_t &waist = robot.controller.peer[HOAP2_CAN_B_WAIST];
  EXPECT_EQ(waist.replies, 1);
  EXPECT_EQ(waist.reply_raw[HOAP2_CAN_REPLY_RESULT], HOAP2_CAN_RESULT_OK);
  EXPECT_EQ(hoap2_can_bits_float(waist.reply_raw[HOAP2_CAN_REPLY_VALUE]), 7.0F);
  EXPECT_EQ(robot.board[HOAP2_CAN_B_WAIST].alive_limit_ticks, 7);
}

TEST(ControllerNode, ValuesThatTheCodingCannotHoldAreCounted) {
  Robot robot;
  robot.run(5);
  robot.outputs.tau_ff_Nm[0] = 1e9;
  robot.outputs.kp_Nm_rad[1] = 1e9;
  robot.tick();
  EXPECT_EQ(robot.controller.clipped, 2U);
}

}  // namespace
