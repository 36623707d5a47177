// The bus model: who wins, how long a frame takes, and that no frame is lost without a cause.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "can/bus.h"
#include "can/frame_bits.h"
#include "frames.hpp"

namespace {

using namespace hoap2_sim;
using can_test::Random;

constexpr std::int64_t kTick_ns = 1000000;
constexpr std::int64_t kTransceivers_ns = 300;

struct Seen {
  int node;
  hoap2_can_frame_t frame;
};

struct Rig {
  BusState bus;
  std::vector<Seen> seen;

  explicit Rig(int nodes, std::uint64_t seed = 1) {
    bus_init(&bus, seed);
    for (int n = 0; n < nodes; ++n) bus_add_node(&bus, n);
  }
  static void deliver(void *owner, int node, const hoap2_can_frame_t &frame) {
    static_cast<Rig *>(owner)->seen.push_back({node, frame});
  }
  void advance(std::int64_t until_ns) { bus_advance(&bus, until_ns, {this, deliver}); }
  std::vector<std::uint32_t> order(int node) const {
    std::vector<std::uint32_t> identifiers;
    for (const Seen &s : seen) {
      if (s.node == node) identifiers.push_back(s.frame.identifier);
    }
    return identifiers;
  }
};

hoap2_can_frame_t frame(std::uint32_t identifier, int length = 8, std::uint8_t fill = 0x5A) {
  hoap2_can_frame_t f = {};
  f.identifier = identifier;
  f.length = static_cast<std::uint8_t>(length);
  f.flags = HOAP2_CAN_FD | HOAP2_CAN_BRS;
  for (int i = 0; i < length; ++i) f.data[i] = fill;
  return f;
}

std::int64_t length_ns(const hoap2_can_frame_t &f) {
  const FrameBits bits = frame_bits(f);
  return bits.nominal * 1000LL + bits.data * 200LL;
}

TEST(Bus, TheSmallerIdentifierWinsWhoeverAndWheneverItWasQueued) {
  Random random(1);
  for (int round = 0; round < 50; ++round) {
    Rig rig(6);
    std::vector<std::uint32_t> identifiers(12);
    for (auto &id : identifiers) id = static_cast<std::uint32_t>(can_test::pick(random, 0, 0x7FF));
    std::sort(identifiers.begin(), identifiers.end());
    identifiers.erase(std::unique(identifiers.begin(), identifiers.end()), identifiers.end());
    auto queued = identifiers;
    std::shuffle(queued.begin(), queued.end(), random);
    for (const std::uint32_t id : queued)
      bus_queue(&rig.bus, static_cast<int>(can_test::pick(random, 0, 4)), frame(id), 0);
    rig.advance(2 * kTick_ns);
    EXPECT_EQ(rig.order(5), identifiers);
  }
}

TEST(Bus, ABaseFrameBeatsAnExtendedOneWithTheSameElevenBits) {
  Rig rig(3);
  hoap2_can_frame_t extended = frame(0x123U << 18);
  extended.flags |= HOAP2_CAN_EXTENDED;
  bus_queue(&rig.bus, 0, extended, 0);
  bus_queue(&rig.bus, 1, frame(0x123), 0);
  bus_queue(&rig.bus, 1, frame(0x124), 0);
  rig.advance(kTick_ns);
  EXPECT_EQ(rig.order(2), (std::vector<std::uint32_t>{0x123, 0x123U << 18, 0x124}));
}

// The emergency stop waits for the frame that is on the wire, and for nothing else.
TEST(Bus, TheEmergencyStopWaitsForOneFrameAtMost) {
  Rig rig(3);
  rig.bus.babbling_node = 1;
  rig.bus.babbling_identifier = 0x010;
  for (std::uint32_t i = 1; i < 10; ++i) bus_queue(&rig.bus, 2, frame(i, 32), 0);
  bus_queue(&rig.bus, 0, frame(0, 3), 5000);
  rig.advance(kTick_ns);
  ASSERT_GT(rig.bus.counts.frames[0], 0);
  const auto order = rig.order(1);
  EXPECT_EQ(order[0], 1U) << "had begun";
  EXPECT_EQ(order[1], 0U);
}

TEST(Bus, AFrameTakesItsBitsAndTheNextBeginsBehindIt) {
  Rig rig(2);
  const hoap2_can_frame_t first = frame(1, 32, 0x00), second = frame(2, 20, 0x5A);
  bus_queue(&rig.bus, 0, first, 0);
  bus_queue(&rig.bus, 0, second, 0);
  rig.advance(length_ns(first) + kTransceivers_ns - 1);
  EXPECT_TRUE(rig.seen.empty());
  rig.advance(length_ns(first) + kTransceivers_ns);
  EXPECT_EQ(rig.seen.size(), 1U);
  rig.advance(length_ns(first) + length_ns(second) + kTransceivers_ns - 1);
  EXPECT_EQ(rig.seen.size(), 1U);
  rig.advance(length_ns(first) + length_ns(second) + kTransceivers_ns);
  EXPECT_EQ(rig.seen.size(), 2U);
  EXPECT_EQ(rig.bus.counts.busy_ns, length_ns(first) + length_ns(second));
}

TEST(Bus, ANewerFrameTakesThePlaceOfAWaitingOne) {
  Rig rig(2);
  bus_queue(&rig.bus, 0, frame(1, 32), 0);
  bus_queue(&rig.bus, 0, frame(7, 8, 0x11), 0);
  bus_queue(&rig.bus, 0, frame(7, 8, 0x22), 0);
  rig.advance(kTick_ns);
  ASSERT_EQ(rig.seen.size(), 2U);
  EXPECT_EQ(rig.seen[1].frame.data[0], 0x22);
  EXPECT_EQ(rig.bus.counts.lost[kLostSuperseded], 1);
}

TEST(Bus, FramesThatCannotBeAreNotTaken) {
  Rig rig(2);
  bus_queue(&rig.bus, 0, frame(0x800), 0);
  bus_queue(&rig.bus, 0, frame(1, 9), 0);
  bus_queue(&rig.bus, 9, frame(1), 0);
  hoap2_can_frame_t classic = frame(3, 12);
  classic.flags = 0;
  bus_queue(&rig.bus, 0, classic, 0);
  rig.advance(kTick_ns);
  EXPECT_TRUE(rig.seen.empty());
  EXPECT_EQ(rig.bus.counts.lost[kLostBad], 3);
  EXPECT_EQ(rig.bus.counts.lost[kLostNodeDown], 1);
}

// Random frames and every disturbance at once: what was queued is delivered, lost with a cause, or still
// there.
TEST(Bus, NoFrameIsLostWithoutACause) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Rig rig(8, seed);
    rig.bus.faults = {0.05, 0.05, 0.03, 0.02, 0.05, 1700000};
    for (int tick = 0; tick < 400; ++tick) {
      rig.bus.babbling_node = tick > 100 && tick < 130 ? 3 : -1;
      rig.bus.babbling_identifier = 0x015;
      bus_power(&rig.bus, 4, !(tick > 150 && tick < 200));
      bus_cut(&rig.bus, tick > 250 && tick < 300, 0x3);
      const auto frames = can_test::pick(random, 0, 25);
      for (int i = 0; i < frames; ++i) {
        const int layout = static_cast<int>(can_test::pick(random, 0, HOAP2_CAN_FRAMES - 1));
        const int node =
            static_cast<int>(HOAP2_CAN_LAYOUT[layout].identifier % 8);  // one sender an identifier
        bus_queue(&rig.bus, node, can_test::random_frame(layout, random),
                  tick * kTick_ns + can_test::pick(random, 0, kTick_ns - 1));
      }
      rig.advance((tick + 1) * kTick_ns);
      const BusCounts &c = rig.bus.counts;
      std::int64_t lost = 0;
      for (const std::int64_t n : c.lost) lost += n;
      ASSERT_EQ(c.queued, c.delivered + lost + bus_pending(rig.bus)) << "seed " << seed << " tick " << tick;
      ASSERT_LE(c.busy_ns, (tick + 2) * kTick_ns);
    }
    EXPECT_GT(rig.bus.counts.lost[kLostOnTheWay], 0);
    EXPECT_GT(rig.bus.counts.lost[kLostCut], 0);
    EXPECT_GT(rig.bus.counts.lost[kLostNodeDown], 0);
    EXPECT_GT(rig.bus.counts.changed, 0);
    EXPECT_GT(rig.bus.counts.errors, 0);
  }
}

TEST(Bus, SharesOfDisturbancesAreAsAsked) {
  Rig rig(3, 5);
  rig.bus.faults.loss = 0.1;
  constexpr int kFrames = 20000;
  for (int i = 0; i < kFrames; ++i) {
    bus_queue(&rig.bus, 0, frame(5), i * kTick_ns);
    rig.advance((i + 1) * kTick_ns);
  }
  EXPECT_NEAR(static_cast<double>(rig.bus.counts.lost[kLostOnTheWay]) / kFrames, 0.1, 0.01);
  EXPECT_EQ(rig.bus.counts.delivered + rig.bus.counts.lost[kLostOnTheWay], kFrames);
}

TEST(Bus, ALateFrameComesLateAndOthersPassIt) {
  Rig rig(2, 3);
  rig.bus.faults.delay = 1.0;
  rig.bus.faults.delay_ns = 2500000;
  bus_queue(&rig.bus, 0, frame(5), 0);
  rig.advance(kTick_ns);
  rig.bus.faults.delay = 0.0;
  bus_queue(&rig.bus, 0, frame(6), kTick_ns);
  rig.advance(2 * kTick_ns);
  EXPECT_EQ(rig.order(1), std::vector<std::uint32_t>{6});
  rig.advance(3 * kTick_ns);
  EXPECT_EQ(rig.order(1), (std::vector<std::uint32_t>{6, 5}));
}

TEST(Bus, ASavedStateGoesOnTheSame) {
  const auto play = [](Rig *rig, int from, int to) {
    for (int tick = from; tick < to; ++tick) {
      Random random(static_cast<std::uint64_t>(tick));
      for (int i = 0; i < 12; ++i) {
        bus_queue(&rig->bus, i % 5, can_test::random_frame(i * 5, random), tick * kTick_ns);
      }
      rig->advance((tick + 1) * kTick_ns);
    }
  };
  Rig rig(6, 9);
  rig.bus.faults = {0.05, 0.1, 0.05, 0.05, 0.1, 3000000};
  play(&rig, 0, 50);
  const BusState saved = rig.bus;
  rig.seen.clear();
  play(&rig, 50, 100);
  Rig other(1, 77);
  other.bus = saved;
  play(&other, 50, 100);
  ASSERT_EQ(rig.seen.size(), other.seen.size());
  for (std::size_t i = 0; i < rig.seen.size(); ++i) {
    EXPECT_EQ(rig.seen[i].node, other.seen[i].node);
    EXPECT_EQ(rig.seen[i].frame.identifier, other.seen[i].frame.identifier);
  }
  EXPECT_EQ(rig.bus.counts.busy_ns, other.bus.counts.busy_ns);
}

}  // namespace
