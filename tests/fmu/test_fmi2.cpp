// FMI 2.0 shell: calls in wrong states, NULL arguments, refused values, damaged states. Nothing may crash,
// every refusal has a logged reason, and a refused call changes nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <vector>

#include "fmu/headers/fmi2Functions.h"
#include "table.hpp"

namespace {

struct Line {
  fmi2Status status;
  std::string category;
  std::string text;
};
std::vector<Line> log_lines;

void keep(fmi2ComponentEnvironment, fmi2String, fmi2Status status, fmi2String category, fmi2String message,
          ...) {
  log_lines.push_back({status, category, message});
}

const fmi2CallbackFunctions CALLBACKS = {keep, nullptr, nullptr, nullptr, nullptr};

fmi2Component make(fmi2Boolean logging = fmi2True) {
  return fmi2Instantiate("test", fmi2CoSimulation, HOAP2_FMU_PRODUCT.token, "", &CALLBACKS, fmi2False,
                         logging);
}

enum Mode { INSTANTIATED, INITIALISING, STEPPING, TERMINATED };
const Mode MODES[] = {INSTANTIATED, INITIALISING, STEPPING, TERMINATED};

fmi2Component make_in(Mode mode) {
  fmi2Component c = make();
  EXPECT_EQ(fmi2SetupExperiment(c, fmi2False, 0, 0, fmi2False, 0), fmi2OK);
  if (mode >= INITIALISING) {
    EXPECT_EQ(fmi2EnterInitializationMode(c), fmi2OK);
  }
  if (mode >= STEPPING) {
    EXPECT_EQ(fmi2ExitInitializationMode(c), fmi2OK);
  }
  if (mode >= TERMINATED) {
    EXPECT_EQ(fmi2Terminate(c), fmi2OK);
  }
  log_lines.clear();
  return c;
}

std::vector<char> bytes_of(fmi2Component c) {
  fmi2FMUstate state = nullptr;
  size_t size = 0;
  EXPECT_EQ(fmi2GetFMUstate(c, &state), fmi2OK);
  EXPECT_EQ(fmi2SerializedFMUstateSize(c, state, &size), fmi2OK);
  std::vector<char> bytes(size);
  EXPECT_EQ(fmi2SerializeFMUstate(c, state, bytes.data(), size), fmi2OK);
  EXPECT_EQ(fmi2FreeFMUstate(c, &state), fmi2OK);
  EXPECT_EQ(state, nullptr);
  return bytes;
}

struct Call {
  const char* name;
  std::vector<Mode> allowed;
  std::function<fmi2Status(fmi2Component)> run;
};

std::vector<Call> calls() {
  static const unsigned in = some_field(HOAP2_FMU_INPUT, HOAP2_FMU_REAL).first_element;
  static const unsigned out = some_field(HOAP2_FMU_OUTPUT, HOAP2_FMU_REAL).first_element;
  static const unsigned out_int = some_field(HOAP2_FMU_OUTPUT, HOAP2_FMU_INT).first_element;
  static const unsigned in_int = some_field(HOAP2_FMU_INPUT, HOAP2_FMU_INT).first_element;
  static const unsigned fixed = some_field(HOAP2_FMU_PARAMETER, HOAP2_FMU_REAL).first_element;
  static fmi2Real real = 0.0;
  static fmi2Integer integer = 1;
  static fmi2Boolean flag = 0;
  const std::vector<Mode> get = {INITIALISING, STEPPING, TERMINATED},
                          set = {INSTANTIATED, INITIALISING, STEPPING};
  return {
      {"SetupExperiment", {INSTANTIATED}, [](auto c) { return fmi2SetupExperiment(c, 0, 0, 0, 0, 0); }},
      {"EnterInitializationMode", {INSTANTIATED}, [](auto c) { return fmi2EnterInitializationMode(c); }},
      {"ExitInitializationMode", {INITIALISING}, [](auto c) { return fmi2ExitInitializationMode(c); }},
      {"Terminate", {STEPPING}, [](auto c) { return fmi2Terminate(c); }},
      {"DoStep", {STEPPING}, [](auto c) { return fmi2DoStep(c, 0.0, 0.001, fmi2True); }},
      {"GetReal", get, [](auto c) { return fmi2GetReal(c, &out, 1, &real); }},
      {"GetInteger", get, [](auto c) { return fmi2GetInteger(c, &out_int, 1, &integer); }},
      {"GetBoolean", get, [](auto c) { return fmi2GetBoolean(c, nullptr, 0, nullptr); }},
      {"GetString", get, [](auto c) { return fmi2GetString(c, nullptr, 0, nullptr); }},
      {"SetReal", set, [](auto c) { return fmi2SetReal(c, &in, 1, &real); }},
      {"SetInteger", set, [](auto c) { return fmi2SetInteger(c, &in_int, 1, &integer); }},
      {"SetBoolean", set, [](auto c) { return fmi2SetBoolean(c, nullptr, 0, nullptr); }},
      {"SetString", set, [](auto c) { return fmi2SetString(c, nullptr, 0, nullptr); }},
      {"SetReal(fixed parameter)",
       {INSTANTIATED, INITIALISING},
       [](auto c) { return fmi2SetReal(c, &fixed, 1, &real); }},
      {"SetReal(output)", {}, [](auto c) { return fmi2SetReal(c, &out, 1, &real); }},
      {"GetRealStatus",
       {STEPPING, TERMINATED},
       [](auto c) { return fmi2GetRealStatus(c, fmi2LastSuccessfulTime, &real); }},
      {"GetBooleanStatus",
       {STEPPING, TERMINATED},
       [](auto c) { return fmi2GetBooleanStatus(c, fmi2Terminated, &flag); }},
  };
}

std::vector<Call> unsupported() {
  static fmi2Real real[2] = {};
  static fmi2Integer integer = 1;
  static fmi2Boolean flag = 0;
  static fmi2Status status;
  static fmi2String text;
  static fmi2EventInfo event;
  static const unsigned reference = 1;
  return {
      {"CancelStep", {}, [](auto c) { return fmi2CancelStep(c); }},
      {"SetRealInputDerivatives",
       {},
       [](auto c) { return fmi2SetRealInputDerivatives(c, &reference, 1, &integer, real); }},
      {"GetRealOutputDerivatives",
       {},
       [](auto c) { return fmi2GetRealOutputDerivatives(c, &reference, 1, &integer, real); }},
      {"GetStatus", {}, [](auto c) { return fmi2GetStatus(c, fmi2DoStepStatus, &status); }},
      {"GetIntegerStatus", {}, [](auto c) { return fmi2GetIntegerStatus(c, fmi2DoStepStatus, &integer); }},
      {"GetStringStatus", {}, [](auto c) { return fmi2GetStringStatus(c, fmi2PendingStatus, &text); }},
      {"GetBoolean", {}, [](auto c) { return fmi2GetBoolean(c, &reference, 1, &flag); }},
      {"SetString", {}, [](auto c) { return fmi2SetString(c, &reference, 1, &text); }},
      {"EnterEventMode", {}, [](auto c) { return fmi2EnterEventMode(c); }},
      {"NewDiscreteStates", {}, [](auto c) { return fmi2NewDiscreteStates(c, &event); }},
      {"EnterContinuousTimeMode", {}, [](auto c) { return fmi2EnterContinuousTimeMode(c); }},
      {"CompletedIntegratorStep", {}, [](auto c) { return fmi2CompletedIntegratorStep(c, 0, &flag, &flag); }},
      {"SetTime", {}, [](auto c) { return fmi2SetTime(c, 0); }},
      {"SetContinuousStates", {}, [](auto c) { return fmi2SetContinuousStates(c, real, 1); }},
      {"GetDerivatives", {}, [](auto c) { return fmi2GetDerivatives(c, real, 1); }},
      {"GetEventIndicators", {}, [](auto c) { return fmi2GetEventIndicators(c, real, 1); }},
      {"GetContinuousStates", {}, [](auto c) { return fmi2GetContinuousStates(c, real, 1); }},
      {"GetNominalsOfContinuousStates",
       {},
       [](auto c) { return fmi2GetNominalsOfContinuousStates(c, real, 1); }},
      {"GetDirectionalDerivative",
       {},
       [](auto c) { return fmi2GetDirectionalDerivative(c, &reference, 1, &reference, 1, real, real); }},
  };
}

void expect_refused(fmi2Component c, const Call& call, const std::string& where) {
  const std::vector<char> before = bytes_of(c);
  log_lines.clear();
  EXPECT_EQ(call.run(c), fmi2Error) << call.name << where;
  ASSERT_FALSE(log_lines.empty()) << call.name << ": refused without a reason" << where;
  EXPECT_EQ(log_lines.back().status, fmi2Error) << call.name;
  EXPECT_EQ(log_lines.back().category, "logStatusError") << call.name;
  EXPECT_EQ(log_lines.back().text.find('%'), std::string::npos);
  EXPECT_EQ(bytes_of(c), before) << call.name << ": a refused call changed the state" << where;
}

TEST(Fmi2, CallsInEachState) {
  for (const Mode mode : MODES) {
    fmi2Component c = make_in(mode);
    fmi2FMUstate start = nullptr;
    EXPECT_EQ(fmi2GetFMUstate(c, &start), fmi2OK);
    for (const Call& call : calls()) {
      bool allowed = false;
      for (const Mode m : call.allowed) allowed = allowed || m == mode;
      if (allowed) {
        EXPECT_EQ(call.run(c), fmi2OK) << call.name << " in state " << mode;
        EXPECT_EQ(fmi2SetFMUstate(c, start), fmi2OK);
      } else {
        expect_refused(c, call, " in state " + std::to_string(mode));
      }
    }
    EXPECT_EQ(fmi2FreeFMUstate(c, &start), fmi2OK);
    fmi2FreeInstance(c);
  }
}

TEST(Fmi2, UnsupportedCallsSayWhy) {
  fmi2Component c = make_in(STEPPING);
  for (const Call& call : unsupported()) expect_refused(c, call, "");
  fmi2FreeInstance(c);
}

TEST(Fmi2, NullComponentIsAnError) {
  for (const Call& call : calls()) EXPECT_EQ(call.run(nullptr), fmi2Error) << call.name;
  for (const Call& call : unsupported()) EXPECT_EQ(call.run(nullptr), fmi2Error) << call.name;
  fmi2FMUstate state = nullptr;
  size_t size = 0;
  EXPECT_EQ(fmi2Reset(nullptr), fmi2Error);
  EXPECT_EQ(fmi2GetFMUstate(nullptr, &state), fmi2Error);
  EXPECT_EQ(fmi2SetFMUstate(nullptr, nullptr), fmi2Error);
  EXPECT_EQ(fmi2FreeFMUstate(nullptr, &state), fmi2Error);
  EXPECT_EQ(fmi2SerializedFMUstateSize(nullptr, nullptr, &size), fmi2Error);
  EXPECT_EQ(fmi2SetDebugLogging(nullptr, 1, 0, nullptr), fmi2Error);
  fmi2FreeInstance(nullptr);
}

TEST(Fmi2, InstantiateRefuses) {
  const char* token = HOAP2_FMU_PRODUCT.token;
  EXPECT_EQ(fmi2Instantiate("x", fmi2CoSimulation, token, "", nullptr, 0, 1), nullptr);
  log_lines.clear();
  EXPECT_EQ(fmi2Instantiate("x", fmi2CoSimulation, "{wrong}", "", &CALLBACKS, 0, 1), nullptr);
  ASSERT_EQ(log_lines.size(), 1u);
  EXPECT_NE(log_lines[0].text.find(token), std::string::npos);
  EXPECT_EQ(fmi2Instantiate("x", fmi2CoSimulation, nullptr, "", &CALLBACKS, 0, 1), nullptr);
  EXPECT_EQ(fmi2Instantiate("x", fmi2ModelExchange, token, "", &CALLBACKS, 0, 1), nullptr);
  EXPECT_EQ(fmi2Instantiate("", fmi2CoSimulation, token, "", &CALLBACKS, 0, 1), nullptr);
  EXPECT_EQ(fmi2Instantiate(nullptr, fmi2CoSimulation, token, "", &CALLBACKS, 0, 1), nullptr);
  log_lines.clear();
  EXPECT_EQ(fmi2Instantiate("x", fmi2CoSimulation, "{wrong}", "", &CALLBACKS, 0, fmi2False), nullptr);
  EXPECT_TRUE(log_lines.empty()) << "logged although logging is off";
}

TEST(Fmi2, LogsOnlyWhenAskedAndOnlyTheCategoriesAsked) {
  fmi2Component c = make(fmi2False);
  EXPECT_EQ(fmi2DoStep(c, 0, 0.001, fmi2True), fmi2Error);
  EXPECT_TRUE(log_lines.empty());
  const fmi2String events[] = {"logEvents"};
  EXPECT_EQ(fmi2SetDebugLogging(c, fmi2True, 1, events), fmi2OK);
  EXPECT_EQ(fmi2DoStep(c, 0, 0.001, fmi2True), fmi2Error);
  EXPECT_TRUE(log_lines.empty());
  EXPECT_EQ(fmi2EnterInitializationMode(c), fmi2OK);
  EXPECT_EQ(fmi2ExitInitializationMode(c), fmi2OK);
  ASSERT_EQ(log_lines.size(), 1u);
  EXPECT_EQ(log_lines[0].category, "logEvents");
  const fmi2String unknown[] = {"logEverything"};
  EXPECT_EQ(fmi2SetDebugLogging(c, fmi2True, 1, unknown), fmi2Error);
  EXPECT_EQ(fmi2SetDebugLogging(c, fmi2True, 1, nullptr), fmi2Error);
  fmi2FreeInstance(c);
  const fmi2CallbackFunctions silent = {nullptr, nullptr, nullptr, nullptr, nullptr};
  c = fmi2Instantiate("x", fmi2CoSimulation, HOAP2_FMU_PRODUCT.token, "", &silent, 0, 1);
  EXPECT_EQ(fmi2DoStep(c, 0, 0.001, fmi2True), fmi2Error); /* no callback: no crash */
  fmi2FreeInstance(c);
}

TEST(Fmi2, UnknownReferencesAndNullArrays) {
  fmi2Component c = make_in(STEPPING);
  const unsigned in = some_field(HOAP2_FMU_INPUT, HOAP2_FMU_REAL).first_element;
  const unsigned beyond = HOAP2_FMU_PRODUCT.element_count + 1;
  for (const unsigned reference :
       {0u, beyond, 0xFFFFFFFFu, some_field(HOAP2_FMU_INPUT, HOAP2_FMU_INT).first_element}) {
    const unsigned references[2] = {in, reference};
    const fmi2Real values[2] = {0.5, 0.5};
    fmi2Real got[2];
    const std::vector<char> before = bytes_of(c);
    EXPECT_EQ(fmi2SetReal(c, references, 2, values), fmi2Error) << reference;
    EXPECT_EQ(bytes_of(c), before) << "the good half of a bad call was set";
    EXPECT_EQ(fmi2GetReal(c, references, 2, got), fmi2Error) << reference;
  }
  fmi2Real value = 0;
  EXPECT_EQ(fmi2GetReal(c, nullptr, 1, &value), fmi2Error);
  EXPECT_EQ(fmi2GetReal(c, &in, 1, nullptr), fmi2Error);
  EXPECT_EQ(fmi2SetReal(c, &in, 1, nullptr), fmi2Error);
  EXPECT_EQ(fmi2GetReal(c, nullptr, 0, nullptr), fmi2OK);
  fmi2FreeInstance(c);
}

TEST(Fmi2, EveryElementGoesToItsOwnPlace) {
  fmi2Component c = make();
  for (uint32_t i = 0; i < HOAP2_FMU_PRODUCT.field_count; ++i) {
    const hoap2_fmu_field_t& f = HOAP2_FMU_PRODUCT.fields[i];
    if (f.group != HOAP2_FMU_INPUT || f.kind != HOAP2_FMU_REAL) continue;
    for (uint32_t e = 0; e < f.count; ++e) {
      const unsigned reference = f.first_element + e;
      const fmi2Real value = 1e-3 * reference;
      EXPECT_EQ(fmi2SetReal(c, &reference, 1, &value), fmi2OK);
    }
  }
  EXPECT_EQ(fmi2EnterInitializationMode(c), fmi2OK);
  for (uint32_t i = 0; i < HOAP2_FMU_PRODUCT.field_count; ++i) {
    const hoap2_fmu_field_t& f = HOAP2_FMU_PRODUCT.fields[i];
    if (f.group != HOAP2_FMU_INPUT || f.kind != HOAP2_FMU_REAL) continue;
    std::vector<unsigned> backwards;
    for (uint32_t e = f.count; e-- > 0;) backwards.push_back(f.first_element + e);
    std::vector<fmi2Real> got(backwards.size());
    EXPECT_EQ(fmi2GetReal(c, backwards.data(), backwards.size(), got.data()), fmi2OK);
    for (size_t k = 0; k < got.size(); ++k) EXPECT_EQ(got[k], 1e-3 * backwards[k]) << f.name;
  }
  fmi2FreeInstance(c);
}

TEST(Fmi2, TunableParametersOnly) {
  if (!is_controller()) {
    EXPECT_EQ(tunable_fields(), 0u) << "the plant takes no parameters between steps";
    return;
  }
  fmi2Component c = make_in(STEPPING);
  const hoap2_fmu_field_t& tunable = field_named("tpcc_kp_1_s2");
  const fmi2Real good = 33.0, bad = tunable.high + 1.0, nan = std::nan("");
  fmi2Real got = 0;
  EXPECT_EQ(fmi2SetReal(c, &tunable.first_element, 1, &good), fmi2OK);
  for (const fmi2Real value : {bad, nan}) {
    log_lines.clear();
    EXPECT_EQ(fmi2SetReal(c, &tunable.first_element, 1, &value), fmi2Error);
    ASSERT_FALSE(log_lines.empty());
    EXPECT_NE(log_lines[0].text.find("tpcc_kp_1_s2"), std::string::npos);
  }
  EXPECT_EQ(fmi2GetReal(c, &tunable.first_element, 1, &got), fmi2OK);
  EXPECT_EQ(got, good);
  fmi2FreeInstance(c);
}

// Each tunable element between steps, within its range; any other parameter not at all.
TEST(Fmi2, EachTunableElementCanBeSetBetweenSteps) {
  fmi2Component c = make_in(STEPPING);
  unsigned refused = 0;
  for (uint32_t i = 0; i < HOAP2_FMU_PRODUCT.field_count; ++i) {
    const hoap2_fmu_field_t& f = HOAP2_FMU_PRODUCT.fields[i];
    if (f.group != HOAP2_FMU_PARAMETER || f.kind != HOAP2_FMU_REAL) continue;
    for (unsigned reference = f.first_element; reference < f.first_element + f.count; ++reference) {
      fmi2Real start = 0, got = 0;
      EXPECT_EQ(fmi2GetReal(c, &reference, 1, &start), fmi2OK);
      const fmi2Real other = start + 1e-4 * (start < f.high - 1e-4 ? 1.0 : -1.0), beyond = f.high + 1.0;
      EXPECT_EQ(fmi2SetReal(c, &reference, 1, &other), f.tunable ? fmi2OK : fmi2Error) << f.name;
      EXPECT_EQ(fmi2SetReal(c, &reference, 1, &beyond), fmi2Error) << f.name;
      EXPECT_EQ(fmi2GetReal(c, &reference, 1, &got), fmi2OK);
      EXPECT_EQ(got, f.tunable ? other : start) << f.name;
    }
    refused += f.tunable ? 0 : 1;
  }
  EXPECT_GT(refused, 10u);
  fmi2FreeInstance(c);
}

TEST(Fmi2, TunableParametersThatDoNotGoTogetherAreRefusedWithTheReason) {
  if (!is_controller()) return;
  fmi2Component c = make_in(STEPPING);
  const unsigned reference = field_named("tpcc_kx_1_s2").first_element;
  const fmi2Real bad = 10.0, good = 90.0; /* 10 is below tpcc_kp_1_s2 */
  fmi2Real got = 0;
  log_lines.clear();
  EXPECT_EQ(fmi2SetReal(c, &reference, 1, &bad), fmi2Error);
  ASSERT_FALSE(log_lines.empty());
  EXPECT_NE(log_lines[0].text.find("tpcc_kx_1_s2 > tpcc_kp_1_s2"), std::string::npos) << log_lines[0].text;
  EXPECT_EQ(fmi2SetReal(c, &reference, 1, &good), fmi2OK);
  EXPECT_EQ(fmi2GetReal(c, &reference, 1, &got), fmi2OK);
  EXPECT_EQ(got, good);
  fmi2FreeInstance(c);
}

TEST(Fmi2, OutOfRangeParameterCanBeMended) {
  fmi2Component c = make_in(INITIALISING);
  const hoap2_fmu_field_t& f = field_named(is_controller() ? "posture_rad" : "start_posture_rad");
  const unsigned reference = f.first_element + 3; /* r_knee */
  const fmi2Real bad = 99.0, good = 0.6951889664830044;
  EXPECT_EQ(fmi2SetReal(c, &reference, 1, &bad), fmi2OK);
  EXPECT_EQ(fmi2ExitInitializationMode(c), fmi2Error);
  ASSERT_FALSE(log_lines.empty());
  EXPECT_NE(log_lines.back().text.find("r_knee." + std::string(f.name) + " = 99"), std::string::npos)
      << log_lines.back().text;
  EXPECT_EQ(fmi2SetReal(c, &reference, 1, &good), fmi2OK);
  EXPECT_EQ(fmi2ExitInitializationMode(c), fmi2OK);
  fmi2FreeInstance(c);
}

TEST(Fmi2, DamagedStatesAreRefused) {
  fmi2Component c = make_in(STEPPING);
  EXPECT_EQ(fmi2DoStep(c, 0, 0.001, fmi2True), fmi2OK);
  const std::vector<char> good = bytes_of(c);
  fmi2FMUstate state = nullptr;
  for (size_t size = 0; size < good.size(); size += 1 + good.size() / 300) {
    EXPECT_EQ(fmi2DeSerializeFMUstate(c, good.data(), size, &state), fmi2Error) << size;
  }
  for (size_t i = 0; i < good.size(); i += i < 160 ? 1 : 37) {
    std::vector<char> bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x10);
    EXPECT_EQ(fmi2DeSerializeFMUstate(c, bad.data(), bad.size(), &state), fmi2Error) << "byte " << i;
    ASSERT_EQ(state, nullptr);
  }
  EXPECT_EQ(fmi2DeSerializeFMUstate(c, nullptr, good.size(), &state), fmi2Error);
  EXPECT_EQ(fmi2DeSerializeFMUstate(c, good.data(), good.size(), nullptr), fmi2Error);
  EXPECT_EQ(fmi2SetFMUstate(c, nullptr), fmi2Error);
  EXPECT_EQ(fmi2GetFMUstate(c, nullptr), fmi2Error);
  char little[8];
  EXPECT_EQ(fmi2GetFMUstate(c, &state), fmi2OK);
  EXPECT_EQ(fmi2SerializeFMUstate(c, state, little, sizeof little), fmi2Error);
  EXPECT_EQ(fmi2GetFMUstate(c, &state), fmi2OK); /* reuse */
  EXPECT_EQ(fmi2FreeFMUstate(c, &state), fmi2OK);
  EXPECT_EQ(fmi2FreeFMUstate(c, &state), fmi2OK); /* twice is harmless */
  EXPECT_EQ(bytes_of(c), good);
  fmi2FreeInstance(c);
}

TEST(Fmi2, ResetIsANewStart) {
  fmi2Component fresh = make_in(STEPPING), used = make_in(STEPPING);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(fmi2DoStep(used, i * 1e-3, 1e-3, fmi2True), fmi2OK);
  EXPECT_EQ(fmi2Reset(used), fmi2OK);
  EXPECT_EQ(fmi2SetupExperiment(used, fmi2False, 0, 0, fmi2False, 0), fmi2OK);
  EXPECT_EQ(fmi2EnterInitializationMode(used), fmi2OK);
  EXPECT_EQ(fmi2ExitInitializationMode(used), fmi2OK);
  EXPECT_EQ(bytes_of(fresh), bytes_of(used));
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(fmi2DoStep(used, i * 1e-3, 1e-3, fmi2True), fmi2OK);
    EXPECT_EQ(fmi2DoStep(fresh, i * 1e-3, 1e-3, fmi2True), fmi2OK);
  }
  EXPECT_EQ(bytes_of(fresh), bytes_of(used));
  fmi2FreeInstance(fresh);
  fmi2FreeInstance(used);
}

TEST(Fmi2, TimesOfAnExperiment) {
  fmi2Component c = make();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(fmi2SetupExperiment(c, 0, 0, std::nan(""), 0, 0), fmi2Error);
  EXPECT_EQ(fmi2SetupExperiment(c, 0, 0, inf, 0, 0), fmi2Error);
  EXPECT_EQ(fmi2SetupExperiment(c, 0, 0, 5.0, 1, 4.0), fmi2Error);
  EXPECT_EQ(fmi2SetupExperiment(c, 0, 0, 5.0, 1, 5.002), fmi2OK);
  EXPECT_EQ(fmi2EnterInitializationMode(c), fmi2OK);
  EXPECT_EQ(fmi2ExitInitializationMode(c), fmi2OK);
  EXPECT_EQ(fmi2DoStep(c, 0.0, 0.001, fmi2True), fmi2Error);
  EXPECT_EQ(fmi2DoStep(c, 5.0, 0.001, fmi2True), fmi2OK);
  EXPECT_EQ(fmi2DoStep(c, 5.0 + 0.001 + 1e-9, 0.001 - 1e-9, fmi2True), fmi2OK) << "sums of floats must do";
  EXPECT_EQ(fmi2DoStep(c, 5.002, 0.001, fmi2True), fmi2Error) << "beyond the stop time";
  fmi2Real now = 0;
  EXPECT_EQ(fmi2GetRealStatus(c, fmi2LastSuccessfulTime, &now), fmi2OK);
  EXPECT_DOUBLE_EQ(now, 5.002);
  fmi2FreeInstance(c);
}

}  // namespace
