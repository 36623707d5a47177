/* Calls that an FMU refuses, with the reason in the log. */
#ifndef HOAP2_FMU_FMI3_REFUSE_H
#define HOAP2_FMU_FMI3_REFUSE_H

#include "headers/fmi3Functions.h"
#include "instance.h"

static inline fmi3Status refuse(fmi3Instance instance, const char *call, const char *why) {
  if (instance) hoap2_fmu_error(instance, "%s: %s", call, why);
  return fmi3Error;
}

/* Of a type without variables only the empty list is right. */
static inline fmi3Status no_such_type(fmi3Instance instance, const char *call, unsigned modes, size_t count) {
  if (!hoap2_fmu_allowed(instance, call, modes)) return fmi3Error;
  return count == 0 ? fmi3OK : refuse(instance, call, "there are no variables of this type");
}

#endif
