/* FMI 3.0 with bus terminals: event mode, clocks, binaries (FMI-LS-BUS 1.0.0). */
#include <string.h>

#include "fmi3_refuse.h"
#include "ls_bus/terminals.h"
#include "ls_bus/side.h"

#define REQUIRE(instance, modes) \
  if (!hoap2_fmu_allowed(instance, __func__, modes)) return fmi3Error

/* The terminal of a reference that must be one of these two members; NULL and a log otherwise. */
static hoap2_ls_terminal_t *find(hoap2_fmu_instance_t *self, unsigned reference, int member, int or_member,
                                 int *found) {
  hoap2_ls_terminal_t *terminal = hoap2_ls_find(self, reference, found);
  if (!terminal || *found == member || *found == or_member) return terminal;
  hoap2_fmu_error(self, "value reference %u has another type", reference);
  return NULL;
}

static bool arguments_ok(hoap2_fmu_instance_t *self, const void *references, size_t count, const void *a,
                         const void *b) {
  if (count == 0 || (references && a && b)) return true;
  hoap2_fmu_error(self, "an argument is NULL");
  return false;
}

/* --- event mode --- */

static bool is_alive(hoap2_fmu_instance_t *self, const char *call) {
  if (self->event_mode_used) return true;
  hoap2_fmu_error(self, "%s: the FMU was instantiated without event mode", call);
  return false;
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
  REQUIRE(instance, HOAP2_FMU_STEPPING);
  if (!is_alive(instance, __func__)) return fmi3Error;
  ((hoap2_fmu_instance_t *)instance)->mode = HOAP2_FMU_EVENT;
  return fmi3OK;
}

fmi3Status fmi3EnterStepMode(fmi3Instance instance) {
  REQUIRE(instance, HOAP2_FMU_EVENT);
  ((hoap2_fmu_instance_t *)instance)->mode = HOAP2_FMU_STEPPING;
  return fmi3OK;
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance) {
  REQUIRE(instance, HOAP2_FMU_EVENT);
  return fmi3OK;
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *discreteStatesNeedUpdate,
                                    fmi3Boolean *terminateSimulation,
                                    fmi3Boolean *nominalsOfContinuousStatesChanged,
                                    fmi3Boolean *valuesOfContinuousStatesChanged,
                                    fmi3Boolean *nextEventTimeDefined, fmi3Float64 *nextEventTime) {
  REQUIRE(instance, HOAP2_FMU_EVENT);
  hoap2_ls_update(instance);
  if (discreteStatesNeedUpdate) *discreteStatesNeedUpdate = fmi3False;
  if (terminateSimulation) *terminateSimulation = fmi3False;
  if (nominalsOfContinuousStatesChanged) *nominalsOfContinuousStatesChanged = fmi3False;
  if (valuesOfContinuousStatesChanged) *valuesOfContinuousStatesChanged = fmi3False;
  if (nextEventTimeDefined) *nextEventTimeDefined = fmi3False;
  if (nextEventTime) *nextEventTime = 0.0;
  return fmi3OK;
}

/* --- clocks --- */

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                        size_t nValueReferences, fmi3Clock values[]) {
  REQUIRE(instance, HOAP2_FMU_EVENT);
  if (!arguments_ok(instance, valueReferences, nValueReferences, values, values)) return fmi3Error;
  for (size_t i = 0; i < nValueReferences; ++i) {
    int member;
    const hoap2_ls_terminal_t *terminal =
        find(instance, valueReferences[i], HOAP2_LS_RX_CLOCK, HOAP2_LS_TX_CLOCK, &member);
    if (!terminal) return fmi3Error;
    values[i] = member == HOAP2_LS_RX_CLOCK ? terminal->rx_active != 0 : terminal->tx_active != 0;
  }
  return fmi3OK;
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                        size_t nValueReferences, const fmi3Clock values[]) {
  REQUIRE(instance, HOAP2_FMU_EVENT);
  if (!arguments_ok(instance, valueReferences, nValueReferences, values, values)) return fmi3Error;
  int member;
  for (size_t i = 0; i < nValueReferences; ++i) {
    if (!find(instance, valueReferences[i], HOAP2_LS_RX_CLOCK, HOAP2_LS_TX_CLOCK, &member)) return fmi3Error;
  }
  for (size_t i = 0; i < nValueReferences; ++i) {
    hoap2_ls_terminal_t *terminal = hoap2_ls_find(instance, valueReferences[i], &member);
    if (member == HOAP2_LS_RX_CLOCK) {
      terminal->rx_active = values[i];
      terminal->rx_size = 0;
    } else {
      terminal->tx_active = values[i];
    }
  }
  return fmi3OK;
}

fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                  size_t nValueReferences, fmi3Float64 intervals[],
                                  fmi3IntervalQualifier qualifiers[]) {
  REQUIRE(instance, HOAP2_FMU_INITIALISING | HOAP2_FMU_EVENT);
  if (!is_alive(instance, __func__) ||
      !arguments_ok(instance, valueReferences, nValueReferences, intervals, qualifiers))
    return fmi3Error;
  for (size_t i = 0; i < nValueReferences; ++i) {
    int member;
    hoap2_ls_terminal_t *terminal =
        find(instance, valueReferences[i], HOAP2_LS_TX_CLOCK, HOAP2_LS_TX_CLOCK, &member);
    if (!terminal) return fmi3Error;
    const int64_t left_ns =
        ((hoap2_fmu_instance_t *)instance)->mode == HOAP2_FMU_EVENT ? hoap2_ls_interval_ns(instance, terminal) : -1;
    intervals[i] = left_ns > 0 ? (double)left_ns / 1e9 : 0.0;
    qualifiers[i] = left_ns < 0          ? fmi3IntervalNotYetKnown
                    : terminal->announced ? fmi3IntervalUnchanged
                                          : fmi3IntervalChanged;
    terminal->announced = left_ns >= 0;
  }
  return fmi3OK;
}

/* --- binaries: they can be touched only while their clock ticks --- */

static bool ticks_now(hoap2_fmu_instance_t *self, bool active, unsigned reference) {
  if (active) return true;
  hoap2_fmu_error(self, "value reference %u: its clock does not tick now", reference);
  return false;
}

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                         size_t nValueReferences, size_t valueSizes[], fmi3Binary values[], size_t nValues) {
  REQUIRE(instance, HOAP2_FMU_EVENT);
  if (!arguments_ok(instance, valueReferences, nValueReferences, valueSizes, values)) return fmi3Error;
  if (nValues != nValueReferences) return refuse(instance, __func__, "as many values as references are needed");
  for (size_t i = 0; i < nValueReferences; ++i) {
    int member;
    hoap2_ls_terminal_t *terminal =
        find(instance, valueReferences[i], HOAP2_LS_RX_DATA, HOAP2_LS_TX_DATA, &member);
    if (!terminal) return fmi3Error;
    const bool sends = member == HOAP2_LS_TX_DATA;
    if (!ticks_now(instance, sends ? terminal->tx_active : terminal->rx_active, valueReferences[i])) return fmi3Error;
    valueSizes[i] = (size_t)(sends ? terminal->tx_size : terminal->rx_size);
    values[i] = sends ? terminal->tx : terminal->rx;
  }
  return fmi3OK;
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                         size_t nValueReferences, const size_t valueSizes[], const fmi3Binary values[],
                         size_t nValues) {
  REQUIRE(instance, HOAP2_FMU_EVENT);
  if (!arguments_ok(instance, valueReferences, nValueReferences, valueSizes, values)) return fmi3Error;
  if (nValues != nValueReferences) return refuse(instance, __func__, "as many values as references are needed");
  for (size_t i = 0; i < nValueReferences; ++i) {
    int member;
    const hoap2_ls_terminal_t *terminal =
        find(instance, valueReferences[i], HOAP2_LS_RX_DATA, HOAP2_LS_RX_DATA, &member);
    if (!terminal || !ticks_now(instance, terminal->rx_active, valueReferences[i])) return fmi3Error;
    if (valueSizes[i] > HOAP2_LS_ROOM) return refuse(instance, __func__, "a value is larger than its maxSize");
    if (valueSizes[i] > 0 && !values[i]) return refuse(instance, __func__, "a value is NULL");
  }
  for (size_t i = 0; i < nValueReferences; ++i) {
    int member;
    hoap2_ls_terminal_t *terminal = hoap2_ls_find(instance, valueReferences[i], &member);
    if (valueSizes[i] > 0) memcpy(terminal->rx, values[i], valueSizes[i]);
    terminal->rx_size = valueSizes[i];
  }
  return fmi3OK;
}
