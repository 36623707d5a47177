// The bytes of FMI-LS-BUS operations: golden ones, round trips, and whatever else may arrive.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "fmu/ls_bus/can_operations.h"

namespace {

using Bytes = std::vector<uint8_t>;
using Operation = hoap2_ls_operation_t;

Bytes written(const Operation& operation) {
  Bytes out(HOAP2_LS_LARGEST_OPERATION);
  size_t size = 0;
  EXPECT_EQ(0, hoap2_ls_write(&operation, out.data(), out.size(), &size));
  out.resize(size);
  return out;
}

Operation transmit(uint32_t identifier, const Bytes& data) {
  Operation operation{};
  operation.code = HOAP2_LS_CAN_TRANSMIT;
  operation.identifier = identifier;
  operation.length = static_cast<uint16_t>(data.size());
  std::copy(data.begin(), data.end(), operation.data);
  return operation;
}

Operation of_code(uint32_t code, uint8_t kind = 0, uint32_t value = 0) {
  Operation operation{};
  operation.code = code;
  operation.kind = kind;
  operation.value = value;
  return operation;
}

// Bytes that the standard's own headers make.
TEST(LsBusOperations, GoldenBytes) {
  EXPECT_EQ((Bytes{0x10, 0, 0, 0, 0x12, 0, 0, 0, 0x23, 0x01, 0, 0, 0, 0, 2, 0, 1, 2}),
            written(transmit(0x123, {1, 2})));
  EXPECT_EQ((Bytes{0x40, 0, 0, 0, 0x0d, 0, 0, 0, 0x01, 0x20, 0xa1, 0x07, 0}),
            written(of_code(HOAP2_LS_CONFIGURATION, HOAP2_LS_CAN_BAUDRATE, 500000)));
  EXPECT_EQ((Bytes{0x40, 0, 0, 0, 0x0a, 0, 0, 0, 4, 1}),
            written(of_code(HOAP2_LS_CONFIGURATION, HOAP2_LS_ARBITRATION_LOST_BEHAVIOR,
                            HOAP2_LS_BUFFER_AND_RETRANSMIT)));
  Operation confirm = of_code(HOAP2_LS_CONFIRM);
  confirm.identifier = 0x123;
  EXPECT_EQ((Bytes{0x20, 0, 0, 0, 0x0c, 0, 0, 0, 0x23, 0x01, 0, 0}), written(confirm));
  EXPECT_EQ((Bytes{0x41, 0, 0, 0, 9, 0, 0, 0, 3}), written(of_code(HOAP2_LS_STATUS, HOAP2_LS_BUS_OFF)));
  EXPECT_EQ((Bytes{0x42, 0, 0, 0, 8, 0, 0, 0}), written(of_code(HOAP2_LS_WAKEUP)));

  const Bytes unknown = {0xff, 0, 0, 0, 8, 0, 0, 0};
  size_t at = 0;
  Operation answer;
  ASSERT_EQ(HOAP2_LS_READ_REFUSED, hoap2_ls_read(unknown.data(), unknown.size(), &at, &answer));
  EXPECT_EQ(8u, at);
  EXPECT_EQ((Bytes{0x01, 0, 0, 0, 0x12, 0, 0, 0, 8, 0, 0xff, 0, 0, 0, 8, 0, 0, 0}), written(answer));
}

class Dice {
 public:
  explicit Dice(uint32_t seed) : engine_(seed) {}
  uint32_t below(uint32_t limit) { return std::uniform_int_distribution<uint32_t>(0, limit - 1)(engine_); }
  uint8_t toss() { return static_cast<uint8_t>(below(2)); }

  Operation operation() {
    static const uint32_t kCodes[] = {HOAP2_LS_FORMAT_ERROR, HOAP2_LS_CAN_TRANSMIT,  HOAP2_LS_CAN_FD_TRANSMIT,
                                      HOAP2_LS_CONFIRM,      HOAP2_LS_ARBITRATION_LOST, HOAP2_LS_BUS_ERROR,
                                      HOAP2_LS_CONFIGURATION, HOAP2_LS_STATUS,       HOAP2_LS_WAKEUP};
    static const uint16_t kFd[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
    Operation o = of_code(kCodes[below(9)]);
    const bool is_can = o.code == HOAP2_LS_CAN_TRANSMIT, is_fd = o.code == HOAP2_LS_CAN_FD_TRANSMIT;
    if (is_can || is_fd) {
      o.extended = toss();
      o.identifier = below(o.extended ? 1u << 29 : 1u << 11);
      o.length = is_fd ? kFd[below(16)] : static_cast<uint16_t>(below(9));
      if (is_can) o.remote = toss();
      if (is_fd) o.bit_rate_switch = toss(), o.error_passive = toss();
    } else if (o.code == HOAP2_LS_FORMAT_ERROR) {
      o.length = static_cast<uint16_t>(below(65));
    } else if (o.code == HOAP2_LS_CONFIGURATION) {
      o.kind = static_cast<uint8_t>(1 + below(4));
      o.value = o.kind == HOAP2_LS_ARBITRATION_LOST_BEHAVIOR ? 1 + below(2) : 1 + below(8000000);
    } else if (o.code == HOAP2_LS_STATUS) {
      o.kind = static_cast<uint8_t>(1 + below(3));
    } else if (o.code != HOAP2_LS_WAKEUP) {
      o.identifier = below(1u << 29);
    }
    if (o.code == HOAP2_LS_BUS_ERROR) {
      o.error_code = static_cast<uint8_t>(1 + below(6));
      o.error_flag = static_cast<uint8_t>(1 + below(2));
      o.is_sender = toss();
    }
    for (int i = 0; i < o.length; ++i) o.data[i] = static_cast<uint8_t>(below(256));
    return o;
  }

 private:
  std::mt19937 engine_;
};

bool equal(const Operation& a, const Operation& b) {
  return a.code == b.code && a.identifier == b.identifier && a.value == b.value && a.length == b.length &&
         a.extended == b.extended && a.remote == b.remote && a.bit_rate_switch == b.bit_rate_switch &&
         a.error_passive == b.error_passive && a.error_code == b.error_code && a.error_flag == b.error_flag &&
         a.is_sender == b.is_sender && a.kind == b.kind && std::equal(a.data, a.data + HOAP2_LS_DATA_BYTES, b.data);
}

TEST(LsBusOperations, WhatIsWrittenIsRead) {
  Dice dice(1);
  for (int round = 0; round < 2000; ++round) {
    std::vector<Operation> operations;
    Bytes bytes(HOAP2_LS_LARGEST_OPERATION * 8);
    size_t size = 0;
    for (uint32_t i = 0; i <= dice.below(8); ++i) {
      operations.push_back(dice.operation());
      ASSERT_EQ(0, hoap2_ls_write(&operations.back(), bytes.data(), bytes.size(), &size));
    }
    size_t at = 0;
    Operation read;
    for (const Operation& operation : operations) {
      ASSERT_EQ(HOAP2_LS_READ_OPERATION, hoap2_ls_read(bytes.data(), size, &at, &read));
      ASSERT_TRUE(equal(operation, read));
    }
    EXPECT_EQ(HOAP2_LS_READ_END, hoap2_ls_read(bytes.data(), size, &at, &read));
    EXPECT_EQ(size, at);
  }
}

// Reads to the end; each operation and each answer can be written again. Returns how many were operations.
int read_all(const Bytes& bytes) {
  int operations = 0;
  size_t at = 0;
  Operation read;
  for (size_t turns = 0; turns <= bytes.size(); ++turns) {
    const size_t before = at;
    const hoap2_ls_read_t result = hoap2_ls_read(bytes.data(), bytes.size(), &at, &read);
    if (result == HOAP2_LS_READ_END) return operations;
    EXPECT_GE(at, before + 1);
    EXPECT_LE(at, bytes.size());
    operations += result == HOAP2_LS_READ_OPERATION;
    if (read.code != 0) {
      EXPECT_FALSE(written(read).empty());
    }
    if (result == HOAP2_LS_READ_BROKEN) {
      EXPECT_EQ(bytes.size(), at);
    }
  }
  ADD_FAILURE() << "does not come to an end";
  return operations;
}

// The heap block of exactly these bytes lets the address sanitizer see any step over its end.
TEST(LsBusOperations, EveryTruncationIsBroken) {
  Dice dice(2);
  for (int round = 0; round < 300; ++round) {
    const Bytes whole = written(dice.operation());
    EXPECT_EQ(1, read_all(whole));
    for (size_t size = 0; size < whole.size(); ++size) {
      EXPECT_EQ(0, read_all(Bytes(whole.begin(), whole.begin() + static_cast<long>(size))));
    }
  }
}

TEST(LsBusOperations, EverySingleByteChangeComesToAnEnd) {
  Dice dice(3);
  for (int round = 0; round < 40; ++round) {
    Bytes bytes = written(dice.operation());
    const Bytes next = written(dice.operation());
    bytes.insert(bytes.end(), next.begin(), next.end());
    for (size_t place = 0; place < bytes.size(); ++place) {
      for (int value = 0; value < 256; ++value) {
        Bytes changed = bytes;
        changed[place] = static_cast<uint8_t>(value);
        EXPECT_LE(read_all(changed), 12);
      }
    }
  }
}

TEST(LsBusOperations, RandomBytesComeToAnEnd) {
  Dice dice(4);
  for (int round = 0; round < 20000; ++round) {
    Bytes bytes(dice.below(120));
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(dice.below(dice.toss() ? 256 : 32));
    read_all(bytes);
  }
}

TEST(LsBusOperations, LengthZeroDoesNotHoldTheReader) {
  const Bytes bytes = {0x10, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 4};
  size_t at = 0;
  Operation read;
  EXPECT_EQ(HOAP2_LS_READ_BROKEN, hoap2_ls_read(bytes.data(), bytes.size(), &at, &read));
  EXPECT_EQ(bytes.size(), at);
}

TEST(LsBusOperations, ADamagedFormatErrorIsNotAnswered) {
  const Bytes bytes = {0x01, 0, 0, 0, 9, 0, 0, 0, 1};
  size_t at = 0;
  Operation read;
  EXPECT_EQ(HOAP2_LS_READ_REFUSED, hoap2_ls_read(bytes.data(), bytes.size(), &at, &read));
  EXPECT_EQ(0u, read.code);
}

TEST(LsBusOperations, ALongFormatErrorIsCut) {
  Bytes bytes = {0x01, 0, 0, 0, 110, 0, 0, 0, 100, 0};
  bytes.resize(110, 7);
  size_t at = 0;
  Operation read;
  EXPECT_EQ(HOAP2_LS_READ_OPERATION, hoap2_ls_read(bytes.data(), bytes.size(), &at, &read));
  EXPECT_EQ(64u, read.length);
  EXPECT_EQ(7, read.data[63]);
}

TEST(LsBusOperations, WhatIsNoOperationIsNotWritten) {
  std::vector<Operation> wrong = {of_code(0), of_code(HOAP2_LS_CAN_XL_TRANSMIT), of_code(HOAP2_LS_STATUS, 4),
                                  of_code(HOAP2_LS_CONFIGURATION, 5, 1), of_code(HOAP2_LS_CONFIGURATION, 1, 0),
                                  transmit(0x800, {}), transmit(1, Bytes(9))};
  Operation odd = transmit(1, {});
  odd.code = HOAP2_LS_CAN_FD_TRANSMIT;
  odd.length = 9;
  wrong.push_back(odd);
  Bytes out(100, 0xaa);
  for (const Operation& operation : wrong) {
    size_t size = 3;
    EXPECT_EQ(-1, hoap2_ls_write(&operation, out.data(), out.size(), &size));
    EXPECT_EQ(3u, size);
  }
  const Operation good = transmit(1, {1, 2, 3});
  size_t size = 0;
  EXPECT_EQ(-1, hoap2_ls_write(&good, out.data(), 18, &size));  // one byte short
  EXPECT_EQ(Bytes(100, 0xaa), out);
  EXPECT_EQ(0, hoap2_ls_write(&good, out.data(), 19, &size));
}

}  // namespace
