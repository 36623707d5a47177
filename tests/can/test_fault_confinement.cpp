// Error counters, error states, bus-off and recovery, as ISO 11898-1 has them.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "can/bus.h"
#include "can/error_counters.h"

namespace {

using namespace hoap2_sim;

constexpr std::int64_t kTick_ns = 1000000, kBit_ns = 1000;

void note(void *order, int node, const hoap2_can_frame_t &frame) {
  if (node == 2) static_cast<std::vector<std::uint32_t> *>(order)->push_back(frame.identifier);
}

hoap2_can_frame_t frame(std::uint32_t identifier, std::uint8_t fill = 0) {
  hoap2_can_frame_t f = {};
  f.identifier = identifier;
  f.length = 8;
  f.flags = HOAP2_CAN_FD | HOAP2_CAN_BRS;
  for (int i = 0; i < 8; ++i) f.data[i] = fill;
  return f;
}

struct Rig {
  BusState bus;
  std::int64_t now_ns = 0;
  std::vector<std::uint32_t> order;  // as node 2 gets them
  explicit Rig(int nodes) {
    bus_init(&bus, 1);
    for (int n = 0; n < nodes; ++n) bus_add_node(&bus, n);
  }
  void advance(std::int64_t by_ns) {
    now_ns += by_ns;
    bus_advance(&bus, now_ns, {&order, note});
  }
};

TEST(FaultConfinement, AnErrorCostsTheSenderEightAndTheReceiversOne) {
  Rig rig(4);
  rig.bus.faults.corrupt = 1.0;
  bus_queue(&rig.bus, 0, frame(1), 0);
  rig.advance(1);  // one transmission, to its end
  EXPECT_EQ(rig.bus.counts.errors, 1);
  EXPECT_EQ(rig.bus.node[0].send_errors, 8);
  for (int n = 1; n < 4; ++n) EXPECT_EQ(rig.bus.node[n].receive_errors, 1) << n;
  EXPECT_EQ(rig.bus.node[0].receive_errors, 0);
}

TEST(FaultConfinement, TheReceiverThatSawItFirstPaysEightMore) {
  Rig rig(4);
  rig.bus.faults.corrupt_at_one = 1.0;
  bus_queue(&rig.bus, 0, frame(1), 0);
  rig.advance(1);
  int sum = 0, most = 0;
  for (int n = 1; n < 4; ++n) {
    sum += rig.bus.node[n].receive_errors;
    most = std::max(most, rig.bus.node[n].receive_errors);
  }
  EXPECT_EQ(most, 9);
  EXPECT_EQ(sum, 11);
}

TEST(FaultConfinement, ASuccessTakesOneBack) {
  Rig rig(2);
  rig.bus.node[0].send_errors = 16;
  rig.bus.node[1].receive_errors = 3;
  for (int i = 0; i < 5; ++i) {
    bus_queue(&rig.bus, 0, frame(1), rig.now_ns);
    rig.advance(kTick_ns);
  }
  EXPECT_EQ(rig.bus.node[0].send_errors, 11);
  EXPECT_EQ(rig.bus.node[1].receive_errors, 0);
}

TEST(FaultConfinement, StatesFollowTheCounters) {
  BusNode node = {};
  node.send_errors = 120;
  send_failed(&node, true);  // 128
  EXPECT_EQ(node.mode, NodeMode::kPassive);
  sent_well(&node);
  EXPECT_EQ(node.mode, NodeMode::kActive);
  node.receive_errors = 127;
  receive_failed(&node, false);
  EXPECT_EQ(node.mode, NodeMode::kPassive);
  received_well(&node);
  EXPECT_EQ(node.receive_errors, 119);
  EXPECT_EQ(node.mode, NodeMode::kActive);
  node.send_errors = 247;
  send_failed(&node, true);  // 255
  EXPECT_EQ(node.mode, NodeMode::kPassive);
  send_failed(&node, true);  // 263
  EXPECT_EQ(node.mode, NodeMode::kOff);
}

TEST(FaultConfinement, ALoneNodeBecomesPassiveAndNeverGoesOff) {
  Rig rig(1);
  bus_queue(&rig.bus, 0, frame(1), 0);
  for (int i = 0; i < 100; ++i) rig.advance(kTick_ns);
  EXPECT_EQ(rig.bus.node[0].send_errors, 128);
  EXPECT_EQ(rig.bus.node[0].mode, NodeMode::kPassive);
  EXPECT_EQ(rig.bus.counts.not_acknowledged, rig.bus.counts.errors);
  EXPECT_EQ(rig.bus.counts.delivered, 0);
  EXPECT_EQ(bus_pending(rig.bus), 1);
  bus_add_node(&rig.bus, 1);
  rig.advance(kTick_ns);
  EXPECT_EQ(rig.bus.counts.delivered, 1) << "someone is there to acknowledge";
}

TEST(FaultConfinement, ThirtyTwoFailuresInARowPutTheSenderOff) {
  Rig rig(3);
  rig.bus.faults.corrupt = 1.0;
  bus_queue(&rig.bus, 0, frame(1), 0);
  int ticks = 0;
  while (rig.bus.node[0].mode != NodeMode::kOff && ticks < 100) {
    rig.advance(kTick_ns / 10);
    ++ticks;
  }
  EXPECT_EQ(rig.bus.counts.errors, 32);
  EXPECT_EQ(rig.bus.node[0].mode, NodeMode::kOff);
  EXPECT_EQ(rig.bus.node[1].mode, NodeMode::kActive) << "32 of them are no reason";
}

// 128 x 11 recessive bits: 1408 us on an idle wire at 1 Mbit/s.
TEST(FaultConfinement, BusOffEndsAfter128TimesElevenRecessiveBits) {
  Rig rig(2);
  rig.bus.node[0].send_errors = 256;
  update_mode(&rig.bus.node[0]);
  ASSERT_EQ(rig.bus.node[0].mode, NodeMode::kOff);
  bus_queue(&rig.bus, 0, frame(1), 0);
  rig.advance(127 * 11 * kBit_ns);
  EXPECT_EQ(rig.bus.node[0].mode, NodeMode::kOff);
  EXPECT_EQ(rig.bus.counts.delivered, 0);
  rig.advance(11 * kBit_ns);
  EXPECT_EQ(rig.bus.node[0].mode, NodeMode::kActive);
  EXPECT_EQ(rig.bus.node[0].send_errors, 0);
  rig.advance(kTick_ns);
  EXPECT_EQ(rig.bus.counts.delivered, 1);
}

// On a busy wire each frame's end is one such sequence.
TEST(FaultConfinement, OnABusyWireEachFramesEndCounts) {
  Rig rig(3);
  rig.bus.node[0].send_errors = 256;
  update_mode(&rig.bus.node[0]);
  rig.bus.babbling_node = 1;
  rig.bus.babbling_identifier = 5;
  while (rig.bus.counts.delivered < 120) rig.advance(10000);
  EXPECT_EQ(rig.bus.node[0].mode, NodeMode::kOff);
  while (rig.bus.counts.delivered < 132) rig.advance(10000);
  EXPECT_EQ(rig.bus.node[0].mode, NodeMode::kActive);
}

TEST(FaultConfinement, APassiveSenderLetsOthersGoFirst) {
  Rig rig(3);
  rig.bus.node[0].send_errors = 200;
  update_mode(&rig.bus.node[0]);
  bus_queue(&rig.bus, 0, frame(1), 0);
  bus_queue(&rig.bus, 0, frame(2), 0);
  bus_queue(&rig.bus, 1, frame(3), 10);
  rig.advance(kTick_ns);
  EXPECT_EQ(rig.order, (std::vector<std::uint32_t>{1, 3, 2}));
}

// Two nodes with one identifier and different data spoil each other until both are off.
TEST(FaultConfinement, TwoSendersOfOneIdentifierPutEachOtherOff) {
  Rig rig(3);
  bus_queue(&rig.bus, 0, frame(1, 0x11), 0);
  bus_queue(&rig.bus, 1, frame(1, 0x22), 0);
  for (int i = 0; i < 4; ++i) rig.advance(kTick_ns);
  EXPECT_EQ(rig.bus.counts.delivered, 0);
  EXPECT_GE(rig.bus.counts.errors, 32);
  Rig same(3);
  bus_queue(&same.bus, 0, frame(1, 0x11), 0);
  bus_queue(&same.bus, 1, frame(1, 0x11), 0);
  same.advance(kTick_ns);
  EXPECT_EQ(same.bus.counts.delivered, 2) << "equal frames are one on the wire";
  EXPECT_EQ(same.bus.counts.errors, 0);
}

TEST(FaultConfinement, ACutWireIsTwoBusesAndHealsAgain) {
  Rig rig(4);
  bus_cut(&rig.bus, true, 0x1);
  bus_queue(&rig.bus, 0, frame(1), 0);
  bus_queue(&rig.bus, 2, frame(2), 0);
  rig.advance(20 * kTick_ns);
  EXPECT_EQ(rig.bus.node[0].mode, NodeMode::kPassive) << "alone: nobody acknowledges";
  EXPECT_EQ(rig.bus.counts.lost[kLostCut], 1) << "sent among the others, and did not reach the first";
  EXPECT_EQ(rig.bus.node[2].send_errors, 0);
  bus_cut(&rig.bus, false, 0x1);
  rig.advance(kTick_ns);
  EXPECT_EQ(rig.bus.counts.delivered, 1);
  EXPECT_EQ(bus_pending(rig.bus), 0);
}

TEST(FaultConfinement, ANodeWithoutPowerNeitherSendsNorAcknowledges) {
  Rig rig(2);
  bus_power(&rig.bus, 1, false);
  bus_queue(&rig.bus, 0, frame(1), 0);
  bus_queue(&rig.bus, 1, frame(2), 0);
  rig.advance(kTick_ns);
  EXPECT_EQ(rig.bus.counts.delivered, 0);
  EXPECT_GT(rig.bus.counts.not_acknowledged, 0);
  EXPECT_EQ(rig.bus.counts.lost[kLostNodeDown], 1);
  bus_power(&rig.bus, 1, true);
  rig.advance(kTick_ns);
  EXPECT_EQ(rig.bus.counts.delivered, 1);
}

}  // namespace
