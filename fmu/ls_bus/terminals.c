#include "ls_bus/terminals.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "can/generated/can_table.h"
#include "ls_bus/can_operations.h"
#include "ls_bus/side.h"
#include "network.h"

static const int64_t TICK_NS = 1000000;
/* Communication points that an importer adds up in floating point are this close to a whole tick. */
static const int64_t SNAP_NS = 1000;
static const double LONGEST_STEP_S = 1e6;
static const int64_t LATEST_NS = INT64_MAX / 4;

const char *hoap2_network_name(void) { return HOAP2_LS_SIDE.name; }

const char *hoap2_network_token(void) { return HOAP2_LS_SIDE.token; }

bool hoap2_network_present(void) { return true; }

size_t hoap2_network_size(void) { return sizeof(hoap2_ls_network_t) + HOAP2_LS_SIDE.size; }

static void *side_of(hoap2_ls_network_t *network) { return network + 1; }

static void put(hoap2_fmu_instance_t *self, int terminal, const hoap2_ls_operation_t *operation) {
  hoap2_ls_network_t *network = self->network;
  hoap2_ls_terminal_t *t = &network->terminal[terminal];
  size_t size = (size_t)t->tx_size;
  if (hoap2_ls_write(operation, t->tx, sizeof t->tx, &size) != 0) {
    ++network->lost;
    hoap2_fmu_log(self, HOAP2_FMU_LOG_WARNING, "terminal %d: no room for what is sent: nobody takes it", terminal);
    return;
  }
  if (t->tx_size == 0 && !HOAP2_LS_SIDE.is_bus) t->announced = 0;
  t->tx_size = size;
}

void hoap2_ls_send(hoap2_fmu_instance_t *self, int terminal, const hoap2_can_frame_t *frame) {
  hoap2_ls_operation_t operation;
  memset(&operation, 0, sizeof operation);
  operation.code = frame->flags & HOAP2_CAN_FD ? HOAP2_LS_CAN_FD_TRANSMIT : HOAP2_LS_CAN_TRANSMIT;
  operation.identifier = frame->identifier;
  operation.extended = (frame->flags & HOAP2_CAN_EXTENDED) != 0;
  operation.remote = (frame->flags & HOAP2_CAN_REMOTE) != 0;
  operation.bit_rate_switch = (frame->flags & HOAP2_CAN_BRS) != 0;
  operation.length = frame->length;
  memcpy(operation.data, frame->data, frame->length);
  put(self, terminal, &operation);
}

static void send_configuration(hoap2_fmu_instance_t *self, int terminal) {
  static const struct {
    uint8_t kind;
    uint32_t value;
  } SETTINGS[] = {{HOAP2_LS_CAN_BAUDRATE, HOAP2_CAN_NOMINAL_BIT_S},
                  {HOAP2_LS_CAN_FD_BAUDRATE, HOAP2_CAN_DATA_BIT_S},
                  {HOAP2_LS_ARBITRATION_LOST_BEHAVIOR, HOAP2_LS_BUFFER_AND_RETRANSMIT}};
  for (size_t i = 0; i < sizeof SETTINGS / sizeof *SETTINGS; ++i) {
    hoap2_ls_operation_t operation;
    memset(&operation, 0, sizeof operation);
    operation.code = HOAP2_LS_CONFIGURATION;
    operation.kind = SETTINGS[i].kind;
    operation.value = SETTINGS[i].value;
    put(self, terminal, &operation);
  }
}

void hoap2_network_start(hoap2_fmu_instance_t *self) {
  hoap2_ls_network_t *network = self->network;
  memset(network, 0, hoap2_network_size());
  network->in_use = self->event_mode_used;
  if (!network->in_use) return;
  HOAP2_LS_SIDE.start(side_of(network));
  for (int t = 0; t < HOAP2_LS_SIDE.terminals && !HOAP2_LS_SIDE.is_bus; ++t) send_configuration(self, t);
  network->due = 1;
}

double hoap2_network_time_s(const hoap2_fmu_instance_t *self) {
  return self->start_time_s + (double)((const hoap2_ls_network_t *)self->network)->now_ns / 1e9;
}

bool hoap2_network_tick_is_due(const hoap2_fmu_instance_t *self) {
  return ((const hoap2_ls_network_t *)self->network)->due != 0;
}

/* --- bytes that came in --- */

static void check_configuration(hoap2_fmu_instance_t *self, int terminal, const hoap2_ls_operation_t *operation) {
  const uint32_t own = operation->kind == HOAP2_LS_CAN_BAUDRATE      ? HOAP2_CAN_NOMINAL_BIT_S
                       : operation->kind == HOAP2_LS_CAN_FD_BAUDRATE ? HOAP2_CAN_DATA_BIT_S
                                                                     : operation->value;
  if (!HOAP2_LS_SIDE.is_bus || operation->value == own) return;
  hoap2_fmu_log(self, HOAP2_FMU_LOG_WARNING, "terminal %d is set to %u bit/s; this bus runs at %u bit/s", terminal,
                operation->value, own);
}

static void receive_frame(hoap2_ls_network_t *network, int terminal, const hoap2_ls_operation_t *operation) {
  hoap2_can_frame_t frame;
  memset(&frame, 0, sizeof frame);
  const bool fd = operation->code == HOAP2_LS_CAN_FD_TRANSMIT;
  frame.identifier = operation->identifier;
  frame.length = (uint8_t)operation->length;
  frame.flags = (uint8_t)((fd ? HOAP2_CAN_FD : 0) | (operation->bit_rate_switch ? HOAP2_CAN_BRS : 0) |
                          (operation->extended ? HOAP2_CAN_EXTENDED : 0) | (operation->remote ? HOAP2_CAN_REMOTE : 0));
  memcpy(frame.data, operation->data, frame.length);
  HOAP2_LS_SIDE.receive(side_of(network), terminal, &frame, network->now_ns);
}

static void receive(hoap2_fmu_instance_t *self, int terminal) {
  hoap2_ls_network_t *network = self->network;
  const hoap2_ls_terminal_t *t = &network->terminal[terminal];
  size_t at = 0;
  hoap2_ls_operation_t operation;
  hoap2_ls_read_t found;
  while ((found = hoap2_ls_read(t->rx, (size_t)t->rx_size, &at, &operation)) != HOAP2_LS_READ_END) {
    if (found != HOAP2_LS_READ_OPERATION) {
      ++network->refused;
      hoap2_fmu_log(self, HOAP2_FMU_LOG_WARNING, "terminal %d: bytes before place %zu are no operation", terminal, at);
      if (operation.code == HOAP2_LS_FORMAT_ERROR) put(self, terminal, &operation);
    } else if (operation.code == HOAP2_LS_CAN_TRANSMIT || operation.code == HOAP2_LS_CAN_FD_TRANSMIT) {
      receive_frame(network, terminal, &operation);
    } else if (operation.code == HOAP2_LS_CONFIGURATION) {
      check_configuration(self, terminal, &operation);
    } else if (operation.code == HOAP2_LS_FORMAT_ERROR) {
      hoap2_fmu_log(self, HOAP2_FMU_LOG_WARNING, "terminal %d: the other side could not read an operation", terminal);
    }
  }
}

static void do_due_tick(hoap2_fmu_instance_t *self) {
  hoap2_ls_network_t *network = self->network;
  if (!network->due) return;
  network->due = 0;
  HOAP2_LS_SIDE.tick(self, side_of(network), network->tick);
}

void hoap2_ls_update(hoap2_fmu_instance_t *self) {
  hoap2_ls_network_t *network = self->network;
  for (int i = 0; i < HOAP2_LS_SIDE.terminals; ++i) {
    hoap2_ls_terminal_t *t = &network->terminal[i];
    if (t->tx_active) {
      t->tx_size = 0;
      t->announced = 0;
    }
    t->tx_active = 0;
  }
  for (int i = 0; i < HOAP2_LS_SIDE.terminals; ++i) {
    hoap2_ls_terminal_t *t = &network->terminal[i];
    if (t->rx_active) receive(self, i);
    t->rx_active = 0;
    t->rx_size = 0;
  }
  do_due_tick(self);
}

hoap2_ls_terminal_t *hoap2_ls_find(hoap2_fmu_instance_t *self, unsigned reference, int *member) {
  hoap2_ls_network_t *network = self->network;
  const unsigned first = HOAP2_FMU_PRODUCT.field_count + 1;
  const unsigned count = (unsigned)HOAP2_LS_SIDE.terminals * HOAP2_LS_MEMBERS;
  if (reference < first || reference - first >= count) {
    hoap2_fmu_error(self, "value reference %u is of no bus terminal", reference);
    return NULL;
  }
  *member = (int)((reference - first) % HOAP2_LS_MEMBERS);
  return &network->terminal[(reference - first) / HOAP2_LS_MEMBERS];
}

int64_t hoap2_ls_interval_ns(const hoap2_fmu_instance_t *self, const hoap2_ls_terminal_t *terminal) {
  const hoap2_ls_network_t *network = self->network;
  if (terminal->tx_size > 0) return 0;
  return HOAP2_LS_SIDE.is_bus ? (network->tick + 1) * TICK_NS - network->now_ns : -1;
}

/* --- steps --- */

/* End of the step since the start, or -1 when it is refused. */
static int64_t end_of_step(hoap2_fmu_instance_t *self, double now_s, double step_s) {
  const hoap2_ls_network_t *network = self->network;
  const double from_ns = 1e9 * (now_s - self->start_time_s);
  if (!(fabs(from_ns - (double)network->now_ns) <= (double)SNAP_NS)) {
    hoap2_fmu_error(self, "a step must start at the current time %.9g s, not at %.9g s", hoap2_fmu_time_s(self), now_s);
    return -1;
  }
  /* importers make a countdown of 0 a step of 0 */
  if (!(step_s >= 0.0 && step_s <= LONGEST_STEP_S)) {
    hoap2_fmu_error(self, "a step of %.9g s is not possible", step_s);
    return -1;
  }
  if (now_s + step_s > self->stop_time_s + 1e-9 * (double)SNAP_NS) {
    hoap2_fmu_error(self, "a step of %.9g s from %.9g s passes the stop time %.9g s", step_s, now_s, self->stop_time_s);
    return -1;
  }
  int64_t end_ns = (int64_t)llround(from_ns + 1e9 * step_s);
  if (end_ns > LATEST_NS) {
    hoap2_fmu_error(self, "%.9g s is beyond the time that can be counted", now_s + step_s);
    return -1;
  }
  const int64_t whole_ns = (end_ns + TICK_NS / 2) / TICK_NS * TICK_NS;
  if (llabs(end_ns - whole_ns) <= SNAP_NS && whole_ns > network->now_ns) end_ns = whole_ns;
  if (end_ns > network->now_ns) return end_ns;
  if (step_s == 0.0) return network->now_ns;
  hoap2_fmu_error(self, "a step of %.9g s is shorter than a nanosecond", step_s);
  return -1;
}

/* What a step of several ticks is undone to. NULL: a single tick keeps its own state, or memory is short. */
static bool keep_before(hoap2_fmu_instance_t *self, int64_t ticks, void **before) {
  const hoap2_ls_network_t *network = self->network;
  *before = NULL;
  if (ticks < 1 || (ticks == 1 && !network->due)) return true;
  return hoap2_fmu_get_state(self, before) == HOAP2_FMU_OK;
}

hoap2_fmu_status_t hoap2_network_do_step(hoap2_fmu_instance_t *self, double now_s, double step_s) {
  hoap2_ls_network_t *network = self->network;
  const int64_t end_ns = end_of_step(self, now_s, step_s);
  if (end_ns < 0) return HOAP2_FMU_ERROR;
  void *before;
  if (!keep_before(self, end_ns / TICK_NS - network->tick, &before)) return HOAP2_FMU_ERROR;
  hoap2_fmu_status_t status = HOAP2_FMU_OK;
  while ((network->tick + 1) * TICK_NS <= end_ns) {
    do_due_tick(self); /* no event mode since it was reached: nothing can have come in */
    if (HOAP2_LS_SIDE.advance(self, side_of(network), network->tick) != 0) {
      status = hoap2_fmu_error(self, "tick %lld failed: %s", (long long)network->tick,
                               hoap2_product_error(self->model));
      if (before) hoap2_fmu_set_state(self, before);
      break;
    }
    ++network->tick;
    network->due = 1;
    for (int t = 0; t < HOAP2_LS_SIDE.terminals && HOAP2_LS_SIDE.is_bus; ++t) network->terminal[t].announced = 0;
    network->now_ns = network->tick * TICK_NS;
  }
  if (status == HOAP2_FMU_OK) {
    network->now_ns = end_ns;
    self->tick = network->tick;
  }
  hoap2_fmu_free_state(self, &before);
  return status;
}

/* --- saved states --- */

static bool is_switch(int32_t value) { return value == 0 || value == 1; }

const char *hoap2_network_fault(const hoap2_fmu_instance_t *self, const void *saved, bool initialised) {
  const hoap2_ls_network_t *found = saved;
  if (!initialised) return NULL; /* the start clears it */
  if ((found->in_use != 0) != self->event_mode_used)
    return "one of both instances uses event mode, the other does not";
  if (!found->in_use) return NULL;
  bool whole = found->now_ns >= 0 && found->now_ns <= LATEST_NS && found->tick == found->now_ns / TICK_NS &&
               is_switch(found->due) && is_switch(found->in_use);
  for (int i = 0; i < HOAP2_LS_TERMINALS; ++i) {
    const hoap2_ls_terminal_t *t = &found->terminal[i];
    whole = whole && t->rx_size <= HOAP2_LS_ROOM && t->tx_size <= HOAP2_LS_ROOM && is_switch(t->rx_active) &&
            is_switch(t->tx_active) && is_switch(t->announced);
  }
  return whole && HOAP2_LS_SIDE.is_whole(found + 1) ? NULL : "its bus terminals hold impossible values";
}
