/* What goes over a channel's AF_UNIX socket (SOCK_SEQPACKET: whole packets, in order), host byte order.
 *
 * A node connects and sends a hello; the hub answers with a welcome. Then each packet is a frame. The hub stamps
 * each frame and gives it to every other node, and back to its sender if that asked for it. Identifiers carry the
 * flags of SocketCAN's can_id (29 bit, remote, error), so error frames pass too.
 */
#ifndef HOAP2_CAN_UNIX_PACKET_H
#define HOAP2_CAN_UNIX_PACKET_H

#include <stdint.h>

enum {
  HOAP2_CAN_UNIX_MAGIC = 0x48324331, /* "H2C1": protocol 1 */
  HOAP2_CAN_UNIX_NAME = 32,          /* bytes of a node's name, its end included */
  HOAP2_CAN_UNIX_DATA = 64,
  HOAP2_CAN_UNIX_HEADER = 16, /* bytes of a frame before its data */
  HOAP2_CAN_UNIX_NODES = 64
};

/* flags of a hello */
enum { HOAP2_CAN_UNIX_ECHO = 1 /* the node gets its own frames too */ };

/* answers of the hub */
enum {
  HOAP2_CAN_UNIX_WELCOME = 0,
  HOAP2_CAN_UNIX_NAME_TAKEN = 1,
  HOAP2_CAN_UNIX_FULL = 2,
  HOAP2_CAN_UNIX_BAD_HELLO = 3
};

/* bits of an identifier, as in linux/can.h */
#define HOAP2_CAN_UNIX_EXTENDED 0x80000000U
#define HOAP2_CAN_UNIX_REMOTE 0x40000000U
#define HOAP2_CAN_UNIX_ERROR 0x20000000U

/* flags of a frame */
enum { HOAP2_CAN_UNIX_BRS = 1, HOAP2_CAN_UNIX_ESI = 2, HOAP2_CAN_UNIX_FD = 4, HOAP2_CAN_UNIX_OWN = 8 };

typedef struct {
  uint32_t magic;
  uint32_t flags;
  char name[HOAP2_CAN_UNIX_NAME]; /* empty: the hub makes one up */
} hoap2_can_unix_hello_t;

typedef struct {
  uint32_t magic;
  uint32_t answer;
} hoap2_can_unix_welcome_t;

/* Only the bytes in use go over the socket: HOAP2_CAN_UNIX_HEADER + length (a remote frame: no data). */
typedef struct {
  uint64_t time_ns; /* since 1970, by the hub; a sender's is not looked at */
  uint32_t identifier;
  uint8_t length;
  uint8_t flags;
  uint8_t zero[2];
  uint8_t data[HOAP2_CAN_UNIX_DATA];
} hoap2_can_unix_frame_t;

/* Bytes of a frame on the socket. */
static inline uint32_t hoap2_can_unix_size(const hoap2_can_unix_frame_t *frame) {
  return HOAP2_CAN_UNIX_HEADER + ((frame->identifier & HOAP2_CAN_UNIX_REMOTE) ? 0U : frame->length);
}

/* Whether size bytes are one frame: lengths as CAN and CAN FD have them, nothing left over. */
static inline int hoap2_can_unix_valid(const hoap2_can_unix_frame_t *frame, long size) {
  static const uint8_t longer[] = {12, 16, 20, 24, 32, 48, 64};
  if (size < HOAP2_CAN_UNIX_HEADER) return 0;
  int known = frame->length <= 8;
  for (unsigned i = 0; i < sizeof longer && (frame->flags & HOAP2_CAN_UNIX_FD); ++i)
    known |= frame->length == longer[i];
  if ((frame->identifier & HOAP2_CAN_UNIX_REMOTE) && (frame->flags & HOAP2_CAN_UNIX_FD)) return 0;
  if (!(frame->identifier & HOAP2_CAN_UNIX_EXTENDED) && (frame->identifier & 0x1FFFFFFFU) > 0x7FFU &&
      !(frame->identifier & HOAP2_CAN_UNIX_ERROR))
    return 0;
  return known && size == (long)hoap2_can_unix_size(frame);
}

#endif
