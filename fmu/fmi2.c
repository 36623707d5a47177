/* FMI 2.0 Co-Simulation: every variable is a scalar. */
#include <math.h>
#include <string.h>

#include "headers/fmi2Functions.h"
#include "instance.h"

static fmi2Status status_of(hoap2_fmu_status_t status) { return status == HOAP2_FMU_OK ? fmi2OK : fmi2Error; }

/* Leave the function unless the instance exists and its state allows the call. */
#define REQUIRE(component, modes) \
  if (!hoap2_fmu_allowed(component, __func__, modes)) return fmi2Error

static fmi2Status refuse(fmi2Component c, const char *call, const char *why) {
  if (c) hoap2_fmu_error(c, "%s: %s", call, why);
  return fmi2Error;
}

static void emit(hoap2_fmu_instance_t *self, hoap2_fmu_category_t category, const char *name,
                 const char *text) {
  const fmi2CallbackLogger logger = (fmi2CallbackLogger)self->logger;
  const fmi2Status status = category == HOAP2_FMU_LOG_ERROR     ? fmi2Error
                            : category == HOAP2_FMU_LOG_WARNING ? fmi2Warning
                                                                : fmi2OK;
  logger(self->environment, self->name, status, name, text);
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }

const char *fmi2GetVersion(void) { return "2.0"; }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean loggingOn, size_t nCategories,
                               const fmi2String categories[]) {
  REQUIRE(c, HOAP2_FMU_ANY_MODE);
  return status_of(hoap2_fmu_set_logging(c, loggingOn != fmi2False, nCategories, categories));
}

fmi2Component fmi2Instantiate(fmi2String instanceName, fmi2Type fmuType, fmi2String fmuGUID,
                              fmi2String fmuResourceLocation, const fmi2CallbackFunctions *functions,
                              fmi2Boolean visible, fmi2Boolean loggingOn) {
  (void)fmuResourceLocation;
  (void)visible;
  if (!functions) return NULL;
  const char *name = instanceName ? instanceName : "";
  hoap2_fmu_instance_t *self = hoap2_fmu_create(name, emit, (void (*)(void))functions->logger,
                                                functions->componentEnvironment, loggingOn != fmi2False);
  if (!self) return NULL;
  bool ok = true;
  if (name[0] == '\0') ok = hoap2_fmu_error(self, "the instance has no name") == HOAP2_FMU_OK;
  if (fmuType != fmi2CoSimulation)
    ok = hoap2_fmu_error(self, "only Co-Simulation is offered") == HOAP2_FMU_OK;
  if (!fmuGUID || strcmp(fmuGUID, HOAP2_FMU_PRODUCT.token) != 0) {
    ok = hoap2_fmu_error(self, "guid %s is not this FMU's %s", fmuGUID ? fmuGUID : "(null)",
                         HOAP2_FMU_PRODUCT.token) == HOAP2_FMU_OK;
  }
  if (ok) return self;
  hoap2_fmu_free(self);
  return NULL;
}

void fmi2FreeInstance(fmi2Component c) { hoap2_fmu_free(c); }

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined, fmi2Real tolerance,
                               fmi2Real startTime, fmi2Boolean stopTimeDefined, fmi2Real stopTime) {
  (void)toleranceDefined;
  (void)tolerance;
  REQUIRE(c, HOAP2_FMU_INSTANTIATED);
  return status_of(hoap2_fmu_set_times(c, startTime, stopTimeDefined != fmi2False, stopTime));
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
  REQUIRE(c, HOAP2_FMU_INSTANTIATED);
  return status_of(hoap2_fmu_enter_initialisation(c));
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  REQUIRE(c, HOAP2_FMU_INITIALISING);
  return status_of(hoap2_fmu_exit_initialisation(c));
}

fmi2Status fmi2Terminate(fmi2Component c) {
  REQUIRE(c, HOAP2_FMU_STEPPING);
  ((hoap2_fmu_instance_t *)c)->mode = HOAP2_FMU_TERMINATED;
  return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component c) {
  REQUIRE(c, HOAP2_FMU_ANY_MODE);
  hoap2_fmu_reset(c);
  return fmi2OK;
}

/* --- values --- */

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Real value[]) {
  REQUIRE(c, HOAP2_FMU_CAN_GET);
  return status_of(hoap2_fmu_get(c, false, HOAP2_FMU_REAL, vr, nvr, value, nvr));
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Integer value[]) {
  REQUIRE(c, HOAP2_FMU_CAN_GET);
  return status_of(hoap2_fmu_get(c, false, HOAP2_FMU_INT, vr, nvr, value, nvr));
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Real value[]) {
  REQUIRE(c, HOAP2_FMU_CAN_SET);
  return status_of(hoap2_fmu_set(c, false, HOAP2_FMU_REAL, vr, nvr, value, nvr));
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                          const fmi2Integer value[]) {
  REQUIRE(c, HOAP2_FMU_CAN_SET);
  return status_of(hoap2_fmu_set(c, false, HOAP2_FMU_INT, vr, nvr, value, nvr));
}

/* There are no Boolean and String variables: only the empty list is right. */
static fmi2Status no_such_type(fmi2Component c, const char *call, unsigned modes, size_t nvr) {
  if (!hoap2_fmu_allowed(c, call, modes)) return fmi2Error;
  return nvr == 0 ? fmi2OK : refuse(c, call, "there are no variables of this type");
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Boolean value[]) {
  (void)vr;
  (void)value;
  return no_such_type(c, __func__, HOAP2_FMU_CAN_GET, nvr);
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2String value[]) {
  (void)vr;
  (void)value;
  return no_such_type(c, __func__, HOAP2_FMU_CAN_GET, nvr);
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                          const fmi2Boolean value[]) {
  (void)vr;
  (void)value;
  return no_such_type(c, __func__, HOAP2_FMU_CAN_SET, nvr);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                         const fmi2String value[]) {
  (void)vr;
  (void)value;
  return no_such_type(c, __func__, HOAP2_FMU_CAN_SET, nvr);
}

/* --- states --- */

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) {
  REQUIRE(c, HOAP2_FMU_ANY_MODE);
  return status_of(hoap2_fmu_get_state(c, FMUstate));
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate FMUstate) {
  REQUIRE(c, HOAP2_FMU_ANY_MODE);
  return status_of(hoap2_fmu_set_state(c, FMUstate));
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) {
  REQUIRE(c, HOAP2_FMU_ANY_MODE);
  return status_of(hoap2_fmu_free_state(c, FMUstate));
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate FMUstate, size_t *size) {
  REQUIRE(c, HOAP2_FMU_ANY_MODE);
  return status_of(hoap2_fmu_serialized_size(c, FMUstate, size));
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate FMUstate, fmi2Byte serializedState[],
                                 size_t size) {
  REQUIRE(c, HOAP2_FMU_ANY_MODE);
  return status_of(hoap2_fmu_serialize(c, FMUstate, serializedState, size));
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte serializedState[], size_t size,
                                   fmi2FMUstate *FMUstate) {
  REQUIRE(c, HOAP2_FMU_ANY_MODE);
  return status_of(hoap2_fmu_deserialize(c, serializedState, size, FMUstate));
}

/* --- stepping --- */

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real currentCommunicationPoint, fmi2Real communicationStepSize,
                      fmi2Boolean noSetFMUStatePriorToCurrentPoint) {
  (void)noSetFMUStatePriorToCurrentPoint;
  REQUIRE(c, HOAP2_FMU_STEPPING);
  return status_of(hoap2_fmu_do_step(c, currentCommunicationPoint, communicationStepSize));
}

fmi2Status fmi2CancelStep(fmi2Component c) { return refuse(c, __func__, "steps are never asynchronous"); }

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                       const fmi2Integer order[], const fmi2Real value[]) {
  (void)vr;
  (void)nvr;
  (void)order;
  (void)value;
  return refuse(c, __func__, "inputs are held, not extrapolated");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                        const fmi2Integer order[], fmi2Real value[]) {
  (void)vr;
  (void)nvr;
  (void)order;
  (void)value;
  return refuse(c, __func__, "output derivatives are not offered");
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind s, fmi2Status *value) {
  (void)s;
  (void)value;
  return refuse(c, __func__, "steps are never asynchronous");
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind s, fmi2Real *value) {
  REQUIRE(c, HOAP2_FMU_STEPPING | HOAP2_FMU_TERMINATED);
  if (s != fmi2LastSuccessfulTime || !value)
    return refuse(c, __func__, "only fmi2LastSuccessfulTime is known");
  *value = hoap2_fmu_time_s(c);
  return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind s, fmi2Integer *value) {
  (void)s;
  (void)value;
  return refuse(c, __func__, "there is no integer status");
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind s, fmi2Boolean *value) {
  REQUIRE(c, HOAP2_FMU_STEPPING | HOAP2_FMU_TERMINATED);
  if (s != fmi2Terminated || !value) return refuse(c, __func__, "only fmi2Terminated is known");
  *value = fmi2False; /* the FMU never asks for the end */
  return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind s, fmi2String *value) {
  (void)s;
  (void)value;
  return refuse(c, __func__, "there is no string status");
}
