/* What FMI 2.0 has and these FMUs do not (Model Exchange, directional derivatives): importers
 * bind every function at load, so each one exists and says why it refuses.
 */
#include "headers/fmi2Functions.h"
#include "instance.h"

/* the whole file is about arguments that nobody looks at */
#pragma GCC diagnostic ignored "-Wunused-parameter"

static fmi2Status refuse(fmi2Component c, const char *call) {
  if (c) hoap2_fmu_error(c, "%s: not offered, these are Co-Simulation FMUs", call);
  return fmi2Error;
}

fmi2Status fmi2EnterEventMode(fmi2Component c) { return refuse(c, __func__); }

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *fmi2eventInfo) {
  return refuse(c, __func__);
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) { return refuse(c, __func__); }

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi2Boolean *enterEventMode, fmi2Boolean *terminateSimulation) {
  return refuse(c, __func__);
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time) { return refuse(c, __func__); }

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t nx) {
  return refuse(c, __func__);
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t nx) {
  return refuse(c, __func__);
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real eventIndicators[], size_t ni) {
  return refuse(c, __func__);
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t nx) { return refuse(c, __func__); }

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real x_nominal[], size_t nx) {
  return refuse(c, __func__);
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference vUnknown_ref[],
                                        size_t nUnknown, const fmi2ValueReference vKnown_ref[], size_t nKnown,
                                        const fmi2Real dvKnown[], fmi2Real dvUnknown[]) {
  return refuse(c, __func__);
}
