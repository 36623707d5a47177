/* FMI 3.0 Co-Simulation: one variable a row of the table, arrays as arrays. */
#include <string.h>

#include "headers/fmi3Functions.h"
#include "instance.h"
#include "network.h"

static fmi3Status status_of(hoap2_fmu_status_t status) { return status == HOAP2_FMU_OK ? fmi3OK : fmi3Error; }

/* Leave the function unless the instance exists and its state allows the call. */
#define REQUIRE(instance, modes) \
  if (!hoap2_fmu_allowed(instance, __func__, modes)) return fmi3Error

static void emit(hoap2_fmu_instance_t *self, hoap2_fmu_category_t category, const char *name,
                 const char *text) {
  const fmi3LogMessageCallback logger = (fmi3LogMessageCallback)self->logger;
  const fmi3Status status = category == HOAP2_FMU_LOG_ERROR     ? fmi3Error
                            : category == HOAP2_FMU_LOG_WARNING ? fmi3Warning
                                                                : fmi3OK;
  logger(self->environment, status, name, text);
}

const char *fmi3GetVersion(void) { return fmi3Version; }

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean loggingOn, size_t nCategories,
                               const fmi3String categories[]) {
  REQUIRE(instance, HOAP2_FMU_ANY_MODE);
  return status_of(hoap2_fmu_set_logging(instance, loggingOn, nCategories, categories));
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String instanceName, fmi3String instantiationToken,
                                         fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                         fmi3Boolean eventModeUsed, fmi3Boolean earlyReturnAllowed,
                                         const fmi3ValueReference requiredIntermediateVariables[],
                                         size_t nRequiredIntermediateVariables,
                                         fmi3InstanceEnvironment instanceEnvironment,
                                         fmi3LogMessageCallback logMessage,
                                         fmi3IntermediateUpdateCallback intermediateUpdate) {
  (void)resourcePath;
  (void)visible;
  (void)earlyReturnAllowed;
  (void)requiredIntermediateVariables;
  (void)intermediateUpdate;
  const char *name = instanceName ? instanceName : "";
  hoap2_fmu_instance_t *self =
      hoap2_fmu_create(name, emit, (void (*)(void))logMessage, instanceEnvironment, loggingOn);
  if (!self) return NULL;
  bool ok = true;
  if (name[0] == '\0') ok = hoap2_fmu_error(self, "the instance has no name") == HOAP2_FMU_OK;
  self->event_mode_used = eventModeUsed && hoap2_network_present();
  if (eventModeUsed && !hoap2_network_present()) {
    ok = hoap2_fmu_error(self, "event mode is not offered") == HOAP2_FMU_OK;
  }
  if (!eventModeUsed && hoap2_network_present()) {
    hoap2_fmu_log(self, HOAP2_FMU_LOG_WARNING,
                  "instantiated without event mode: the bus terminals are dormant, signals go by the variables");
  }
  if (nRequiredIntermediateVariables > 0) {
    ok = hoap2_fmu_error(self, "intermediate updates are not offered") == HOAP2_FMU_OK;
  }
  if (!instantiationToken || strcmp(instantiationToken, hoap2_network_token()) != 0) {
    ok = hoap2_fmu_error(self, "instantiation token %s is not this FMU's %s",
                         instantiationToken ? instantiationToken : "(null)",
                         hoap2_network_token()) == HOAP2_FMU_OK;
  }
  if (ok) return self;
  hoap2_fmu_free(self);
  return NULL;
}

void fmi3FreeInstance(fmi3Instance instance) { hoap2_fmu_free(instance); }

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean toleranceDefined,
                                       fmi3Float64 tolerance, fmi3Float64 startTime,
                                       fmi3Boolean stopTimeDefined, fmi3Float64 stopTime) {
  (void)toleranceDefined;
  (void)tolerance;
  REQUIRE(instance, HOAP2_FMU_INSTANTIATED);
  if (hoap2_fmu_set_times(instance, startTime, stopTimeDefined, stopTime) != HOAP2_FMU_OK) return fmi3Error;
  return status_of(hoap2_fmu_enter_initialisation(instance));
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
  REQUIRE(instance, HOAP2_FMU_INITIALISING);
  return status_of(hoap2_fmu_exit_initialisation(instance));
}

fmi3Status fmi3Terminate(fmi3Instance instance) {
  REQUIRE(instance, HOAP2_FMU_RUNNING);
  ((hoap2_fmu_instance_t *)instance)->mode = HOAP2_FMU_TERMINATED;
  return fmi3OK;
}

fmi3Status fmi3Reset(fmi3Instance instance) {
  REQUIRE(instance, HOAP2_FMU_ANY_MODE);
  hoap2_fmu_reset(instance);
  return fmi3OK;
}

/* --- values --- */

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                          size_t nValueReferences, fmi3Float64 values[], size_t nValues) {
  REQUIRE(instance, HOAP2_FMU_CAN_GET);
  return status_of(
      hoap2_fmu_get(instance, true, HOAP2_FMU_REAL, valueReferences, nValueReferences, values, nValues));
}

fmi3Status fmi3GetInt32(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                        size_t nValueReferences, fmi3Int32 values[], size_t nValues) {
  REQUIRE(instance, HOAP2_FMU_CAN_GET);
  return status_of(
      hoap2_fmu_get(instance, true, HOAP2_FMU_INT, valueReferences, nValueReferences, values, nValues));
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                          size_t nValueReferences, const fmi3Float64 values[], size_t nValues) {
  REQUIRE(instance, HOAP2_FMU_CAN_SET);
  return status_of(
      hoap2_fmu_set(instance, true, HOAP2_FMU_REAL, valueReferences, nValueReferences, values, nValues));
}

fmi3Status fmi3SetInt32(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                        size_t nValueReferences, const fmi3Int32 values[], size_t nValues) {
  REQUIRE(instance, HOAP2_FMU_CAN_SET);
  return status_of(
      hoap2_fmu_set(instance, true, HOAP2_FMU_INT, valueReferences, nValueReferences, values, nValues));
}

/* --- states --- */

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *FMUState) {
  REQUIRE(instance, HOAP2_FMU_ANY_MODE);
  return status_of(hoap2_fmu_get_state(instance, FMUState));
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState FMUState) {
  REQUIRE(instance, HOAP2_FMU_ANY_MODE);
  return status_of(hoap2_fmu_set_state(instance, FMUState));
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *FMUState) {
  REQUIRE(instance, HOAP2_FMU_ANY_MODE);
  return status_of(hoap2_fmu_free_state(instance, FMUState));
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState FMUState, size_t *size) {
  REQUIRE(instance, HOAP2_FMU_ANY_MODE);
  return status_of(hoap2_fmu_serialized_size(instance, FMUState, size));
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState FMUState, fmi3Byte serializedState[],
                                 size_t size) {
  REQUIRE(instance, HOAP2_FMU_ANY_MODE);
  return status_of(hoap2_fmu_serialize(instance, FMUState, serializedState, size));
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte serializedState[], size_t size,
                                   fmi3FMUState *FMUState) {
  REQUIRE(instance, HOAP2_FMU_ANY_MODE);
  return status_of(hoap2_fmu_deserialize(instance, serializedState, size, FMUState));
}

/* --- stepping --- */

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 currentCommunicationPoint,
                      fmi3Float64 communicationStepSize, fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                      fmi3Boolean *eventHandlingNeeded, fmi3Boolean *terminateSimulation,
                      fmi3Boolean *earlyReturn, fmi3Float64 *lastSuccessfulTime) {
  (void)noSetFMUStatePriorToCurrentPoint;
  REQUIRE(instance, HOAP2_FMU_STEPPING);
  if (terminateSimulation) *terminateSimulation = fmi3False;
  if (earlyReturn) *earlyReturn = fmi3False;
  const hoap2_fmu_status_t status =
      hoap2_fmu_do_step(instance, currentCommunicationPoint, communicationStepSize);
  if (eventHandlingNeeded) *eventHandlingNeeded = hoap2_network_tick_is_due(instance);
  if (lastSuccessfulTime) *lastSuccessfulTime = hoap2_fmu_time_s(instance);
  return status_of(status);
}
