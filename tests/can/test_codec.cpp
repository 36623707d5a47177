// The codec: what goes in comes out, and what is not as the table says is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "frames.hpp"

namespace {

using can_test::Random;

constexpr int kRounds = 200;

TEST(Codec, EveryFrameComesBackAsItWasMade) {
  Random random(1);
  for (int layout = 0; layout < HOAP2_CAN_FRAMES; ++layout) {
    for (int round = 0; round < kRounds; ++round) {
      const auto raw = can_test::random_raw(layout, random);
      const auto counter = static_cast<std::uint8_t>(round * 7);
      hoap2_can_frame_t frame;
      ASSERT_EQ(hoap2_can_encode(layout, counter, raw.data(), &frame), 0);
      EXPECT_EQ(frame.data[0], can_test::crc8(frame));
      hoap2_can_message_t message;
      ASSERT_EQ(hoap2_can_decode(HOAP2_CAN_LAYOUT[layout].bus, &frame, &message), 0);
      EXPECT_EQ(message.layout, layout);
      EXPECT_EQ(message.counter, counter);
      for (int i = 0; i < HOAP2_CAN_LAYOUT[layout].fields; ++i) {
        EXPECT_EQ(message.raw[i], raw[static_cast<std::size_t>(i)]) << layout << " field " << i;
      }
    }
  }
}

TEST(Codec, FieldsDoNotShareBits) {
  Random random(2);
  for (int layout = 0; layout < HOAP2_CAN_FRAMES; ++layout) {
    const hoap2_can_layout_t &l = HOAP2_CAN_LAYOUT[layout];
    for (int changed = 0; changed < l.fields; ++changed) {
      auto raw = can_test::random_raw(layout, random);
      const hoap2_can_field_t &field = HOAP2_CAN_FIELD[l.first_field + changed];
      hoap2_can_frame_t one, other;
      raw[static_cast<std::size_t>(changed)] = field.low;
      hoap2_can_encode(layout, 1, raw.data(), &one);
      raw[static_cast<std::size_t>(changed)] = field.high;
      hoap2_can_encode(layout, 1, raw.data(), &other);
      for (int bit = 16; bit < 8 * l.length; ++bit) {
        const bool inside = bit >= field.first_bit && bit < field.first_bit + field.bits;
        const bool differs = (one.data[bit / 8] ^ other.data[bit / 8]) >> (bit % 8) & 1;
        EXPECT_TRUE(inside || !differs) << layout << " field " << changed << " bit " << bit;
      }
    }
  }
}

TEST(Codec, EveryOtherLengthIsRefused) {
  Random random(3);
  for (int layout = 0; layout < HOAP2_CAN_FRAMES; ++layout) {
    const hoap2_can_frame_t good = can_test::random_frame(layout, random);
    for (int length = 0; length <= 255; ++length) {
      if (length == good.length) continue;
      hoap2_can_frame_t frame = good;
      frame.length = static_cast<std::uint8_t>(length);
      hoap2_can_message_t message;
      EXPECT_EQ(hoap2_can_decode(HOAP2_CAN_LAYOUT[layout].bus, &frame, &message), HOAP2_CAN_REFUSED_LENGTH);
    }
  }
}

// A CRC-8 finds every burst of eight bits: no change of one byte gets through, whatever byte and value.
TEST(Codec, EveryChangeOfOneByteIsRefused) {
  Random random(4);
  for (int layout = 0; layout < HOAP2_CAN_FRAMES; ++layout) {
    const hoap2_can_frame_t good = can_test::random_frame(layout, random);
    for (int byte = 0; byte < good.length; ++byte) {
      for (int change = 1; change < 256; ++change) {
        hoap2_can_frame_t frame = good;
        frame.data[byte] = static_cast<std::uint8_t>(frame.data[byte] ^ change);
        hoap2_can_message_t message;
        ASSERT_EQ(hoap2_can_decode(HOAP2_CAN_LAYOUT[layout].bus, &frame, &message), HOAP2_CAN_REFUSED_CRC)
            << layout << " byte " << byte;
      }
    }
  }
}

TEST(Codec, AFrameUnderAnotherIdentifierIsRefused) {
  Random random(5);
  for (int layout = 0; layout < HOAP2_CAN_FRAMES; ++layout) {
    const hoap2_can_frame_t good = can_test::random_frame(layout, random);
    for (int bit = 0; bit < 11; ++bit) {
      hoap2_can_frame_t frame = good;
      frame.identifier ^= 1U << bit;
      hoap2_can_message_t message;
      EXPECT_NE(hoap2_can_decode(HOAP2_CAN_LAYOUT[layout].bus, &frame, &message), 0);
    }
  }
}

TEST(Codec, UnknownIdentifiersBusesAndFormatsAreRefused) {
  Random random(6);
  const hoap2_can_frame_t good = can_test::random_frame(0, random);
  hoap2_can_message_t message;
  for (const unsigned flag : {HOAP2_CAN_EXTENDED, HOAP2_CAN_REMOTE}) {
    hoap2_can_frame_t frame = good;
    frame.flags = static_cast<std::uint8_t>(frame.flags | flag);
    EXPECT_EQ(hoap2_can_decode(0, &frame, &message), HOAP2_CAN_REFUSED_UNKNOWN);
    EXPECT_EQ(message.layout, -1);
  }
  for (const int bus : {-1, 2, 1000})
    EXPECT_EQ(hoap2_can_decode(bus, &good, &message), HOAP2_CAN_REFUSED_UNKNOWN);
  for (const std::uint32_t identifier : {0x01FU, 0x3FFU, 0x7FFU, 0x800U, 0x1FFFFFFFU, 0xFFFFFFFFU}) {
    hoap2_can_frame_t frame = good;
    frame.identifier = identifier;
    EXPECT_EQ(hoap2_can_decode(0, &frame, &message), HOAP2_CAN_REFUSED_UNKNOWN);
  }
  EXPECT_EQ(hoap2_can_find(0, HOAP2_CAN_K_COMMAND, 6), -1) << "the left leg is not on the right bus";
  EXPECT_EQ(hoap2_can_find(0, -1, 0), -1);
  EXPECT_EQ(hoap2_can_find(7, 0, 0), -1);
}

TEST(Codec, SpareBitsAreZero) {
  Random random(7);
  int seen = 0;
  for (int layout = 0; layout < HOAP2_CAN_FRAMES; ++layout) {
    const hoap2_can_layout_t &l = HOAP2_CAN_LAYOUT[layout];
    for (int bit = l.used_bits; bit < 8 * l.length; ++bit, ++seen) {
      hoap2_can_frame_t frame = can_test::random_frame(layout, random);
      frame.data[bit / 8] = static_cast<std::uint8_t>(frame.data[bit / 8] | 1U << (bit % 8));
      can_test::seal(&frame);
      hoap2_can_message_t message;
      EXPECT_EQ(hoap2_can_decode(l.bus, &frame, &message), HOAP2_CAN_REFUSED_VALUE);
    }
  }
  EXPECT_GT(seen, 0);
}

// Values that the bits could hold and the table does not allow, sealed with a right CRC.
TEST(Codec, ValuesBeyondTheirRangeAreRefusedBothWays) {
  Random random(8);
  int seen = 0;
  for (int layout = 0; layout < HOAP2_CAN_FRAMES; ++layout) {
    const hoap2_can_layout_t &l = HOAP2_CAN_LAYOUT[layout];
    for (int i = 0; i < l.fields; ++i) {
      const hoap2_can_field_t &f = HOAP2_CAN_FIELD[l.first_field + i];
      const std::int64_t most =
          f.kind == HOAP2_CAN_UNSIGNED ? (1LL << f.bits) - 1 : (1LL << (f.bits - 1)) - 1;
      if (f.high == most) continue;
      ++seen;
      auto raw = can_test::random_raw(layout, random);
      raw[static_cast<std::size_t>(i)] = f.high + 1;
      hoap2_can_frame_t frame;
      EXPECT_EQ(hoap2_can_encode(layout, 0, raw.data(), &frame), HOAP2_CAN_REFUSED_VALUE);
      frame = can_test::random_frame(layout, random);
      for (int bit = 0; bit < f.bits; ++bit) {
        const int at = f.first_bit + bit;
        const unsigned mask = 1U << (at % 8);
        const unsigned value = static_cast<unsigned>(static_cast<std::uint32_t>(f.high + 1) >> bit & 1U);
        frame.data[at / 8] = static_cast<std::uint8_t>((frame.data[at / 8] & ~mask) | (value ? mask : 0U));
      }
      can_test::seal(&frame);
      hoap2_can_message_t message;
      EXPECT_EQ(hoap2_can_decode(l.bus, &frame, &message), HOAP2_CAN_REFUSED_VALUE)
          << layout << " field " << i;
    }
  }
  EXPECT_GT(seen, 10);
}

TEST(Codec, EncoderCountsAndSensorReadingsPassExactly) {
  const double count_rad =
      HOAP2_CAN_FIELD[HOAP2_CAN_LAYOUT[hoap2_can_find(0, HOAP2_CAN_K_STATUS, 1)].first_field].lsb * 256;
  const auto &q = HOAP2_CAN_FIELD[HOAP2_CAN_LAYOUT[hoap2_can_find(0, HOAP2_CAN_K_STATUS, 1)].first_field];
  for (int count = -32767; count <= 32767; ++count) {
    const double angle_rad = count_rad * count;  // as the plant quantises
    ASSERT_EQ(hoap2_can_value(&q, hoap2_can_raw(&q, angle_rad)), angle_rad) << count;
  }
  const auto *imu = &HOAP2_CAN_FIELD[HOAP2_CAN_LAYOUT[hoap2_can_find(0, HOAP2_CAN_K_IMU, 4)].first_field];
  for (const int field : {HOAP2_CAN_IMU_GYRO, HOAP2_CAN_IMU_ACCEL}) {
    const double lsb = imu[field].lsb * 1024;
    for (int step = -500; step <= 500; ++step) {
      ASSERT_EQ(hoap2_can_value(&imu[field], hoap2_can_raw(&imu[field], lsb * step)), lsb * step);
    }
  }
}

TEST(Codec, ConversionPullsToTheRangeAndTakesNoNonsense) {
  const hoap2_can_field_t &tau =
      HOAP2_CAN_FIELD[HOAP2_CAN_LAYOUT[hoap2_can_find(0, HOAP2_CAN_K_COMMAND, 1)].first_field +
                      HOAP2_CAN_COMMAND_J_TAU_FF];
  EXPECT_EQ(hoap2_can_raw(&tau, 1e300), tau.high);
  EXPECT_EQ(hoap2_can_raw(&tau, -HUGE_VAL), tau.low);
  EXPECT_EQ(hoap2_can_raw(&tau, std::nan("")), 0);
  EXPECT_EQ(hoap2_can_raw(&tau, 1.4999 * tau.lsb), 1);
  EXPECT_EQ(hoap2_can_raw(&tau, -1.5001 * tau.lsb), -2);
  EXPECT_EQ(hoap2_can_bits_float(hoap2_can_float_bits(-2.5F)), -2.5F);
}

// Bytes behind the payload are not part of the frame.
TEST(Codec, NothingBehindTheDataMatters) {
  Random random(9);
  for (int layout = 0; layout < HOAP2_CAN_FRAMES; ++layout) {
    const hoap2_can_frame_t good = can_test::random_frame(layout, random);
    hoap2_can_frame_t other = good;
    std::memset(other.data + other.length, 0xA5, sizeof other.data - other.length);
    hoap2_can_message_t a, b;
    ASSERT_EQ(hoap2_can_decode(HOAP2_CAN_LAYOUT[layout].bus, &good, &a), 0);
    ASSERT_EQ(hoap2_can_decode(HOAP2_CAN_LAYOUT[layout].bus, &other, &b), 0);
    EXPECT_EQ(std::memcmp(a.raw, b.raw, sizeof a.raw[0] * HOAP2_CAN_LAYOUT[layout].fields), 0);
  }
}

}  // namespace
