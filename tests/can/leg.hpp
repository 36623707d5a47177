// The right leg's board with frames as the controller would send them.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "can/board.h"
#include "frames.hpp"
#include "hoap2/generated/robot_model.h"
#include "hoap2/generated/signals.h"

namespace can_test {

constexpr int kBoard = HOAP2_CAN_B_R_LEG, kBus = 0, kNode = 1, kJoints = 6;
inline const double kLsb = HOAP2_RAD_PER_COUNT / 256.0;
constexpr double kStart_rad = 0.1;

struct Leg {
  hoap2_can_board_t board;
  hoap2_can_sensed_t sensed = {};
  hoap2_can_outbox_t out = {};
  int counter = 0;

  Leg() {
    hoap2_can_board_init(&board, kBoard);
    for (double &q_rad : sensed.q_enc_rad) q_rad = kStart_rad;
  }
  int receive(const hoap2_can_frame_t &frame) { return hoap2_can_board_receive(&board, &frame); }
  void tick() {
    ++sensed.sample;
    out.count = 0;
    hoap2_can_board_tick(&board, &sensed, &out);
  }
  int command(double q_rad, double tau_Nm = 0.0, int at_counter = -1) {
    return receive(can_test::frame_of(
        kBus, HOAP2_CAN_K_COMMAND, kNode, at_counter < 0 ? counter : at_counter, [&](std::int32_t *raw) {
          for (int j = 0; j < kJoints; ++j) {
            raw[2 * j] = static_cast<std::int32_t>(std::lround(q_rad / kLsb));
            raw[2 * j + 1] = static_cast<std::int32_t>(std::lround(tau_Nm / 0.0002));
          }
        }));
  }
  int settings(int mode = HOAP2_DRIVE_MODE_POSITION, int scale = 0) {
    return receive(can_test::frame_of(kBus, HOAP2_CAN_K_SETTINGS, kNode, counter, [&](std::int32_t *raw) {
      for (int j = 0; j < kJoints; ++j) {
        raw[4 * j] = mode;
        raw[4 * j + 1] = scale;
        raw[4 * j + 2] = 8000;  // 1000 N m/rad
        raw[4 * j + 3] = 5000;  // 5 N m s/rad
      }
    }));
  }
  int beat(int protocol = HOAP2_CAN_PROTOCOL) { return receive(can_test::beat(kBus, counter, protocol)); }
  // One good tick: heartbeat and command, then the board's own.
  void follow(double q_rad) {
    ++counter;
    ASSERT_EQ(beat(), 0);
    ASSERT_EQ(command(q_rad), 0);
    tick();
  }
  void start() {
    tick();
    ++counter;
    ASSERT_EQ(beat(), 0);
    ASSERT_EQ(settings(), 0);
    ASSERT_EQ(command(kStart_rad), 0);
    tick();
    ASSERT_EQ(board.mode, HOAP2_CAN_BOARD_MODE_FOLLOW);
  }
};

}  // namespace can_test
