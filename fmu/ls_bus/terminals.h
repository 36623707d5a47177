/* Bus terminals of FMI-LS-BUS 1.0.0: their clocks and their bytes. */
#ifndef HOAP2_LS_BUS_TERMINALS_H
#define HOAP2_LS_BUS_TERMINALS_H

#include "instance.h"

/* HOAP2_LS_ROOM: maxSize of the binaries; a tick needs less than 2000 bytes. */
enum { HOAP2_LS_TERMINALS = 4, HOAP2_LS_ROOM = 8192 };
/* Variables of a terminal, in the order of their value references, which follow those of the table's rows. */
enum { HOAP2_LS_RX_CLOCK = 0, HOAP2_LS_RX_DATA = 1, HOAP2_LS_TX_CLOCK = 2, HOAP2_LS_TX_DATA = 3, HOAP2_LS_MEMBERS = 4 };

typedef struct {
  int32_t rx_active; /* clocks that tick in this event */
  int32_t tx_active;
  int32_t announced; /* the present countdown has been told */
  int32_t reserved;  /* 0 */
  uint64_t rx_size;
  uint64_t tx_size;
  uint8_t rx[HOAP2_LS_ROOM];
  uint8_t tx[HOAP2_LS_ROOM];
} hoap2_ls_terminal_t;

typedef struct {
  int64_t now_ns;  /* since the start */
  int64_t tick;    /* whole ticks reached */
  int64_t refused; /* operations that were none */
  int64_t lost;    /* frames that found no room */
  int32_t due;     /* the last tick reached is not done yet */
  int32_t in_use;  /* event mode is used */
  hoap2_ls_terminal_t terminal[HOAP2_LS_TERMINALS];
  /* the side's own state follows */
} hoap2_ls_network_t;

/* The terminal and member of a value reference, or NULL and a log. */
hoap2_ls_terminal_t *hoap2_ls_find(hoap2_fmu_instance_t *self, unsigned reference, int *member);

/* End of an event iteration: what came in is received, a due tick is done. */
void hoap2_ls_update(hoap2_fmu_instance_t *self);

/* Nanoseconds until a transmit clock ticks, -1 when that is not known. */
int64_t hoap2_ls_interval_ns(const hoap2_fmu_instance_t *self, const hoap2_ls_terminal_t *terminal);

#endif
