#define _GNU_SOURCE
#include "hub.h"

#include <errno.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

enum { BURST = 32 };        /* frames of a node before the next has its turn */
enum { GREETING_S = 5 };    /* a connection that says nothing for so long is closed */
enum { CRTL_CLASS = 0x04, RX_OVERFLOW = 0x01, ERROR_BYTES = 8 }; /* linux/can/error.h */

double hub_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static uint64_t now_ns(void) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  return (uint64_t)now.tv_sec * 1000000000U + (uint64_t)now.tv_nsec;
}

static void leave(hub_t *hub, int i) {
  hub_node_t *node = &hub->node[i];
  close(node->socket);
  free(node->queue);
  memset(node, 0, sizeof *node);
  node->socket = -1;
}

static void close_gaps(hub_t *hub) {
  int kept = 0;
  for (int i = 0; i < hub->count; ++i) {
    if (hub->node[i].socket >= 0) hub->node[kept++] = hub->node[i];
  }
  hub->count = kept;
}

/* 1 sent, 0 no room, -1 the node has gone */
static int push(int socket, const hoap2_can_unix_frame_t *frame) {
  if (send(socket, frame, hoap2_can_unix_size(frame), MSG_NOSIGNAL | MSG_DONTWAIT) >= 0) return 1;
  return errno == EAGAIN || errno == EINTR ? 0 : -1;
}

static void enqueue(hub_node_t *node, const hoap2_can_unix_frame_t *frame) {
  if (!node->queue) node->queue = malloc(HUB_QUEUE * sizeof *node->queue);
  if (!node->queue || node->waiting == HUB_QUEUE) {
    ++node->missed;
    return;
  }
  node->queue[(node->first + node->waiting++) % HUB_QUEUE] = *frame;
}

static int drain(hub_node_t *node) {
  while (node->waiting) {
    const int sent = push(node->socket, &node->queue[node->first]);
    if (sent <= 0) return sent;
    node->first = (node->first + 1) % HUB_QUEUE;
    --node->waiting;
  }
  if (!node->missed) return 1;
  hoap2_can_unix_frame_t told = {.time_ns = now_ns(), .length = ERROR_BYTES};
  told.identifier = HOAP2_CAN_UNIX_ERROR | CRTL_CLASS;
  told.data[1] = RX_OVERFLOW;
  const int sent = push(node->socket, &told);
  if (sent > 0) node->missed = 0;
  return sent;
}

static void deliver(hub_t *hub, int from, const hoap2_can_unix_frame_t *frame) {
  ++hub->frames;
  for (int i = 0; i < hub->count; ++i) {
    hub_node_t *node = &hub->node[i];
    if (node->socket < 0 || !node->welcome || (i == from && !(node->flags & HOAP2_CAN_UNIX_ECHO))) continue;
    hoap2_can_unix_frame_t given = *frame;
    if (i == from) given.flags |= HOAP2_CAN_UNIX_OWN;
    const int sent = node->waiting || node->missed ? 0 : push(node->socket, &given);
    if (sent == 0) enqueue(node, &given);
    /* A dead one is found by its own poll. */
  }
}

static uint32_t judge(const hub_t *hub, int i, const hoap2_can_unix_hello_t *hello, ssize_t size) {
  if (size != (ssize_t)sizeof *hello || hello->magic != HOAP2_CAN_UNIX_MAGIC ||
      !memchr(hello->name, 0, sizeof hello->name))
    return HOAP2_CAN_UNIX_BAD_HELLO;
  for (int j = 0; j < hub->count; ++j) {
    const hub_node_t *other = &hub->node[j];
    if (j != i && other->welcome && hello->name[0] && strcmp(other->name, hello->name) == 0)
      return HOAP2_CAN_UNIX_NAME_TAKEN;
  }
  return HOAP2_CAN_UNIX_WELCOME;
}

static int greet(hub_t *hub, int i) {
  hub_node_t *node = &hub->node[i];
  hoap2_can_unix_hello_t hello;
  const ssize_t size = recv(node->socket, &hello, sizeof hello, MSG_DONTWAIT | MSG_TRUNC);
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) return 1;
  if (size <= 0) return -1;
  hoap2_can_unix_welcome_t welcome = {.magic = HOAP2_CAN_UNIX_MAGIC};
  welcome.answer = judge(hub, i, &hello, size);
  if (send(node->socket, &welcome, sizeof welcome, MSG_NOSIGNAL | MSG_DONTWAIT) < 0) return -1;
  if (welcome.answer) return -1;
  node->flags = hello.flags;
  memcpy(node->name, hello.name, sizeof node->name);
  if (!node->name[0]) snprintf(node->name, sizeof node->name, "#%u", ++hub->named);
  node->welcome = 1;
  return 1;
}

/* -1: the node has gone, or sent what is no frame */
static int take(hub_t *hub, int i) {
  if (!hub->node[i].welcome) return greet(hub, i);
  for (int n = 0; n < BURST; ++n) {
    hoap2_can_unix_frame_t frame;
    const ssize_t size = recv(hub->node[i].socket, &frame, sizeof frame, MSG_DONTWAIT | MSG_TRUNC);
    if (size < 0) return errno == EAGAIN || errno == EINTR ? 1 : -1;
    if (size == 0 || size > (ssize_t)sizeof frame || !hoap2_can_unix_valid(&frame, size)) return -1;
    frame.time_ns = now_ns();
    frame.flags &= HOAP2_CAN_UNIX_BRS | HOAP2_CAN_UNIX_ESI | HOAP2_CAN_UNIX_FD;
    deliver(hub, i, &frame);
  }
  return 1;
}

static void enter(hub_t *hub) {
  const int socket = accept4(hub->listener, NULL, NULL, SOCK_CLOEXEC | SOCK_NONBLOCK);
  if (socket < 0) return;
  if (hub->count == HOAP2_CAN_UNIX_NODES) {
    const hoap2_can_unix_welcome_t full = {HOAP2_CAN_UNIX_MAGIC, HOAP2_CAN_UNIX_FULL};
    (void)!send(socket, &full, sizeof full, MSG_NOSIGNAL);
    close(socket);
    return;
  }
  hub->node[hub->count++] = (hub_node_t){.socket = socket, .joined_s = hub_seconds()};
}

int hub_turn(hub_t *hub, int timeout_ms) {
  struct pollfd polled[HOAP2_CAN_UNIX_NODES + 1];
  const int count = hub->count;
  for (int i = 0; i < count; ++i) {
    const hub_node_t *node = &hub->node[i];
    const int behind = node->waiting || node->missed;
    polled[i] = (struct pollfd){.fd = node->socket, .events = (short)(POLLIN | (behind ? POLLOUT : 0))};
    if (!node->welcome && timeout_ms > 1000) timeout_ms = 1000;
  }
  polled[count] = (struct pollfd){.fd = hub->listener, .events = POLLIN};
  if (poll(polled, (nfds_t)count + 1, timeout_ms) < 0) return errno == EINTR ? 0 : -errno;
  for (int i = 0; i < count; ++i) {
    hub_node_t *node = &hub->node[i];
    const int silent = !node->welcome && hub_seconds() - node->joined_s > GREETING_S;
    int alive = !silent;
    if (alive && (polled[i].revents & POLLOUT)) alive = drain(node) >= 0;
    if (alive && (polled[i].revents & (POLLIN | POLLHUP | POLLERR))) alive = take(hub, i) >= 0;
    if (!alive) leave(hub, i);
  }
  close_gaps(hub);
  if (polled[count].revents) enter(hub);
  return 0;
}

void hub_close(hub_t *hub) {
  for (int i = 0; i < hub->count; ++i) leave(hub, i);
  hub->count = 0;
}
