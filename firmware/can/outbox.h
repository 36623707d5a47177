/* Adding frames to what a node sends. */
#ifndef HOAP2_CAN_OUTBOX_H
#define HOAP2_CAN_OUTBOX_H

#include "can/codec.h"

/* Encodes a message and moves its counter on. A message that cannot be encoded or has no room is not sent. */
static inline void hoap2_can_post(hoap2_can_outbox_t *out, int layout, uint8_t *counter,
                                  const int32_t raw[]) {
  if (layout < 0 || out->count >= HOAP2_CAN_OUTBOX_FRAMES) return;
  if (hoap2_can_encode(layout, (uint8_t)(*counter + 1), raw, &out->frame[out->count]) == 0) {
    ++*counter;
    ++out->count;
  }
}

/* True in the ticks in which a periodic message is due. */
static inline int hoap2_can_due(int layout, int32_t tick) {
  const hoap2_can_layout_t *l = &HOAP2_CAN_LAYOUT[layout];
  return l->period_ticks > 0 && tick % l->period_ticks == l->offset_ticks;
}

#endif
