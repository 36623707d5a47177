/* An FMU without bus terminals: neither clocks nor binaries nor event mode. */
#include "fmi3_refuse.h"

/* the whole file is about arguments that nobody looks at */
#pragma GCC diagnostic ignored "-Wunused-parameter"

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                         size_t nValueReferences, size_t valueSizes[], fmi3Binary values[], size_t nValues) {
  return no_such_type(instance, __func__, HOAP2_FMU_CAN_GET, nValueReferences);
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                         size_t nValueReferences, const size_t valueSizes[], const fmi3Binary values[],
                         size_t nValues) {
  return no_such_type(instance, __func__, HOAP2_FMU_CAN_SET, nValueReferences);
}

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                        size_t nValueReferences, fmi3Clock values[]) {
  return no_such_type(instance, __func__, HOAP2_FMU_CAN_GET, nValueReferences);
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                        size_t nValueReferences, const fmi3Clock values[]) {
  return no_such_type(instance, __func__, HOAP2_FMU_CAN_SET, nValueReferences);
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
  return refuse(instance, __func__, "there is no event mode");
}

fmi3Status fmi3EnterStepMode(fmi3Instance instance) {
  return refuse(instance, __func__, "there is no event mode");
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance) {
  return refuse(instance, __func__, "there is no event mode");
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *discreteStatesNeedUpdate,
                                    fmi3Boolean *terminateSimulation,
                                    fmi3Boolean *nominalsOfContinuousStatesChanged,
                                    fmi3Boolean *valuesOfContinuousStatesChanged,
                                    fmi3Boolean *nextEventTimeDefined, fmi3Float64 *nextEventTime) {
  return refuse(instance, __func__, "there is no event mode");
}

fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                  size_t nValueReferences, fmi3Float64 intervals[],
                                  fmi3IntervalQualifier qualifiers[]) {
  return refuse(instance, __func__, "there are no clocks");
}
