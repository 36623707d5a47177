/* hoap2_can_ping PATH ping|pong COUNT: round trips over a channel, in C. `pong` sends each frame back with the next
 * identifier; `ping` prints the round trips a second. */
#define _GNU_SOURCE
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "hoap2_can_unix/node.h"

enum { TIMEOUT_MS = 5000, PING_ID = 0x7F0, PONG_ID = 0x7F1, LENGTH = 32 };

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int failed(const char *what, int error) {
  fprintf(stderr, "hoap2_can_ping: %s: %s\n", what, strerror(-error));
  return 1;
}

static int await(int node, uint32_t identifier, hoap2_can_unix_frame_t *frame) {
  int error;
  do {
    error = hoap2_can_unix_receive(node, frame, TIMEOUT_MS);
  } while (error == 0 && frame->identifier != identifier);
  return error;
}

int main(int argc, char **argv) {
  if (argc != 4) {
    fprintf(stderr, "usage: hoap2_can_ping PATH ping|pong COUNT\n");
    return 2;
  }
  const int asks = strcmp(argv[2], "ping") == 0;
  const long count = strtol(argv[3], NULL, 10);
  const int node = hoap2_can_unix_join(argv[1], argv[2], 0);
  if (node < 0) return failed("cannot join", node);
  hoap2_can_unix_frame_t frame = {.identifier = PING_ID, .length = LENGTH};
  frame.flags = HOAP2_CAN_UNIX_FD | HOAP2_CAN_UNIX_BRS;
  const double start = seconds();
  for (long i = 0; i < count; ++i) {
    int error = 0;
    if (asks) {
      frame.identifier = PING_ID;
      memcpy(frame.data, &i, sizeof i);
      error = hoap2_can_unix_send(node, &frame, TIMEOUT_MS);
      if (!error) error = await(node, PONG_ID, &frame);
      if (!error && memcmp(frame.data, &i, sizeof i) != 0) error = -EPROTO;
    } else {
      error = await(node, PING_ID, &frame);
      frame.identifier = PONG_ID;
      if (!error) error = hoap2_can_unix_send(node, &frame, TIMEOUT_MS);
    }
    if (error) return failed(asks ? "no answer" : "no question", error);
  }
  if (asks) printf("%.0f\n", (double)count / (seconds() - start));
  return 0;
}
