#define _GNU_SOURCE
#include "hoap2_can_unix/node.h"

#include <errno.h>
#include <poll.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#define HOAP2_EXPORT __attribute__((visibility("default")))
enum { HELLO_MS = 5000 };

static int wait_for(int node, short events, int timeout_ms) {
  struct pollfd pollfd = {.fd = node, .events = events};
  int ready;
  do {
    ready = poll(&pollfd, 1, timeout_ms);
  } while (ready < 0 && errno == EINTR);
  return ready < 0 ? -errno : ready == 0 ? -EAGAIN : 0;
}

static int greet(int node, const char *name, uint32_t flags) {
  hoap2_can_unix_hello_t hello = {.magic = HOAP2_CAN_UNIX_MAGIC, .flags = flags};
  if (strlen(name) >= sizeof hello.name) return -ENAMETOOLONG;
  memcpy(hello.name, name, strlen(name));
  if (send(node, &hello, sizeof hello, MSG_NOSIGNAL) < 0) return -errno;
  const int waited = wait_for(node, POLLIN, HELLO_MS);
  if (waited < 0) return waited;
  hoap2_can_unix_welcome_t welcome = {0};
  const ssize_t size = recv(node, &welcome, sizeof welcome, 0);
  if (size == 0) return -ECONNREFUSED; /* the hub was just leaving */
  if (size != (ssize_t)sizeof welcome || welcome.magic != HOAP2_CAN_UNIX_MAGIC) return -EPROTO;
  switch (welcome.answer) {
    case HOAP2_CAN_UNIX_WELCOME: return 0;
    case HOAP2_CAN_UNIX_NAME_TAKEN: return -EADDRINUSE;
    case HOAP2_CAN_UNIX_FULL: return -EUSERS;
    default: return -EPROTO;
  }
}

HOAP2_EXPORT int hoap2_can_unix_join(const char *path, const char *name, uint32_t flags) {
  struct sockaddr_un address = {.sun_family = AF_UNIX};
  if (strlen(path) >= sizeof address.sun_path) return -ENAMETOOLONG;
  memcpy(address.sun_path, path, strlen(path));
  const int node = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
  if (node < 0) return -errno;
  const int failed =
      connect(node, (const struct sockaddr *)&address, sizeof address) < 0 ? -errno : greet(node, name, flags);
  if (failed) {
    close(node);
    return failed;
  }
  return node;
}

HOAP2_EXPORT int hoap2_can_unix_send(int node, const hoap2_can_unix_frame_t *frame, int timeout_ms) {
  const uint32_t size = hoap2_can_unix_size(frame);
  if (!hoap2_can_unix_valid(frame, (long)size)) return -EINVAL;
  for (;;) {
    if (send(node, frame, size, MSG_NOSIGNAL | MSG_DONTWAIT) >= 0) return 0;
    if (errno == EINTR) continue;
    if (errno != EAGAIN) return -errno;
    const int waited = wait_for(node, POLLOUT, timeout_ms);
    if (waited < 0) return waited;
  }
}

HOAP2_EXPORT int hoap2_can_unix_receive(int node, hoap2_can_unix_frame_t *frame, int timeout_ms) {
  for (;;) {
    const ssize_t size = recv(node, frame, sizeof *frame, MSG_DONTWAIT);
    if (size > 0) return hoap2_can_unix_valid(frame, size) ? 0 : -EPROTO;
    if (size == 0) return -EPIPE;
    if (errno == EINTR) continue;
    if (errno != EAGAIN) return -errno;
    const int waited = wait_for(node, POLLIN, timeout_ms);
    if (waited < 0) return waited;
  }
}
