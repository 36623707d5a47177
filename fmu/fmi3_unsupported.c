/* What FMI 3.0 has and none of these FMUs does: importers bind every function at load, so each
 * one exists and says why it refuses.
 */
#include "fmi3_refuse.h"

/* the whole file is about arguments that nobody looks at */
#pragma GCC diagnostic ignored "-Wunused-parameter"

fmi3Instance fmi3InstantiateModelExchange(fmi3String instanceName, fmi3String instantiationToken,
                                          fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                          fmi3InstanceEnvironment instanceEnvironment,
                                          fmi3LogMessageCallback logMessage) {
  if (loggingOn && logMessage) {
    logMessage(instanceEnvironment, fmi3Error, "logStatusError", "only Co-Simulation is offered");
  }
  return NULL;
}

fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath, fmi3Boolean visible,
    fmi3Boolean loggingOn, fmi3InstanceEnvironment instanceEnvironment, fmi3LogMessageCallback logMessage,
    fmi3ClockUpdateCallback clockUpdate, fmi3LockPreemptionCallback lockPreemption,
    fmi3UnlockPreemptionCallback unlockPreemption) {
  if (loggingOn && logMessage) {
    logMessage(instanceEnvironment, fmi3Error, "logStatusError", "only Co-Simulation is offered");
  }
  return NULL;
}

/* --- types without variables: only the empty list is right --- */

#define NO_VARIABLES(type)                                                                             \
  fmi3Status fmi3Get##type(fmi3Instance instance, const fmi3ValueReference references[], size_t count, \
                           fmi3##type values[], size_t value_count) {                                  \
    return no_such_type(instance, __func__, HOAP2_FMU_CAN_GET, count);                                 \
  }                                                                                                    \
  fmi3Status fmi3Set##type(fmi3Instance instance, const fmi3ValueReference references[], size_t count, \
                           const fmi3##type values[], size_t value_count) {                            \
    return no_such_type(instance, __func__, HOAP2_FMU_CAN_SET, count);                                 \
  }

NO_VARIABLES(Float32)
NO_VARIABLES(Int8)
NO_VARIABLES(UInt8)
NO_VARIABLES(Int16)
NO_VARIABLES(UInt16)
NO_VARIABLES(UInt32)
NO_VARIABLES(Int64)
NO_VARIABLES(UInt64)
NO_VARIABLES(Boolean)
NO_VARIABLES(String)

/* --- configuration mode --- */

fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance) {
  return refuse(instance, __func__, "there is no configuration mode");
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance) {
  return refuse(instance, __func__, "there is no configuration mode");
}

/* --- clocks --- */

fmi3Status fmi3GetIntervalFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                   size_t nValueReferences, fmi3UInt64 counters[], fmi3UInt64 resolutions[],
                                   fmi3IntervalQualifier qualifiers[]) {
  return refuse(instance, __func__, "there are no clocks of this kind");
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                               size_t nValueReferences, fmi3Float64 shifts[]) {
  return refuse(instance, __func__, "there are no clocks of this kind");
}

fmi3Status fmi3GetShiftFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                size_t nValueReferences, fmi3UInt64 counters[], fmi3UInt64 resolutions[]) {
  return refuse(instance, __func__, "there are no clocks of this kind");
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                  size_t nValueReferences, const fmi3Float64 intervals[]) {
  return refuse(instance, __func__, "there are no clocks of this kind");
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                   size_t nValueReferences, const fmi3UInt64 counters[],
                                   const fmi3UInt64 resolutions[]) {
  return refuse(instance, __func__, "there are no clocks of this kind");
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                               size_t nValueReferences, const fmi3Float64 shifts[]) {
  return refuse(instance, __func__, "there are no clocks of this kind");
}

fmi3Status fmi3SetShiftFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                size_t nValueReferences, const fmi3UInt64 counters[],
                                const fmi3UInt64 resolutions[]) {
  return refuse(instance, __func__, "there are no clocks of this kind");
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference clockReference,
                                      fmi3Float64 activationTime) {
  return refuse(instance, __func__, "there are no clocks of this kind");
}

/* --- dependencies and derivatives --- */

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference valueReference,
                                               size_t *nDependencies) {
  return refuse(instance, __func__, "not offered");
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent,
                                       size_t elementIndicesOfDependent[], fmi3ValueReference independents[],
                                       size_t elementIndicesOfIndependents[],
                                       fmi3DependencyKind dependencyKinds[], size_t nDependencies) {
  return refuse(instance, __func__, "not offered");
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                        size_t nUnknowns, const fmi3ValueReference knowns[], size_t nKnowns,
                                        const fmi3Float64 seed[], size_t nSeed, fmi3Float64 sensitivity[],
                                        size_t nSensitivity) {
  return refuse(instance, __func__, "not offered");
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                    size_t nUnknowns, const fmi3ValueReference knowns[], size_t nKnowns,
                                    const fmi3Float64 seed[], size_t nSeed, fmi3Float64 sensitivity[],
                                    size_t nSensitivity) {
  return refuse(instance, __func__, "not offered");
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                    size_t nValueReferences, const fmi3Int32 orders[], fmi3Float64 values[],
                                    size_t nValues) {
  return refuse(instance, __func__, "not offered");
}

/* --- Model Exchange --- */

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance) {
  return refuse(instance, __func__, "only Co-Simulation is offered");
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi3Boolean *enterEventMode, fmi3Boolean *terminateSimulation) {
  return refuse(instance, __func__, "only Co-Simulation is offered");
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time) {
  return refuse(instance, __func__, "only Co-Simulation is offered");
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 continuousStates[],
                                   size_t nContinuousStates) {
  return refuse(instance, __func__, "only Co-Simulation is offered");
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 derivatives[],
                                             size_t nContinuousStates) {
  return refuse(instance, __func__, "only Co-Simulation is offered");
}

fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 eventIndicators[],
                                  size_t nEventIndicators) {
  return refuse(instance, __func__, "only Co-Simulation is offered");
}

fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 continuousStates[],
                                   size_t nContinuousStates) {
  return refuse(instance, __func__, "only Co-Simulation is offered");
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[],
                                             size_t nContinuousStates) {
  return refuse(instance, __func__, "only Co-Simulation is offered");
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *nEventIndicators) {
  return refuse(instance, __func__, "only Co-Simulation is offered");
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *nContinuousStates) {
  return refuse(instance, __func__, "only Co-Simulation is offered");
}
