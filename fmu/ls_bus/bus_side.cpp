// Two modelled CAN buses behind four bus terminals: on each bus the controller's, then that of the boards.
// A frame goes on once it is complete on the wire; all of a tick leave together at its end.
#include "can/bus.h"
#include "can/generated/can_table.h"
#include "ls_bus/generated/tokens.h"
#include "ls_bus/side.h"

namespace {

using namespace hoap2_sim;

constexpr int kTerminalsOfBus = 2;
constexpr std::int64_t kTick_ns = 1000000;

struct Buses {
  BusState bus[HOAP2_CAN_BUSES];
};

struct Target {
  hoap2_fmu_instance_t *self;
  int bus;
};

void start(void *side) {
  auto *buses = static_cast<Buses *>(side);
  for (int b = 0; b < HOAP2_CAN_BUSES; ++b) {
    bus_init(&buses->bus[b], static_cast<std::uint64_t>(b));
    bus_add_node(&buses->bus[b], HOAP2_CAN_CONTROLLER_NODE);
  }
  for (const hoap2_can_board_data_t &board : HOAP2_CAN_BOARD) bus_add_node(&buses->bus[board.bus], board.node);
}

// The n-th board on a bus.
int board_node(int bus, int n) {
  for (const hoap2_can_board_data_t &board : HOAP2_CAN_BOARD) {
    if (board.bus == bus && n-- == 0) return board.node;
  }
  return -1;
}

// Which node behind a terminal sends this frame: by its identifier, or the first one.
int sender_of(int bus, bool boards, const hoap2_can_frame_t &frame) {
  if (!boards) return HOAP2_CAN_CONTROLLER_NODE;
  if (!(frame.flags & HOAP2_CAN_EXTENDED) && frame.identifier < HOAP2_CAN_KINDS << HOAP2_CAN_NODE_BITS) {
    const int layout = HOAP2_CAN_LOOKUP[bus][frame.identifier];
    if (layout >= 0 && HOAP2_CAN_LAYOUT[layout].board >= 0 &&
        HOAP2_CAN_LAYOUT[layout].sender != HOAP2_CAN_CONTROLLER_NODE)
      return HOAP2_CAN_LAYOUT[layout].sender;
  }
  return board_node(bus, 0);
}

void receive(void *side, int terminal, const hoap2_can_frame_t *frame, std::int64_t now_ns) {
  const int bus = terminal / kTerminalsOfBus;
  const int node = sender_of(bus, terminal % kTerminalsOfBus != 0, *frame);
  bus_queue(&static_cast<Buses *>(side)->bus[bus], node, *frame, now_ns);
}

// Called for each node that hears the frame. One board listens for all that share its terminal: the first one, or the
// second when it is the first that sends.
void deliver(void *owner, int node, const hoap2_can_frame_t &frame) {
  const Target &target = *static_cast<const Target *>(owner);
  const int first = kTerminalsOfBus * target.bus;
  if (node == HOAP2_CAN_CONTROLLER_NODE) return hoap2_ls_send(target.self, first, &frame);
  const bool first_sends = sender_of(target.bus, true, frame) == board_node(target.bus, 0);
  if (node == board_node(target.bus, first_sends ? 1 : 0)) hoap2_ls_send(target.self, first + 1, &frame);
}

void tick(hoap2_fmu_instance_t * /*self*/, void * /*side*/, std::int64_t /*number*/) {}

int advance(hoap2_fmu_instance_t *self, void *side, std::int64_t number) {
  for (int b = 0; b < HOAP2_CAN_BUSES; ++b) {
    Target target = {self, b};
    bus_advance(&static_cast<Buses *>(side)->bus[b], (number + 1) * kTick_ns, {&target, deliver});
  }
  return 0;
}

bool frame_is_whole(const hoap2_can_frame_t &frame) { return frame.length <= HOAP2_CAN_DATA_BYTES; }

int is_whole(const void *side) {
  for (const BusState &bus : static_cast<const Buses *>(side)->bus) {
    for (const std::int64_t free_ns : bus.free_ns) {
      if (free_ns < 0 || free_ns > bus.now_ns + kTick_ns || bus.now_ns - free_ns > 1000 * kTick_ns) return 0;
    }
    for (const BusNode &node : bus.node) {
      if (node.side != 0 || node.mode < NodeMode::kActive || node.mode > NodeMode::kOff) return 0;
      for (const BusNode::Mailbox &box : node.box) {
        if (!frame_is_whole(box.frame)) return 0;
      }
    }
    for (const BusState::Flight &flight : bus.flight) {
      if (!frame_is_whole(flight.frame)) return 0;
    }
    if (bus.now_ns < 0 || bus.babbling_node != -1 || bus.cut != 0) return 0;
  }
  return 1;
}

}  // namespace

extern "C" const hoap2_ls_side_t HOAP2_LS_SIDE = {
    "hoap2_can_bus", HOAP2_LS_BUS_TOKEN, kTerminalsOfBus *HOAP2_CAN_BUSES, 1, sizeof(Buses), start, receive, tick,
    advance,         is_whole};
