// A board: what it does when all is well, and when it goes to its safe mode.
#include <gtest/gtest.h>

#include <cmath>

#include "leg.hpp"

namespace {

using namespace can_test;

TEST(Board, HoldsWhereItIsUntilTheControllerComes) {
  Leg leg;
  for (int i = 0; i < 20; ++i) leg.tick();
  EXPECT_EQ(leg.board.mode, HOAP2_CAN_BOARD_MODE_BOOT);
  for (int j = 0; j < kJoints; ++j) {
    EXPECT_EQ(leg.board.drives.drive_mode[j], HOAP2_DRIVE_MODE_POSITION);
    EXPECT_EQ(leg.board.drives.q_ref_rad[j], kStart_rad);
    EXPECT_DOUBLE_EQ(leg.board.drives.kp_Nm_rad[j], HOAP2_JOINT[j].armature_kgm2 * 500 * 187.5);
    EXPECT_EQ(leg.board.drives.tau_ff_Nm[j], 0.0);
  }
}

TEST(Board, FollowsCommandsAndSettings) {
  Leg leg;
  leg.start();
  leg.follow(kStart_rad + 0.003);
  EXPECT_NEAR(leg.board.drives.q_ref_rad[3], kStart_rad + 0.003, kLsb);
  EXPECT_EQ(leg.board.drives.kp_Nm_rad[0], 1000.0);
  EXPECT_EQ(leg.board.drives.kd_Nms_rad[0], 5.0);
  EXPECT_EQ(leg.board.drives.qd_ref_rad_s[0], 0.0);
  ++leg.counter;
  leg.settings(HOAP2_DRIVE_MODE_TORQUE, 32);  // the rate of the reference, once
  leg.beat();
  EXPECT_EQ(leg.command(kStart_rad + 0.005, 1.5), 0);
  leg.tick();
  EXPECT_NEAR(leg.board.drives.tau_ff_Nm[2], 1.5, 1e-4);
  EXPECT_NEAR(leg.board.drives.qd_ref_rad_s[2], 2.0, 2e-3);
  EXPECT_EQ(leg.board.drives.drive_mode[2], HOAP2_DRIVE_MODE_TORQUE);
}

TEST(Board, AnswersSettings) {
  Leg leg;
  leg.start();
  int answers = 0;
  for (int i = 0; i < leg.out.count; ++i) {
    hoap2_can_message_t m;
    ASSERT_EQ(hoap2_can_decode(kBus, &leg.out.frame[i], &m), 0);
    if (m.kind != HOAP2_CAN_K_ANSWER) continue;
    ++answers;
    EXPECT_EQ(m.raw[HOAP2_CAN_ANSWER_SETTINGS_COUNTER], leg.counter);
  }
  EXPECT_EQ(answers, 1);
}

TEST(Board, OneLostFrameIsBridged) {
  Leg leg;
  leg.start();
  leg.follow(kStart_rad + 0.002);
  leg.tick();
  EXPECT_EQ(leg.board.mode, HOAP2_CAN_BOARD_MODE_FOLLOW);
  EXPECT_NEAR(leg.board.drives.q_ref_rad[0], kStart_rad + 0.002, kLsb);
  leg.counter += 1;
  leg.follow(kStart_rad + 0.006);  // two ticks' way
  EXPECT_EQ(leg.board.mode, HOAP2_CAN_BOARD_MODE_FOLLOW);
}

// Heartbeats end (commands go on), or commands end (heartbeats go on): hold in the fifth tick without them,
// not before.
TEST(Board, HoldsInTheFifthTickWithoutHeartbeatOrCommands) {
  for (const bool beats_end : {true, false}) {
    Leg leg;
    leg.start();
    for (int missing = 1; missing <= HOAP2_CAN_ALIVE_LIMIT_TICKS; ++missing) {
      ASSERT_EQ(leg.board.mode, HOAP2_CAN_BOARD_MODE_FOLLOW) << missing;
      ++leg.counter;
      if (beats_end) leg.command(kStart_rad + 0.001 * missing, 1.0);
      if (!beats_end) leg.beat();
      leg.tick();
    }
    EXPECT_EQ(leg.board.mode, HOAP2_CAN_BOARD_MODE_HOLD);
    EXPECT_EQ(leg.board.holds, 1U);
    const double held_rad = leg.board.drives.q_ref_rad[0];
    EXPECT_EQ(leg.board.drives.tau_ff_Nm[0], 0.0);
    leg.tick();
    EXPECT_EQ(leg.board.drives.q_ref_rad[0], held_rad);
    leg.counter += 2;
    leg.follow(kStart_rad);
    EXPECT_EQ(leg.board.mode, HOAP2_CAN_BOARD_MODE_FOLLOW) << "both are back";
  }
}

// After a long cut the reference is far away: it is approached at the drive's velocity limit.
TEST(Board, ComesBackNoFasterThanTheDrive) {
  Leg leg;
  leg.start();
  for (int i = 0; i < 50; ++i) leg.tick();
  leg.counter += 51;
  const double target_rad = kStart_rad + 0.2;
  leg.follow(target_rad);
  double before_rad = kStart_rad;
  int ticks = 0;
  for (; ticks < 100 && leg.board.drives.q_ref_rad[0] < target_rad - kLsb; ++ticks) {
    const double now_rad = leg.board.drives.q_ref_rad[0];
    EXPECT_LE(now_rad - before_rad, 1e-3 * HOAP2_JOINT[0].velocity_limit_rad_s + HOAP2_RAD_PER_COUNT);
    before_rad = now_rad;
    leg.follow(target_rad);
  }
  EXPECT_GE(ticks, 40);
  EXPECT_LE(ticks, 45);
}

// The first of three comes late, together with the third: their counters tell that two ticks lie between
// them.
TEST(Board, FramesThatComeOneUponTheOtherAreMeasuredByTheirCounters) {
  Leg leg;
  leg.start();
  leg.tick();
  leg.tick();
  EXPECT_EQ(leg.command(kStart_rad + 0.0046, 0.0, leg.counter + 1), 0);
  EXPECT_EQ(leg.command(kStart_rad + 0.0140, 0.0, leg.counter + 3), 0);
  leg.tick();
  EXPECT_LE(leg.board.drives.q_ref_rad[0], kStart_rad + 0.00476 + HOAP2_RAD_PER_COUNT)
      << "the drive is not hurried";
}

TEST(Board, ParametersAreReadWrittenAndRefused) {
  struct Case {
    int operation, parameter, joint;
    float value;
    int result;
    float after;
  };
  const Case cases[] = {
      {HOAP2_CAN_OPERATION_READ, HOAP2_CAN_P_ALIVE_LIMIT_TICKS, 0, 0.0F, HOAP2_CAN_RESULT_OK, 5.0F},
      {HOAP2_CAN_OPERATION_WRITE, HOAP2_CAN_P_ALIVE_LIMIT_TICKS, 0, 3.0F, HOAP2_CAN_RESULT_OK, 3.0F},
      {HOAP2_CAN_OPERATION_WRITE, HOAP2_CAN_P_ALIVE_LIMIT_TICKS, 0, 0.0F, HOAP2_CAN_RESULT_OUT_OF_RANGE,
       3.0F},
      {HOAP2_CAN_OPERATION_WRITE, HOAP2_CAN_P_ALIVE_LIMIT_TICKS, 0, NAN, HOAP2_CAN_RESULT_OUT_OF_RANGE, 3.0F},
      {HOAP2_CAN_OPERATION_WRITE, HOAP2_CAN_P_VELOCITY_LIMIT_RAD_S, 5, 1.0F, HOAP2_CAN_RESULT_OK, 1.0F},
      {HOAP2_CAN_OPERATION_WRITE, HOAP2_CAN_P_VELOCITY_LIMIT_RAD_S, 0, 5.0F, HOAP2_CAN_RESULT_OK, 4.76F},
      {HOAP2_CAN_OPERATION_READ, HOAP2_CAN_P_VELOCITY_LIMIT_RAD_S, 6, 0.0F, HOAP2_CAN_RESULT_UNKNOWN_JOINT,
       0.0F},
      {HOAP2_CAN_OPERATION_WRITE, HOAP2_CAN_P_REFUSED, 0, 0.0F, HOAP2_CAN_RESULT_READ_ONLY, 0.0F},
      {HOAP2_CAN_OPERATION_READ, 200, 0, 0.0F, HOAP2_CAN_RESULT_UNKNOWN_PARAMETER, 0.0F},
  };
  Leg leg;
  leg.start();
  int counter = 0;
  for (const Case &c : cases) {
    const auto request =
        can_test::frame_of(kBus, HOAP2_CAN_K_REQUEST, kNode, ++counter, [&](std::int32_t *raw) {
          raw[HOAP2_CAN_REQUEST_OPERATION] = c.operation;
          raw[HOAP2_CAN_REQUEST_JOINT] = c.joint;
          raw[HOAP2_CAN_REQUEST_PARAMETER] = c.parameter;
          raw[HOAP2_CAN_REQUEST_VALUE] = hoap2_can_float_bits(c.value);
        });
    ASSERT_EQ(leg.receive(request), 0);
    leg.follow(kStart_rad);
    bool replied = false;
    for (int i = 0; i < leg.out.count; ++i) {
      hoap2_can_message_t m;
      ASSERT_EQ(hoap2_can_decode(kBus, &leg.out.frame[i], &m), 0);
      if (m.kind != HOAP2_CAN_K_REPLY) continue;
      replied = true;
      EXPECT_EQ(m.raw[HOAP2_CAN_REPLY_RESULT], c.result) << counter;
      EXPECT_EQ(hoap2_can_bits_float(m.raw[HOAP2_CAN_REPLY_VALUE]), c.after) << counter;
    }
    EXPECT_TRUE(replied) << counter;
  }
}

TEST(Board, ASensorThatStandsStillIsNotSentAgain) {
  Leg leg;
  leg.start();
  leg.out.count = 0;
  hoap2_can_board_tick(&leg.board, &leg.sensed, &leg.out);
  for (int i = 0; i < leg.out.count; ++i)
    EXPECT_NE(leg.out.frame[i].identifier >> 5, unsigned{HOAP2_CAN_K_STATUS});
}

}  // namespace
