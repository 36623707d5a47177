/* What a node knows of one stream of messages: which counter was the last, and how long ago. */
#ifndef HOAP2_CAN_TRACK_H
#define HOAP2_CAN_TRACK_H

#include <stdint.h>

#include "can/generated/can_table.h"

typedef struct {
  int32_t age_ticks; /* ticks that ended without a message, 0: there was one in the last */
  uint8_t counter;
  uint8_t started; /* there has been one */
  uint8_t heard;   /* since the last tick */
} hoap2_can_track_t;

/* Messages between the last one and this, this one included; 0: it is not new and is to be refused.
 * After `silence_ticks` without a message any counter is new: the sender may have started again. */
static inline int hoap2_can_track_take(hoap2_can_track_t *track, uint8_t counter, int silence_ticks) {
  const uint8_t ahead = (uint8_t)(counter - track->counter);
  const int known = track->started && track->age_ticks < silence_ticks;
  if (known && (ahead == 0 || ahead > HOAP2_CAN_COUNTER_WINDOW)) return 0;
  track->counter = counter;
  track->started = 1;
  track->heard = 1;
  track->age_ticks = 0;
  return known ? ahead : 1;
}

/* Once a tick, before the tick's work. */
static inline void hoap2_can_track_tick(hoap2_can_track_t *track) {
  if (track->heard) {
    track->age_ticks = 0;
  } else if (track->age_ticks < INT32_MAX) {
    ++track->age_ticks;
  }
  track->heard = 0;
}

#endif
