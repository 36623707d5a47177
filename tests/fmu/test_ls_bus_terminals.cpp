// The shell with bus terminals called directly, so that the sanitizers see it: NULLs, any bytes, damaged states.
#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

#include "fmu/headers/fmi3Functions.h"
#include "fmu/ls_bus/can_operations.h"
#include "fmu/ls_bus/side.h"
#include "fmu/ls_bus/terminals.h"

namespace {

using Bytes = std::vector<uint8_t>;

struct Fmu {
  fmi3Instance c;

  explicit Fmu(bool event_mode = true)
      : c(fmi3InstantiateCoSimulation("test", HOAP2_LS_SIDE.token, "", false, false, event_mode, false, nullptr, 0,
                                      nullptr, nullptr, nullptr)) {
    EXPECT_EQ(fmi3EnterInitializationMode(c, false, 0, 0, false, 0), fmi3OK);
    EXPECT_EQ(fmi3ExitInitializationMode(c), fmi3OK);
  }
  ~Fmu() { fmi3FreeInstance(c); }
  Fmu(const Fmu&) = delete;
  Fmu& operator=(const Fmu&) = delete;

  static unsigned reference(int terminal, int member) {
    return HOAP2_FMU_PRODUCT.field_count + 1 + static_cast<unsigned>(terminal * HOAP2_LS_MEMBERS + member);
  }
  fmi3Status set_clock(unsigned reference) const {
    const bool on = true;
    return fmi3SetClock(c, &reference, 1, &on);
  }
  fmi3Status set(unsigned reference, const Bytes& bytes) const {
    const size_t size = bytes.size();
    const fmi3Binary value = bytes.data();
    return fmi3SetBinary(c, &reference, 1, &size, &value, 1);
  }
  fmi3Status update() const {
    bool flags[5];
    double next;
    return fmi3UpdateDiscreteStates(c, &flags[0], &flags[1], &flags[2], &flags[3], &flags[4], &next);
  }
  void receive(int terminal, const Bytes& bytes) const {
    EXPECT_EQ(set_clock(reference(terminal, HOAP2_LS_RX_CLOCK)), fmi3OK);
    EXPECT_EQ(set(reference(terminal, HOAP2_LS_RX_DATA), bytes), fmi3OK);
    EXPECT_EQ(update(), fmi3OK);
  }
  Bytes send(int terminal) const {
    const unsigned data = reference(terminal, HOAP2_LS_TX_DATA);
    size_t size = 0;
    fmi3Binary value = nullptr;
    EXPECT_EQ(set_clock(reference(terminal, HOAP2_LS_TX_CLOCK)), fmi3OK);
    EXPECT_EQ(fmi3GetBinary(c, &data, 1, &size, &value, 1), fmi3OK);
    Bytes bytes(value, value + size);
    EXPECT_EQ(update(), fmi3OK);
    return bytes;
  }
  fmi3Status step(double now_s, double size_s) const {
    bool event, end, early;
    double last;
    EXPECT_EQ(fmi3EnterStepMode(c), fmi3OK);
    const fmi3Status status = fmi3DoStep(c, now_s, size_s, true, &event, &end, &early, &last);
    EXPECT_EQ(fmi3EnterEventMode(c), fmi3OK);
    return status;
  }
};

// A frame that each side takes apart: the controller's heartbeat has identifier 0x020.
Bytes some_frames() {
  Bytes out(4 * HOAP2_LS_LARGEST_OPERATION);
  size_t size = 0;
  for (uint32_t identifier : {0x020U, 0x001U, 0x7ffU}) {
    hoap2_ls_operation_t operation = {};
    operation.code = HOAP2_LS_CAN_FD_TRANSMIT;
    operation.identifier = identifier;
    operation.bit_rate_switch = 1;
    operation.length = 12;
    EXPECT_EQ(hoap2_ls_write(&operation, out.data(), out.size(), &size), 0);
  }
  out.resize(size);
  return out;
}

TEST(LsBusTerminals, NullsAreRefused) {
  const Fmu fmu;
  const unsigned clock = Fmu::reference(0, HOAP2_LS_TX_CLOCK), data = Fmu::reference(0, HOAP2_LS_RX_DATA);
  bool on = true;
  size_t size = 3;
  fmi3Binary value = nullptr;
  double interval;
  fmi3IntervalQualifier qualifier;
  EXPECT_EQ(fmi3SetClock(fmu.c, nullptr, 1, &on), fmi3Error);
  EXPECT_EQ(fmi3SetClock(fmu.c, &clock, 1, nullptr), fmi3Error);
  EXPECT_EQ(fmi3GetClock(fmu.c, &clock, 1, nullptr), fmi3Error);
  EXPECT_EQ(fmi3GetIntervalDecimal(fmu.c, &clock, 1, nullptr, &qualifier), fmi3Error);
  EXPECT_EQ(fmi3GetIntervalDecimal(fmu.c, &clock, 1, &interval, nullptr), fmi3Error);
  EXPECT_EQ(fmi3GetBinary(fmu.c, &data, 1, nullptr, &value, 1), fmi3Error);
  EXPECT_EQ(fmi3GetBinary(fmu.c, &data, 1, &size, &value, 2), fmi3Error);
  EXPECT_EQ(fmu.set_clock(Fmu::reference(0, HOAP2_LS_RX_CLOCK)), fmi3OK);
  EXPECT_EQ(fmi3SetBinary(fmu.c, &data, 1, &size, &value, 1), fmi3Error) << "NULL of 3 bytes";
  EXPECT_EQ(fmi3SetBinary(fmu.c, &data, 1, nullptr, &value, 1), fmi3Error);
  EXPECT_EQ(fmi3SetBinary(nullptr, &data, 1, &size, &value, 1), fmi3Error);
  EXPECT_EQ(fmi3SetClock(fmu.c, nullptr, 0, nullptr), fmi3OK) << "an empty list is right";
  EXPECT_EQ(fmi3UpdateDiscreteStates(fmu.c, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr), fmi3OK);
}

TEST(LsBusTerminals, NoReferenceBeyondTheTerminals) {
  const Fmu fmu;
  for (const unsigned r : {0U, Fmu::reference(0, 0) - 1, Fmu::reference(HOAP2_LS_SIDE.terminals, 0), ~0U})
    EXPECT_EQ(fmu.set_clock(r), fmi3Error) << r;
  EXPECT_EQ(fmu.set_clock(Fmu::reference(HOAP2_LS_SIDE.terminals - 1, HOAP2_LS_TX_CLOCK)), fmi3OK);
}

TEST(LsBusTerminals, WithoutEventModeTheTerminalsSleep) {
  const Fmu fmu(false);
  EXPECT_EQ(fmi3EnterEventMode(fmu.c), fmi3Error);
  EXPECT_EQ(fmu.set_clock(Fmu::reference(0, HOAP2_LS_TX_CLOCK)), fmi3Error);
  bool event = true, end, early;
  double last;
  EXPECT_EQ(fmi3DoStep(fmu.c, 0.0, 0.001, true, &event, &end, &early, &last), fmi3OK);
  EXPECT_FALSE(event);
}

TEST(LsBusTerminals, EveryTruncationAndEveryChangedByte) {
  const Fmu fmu;
  const Bytes good = some_frames();
  for (int terminal = 0; terminal < HOAP2_LS_SIDE.terminals; ++terminal) {
    for (size_t end = 0; end <= good.size(); ++end) {
      fmu.receive(terminal, Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(end)));
      fmu.send(terminal);
    }
    for (size_t i = 0; i < good.size(); ++i) {
      for (int change = 1; change < 256; change += 13) {
        Bytes changed = good;
        changed[i] = static_cast<uint8_t>(changed[i] ^ change);
        fmu.receive(terminal, changed);
        fmu.send(terminal);
      }
    }
  }
  EXPECT_EQ(fmu.step(0.0, 0.02), fmi3OK);
  EXPECT_EQ(fmu.update(), fmi3OK);
}

// A state is a block of memory: whatever stands in it is refused, or the FMU goes on from it unharmed.
TEST(LsBusTerminals, ChangedStatesAreRefusedOrHarmless) {
  const Fmu fmu;
  fmu.receive(0, some_frames());
  std::mt19937 random(3);
  fmi3FMUState state = nullptr;
  ASSERT_EQ(fmi3GetFMUState(fmu.c, &state), fmi3OK);
  size_t size = 0;
  ASSERT_EQ(fmi3SerializedFMUStateSize(fmu.c, state, &size), fmi3OK);
  auto* bytes = static_cast<uint8_t*>(state);
  const Bytes good(bytes, bytes + size);
  size_t first = good.size();
  const auto* network = static_cast<const uint8_t*>(static_cast<hoap2_fmu_instance_t*>(fmu.c)->network);
  const size_t network_size = sizeof(hoap2_ls_network_t) + HOAP2_LS_SIDE.size;
  for (size_t i = 0; i + network_size <= good.size(); ++i) {
    if (std::memcmp(good.data() + i, network, network_size) == 0) first = i;
  }
  ASSERT_LT(first, good.size());
  int refused = 0;
  for (int round = 0; round < 300; ++round) {
    std::memcpy(bytes, good.data(), size);
    // half of the changes in the terminals' own fields, half in the side's state
    const size_t begin = round % 2 ? first : first + sizeof(hoap2_ls_network_t);
    const size_t length = round % 2 ? 64 : HOAP2_LS_SIDE.size;
    bytes[begin + random() % length] = static_cast<uint8_t>(random());
    if (fmi3SetFMUState(fmu.c, state) != fmi3OK) {
      ++refused;
      continue;
    }
    const double now_s = 1e-9 * static_cast<double>(static_cast<hoap2_ls_network_t*>(
                                    static_cast<hoap2_fmu_instance_t*>(fmu.c)->network)->now_ns);
    fmu.update();
    fmu.step(now_s, 0.003);
    fmu.update();
    for (int t = 0; t < HOAP2_LS_SIDE.terminals; ++t) fmu.send(t);
  }
  EXPECT_GT(refused, 20);
  std::memcpy(bytes, good.data(), size);
  EXPECT_EQ(fmi3SetFMUState(fmu.c, state), fmi3OK);
  EXPECT_EQ(fmi3FreeFMUState(fmu.c, &state), fmi3OK);
}

}  // namespace
