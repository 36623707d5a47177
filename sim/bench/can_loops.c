/* Loops of `bench can`: the codec over the frames of a tick, and the link's exchange; every tick timed by
 * itself. */
#include <stddef.h>
#include <stdint.h>
#include <time.h>

#include "can/codec.h"
#include "hoap2_link/link.h"

#define BENCH_EXPORT __attribute__((visibility("default")))

static int64_t now_ns(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (int64_t)t.tv_sec * 1000000000 + t.tv_nsec;
}

/* Encodes and decodes `frames` messages a tick: raw[tick][frame][HOAP2_CAN_MAX_FIELDS]. Returns how many were
 * refused. */
BENCH_EXPORT int32_t bench_codec(const int32_t *layout, int32_t frames, const int32_t *raw, int32_t ticks,
                                 int64_t *encode_ns, int64_t *decode_ns) {
  hoap2_can_frame_t frame[64];
  hoap2_can_message_t message[64];
  int32_t refused = 0;
  if (frames > 64) return frames;
  for (int32_t k = 0; k < ticks; ++k) {
    const int32_t *row = raw + (size_t)k * (size_t)frames * HOAP2_CAN_MAX_FIELDS;
    const int64_t start = now_ns();
    for (int32_t i = 0; i < frames; ++i)
      refused += hoap2_can_encode(layout[i], (uint8_t)k, row + i * HOAP2_CAN_MAX_FIELDS, &frame[i]) != 0;
    const int64_t middle = now_ns();
    for (int32_t i = 0; i < frames; ++i)
      refused += hoap2_can_decode(HOAP2_CAN_LAYOUT[layout[i]].bus, &frame[i], &message[i]) != 0;
    decode_ns[k] = now_ns() - middle;
    encode_ns[k] = middle - start;
    for (int32_t i = 0; i < frames; ++i) refused += message[i].raw[0] != row[i * HOAP2_CAN_MAX_FIELDS];
  }
  return refused;
}

/* The exchange of a tick by the link, with commands and measurements held. */
BENCH_EXPORT void bench_link(hoap2_link_t *link, const hoap2_link_command_t *asked,
                             hoap2_link_measured_t *measured, int32_t ticks, int64_t *ns) {
  hoap2_link_command_t to_plant;
  hoap2_link_measured_t to_controller;
  hoap2_link_tick_t tick;
  for (int32_t k = 0; k < ticks; ++k) {
    ++measured->sensor_tick;
    const int64_t start = now_ns();
    hoap2_link_exchange(link, asked, measured, &to_plant, &to_controller, &tick);
    ns[k] = now_ns() - start;
  }
}
