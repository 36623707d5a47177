/* What the harnesses share. */
#ifndef HOAP2_TESTS_CAN_FUZZ_H
#define HOAP2_TESTS_CAN_FUZZ_H

#include <stdlib.h>

#include "can/codec.h"

static inline void require(int holds) {
  if (!holds) abort();
}

/* Puts the right CRC into a frame, so that the fuzzer gets behind it. */
static inline void seal(hoap2_can_frame_t *frame) {
  uint8_t crc = 0xFF;
  const uint8_t head[2] = {(uint8_t)frame->identifier, (uint8_t)(frame->identifier >> 8)};
  for (int i = 0; i < 2; ++i) crc = HOAP2_CAN_CRC8[0][crc ^ head[i]];
  for (int i = 1; i < frame->length && i < HOAP2_CAN_DATA_BYTES; ++i)
    crc = HOAP2_CAN_CRC8[0][crc ^ frame->data[i]];
  if (frame->length > 0) frame->data[0] = (uint8_t)(crc ^ 0xFF);
}

#endif
