/* The hub of one channel: takes the frames of each node, stamps them, and hands them to all others. */
#ifndef HOAP2_CAN_UNIX_HUB_H
#define HOAP2_CAN_UNIX_HUB_H

#include <stdint.h>

#include "hoap2_can_unix/packet.h"

/* Frames that may wait for one node; a node that is further behind misses the next ones and gets an error frame that
 * tells so. */
enum { HUB_QUEUE = 65536 };

typedef struct {
  int socket;
  int welcome; /* has greeted */
  uint32_t flags;
  char name[HOAP2_CAN_UNIX_NAME];
  hoap2_can_unix_frame_t *queue; /* ring */
  uint32_t first, waiting, missed;
  double joined_s;
} hub_node_t;

typedef struct {
  int listener;
  int count;
  hub_node_t node[HOAP2_CAN_UNIX_NODES];
  uint64_t frames;
  uint32_t named; /* names made up so far */
} hub_t;

/* Handles what is there; waits at most timeout_ms for it. Returns 0, or a negative errno. */
int hub_turn(hub_t *hub, int timeout_ms);
void hub_close(hub_t *hub);
double hub_seconds(void); /* monotonic */

#endif
