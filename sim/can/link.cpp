// The link's C interface.
#include "hoap2_link/link.h"

#include <cstring>
#include <new>

#include "can/frame_bits.h"
#include "can/link_state.h"

namespace {

using namespace hoap2_sim;

static_assert(int{HOAP2_LINK_BUSES} == int{HOAP2_CAN_BUSES} &&
                  int{HOAP2_LINK_REASONS} == int{HOAP2_CAN_REFUSALS},
              "see can.toml");
static_assert(int{HOAP2_LINK_PRIORITIES} == kPriorities && int{HOAP2_LINK_CAUSES} == int{kLossCauses},
              "see bus.h");

std::int64_t total_lost(const BusCounts &counts) {
  std::int64_t sum = 0;
  for (const std::int64_t lost : counts.lost) sum += lost;
  return sum;
}

std::int64_t total_refused(const LinkState &link) {
  std::int64_t sum = 0;
  for (int r = 0; r < HOAP2_CAN_REFUSALS; ++r) {
    sum += link.controller.refused[r];
    for (const hoap2_can_board_t &board : link.board) sum += board.refused[r];
  }
  return sum;
}

void tell_tick(const LinkState &link, const std::int64_t busy_ns[], std::int64_t lost, std::int64_t refused,
               hoap2_link_tick_t *tick) {
  tick->lost = static_cast<double>(-lost);
  for (int b = 0; b < HOAP2_CAN_BUSES; ++b) {
    tick->busy_us[b] = 1e-3 * static_cast<double>(link.bus[b].counts.busy_ns - busy_ns[b]);
    tick->lost += static_cast<double>(total_lost(link.bus[b].counts));
  }
  tick->refused = static_cast<double>(total_refused(link) - refused);
  tick->holding = tick->bus_modes = 0.0;
  for (const hoap2_can_board_t &board : link.board)
    tick->holding += board.mode != HOAP2_CAN_BOARD_MODE_FOLLOW;
  for (const BusState &bus : link.bus) {
    for (const BusNode &node : bus.node) {
      const double mode = static_cast<double>(node.mode);
      if (mode > tick->bus_modes) tick->bus_modes = mode;
    }
  }
  tick->state = link.controller.state;
}

}  // namespace

struct hoap2_link {
  LinkState state;
};

#define HOAP2_EXPORT __attribute__((visibility("default")))

extern "C" {

HOAP2_EXPORT hoap2_link_t *hoap2_link_create(void) { return new (std::nothrow) hoap2_link; }

HOAP2_EXPORT void hoap2_link_destroy(hoap2_link_t *link) { delete link; }

HOAP2_EXPORT int hoap2_link_init(hoap2_link_t *link, const hoap2_link_params_t *params, uint32_t run_seed) {
  if (!hoap2_link_params_in_range(params)) return 1;
  link_init(&link->state, *params, run_seed);
  return 0;
}

HOAP2_EXPORT void hoap2_link_exchange(hoap2_link_t *link, const hoap2_link_command_t *asked,
                                      const hoap2_link_measured_t *measured, hoap2_link_command_t *to_plant,
                                      hoap2_link_measured_t *to_controller, hoap2_link_tick_t *tick) {
  LinkState &state = link->state;
  link_boot(&state, *asked, *measured);
  std::int64_t busy_ns[HOAP2_CAN_BUSES], lost = 0;
  for (int b = 0; b < HOAP2_CAN_BUSES; ++b) {
    busy_ns[b] = state.bus[b].counts.busy_ns;
    lost += total_lost(state.bus[b].counts);
  }
  const std::int64_t refused = total_refused(state);
  link_exchange(&state, *asked, *measured, to_plant, to_controller);
  tell_tick(state, busy_ns, lost, refused, tick);
}

HOAP2_EXPORT void hoap2_link_counts(const hoap2_link_t *link, hoap2_link_counts_t *counts) {
  const LinkState &state = link->state;
  std::memset(counts, 0, sizeof *counts);
  for (int b = 0; b < HOAP2_CAN_BUSES; ++b) {
    const BusCounts &all = state.bus[b].counts, &boot = state.boot[b];
    counts->pending[b] = bus_pending(state.bus[b]);
    counts->delivered[b] = all.delivered - boot.delivered;
    counts->error_frames[b] = all.errors - boot.errors;
    counts->not_acknowledged[b] = all.not_acknowledged - boot.not_acknowledged;
    counts->changed[b] = all.changed - boot.changed;
    counts->busy_ns[b] = all.busy_ns - boot.busy_ns;
    counts->queued[b] = all.queued - boot.queued;
    for (int c = 0; c < kLossCauses; ++c) counts->lost[b][c] = all.lost[c] - boot.lost[c];
    for (int p = 0; p < kPriorities; ++p) {
      counts->frames[p] += all.frames[p] - boot.frames[p];
      counts->latency_sum_ns[p] += all.latency_sum_ns[p] - boot.latency_sum_ns[p];
      if (all.latency_max_ns[p] > counts->latency_max_ns[p])
        counts->latency_max_ns[p] = all.latency_max_ns[p];
    }
  }
  for (int r = 0; r < HOAP2_CAN_REFUSALS; ++r) {
    counts->refused_by_controller[r] = state.controller.refused[r];
    for (const hoap2_can_board_t &board : state.board) counts->refused_by_boards[r] += board.refused[r];
  }
  for (const hoap2_can_board_t &board : state.board) counts->holds += board.holds;
  counts->hold_ticks = state.hold_ticks;
  counts->clipped = state.controller.clipped;
  counts->ticks = state.tick;
}

HOAP2_EXPORT void hoap2_link_frame_bits(const hoap2_can_frame_t *frame, int32_t *nominal, int32_t *data) {
  const FrameBits bits = frame_bits(*frame);
  *nominal = bits.nominal;
  *data = bits.data;
}

HOAP2_EXPORT size_t hoap2_link_state_size(const hoap2_link_t *link) { return sizeof link->state; }

HOAP2_EXPORT void hoap2_link_get_state(const hoap2_link_t *link, void *state) {
  std::memcpy(state, &link->state, sizeof link->state);
}

HOAP2_EXPORT int hoap2_link_set_state(hoap2_link_t *link, const void *state, size_t size) {
  LinkState saved;
  if (size != sizeof saved) return 1;
  std::memcpy(static_cast<void *>(&saved), state, sizeof saved);
  if (saved.magic != kLinkMagic || saved.version != kLinkVersion || saved.size != size ||
      !link_is_whole(saved))
    return 1;
  link->state = saved;
  return 0;
}

}  // extern "C"
