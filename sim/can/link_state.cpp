#include "can/link_state.h"

#include <cstring>

#include "boards/boards.h"
#include "can/signals.h"

namespace hoap2_sim {
namespace {

// Before the run the boards are switched on, in the jig: heartbeats, settings and the first commands are
// exchanged while the robot does not move. They fit into three ticks.
constexpr std::int32_t kBootTicks = 4;
constexpr std::int64_t kTick_ns = 1000LL * HOAP2_TICK_US;
constexpr std::uint64_t kBusSalt[HOAP2_CAN_BUSES] = {0x7269676874ULL, 0x6c656674ULL};

struct Receiver {
  LinkState *link;
  int bus;
};

int board_of_node(int bus, int node) {
  for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) {
    if (HOAP2_CAN_BOARD[b].bus == bus && HOAP2_CAN_BOARD[b].node == node) return b;
  }
  return -1;
}

void deliver(void *owner, int node, const hoap2_can_frame_t &frame) {
  const Receiver &receiver = *static_cast<const Receiver *>(owner);
  LinkState *link = receiver.link;
  if (node == HOAP2_CAN_CONTROLLER_NODE) {
    hoap2_can_controller_receive(&link->controller, receiver.bus, &frame);
  } else if (node == kSecondNode) {
    hoap2_can_controller_receive(&link->second, receiver.bus, &frame);
  } else if (const int board = board_of_node(receiver.bus, node); board >= 0) {
    hoap2_can_board_receive(&link->board[board], &frame);
  }
}

bool within(const LinkState &link, double start_s, double length_s) {
  const double now_s = 1e-9 * static_cast<double>(link.tick * kTick_ns);
  return length_s > 0.0 && link.tick >= 0 && now_s >= start_s - 1e-9 && now_s < start_s + length_s - 1e-9;
}

bool begins(const LinkState &link, double start_s) {
  return start_s > 0.0 && static_cast<std::int64_t>(1e9 * start_s + 0.5) / kTick_ns == link.tick;
}

void apply_disturbances(LinkState *link) {
  const hoap2_link_params_t &p = link->params;
  for (int b = 0; b < HOAP2_CAN_BUSES; ++b) {
    BusState &bus = link->bus[b];
    const bool running = link->tick >= 0;
    bus.faults = {};
    if (running) {
      bus.faults = {p.loss,     p.corrupt, p.corrupt_at_one,
                    p.residual, p.delay,   static_cast<std::int64_t>(1e9 * p.delay_s)};
    }
    const bool here = bus.node[p.babble_node].present != 0;
    bus.babbling_node = here && within(*link, p.babble_start_s, p.babble_s) ? p.babble_node : -1;
    bus.babbling_identifier = static_cast<std::uint32_t>(p.babble_identifier);
    const bool cut =
        (p.cut_bus == b || p.cut_bus == HOAP2_CAN_BUSES) && within(*link, p.cut_start_s, p.cut_s);
    bus_cut(&bus, cut, 1U << HOAP2_CAN_CONTROLLER_NODE | 1U << kSecondNode);
    bus_power(&bus, p.drop_node, !within(*link, p.drop_start_s, p.drop_s));
  }
  if (begins(*link, p.stop_start_s)) hoap2_can_board_stop(&link->board[HOAP2_CAN_B_POSTURE]);
  if (begins(*link, p.second_start_s)) {
    hoap2_can_controller_init(&link->second);
    for (BusState &bus : link->bus) bus_add_node(&bus, kSecondNode);
  }
}

void queue_all(LinkState *link, int bus, int node, const hoap2_can_outbox_t &out, std::int64_t at_ns) {
  for (int i = 0; i < out.count; ++i) bus_queue(&link->bus[bus], node, out.frame[i], at_ns);
}

// The boards' tick: they act on what has arrived, measure, and send.
void run_boards(LinkState *link, const hoap2_link_measured_t &measured, hoap2_link_command_t *to_plant,
                std::int64_t now_ns) {
  for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) {
    hoap2_can_outbox_t out;
    out.count = 0;
    const hoap2_can_sensed_t sensed = sensed_by(b, measured, link->sample);
    hoap2_can_board_tick(&link->board[b], &sensed, &out);
    drive_plant(link->board[b], to_plant);
    queue_all(link, HOAP2_CAN_BOARD[b].bus, HOAP2_CAN_BOARD[b].node, out, now_ns);
    if (link->tick >= 0 && link->board[b].mode != HOAP2_CAN_BOARD_MODE_FOLLOW) ++link->hold_ticks;
  }
}

void send_commands(LinkState *link, hoap2_can_controller_t *controller, int node,
                   const hoap2_outputs_t &outputs, std::int64_t now_ns) {
  hoap2_can_outbox_t out[HOAP2_CAN_BUSES];
  for (hoap2_can_outbox_t &box : out) box.count = 0;
  hoap2_can_controller_send(controller, &outputs, out);
  for (int bus = 0; bus < HOAP2_CAN_BUSES; ++bus) queue_all(link, bus, node, out[bus], now_ns);
}

void run_tick(LinkState *link, const hoap2_link_command_t &asked, const hoap2_link_measured_t &measured,
              hoap2_link_command_t *to_plant, hoap2_link_measured_t *to_controller) {
  const std::int64_t now_ns = (link->tick + kBootTicks) * kTick_ns;
  apply_disturbances(link);
  // a sensor that stands still sends nothing
  if (link->tick < 0 || measured.sensor_tick != link->last_sensor_tick) ++link->sample;
  link->last_sensor_tick = measured.sensor_tick;
  run_boards(link, measured, to_plant, now_ns);
  const hoap2_outputs_t controller_out = outputs_of(asked);
  send_commands(link, &link->controller, HOAP2_CAN_CONTROLLER_NODE, controller_out, now_ns);
  const bool two = link->bus[0].node[kSecondNode].present != 0;
  if (two) {
    const auto late_ns = static_cast<std::int64_t>(1e9 * link->params.second_late_s);
    send_commands(link, &link->second, kSecondNode, controller_out, now_ns + late_ns);
  }
  for (int bus = 0; bus < HOAP2_CAN_BUSES; ++bus) {
    Receiver receiver = {link, bus};
    bus_advance(&link->bus[bus], now_ns + kTick_ns, {&receiver, deliver});
  }
  hoap2_inputs_t inputs;
  if (two) hoap2_can_controller_inputs(&link->second, &inputs);
  hoap2_can_controller_inputs(&link->controller, &inputs);
  tell_controller(inputs, to_controller);
  ++link->tick;
}

}  // namespace

void link_init(LinkState *link, const hoap2_link_params_t &params, std::uint32_t run_seed) {
  std::memset(static_cast<void *>(link), 0, sizeof *link);
  link->magic = kLinkMagic;
  link->version = kLinkVersion;
  link->size = sizeof *link;
  link->params = params;
  link->tick = -kBootTicks;
  const std::uint64_t seed = static_cast<std::uint64_t>(params.seed) << 32 | run_seed;
  hoap2_can_controller_init(&link->controller);
  for (int b = 0; b < HOAP2_CAN_BUSES; ++b) {
    bus_init(&link->bus[b], seed ^ kBusSalt[b] << 8);
    bus_add_node(&link->bus[b], HOAP2_CAN_CONTROLLER_NODE);
  }
  for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) {
    hoap2_can_board_init(&link->board[b], b);
    bus_add_node(&link->bus[HOAP2_CAN_BOARD[b].bus], HOAP2_CAN_BOARD[b].node);
  }
}

namespace {

bool bus_is_whole(const BusState &bus) {
  // frees in the future or far in the past would make the bus run for a long time
  for (const std::int64_t free_ns : bus.free_ns) {
    if (free_ns < 0 || free_ns > bus.now_ns + kTick_ns || bus.now_ns - free_ns > 1000 * kTick_ns)
      return false;
  }
  for (const BusNode &node : bus.node) {
    if (node.side < 0 || node.side > 1 || node.mode < NodeMode::kActive || node.mode > NodeMode::kOff)
      return false;
    for (const BusNode::Mailbox &box : node.box) {
      if (box.frame.length > HOAP2_CAN_DATA_BYTES) return false;
    }
  }
  for (const BusState::Flight &flight : bus.flight) {
    if (flight.frame.length > HOAP2_CAN_DATA_BYTES) return false;
  }
  return bus.now_ns >= 0 && bus.babbling_node >= -1 && bus.babbling_node < kBusNodes &&
         (bus.cut == 0 || bus.cut == 1);
}

bool controller_is_whole(const hoap2_can_controller_t &controller) {
  return controller.tick >= 0 && controller.request_board >= -1 &&
         controller.request_board < HOAP2_CAN_BOARDS;
}

}  // namespace

bool link_is_whole(const LinkState &link) {
  bool whole = hoap2_link_params_in_range(&link.params) && link.tick >= -kBootTicks && link.sample >= 0 &&
               controller_is_whole(link.controller) && controller_is_whole(link.second);
  for (const BusState &bus : link.bus) whole = whole && bus_is_whole(bus);
  for (int b = 0; b < HOAP2_CAN_BOARDS; ++b) {
    const hoap2_can_board_t &board = link.board[b];
    whole = whole && board.board == b && board.tick >= 0 && board.mode >= HOAP2_CAN_BOARD_MODE_BOOT &&
            board.mode <= HOAP2_CAN_BOARD_MODE_STOPPED;
  }
  return whole;
}

void link_boot(LinkState *link, const hoap2_link_command_t &asked, const hoap2_link_measured_t &measured) {
  if (link->tick >= 0) return;
  hoap2_link_command_t to_plant = {};
  hoap2_link_measured_t to_controller;
  for (int i = 0; i < kBootTicks; ++i) run_tick(link, asked, measured, &to_plant, &to_controller);
  for (int b = 0; b < HOAP2_CAN_BUSES; ++b) {
    BusCounts &counts = link->bus[b].counts;
    for (std::int64_t &latency_ns : counts.latency_max_ns) latency_ns = 0;
    link->boot[b] = counts;
    link->boot[b].queued -= bus_pending(link->bus[b]);  // what still waits belongs to the run
  }
}

void link_exchange(LinkState *link, const hoap2_link_command_t &asked, const hoap2_link_measured_t &measured,
                   hoap2_link_command_t *to_plant, hoap2_link_measured_t *to_controller) {
  *to_plant = {};
  run_tick(link, asked, measured, to_plant, to_controller);
}

}  // namespace hoap2_sim
