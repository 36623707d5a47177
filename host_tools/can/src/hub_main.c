/* hoap2_can_hub PATH: the hub of the channel at PATH, until Ctrl-C or, with --linger, until it is alone. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "hub.h"

enum { OK = 0, FAILED = 1, USAGE = 2, RUNS_ALREADY = 4 };

static volatile sig_atomic_t stopped = 0;
static void stop(int number) {
  (void)number;
  stopped = 1;
}

static int complain(const char *path, const char *what) {
  fprintf(stderr, "hoap2_can_hub: %s: %s: %s\n", path, what, strerror(errno));
  return FAILED;
}

/* One hub a path: whoever holds the lock may remove what a dead one left. */
static int lock_path(const char *path, int *result) {
  char lock[sizeof(((struct sockaddr_un *)0)->sun_path) + 8];
  snprintf(lock, sizeof lock, "%s.lock", path);
  const int file = open(lock, O_CREAT | O_RDWR | O_CLOEXEC, 0600);
  if (file < 0) {
    *result = complain(lock, "cannot open");
    return -1;
  }
  if (flock(file, LOCK_EX | LOCK_NB) < 0) {
    *result = errno == EWOULDBLOCK ? RUNS_ALREADY : complain(lock, "cannot lock");
    close(file);
    return -1;
  }
  return file;
}

static int listen_at(const char *path) {
  struct sockaddr_un address = {.sun_family = AF_UNIX};
  memcpy(address.sun_path, path, strlen(path));
  struct stat there;
  if (lstat(path, &there) == 0 && !S_ISSOCK(there.st_mode)) {
    errno = EEXIST;
    return -1;
  }
  unlink(path);
  const int listener = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (listener < 0) return -1;
  const mode_t mask = umask(0077);
  const int failed = bind(listener, (const struct sockaddr *)&address, sizeof address) < 0 || listen(listener, 32) < 0;
  umask(mask);
  return failed ? -1 : listener;
}

/* Into the background; the parent ends once the socket listens. */
static void detach(void) {
  const pid_t child = fork();
  if (child > 0) _exit(OK);
  if (child < 0) return; /* stays in front */
  setsid();
  const int null = open("/dev/null", O_RDWR);
  for (int fd = 0; fd < 3 && null >= 0; ++fd) dup2(null, fd);
  if (null > 2) close(null);
  (void)!chdir("/");
}

static int serve(hub_t *hub, double linger_s) {
  double alone_since = hub_seconds();
  while (!stopped) {
    const int failed = hub_turn(hub, linger_s < 0.0 ? -1 : 200);
    if (failed) return FAILED;
    if (hub->count) alone_since = hub_seconds();
    if (linger_s >= 0.0 && hub_seconds() - alone_since > linger_s) break;
  }
  return OK;
}

int main(int argc, char **argv) {
  const char *path = NULL;
  double linger_s = -1.0;
  int background = 0;
  for (int i = 1; i < argc; ++i) {
    if (strcmp(argv[i], "--linger") == 0 && i + 1 < argc) {
      linger_s = strtod(argv[++i], NULL);
    } else if (strcmp(argv[i], "--detach") == 0) {
      background = 1;
    } else if (argv[i][0] != '-' && !path) {
      path = argv[i];
    } else {
      path = NULL;
      break;
    }
  }
  if (!path || strlen(path) >= sizeof(((struct sockaddr_un *)0)->sun_path)) {
    fprintf(stderr, "usage: hoap2_can_hub [--detach] [--linger SECONDS] PATH (at most 107 bytes)\n");
    return USAGE;
  }
  int result = OK;
  const int lock = lock_path(path, &result);
  if (lock < 0) return result;
  static hub_t hub; /* too large for a small stack */
  hub.listener = listen_at(path);
  if (hub.listener < 0) return complain(path, "cannot listen");
  struct sigaction action = {.sa_handler = stop};
  sigaction(SIGINT, &action, NULL);
  sigaction(SIGTERM, &action, NULL);
  if (background) detach();
  result = serve(&hub, linger_s);
  unlink(path); /* first, so that a newcomer starts the next hub */
  hub_close(&hub);
  close(hub.listener);
  return result;
}
