/* What the FMI 3.0 shell needs of a flavour with bus terminals. One of these is linked into each FMU: no_network.c,
 * or ls_bus/terminals.c.
 */
#ifndef HOAP2_FMU_NETWORK_H
#define HOAP2_FMU_NETWORK_H

#include "instance.h"

const char *hoap2_network_name(void);  /* modelIdentifier */
const char *hoap2_network_token(void); /* instantiationToken */
bool hoap2_network_present(void);
size_t hoap2_network_size(void); /* of its state, which is saved with the instance's */

/* End of the initialisation. */
void hoap2_network_start(hoap2_fmu_instance_t *self);
/* Any step; nothing changes when it fails. */
hoap2_fmu_status_t hoap2_network_do_step(hoap2_fmu_instance_t *self, double now_s, double step_s);
double hoap2_network_time_s(const hoap2_fmu_instance_t *self);
/* NULL, or why this saved state cannot be this instance's. */
const char *hoap2_network_fault(const hoap2_fmu_instance_t *self, const void *saved, bool initialised);
/* A whole tick has been reached, and is done in the next event mode. */
bool hoap2_network_tick_is_due(const hoap2_fmu_instance_t *self);

#endif
