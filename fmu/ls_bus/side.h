/* What stands behind the bus terminals of an FMU: the controller, the plant's boards, or the bus. One of these is
 * linked into each FMU; ls_bus/terminals.c knows nothing else about it.
 *
 * At each whole tick, in event mode: what the terminals took in is received, then the tick is done, and what it sends
 * lies in the terminals. Between two ticks the side advances.
 */
#ifndef HOAP2_LS_BUS_SIDE_H
#define HOAP2_LS_BUS_SIDE_H

#include "can/frame.h"
#include "instance.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Ticks from the start in which boards and controller are switched on while the robot stands still. */
enum { HOAP2_LS_BOOT_TICKS = 4 };

typedef struct {
  const char *name;  /* modelIdentifier */
  const char *token; /* instantiationToken */
  int terminals;     /* at most HOAP2_LS_TERMINALS */
  int is_bus; /* its transmit clocks count down to the next whole tick; those of a node tick once it has sent */
  size_t size;       /* of its state, a plain struct */
  void (*start)(void *side);
  void (*receive)(void *side, int terminal, const hoap2_can_frame_t *frame, int64_t now_ns);
  void (*tick)(hoap2_fmu_instance_t *self, void *side, int64_t tick);
  /* From this tick to the next one. 0, or non-zero: nothing has changed, hoap2_product_error says why. */
  int (*advance)(hoap2_fmu_instance_t *self, void *side, int64_t tick);
  int (*is_whole)(const void *side); /* a state that may come from a file */
} hoap2_ls_side_t;

extern const hoap2_ls_side_t HOAP2_LS_SIDE;

/* Hand a frame to a terminal. */
void hoap2_ls_send(hoap2_fmu_instance_t *self, int terminal, const hoap2_can_frame_t *frame);

#ifdef __cplusplus
}
#endif
#endif
