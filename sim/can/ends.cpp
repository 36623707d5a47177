// The C interface of the two ends of the buses.
#include "hoap2_link/ends.h"

#include <new>

#include "boards/boards.h"
#include "can/board.h"
#include "can/controller_node.h"
#include "can/signals.h"

namespace {

using namespace hoap2_sim;

static_assert(int{HOAP2_END_FRAMES} == int{HOAP2_CAN_BOARDS} * int{HOAP2_CAN_OUTBOX_FRAMES}, "room for all");

void add(hoap2_end_frames_t *frames, int bus, const hoap2_can_outbox_t &out) {
  for (int i = 0; i < out.count; ++i) {
    frames->bus[frames->count] = bus;
    frames->frame[frames->count++] = out.frame[i];
  }
}

void add_refused(const std::uint32_t refused[], hoap2_end_health_t *health) {
  for (int r = 0; r < HOAP2_CAN_REFUSALS; ++r) health->refused[r] += static_cast<std::int32_t>(refused[r]);
}

}  // namespace

struct hoap2_controller_end {
  hoap2_can_controller_t node;
};

struct hoap2_boards_end {
  hoap2_can_board_t board[HOAP2_CAN_BOARDS];
  std::int32_t sample;
};

#define HOAP2_EXPORT __attribute__((visibility("default")))

extern "C" {

HOAP2_EXPORT hoap2_controller_end_t *hoap2_controller_end_create(void) {
  auto *end = new (std::nothrow) hoap2_controller_end_t;
  if (end) hoap2_can_controller_init(&end->node);
  return end;
}

HOAP2_EXPORT void hoap2_controller_end_destroy(hoap2_controller_end_t *end) { delete end; }

HOAP2_EXPORT int hoap2_controller_end_receive(hoap2_controller_end_t *end, int bus,
                                              const hoap2_can_frame_t *frame) {
  return hoap2_can_controller_receive(&end->node, bus, frame);
}

HOAP2_EXPORT void hoap2_controller_end_send(hoap2_controller_end_t *end, const hoap2_link_command_t *asked,
                                            hoap2_end_frames_t *frames) {
  hoap2_can_outbox_t out[HOAP2_CAN_BUSES];
  for (hoap2_can_outbox_t &box : out) box.count = 0;
  const hoap2_outputs_t outputs = outputs_of(*asked);
  hoap2_can_controller_send(&end->node, &outputs, out);
  frames->count = 0;
  for (int bus = 0; bus < HOAP2_CAN_BUSES; ++bus) add(frames, bus, out[bus]);
}

HOAP2_EXPORT void hoap2_controller_end_inputs(hoap2_controller_end_t *end, hoap2_link_measured_t *inputs) {
  hoap2_inputs_t next;
  hoap2_can_controller_inputs(&end->node, &next);
  tell_controller(next, inputs);
}

HOAP2_EXPORT void hoap2_controller_end_health(const hoap2_controller_end_t *end, hoap2_end_health_t *health) {
  *health = {};
  health->state = end->node.state;
  health->clipped = static_cast<std::int32_t>(end->node.clipped);
  add_refused(end->node.refused, health);
}

HOAP2_EXPORT hoap2_boards_end_t *hoap2_boards_end_create(void) {
  auto *end = new (std::nothrow) hoap2_boards_end_t;
  if (!end) return nullptr;
  end->sample = 0;
  for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) hoap2_can_board_init(&end->board[b], b);
  return end;
}

HOAP2_EXPORT void hoap2_boards_end_destroy(hoap2_boards_end_t *end) { delete end; }

HOAP2_EXPORT int hoap2_boards_end_receive(hoap2_boards_end_t *end, int bus, const hoap2_can_frame_t *frame) {
  int refused = 0;
  for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) {
    if (HOAP2_CAN_BOARD[b].bus == bus) refused += hoap2_can_board_receive(&end->board[b], frame) != 0;
  }
  return refused;
}

HOAP2_EXPORT void hoap2_boards_end_tick(hoap2_boards_end_t *end, const hoap2_link_measured_t *measured,
                                        int fresh, hoap2_link_command_t *to_plant,
                                        hoap2_end_frames_t *frames) {
  if (fresh) ++end->sample;
  *to_plant = {};
  frames->count = 0;
  int first[HOAP2_CAN_BOARDS + 1] = {};
  for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) {
    hoap2_can_outbox_t out;
    out.count = 0;
    const hoap2_can_sensed_t sensed = sensed_by(b, *measured, end->sample);
    hoap2_can_board_tick(&end->board[b], &sensed, &out);
    drive_plant(end->board[b], to_plant);
    add(frames, HOAP2_CAN_BOARD[b].bus, out);
    first[b + 1] = frames->count;
  }
  // The boards hear each other too (an emergency stop), though they are one node of the bus outside.
  for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) {
    for (int i = 0; i < frames->count; ++i) {
      const bool own = i >= first[b] && i < first[b + 1];
      if (!own && frames->bus[i] == HOAP2_CAN_BOARD[b].bus)
        hoap2_can_board_receive(&end->board[b], &frames->frame[i]);
    }
  }
}

HOAP2_EXPORT void hoap2_boards_end_health(const hoap2_boards_end_t *end, hoap2_end_health_t *health) {
  *health = {};
  for (const hoap2_can_board_t &board : end->board) {
    health->holding += board.mode != HOAP2_CAN_BOARD_MODE_FOLLOW;
    health->holds += static_cast<std::int32_t>(board.holds);
    add_refused(board.refused, health);
  }
}

}  // extern "C"
