/* A node on a channel of AF_UNIX sockets, in C; host_tools/hoap2/can/unix_bus.py is the same for python-can. */
#ifndef HOAP2_CAN_UNIX_NODE_H
#define HOAP2_CAN_UNIX_NODE_H

#include "hoap2_can_unix/packet.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Joins the channel at path, where a hub must run. name: up to 31 bytes, or "" for any. flags:
 * HOAP2_CAN_UNIX_ECHO or 0. Returns a descriptor (close() leaves the channel), or a negative errno: -ENOENT or -ECONNREFUSED no hub,
 * -EADDRINUSE the name is taken, -EUSERS the channel is full, -EPROTO not a hub of this version. */
int hoap2_can_unix_join(const char *path, const char *name, uint32_t flags);

/* Sends a frame; waits up to timeout_ms (-1: for ever) for room. Returns 0, -EINVAL for what is no frame, -EAGAIN at a
 * time-out, or another negative errno: -EPIPE, -ECONNRESET the hub has gone. */
int hoap2_can_unix_send(int node, const hoap2_can_unix_frame_t *frame, int timeout_ms);

/* Takes the next frame. Returns 0, -EAGAIN when none came in timeout_ms, -EPIPE when the hub has gone. */
int hoap2_can_unix_receive(int node, hoap2_can_unix_frame_t *frame, int timeout_ms);

#ifdef __cplusplus
}
#endif
#endif
