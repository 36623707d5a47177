// A board: what it refuses, and the emergency stop.
#include <gtest/gtest.h>

#include <cmath>

#include "leg.hpp"

namespace {

using namespace can_test;

TEST(Board, RefusesCommandsBeyondTheStopsAndCountsThem) {
  Leg leg;
  leg.start();
  for (const double q_rad :
       {HOAP2_JOINT[0].limit_hard_rad[1] + 0.01, HOAP2_JOINT[0].limit_hard_rad[0] - 0.01}) {
    ++leg.counter;
    leg.beat();
    EXPECT_EQ(leg.command(q_rad), HOAP2_CAN_REFUSED_LIMIT);
    leg.tick();
    EXPECT_NEAR(leg.board.drives.q_ref_rad[0], kStart_rad, kLsb);
  }
  EXPECT_EQ(leg.board.refused[HOAP2_CAN_REFUSED_LIMIT], 2U);
  bool told = false;
  for (int i = 0; i < leg.out.count; ++i) {
    hoap2_can_message_t m;
    ASSERT_EQ(hoap2_can_decode(kBus, &leg.out.frame[i], &m), 0);
    if (m.kind == HOAP2_CAN_K_STATUS) told = m.raw[HOAP2_CAN_STATUS_J_FAULT] & 1;
  }
  EXPECT_TRUE(told);
}

TEST(Board, RefusesAJumpThatTheDriveCannotFollow) {
  Leg leg;
  leg.start();
  ++leg.counter;
  leg.beat();
  EXPECT_EQ(leg.command(kStart_rad + 0.05), HOAP2_CAN_REFUSED_LIMIT);
  EXPECT_EQ(leg.command(kStart_rad + 0.0047), 0) << "as far as a tick goes";
}

TEST(Board, RefusesStaleCounters) {
  Leg leg;
  leg.start();
  for (int i = 0; i < 10; ++i) leg.follow(kStart_rad);
  const auto refused = [&] { return leg.board.refused[HOAP2_CAN_REFUSED_COUNTER]; };
  EXPECT_EQ(leg.command(kStart_rad, 0.0, leg.counter), HOAP2_CAN_REFUSED_COUNTER) << "again";
  EXPECT_EQ(leg.command(kStart_rad, 0.0, leg.counter - 3), HOAP2_CAN_REFUSED_COUNTER) << "old";
  EXPECT_EQ(leg.command(kStart_rad, 0.0, (leg.counter + HOAP2_CAN_COUNTER_WINDOW + 1) & 0xFF),
            HOAP2_CAN_REFUSED_COUNTER);
  EXPECT_EQ(leg.receive(can_test::beat(kBus, leg.counter)), HOAP2_CAN_REFUSED_COUNTER);
  EXPECT_EQ(refused(), 4U);
}

TEST(Board, RefusesAnotherProtocol) {
  Leg leg;
  leg.tick();
  leg.counter = 1;
  EXPECT_EQ(leg.command(kStart_rad), HOAP2_CAN_REFUSED_VERSION) << "nobody said which protocol";
  EXPECT_EQ(leg.beat(HOAP2_CAN_PROTOCOL ^ 1), HOAP2_CAN_REFUSED_VERSION);
  EXPECT_EQ(leg.settings(), HOAP2_CAN_REFUSED_VERSION);
  leg.tick();
  EXPECT_EQ(leg.board.mode, HOAP2_CAN_BOARD_MODE_BOOT);
  EXPECT_EQ(leg.board.refused[HOAP2_CAN_REFUSED_VERSION], 3U);
  Leg other;
  other.start();
  ++other.counter;
  EXPECT_EQ(other.beat(HOAP2_CAN_PROTOCOL ^ 1), HOAP2_CAN_REFUSED_VERSION);
  EXPECT_EQ(other.command(kStart_rad), HOAP2_CAN_REFUSED_VERSION) << "the controller was exchanged";
}

TEST(Board, RefusesItsOwnIdentifiersAndLetsOthersPass) {
  Leg leg;
  leg.start();
  const auto nothing = [](std::int32_t *) {};
  EXPECT_EQ(leg.receive(can_test::frame_of(kBus, HOAP2_CAN_K_STATUS, kNode, 9, nothing)),
            HOAP2_CAN_REFUSED_NODE);
  EXPECT_EQ(leg.receive(can_test::frame_of(kBus, HOAP2_CAN_K_STATUS, 2, 9, nothing)), 0);
  hoap2_can_frame_t spoiled = can_test::frame_of(kBus, HOAP2_CAN_K_STATUS, 2, 9, nothing);
  spoiled.data[3] ^= 1;
  EXPECT_EQ(leg.receive(spoiled), 0) << "of another board: not looked at";
  EXPECT_EQ(leg.receive(can_test::frame_of(kBus, HOAP2_CAN_K_COMMAND, 2, 9, nothing)), 0) << "for the arm";
  EXPECT_NEAR(leg.board.drives.q_ref_rad[0], kStart_rad, kLsb);
  hoap2_can_frame_t frame = can_test::beat(kBus, 99);
  frame.identifier = 0x2E6;  // the answer of the left leg does not exist on the right bus
  EXPECT_EQ(leg.receive(frame), HOAP2_CAN_REFUSED_UNKNOWN);
}

TEST(Board, EmergencyStopDampsUntilThePowerIsSwitched) {
  Leg leg;
  leg.start();
  EXPECT_EQ(leg.receive(can_test::frame_of(kBus, HOAP2_CAN_K_STOP, 2, 0, [](std::int32_t *) {})), 0)
      << "from the arm";
  leg.tick();
  for (int i = 0; i < 30; ++i) leg.follow(kStart_rad);
  EXPECT_EQ(leg.board.mode, HOAP2_CAN_BOARD_MODE_STOPPED);
  EXPECT_EQ(leg.board.drives.drive_mode[0], HOAP2_DRIVE_MODE_DAMPED_TORQUE);
  EXPECT_EQ(leg.board.drives.tau_ff_Nm[0], 0.0);
  hoap2_can_board_init(&leg.board, kBoard);
  EXPECT_EQ(leg.board.mode, HOAP2_CAN_BOARD_MODE_BOOT);
}

TEST(Board, AnEmergencyStopCountsWhoeverSendsIt) {
  for (const int node : {0, 1, 5}) {  // the controller, the board's own identifier, head and hands
    Leg leg;
    leg.start();
    leg.receive(can_test::frame_of(kBus, HOAP2_CAN_K_STOP, node, 77, [](std::int32_t *) {}));
    leg.tick();
    EXPECT_EQ(leg.board.mode, HOAP2_CAN_BOARD_MODE_STOPPED) << node;
  }
  Leg leg;
  leg.start();
  hoap2_can_frame_t spoiled = can_test::frame_of(kBus, HOAP2_CAN_K_STOP, 0, 1, [](std::int32_t *) {});
  spoiled.data[2] ^= 1;
  EXPECT_EQ(leg.receive(spoiled), HOAP2_CAN_REFUSED_CRC);
  leg.follow(kStart_rad);
  EXPECT_EQ(leg.board.mode, HOAP2_CAN_BOARD_MODE_FOLLOW);
}

}  // namespace
