/* A flavour without bus terminals. */
#include "network.h"

const char *hoap2_network_name(void) { return HOAP2_FMU_PRODUCT.name; }

const char *hoap2_network_token(void) { return HOAP2_FMU_PRODUCT.token; }

bool hoap2_network_present(void) { return false; }

size_t hoap2_network_size(void) { return 0; }

void hoap2_network_start(hoap2_fmu_instance_t *self) { (void)self; }

hoap2_fmu_status_t hoap2_network_do_step(hoap2_fmu_instance_t *self, double now_s, double step_s) {
  (void)now_s;
  (void)step_s;
  return hoap2_fmu_error(self, "there is no network");
}

double hoap2_network_time_s(const hoap2_fmu_instance_t *self) { return self->start_time_s; }

const char *hoap2_network_fault(const hoap2_fmu_instance_t *self, const void *saved, bool initialised) {
  (void)initialised;
  (void)self;
  (void)saved;
  return NULL;
}

bool hoap2_network_tick_is_due(const hoap2_fmu_instance_t *self) {
  (void)self;
  return false;
}
