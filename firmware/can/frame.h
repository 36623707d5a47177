/* A frame as it lies in a mailbox of a CAN controller. */
#ifndef HOAP2_CAN_FRAME_H
#define HOAP2_CAN_FRAME_H

#include <stdint.h>

enum { HOAP2_CAN_FD = 1, HOAP2_CAN_BRS = 2, HOAP2_CAN_EXTENDED = 4, HOAP2_CAN_REMOTE = 8 };
enum { HOAP2_CAN_DATA_BYTES = 64, HOAP2_CAN_OUTBOX_FRAMES = 16 };

typedef struct {
  uint32_t identifier;
  uint8_t length; /* bytes of data */
  uint8_t flags;  /* HOAP2_CAN_FD ... */
  uint8_t data[HOAP2_CAN_DATA_BYTES];
} hoap2_can_frame_t;

/* What a node wants to send on one bus in a tick. */
typedef struct {
  int32_t count;
  hoap2_can_frame_t frame[HOAP2_CAN_OUTBOX_FRAMES];
} hoap2_can_outbox_t;

#endif
