// FMI 3.0 shell: the same demands as on the FMI 2.0 shell, with whole rows as arrays.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "fmu/headers/fmi3Functions.h"
#include "table.hpp"

namespace {

struct Line {
  fmi3Status status;
  std::string category;
  std::string text;
};
std::vector<Line> log_lines;

void keep(fmi3InstanceEnvironment, fmi3Status status, fmi3String category, fmi3String message) {
  log_lines.push_back({status, category, message});
}

fmi3Instance make(bool logging = true, const char* token = HOAP2_FMU_PRODUCT.token, bool event_mode = false,
                  const char* name = "test") {
  return fmi3InstantiateCoSimulation(name, token, "", false, logging, event_mode, false, nullptr, 0, nullptr,
                                     keep, nullptr);
}

enum Mode { INSTANTIATED, INITIALISING, STEPPING, TERMINATED };
const Mode MODES[] = {INSTANTIATED, INITIALISING, STEPPING, TERMINATED};

fmi3Instance make_in(Mode mode) {
  fmi3Instance c = make();
  if (mode >= INITIALISING) {
    EXPECT_EQ(fmi3EnterInitializationMode(c, false, 0, 0, false, 0), fmi3OK);
  }
  if (mode >= STEPPING) {
    EXPECT_EQ(fmi3ExitInitializationMode(c), fmi3OK);
  }
  if (mode >= TERMINATED) {
    EXPECT_EQ(fmi3Terminate(c), fmi3OK);
  }
  log_lines.clear();
  return c;
}

fmi3Status step(fmi3Instance c, double now_s, double size_s) {
  bool event = true, end = true, early = true;
  double last = 0;
  const fmi3Status status = fmi3DoStep(c, now_s, size_s, true, &event, &end, &early, &last);
  if (c) {
    EXPECT_FALSE(status == fmi3OK && (event || end || early));
  }
  if (status == fmi3OK) {
    EXPECT_NEAR(last, now_s + size_s, 1e-9);
  }
  return status;
}

std::vector<fmi3Byte> bytes_of(fmi3Instance c) {
  fmi3FMUState state = nullptr;
  size_t size = 0;
  EXPECT_EQ(fmi3GetFMUState(c, &state), fmi3OK);
  EXPECT_EQ(fmi3SerializedFMUStateSize(c, state, &size), fmi3OK);
  std::vector<fmi3Byte> bytes(size);
  EXPECT_EQ(fmi3SerializeFMUState(c, state, bytes.data(), size), fmi3OK);
  EXPECT_EQ(fmi3FreeFMUState(c, &state), fmi3OK);
  return bytes;
}

struct Call {
  const char* name;
  std::vector<Mode> allowed;
  std::function<fmi3Status(fmi3Instance)> run;
};

// A buffer that is large enough for any row.
double* reals() {
  static double values[512];
  return values;
}
int32_t* integers() {
  static int32_t values[512];
  return values;
}

std::vector<Call> calls() {
  static const hoap2_fmu_field_t& in = some_field(HOAP2_FMU_INPUT, HOAP2_FMU_REAL);
  static const hoap2_fmu_field_t& out = some_field(HOAP2_FMU_OUTPUT, HOAP2_FMU_REAL);
  static const hoap2_fmu_field_t& in_int = some_field(HOAP2_FMU_INPUT, HOAP2_FMU_INT);
  static const hoap2_fmu_field_t& out_int = some_field(HOAP2_FMU_OUTPUT, HOAP2_FMU_INT);
  static const hoap2_fmu_field_t& fixed = some_field(HOAP2_FMU_PARAMETER, HOAP2_FMU_REAL);
  static const unsigned in_row = row_of(in), out_row = row_of(out), in_int_row = row_of(in_int),
                        out_int_row = row_of(out_int), fixed_row = row_of(fixed), time_row = 0;
  const std::vector<Mode> get = {INITIALISING, STEPPING, TERMINATED},
                          set = {INSTANTIATED, INITIALISING, STEPPING};
  return {
      {"EnterInitializationMode",
       {INSTANTIATED},
       [](auto c) { return fmi3EnterInitializationMode(c, 0, 0, 0, 0, 0); }},
      {"ExitInitializationMode", {INITIALISING}, [](auto c) { return fmi3ExitInitializationMode(c); }},
      {"Terminate", {STEPPING}, [](auto c) { return fmi3Terminate(c); }},
      {"DoStep", {STEPPING}, [](auto c) { return step(c, 0.0, 0.001); }},
      {"GetFloat64", get, [](auto c) { return fmi3GetFloat64(c, &out_row, 1, reals(), out.count); }},
      {"GetFloat64(time)", get, [](auto c) { return fmi3GetFloat64(c, &time_row, 1, reals(), 1); }},
      {"GetInt32", get, [](auto c) { return fmi3GetInt32(c, &out_int_row, 1, integers(), out_int.count); }},
      {"SetFloat64", set, [](auto c) { return fmi3SetFloat64(c, &in_row, 1, reals(), in.count); }},
      {"SetInt32", set, [](auto c) { return fmi3SetInt32(c, &in_int_row, 1, integers(), in_int.count); }},
      {"GetFloat32", get, [](auto c) { return fmi3GetFloat32(c, nullptr, 0, nullptr, 0); }},
      {"SetString", set, [](auto c) { return fmi3SetString(c, nullptr, 0, nullptr, 0); }},
      {"SetFloat64(fixed parameter)",
       {INSTANTIATED, INITIALISING},
       [](auto c) { return fmi3SetFloat64(c, &fixed_row, 1, reals(), fixed.count); }},
      {"SetFloat64(output)", {}, [](auto c) { return fmi3SetFloat64(c, &out_row, 1, reals(), out.count); }},
      {"SetFloat64(time)", {}, [](auto c) { return fmi3SetFloat64(c, &time_row, 1, reals(), 1); }},
      {"SetFloat64(too few values)",
       {},
       [](auto c) { return fmi3SetFloat64(c, &in_row, 1, reals(), in.count - 1); }},
      {"GetFloat64(too many values)",
       {},
       [](auto c) { return fmi3GetFloat64(c, &out_row, 1, reals(), out.count + 1); }},
  };
}

std::vector<Call> unsupported() {
  static const unsigned reference = 1;
  static bool flag;
  static double number = 0;
  static size_t count;
  static uint64_t big;
  static fmi3IntervalQualifier qualifier;
  static fmi3Binary binary;
  static fmi3Clock clock;
  static fmi3String text;
  static float single;
  return {
      {"EnterConfigurationMode", {}, [](auto c) { return fmi3EnterConfigurationMode(c); }},
      {"ExitConfigurationMode", {}, [](auto c) { return fmi3ExitConfigurationMode(c); }},
      {"EnterEventMode", {}, [](auto c) { return fmi3EnterEventMode(c); }},
      {"EnterStepMode", {}, [](auto c) { return fmi3EnterStepMode(c); }},
      {"EvaluateDiscreteStates", {}, [](auto c) { return fmi3EvaluateDiscreteStates(c); }},
      {"UpdateDiscreteStates",
       {},
       [](auto c) { return fmi3UpdateDiscreteStates(c, &flag, &flag, &flag, &flag, &flag, &number); }},
      {"GetIntervalDecimal",
       {},
       [](auto c) { return fmi3GetIntervalDecimal(c, &reference, 1, &number, &qualifier); }},
      {"GetIntervalFraction",
       {},
       [](auto c) { return fmi3GetIntervalFraction(c, &reference, 1, &big, &big, &qualifier); }},
      {"GetShiftDecimal", {}, [](auto c) { return fmi3GetShiftDecimal(c, &reference, 1, &number); }},
      {"GetShiftFraction", {}, [](auto c) { return fmi3GetShiftFraction(c, &reference, 1, &big, &big); }},
      {"SetIntervalDecimal", {}, [](auto c) { return fmi3SetIntervalDecimal(c, &reference, 1, &number); }},
      {"SetIntervalFraction",
       {},
       [](auto c) { return fmi3SetIntervalFraction(c, &reference, 1, &big, &big); }},
      {"SetShiftDecimal", {}, [](auto c) { return fmi3SetShiftDecimal(c, &reference, 1, &number); }},
      {"SetShiftFraction", {}, [](auto c) { return fmi3SetShiftFraction(c, &reference, 1, &big, &big); }},
      {"ActivateModelPartition", {}, [](auto c) { return fmi3ActivateModelPartition(c, 1, 0); }},
      {"GetNumberOfVariableDependencies",
       {},
       [](auto c) { return fmi3GetNumberOfVariableDependencies(c, 1, &count); }},
      {"GetVariableDependencies",
       {},
       [](auto c) { return fmi3GetVariableDependencies(c, 1, nullptr, nullptr, nullptr, nullptr, 0); }},
      {"GetDirectionalDerivative",
       {},
       [](auto c) {
         return fmi3GetDirectionalDerivative(c, &reference, 1, &reference, 1, &number, 1, &number, 1);
       }},
      {"GetAdjointDerivative",
       {},
       [](auto c) {
         return fmi3GetAdjointDerivative(c, &reference, 1, &reference, 1, &number, 1, &number, 1);
       }},
      {"GetOutputDerivatives",
       {},
       [](auto c) { return fmi3GetOutputDerivatives(c, &reference, 1, integers(), &number, 1); }},
      {"EnterContinuousTimeMode", {}, [](auto c) { return fmi3EnterContinuousTimeMode(c); }},
      {"CompletedIntegratorStep",
       {},
       [](auto c) { return fmi3CompletedIntegratorStep(c, true, &flag, &flag); }},
      {"SetTime", {}, [](auto c) { return fmi3SetTime(c, 0); }},
      {"SetContinuousStates", {}, [](auto c) { return fmi3SetContinuousStates(c, &number, 1); }},
      {"GetContinuousStateDerivatives",
       {},
       [](auto c) { return fmi3GetContinuousStateDerivatives(c, &number, 1); }},
      {"GetEventIndicators", {}, [](auto c) { return fmi3GetEventIndicators(c, &number, 1); }},
      {"GetContinuousStates", {}, [](auto c) { return fmi3GetContinuousStates(c, &number, 1); }},
      {"GetNominalsOfContinuousStates",
       {},
       [](auto c) { return fmi3GetNominalsOfContinuousStates(c, &number, 1); }},
      {"GetNumberOfEventIndicators", {}, [](auto c) { return fmi3GetNumberOfEventIndicators(c, &count); }},
      {"GetNumberOfContinuousStates", {}, [](auto c) { return fmi3GetNumberOfContinuousStates(c, &count); }},
      {"GetBinary", {}, [](auto c) { return fmi3GetBinary(c, &reference, 1, &count, &binary, 1); }},
      {"SetBinary", {}, [](auto c) { return fmi3SetBinary(c, &reference, 1, &count, &binary, 1); }},
      {"GetClock", {}, [](auto c) { return fmi3GetClock(c, &reference, 1, &clock); }},
      {"SetClock", {}, [](auto c) { return fmi3SetClock(c, &reference, 1, &clock); }},
      {"GetFloat32", {}, [](auto c) { return fmi3GetFloat32(c, &reference, 1, &single, 1); }},
      {"SetString", {}, [](auto c) { return fmi3SetString(c, &reference, 1, &text, 1); }},
  };
}

void expect_refused(fmi3Instance c, const Call& call, const std::string& where) {
  const std::vector<fmi3Byte> before = bytes_of(c);
  log_lines.clear();
  EXPECT_EQ(call.run(c), fmi3Error) << call.name << where;
  ASSERT_FALSE(log_lines.empty()) << call.name << ": refused without a reason" << where;
  EXPECT_EQ(log_lines.back().status, fmi3Error) << call.name;
  EXPECT_EQ(log_lines.back().category, "logStatusError") << call.name;
  EXPECT_EQ(bytes_of(c), before) << call.name << ": a refused call changed the state" << where;
}

TEST(Fmi3, CallsInEachState) {
  for (const Mode mode : MODES) {
    fmi3Instance c = make_in(mode);
    // the buffer holds the first fixed parameter as it is, so that setting it is harmless
    const hoap2_fmu_field_t& fixed = some_field(HOAP2_FMU_PARAMETER, HOAP2_FMU_REAL);
    const unsigned row = row_of(fixed);
    if (mode != INSTANTIATED) {
      EXPECT_EQ(fmi3GetFloat64(c, &row, 1, reals(), fixed.count), fmi3OK);
    }
    fmi3FMUState start = nullptr;
    EXPECT_EQ(fmi3GetFMUState(c, &start), fmi3OK);
    for (const Call& call : calls()) {
      bool allowed = false;
      for (const Mode m : call.allowed) allowed = allowed || m == mode;
      if (allowed) {
        EXPECT_EQ(call.run(c), fmi3OK) << call.name << " in state " << mode;
        EXPECT_EQ(fmi3SetFMUState(c, start), fmi3OK);
      } else {
        expect_refused(c, call, " in state " + std::to_string(mode));
      }
    }
    EXPECT_EQ(fmi3FreeFMUState(c, &start), fmi3OK);
    fmi3FreeInstance(c);
  }
}

TEST(Fmi3, UnsupportedCallsSayWhy) {
  fmi3Instance c = make_in(STEPPING);
  for (const Call& call : unsupported()) expect_refused(c, call, "");
  fmi3FreeInstance(c);
}

TEST(Fmi3, NullInstanceIsAnError) {
  for (const Call& call : calls()) EXPECT_EQ(call.run(nullptr), fmi3Error) << call.name;
  for (const Call& call : unsupported()) EXPECT_EQ(call.run(nullptr), fmi3Error) << call.name;
  fmi3FMUState state = nullptr;
  EXPECT_EQ(fmi3Reset(nullptr), fmi3Error);
  EXPECT_EQ(fmi3GetFMUState(nullptr, &state), fmi3Error);
  EXPECT_EQ(fmi3SetFMUState(nullptr, nullptr), fmi3Error);
  EXPECT_EQ(fmi3FreeFMUState(nullptr, &state), fmi3Error);
  fmi3FreeInstance(nullptr);
}

TEST(Fmi3, InstantiateRefuses) {
  log_lines.clear();
  EXPECT_EQ(make(true, "{wrong}"), nullptr);
  ASSERT_EQ(log_lines.size(), 1u);
  EXPECT_NE(log_lines[0].text.find(HOAP2_FMU_PRODUCT.token), std::string::npos);
  EXPECT_EQ(make(true, nullptr), nullptr);
  EXPECT_EQ(make(true, HOAP2_FMU_PRODUCT.token, true), nullptr) << "there is no event mode";
  EXPECT_EQ(make(true, HOAP2_FMU_PRODUCT.token, false, ""), nullptr);
  EXPECT_EQ(make(true, HOAP2_FMU_PRODUCT.token, false, nullptr), nullptr);
  log_lines.clear();
  EXPECT_EQ(make(false, "{wrong}"), nullptr);
  EXPECT_TRUE(log_lines.empty());
  EXPECT_EQ(fmi3InstantiateModelExchange("x", HOAP2_FMU_PRODUCT.token, "", false, true, nullptr, keep),
            nullptr);
  EXPECT_EQ(log_lines.size(), 1u);
  EXPECT_EQ(fmi3InstantiateScheduledExecution("x", HOAP2_FMU_PRODUCT.token, "", false, true, nullptr, keep,
                                              nullptr, nullptr, nullptr),
            nullptr);
}

TEST(Fmi3, EveryRowGoesToItsOwnPlace) {
  fmi3Instance c = make();
  for (uint32_t i = 0; i < HOAP2_FMU_PRODUCT.field_count; ++i) {
    const hoap2_fmu_field_t& f = HOAP2_FMU_PRODUCT.fields[i];
    const unsigned row = row_of(f);
    if (f.group != HOAP2_FMU_INPUT || f.kind != HOAP2_FMU_REAL) continue;
    for (uint32_t e = 0; e < f.count; ++e) reals()[e] = 1e-3 * (f.first_element + e);
    EXPECT_EQ(fmi3SetFloat64(c, &row, 1, reals(), f.count), fmi3OK);
  }
  EXPECT_EQ(fmi3EnterInitializationMode(c, false, 0, 0, false, 0), fmi3OK);
  std::vector<unsigned> rows;
  std::vector<double> expected;
  for (uint32_t i = HOAP2_FMU_PRODUCT.field_count; i-- > 0;) {
    const hoap2_fmu_field_t& f = HOAP2_FMU_PRODUCT.fields[i];
    if (f.group != HOAP2_FMU_INPUT || f.kind != HOAP2_FMU_REAL) continue;
    rows.push_back(row_of(f));
    for (uint32_t e = 0; e < f.count; ++e) expected.push_back(1e-3 * (f.first_element + e));
  }
  std::vector<double> got(expected.size());
  EXPECT_EQ(fmi3GetFloat64(c, rows.data(), rows.size(), got.data(), got.size()), fmi3OK);
  EXPECT_EQ(got, expected);
  fmi3FreeInstance(c);
}

TEST(Fmi3, ARefusedParameterLeavesTheInputsOfTheSameCallAlone) {
  if (!is_controller()) {
    EXPECT_EQ(tunable_fields(), 0u) << "the plant takes no parameters between steps";
    return;
  }
  fmi3Instance c = make_in(STEPPING);
  const hoap2_fmu_field_t& input = field_named("gyro_S_rad_s");
  const hoap2_fmu_field_t& tunable = field_named("tpcc_kp_1_s2");
  const unsigned rows[2] = {row_of(input), row_of(tunable)};
  const double bad[4] = {1, 2, 3, tunable.high * 2}, good[4] = {1, 2, 3, tunable.high / 2};
  const std::vector<fmi3Byte> before = bytes_of(c);
  EXPECT_EQ(fmi3SetFloat64(c, rows, 2, bad, 4), fmi3Error);
  EXPECT_EQ(bytes_of(c), before);
  EXPECT_EQ(fmi3SetFloat64(c, rows, 2, good, 4), fmi3OK);
  double got[4];
  EXPECT_EQ(fmi3GetFloat64(c, rows, 2, got, 4), fmi3OK);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(got[i], good[i]);
  fmi3FreeInstance(c);
}

// Rows, arrays too; what is tuned is part of the state.
TEST(Fmi3, EachTunableRowCanBeSetBetweenStepsAndIsKeptInTheState) {
  fmi3Instance c = make_in(STEPPING);
  fmi3Instance other = make_in(STEPPING);
  unsigned arrays = 0;
  for (uint32_t i = 0; i < HOAP2_FMU_PRODUCT.field_count; ++i) {
    const hoap2_fmu_field_t& f = HOAP2_FMU_PRODUCT.fields[i];
    if (f.group != HOAP2_FMU_PARAMETER || f.kind != HOAP2_FMU_REAL) continue;
    const unsigned row = row_of(f);
    std::vector<double> values(f.count), got(f.count);
    EXPECT_EQ(fmi3GetFloat64(c, &row, 1, values.data(), f.count), fmi3OK);
    for (double& value : values) value += 1e-4 * (value < f.high - 1e-4 ? 1.0 : -1.0);
    EXPECT_EQ(fmi3SetFloat64(c, &row, 1, values.data(), f.count), f.tunable ? fmi3OK : fmi3Error) << f.name;
    if (!f.tunable) continue;
    arrays += f.count > 1 ? 1 : 0;
    const std::vector<fmi3Byte> bytes = bytes_of(c);
    fmi3FMUState state = nullptr;
    EXPECT_EQ(fmi3DeserializeFMUState(other, bytes.data(), bytes.size(), &state), fmi3OK);
    EXPECT_EQ(fmi3SetFMUState(other, state), fmi3OK);
    EXPECT_EQ(fmi3FreeFMUState(other, &state), fmi3OK);
    EXPECT_EQ(fmi3GetFloat64(other, &row, 1, got.data(), f.count), fmi3OK);
    EXPECT_EQ(got, values) << f.name;
  }
  EXPECT_EQ(arrays > 0, is_controller());
  fmi3FreeInstance(c);
  fmi3FreeInstance(other);
}

TEST(Fmi3, StateOfAnotherProductOrTableIsRefused) {
  fmi3Instance c = make_in(STEPPING);
  const std::vector<fmi3Byte> good = bytes_of(c);
  fmi3FMUState state = nullptr;
  std::vector<fmi3Byte> other = good;
  other[16 + 7] = static_cast<fmi3Byte>('x'); /* product name */
  log_lines.clear();
  EXPECT_EQ(fmi3DeserializeFMUState(c, other.data(), other.size(), &state), fmi3Error);
  ASSERT_FALSE(log_lines.empty());
  EXPECT_NE(log_lines.back().text.find("another product"), std::string::npos);
  other = good;
  other[48 + 3] ^= 1; /* token */
  EXPECT_EQ(fmi3DeserializeFMUState(c, other.data(), other.size(), &state), fmi3Error);
  EXPECT_NE(log_lines.back().text.find("another table"), std::string::npos);
  EXPECT_EQ(state, nullptr);
  EXPECT_EQ(fmi3DeserializeFMUState(c, good.data(), good.size(), &state), fmi3OK);
  EXPECT_EQ(fmi3SetFMUState(c, state), fmi3OK);
  EXPECT_EQ(fmi3FreeFMUState(c, &state), fmi3OK);
  EXPECT_EQ(bytes_of(c), good);
  fmi3FreeInstance(c);
}

TEST(Fmi3, StatesOfEveryModeComeBack) {
  for (const Mode mode : MODES) {
    fmi3Instance a = make_in(mode), b = make();
    const hoap2_fmu_field_t& input = some_field(HOAP2_FMU_INPUT, HOAP2_FMU_REAL);
    const unsigned row = row_of(input);
    for (uint32_t e = 0; e < input.count; ++e) reals()[e] = 0.01 * e; /* not the start values */
    EXPECT_EQ(fmi3SetFloat64(a, &row, 1, reals(), input.count), mode == TERMINATED ? fmi3Error : fmi3OK);
    const std::vector<fmi3Byte> bytes = bytes_of(a);
    fmi3FMUState state = nullptr;
    EXPECT_EQ(fmi3DeserializeFMUState(b, bytes.data(), bytes.size(), &state), fmi3OK);
    EXPECT_EQ(fmi3SetFMUState(b, state), fmi3OK);
    EXPECT_EQ(fmi3FreeFMUState(b, &state), fmi3OK);
    EXPECT_EQ(bytes_of(b), bytes) << "mode " << mode;
    EXPECT_EQ(step(b, 0, 0.001), mode == STEPPING ? fmi3OK : fmi3Error);
    fmi3FreeInstance(a);
    fmi3FreeInstance(b);
  }
}

TEST(Fmi3, ManyInstancesLeaveNothingBehind) {
  for (int i = 0; i < 200; ++i) {
    fmi3Instance c = i % 50 == 0 ? make_in(STEPPING) : make();
    ASSERT_NE(c, nullptr);
    fmi3FreeInstance(c); /* the leak sanitizer counts */
  }
}

TEST(Fmi3, DoStepWithoutResultPointers) {
  fmi3Instance c = make_in(STEPPING);
  EXPECT_EQ(fmi3DoStep(c, 0, 0.002, true, nullptr, nullptr, nullptr, nullptr), fmi3OK);
  double now = 0;
  const unsigned time_row = 0;
  EXPECT_EQ(fmi3GetFloat64(c, &time_row, 1, &now, 1), fmi3OK);
  EXPECT_DOUBLE_EQ(now, 0.002);
  fmi3FreeInstance(c);
}

}  // namespace
