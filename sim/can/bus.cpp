#include "can/bus.h"

#include <cstring>

#include "can/frame_bits.h"
#include "can/generated/can_table.h"
#include "can/wire.h"
#include "sensors/noise.h"

namespace hoap2_sim {
namespace {

int priority_of(const hoap2_can_frame_t &frame) {
  const std::uint32_t base = frame.flags & HOAP2_CAN_EXTENDED ? frame.identifier >> 18 : frame.identifier;
  return static_cast<int>(base >> HOAP2_CAN_NODE_BITS) & (kPriorities - 1);
}

void hand_over(BusState *bus, const BusState::Flight &flight, const BusSink &sink) {
  ++bus->counts.delivered;
  const int priority = priority_of(flight.frame);
  const std::int64_t latency = flight.due_ns - flight.queued_ns;
  ++bus->counts.frames[priority];
  bus->counts.latency_sum_ns[priority] += latency;
  if (latency > bus->counts.latency_max_ns[priority]) bus->counts.latency_max_ns[priority] = latency;
  for (int n = 0; n < kBusNodes; ++n) {
    const BusNode &node = bus->node[n];
    if (n == flight.sender || !node.present || !node.powered || node.mode == NodeMode::kOff) continue;
    sink.deliver(sink.owner, n, flight.frame);
  }
}

// All frames that have arrived by this time, in the order of their arrival.
void deliver_due(BusState *bus, std::int64_t until_ns, const BusSink &sink) {
  for (int round = 0; round < kInFlight; ++round) {
    BusState::Flight *first = nullptr;
    for (BusState::Flight &flight : bus->flight) {
      if (flight.used && flight.due_ns <= until_ns && (first == nullptr || flight.due_ns < first->due_ns))
        first = &flight;
    }
    if (first == nullptr) return;
    first->used = 0;
    hand_over(bus, *first, sink);
  }
}

}  // namespace

void bus_init(BusState *bus, std::uint64_t seed) {
  std::memset(static_cast<void *>(bus), 0, sizeof *bus);
  noise_seed(bus->random, seed);
  bus->babbling_node = -1;
}

void bus_add_node(BusState *bus, int node) { bus->node[node].present = bus->node[node].powered = 1; }

void bus_power(BusState *bus, int node, bool on) {
  BusNode &n = bus->node[node];
  if (n.powered == (on ? 1 : 0)) return;
  n.powered = on ? 1 : 0;
  n.mode = NodeMode::kActive;
  n.send_errors = n.receive_errors = n.recovery = 0;
  for (BusNode::Mailbox &box : n.box) {
    if (box.used) lose(bus, kLostNodeDown);
    box.used = 0;
  }
}

void bus_cut(BusState *bus, bool cut, std::uint32_t far_nodes) {
  if (bus->cut == (cut ? 1 : 0)) return;
  bus->cut = cut ? 1 : 0;
  for (int n = 0; n < kBusNodes; ++n) bus->node[n].side = cut && (far_nodes >> n & 1U) ? 1 : 0;
  bus->free_ns[1] = bus->free_ns[0] = bus->free_ns[0] > bus->free_ns[1] ? bus->free_ns[0] : bus->free_ns[1];
}

void bus_queue(BusState *bus, int node, const hoap2_can_frame_t &frame, std::int64_t at_ns) {
  ++bus->counts.queued;
  BusNode &n = bus->node[node];
  if (!n.present || !n.powered) return lose(bus, kLostNodeDown);
  const bool fd = frame.flags & HOAP2_CAN_FD;
  const std::uint32_t highest = frame.flags & HOAP2_CAN_EXTENDED ? 0x1FFFFFFFU : 0x7FFU;
  if (length_code(frame.length, fd) < 0 || frame.identifier > highest) return lose(bus, kLostBad);
  BusNode::Mailbox *place = nullptr;
  for (BusNode::Mailbox &box : n.box) {
    if (box.used && arbitration_key(box.frame) == arbitration_key(frame)) {
      lose(bus, kLostSuperseded);
      place = &box;
      break;
    }
    if (!box.used && place == nullptr) place = &box;
  }
  if (place == nullptr) return lose(bus, kLostNoRoom);
  *place = {frame, at_ns > bus->now_ns ? at_ns : bus->now_ns, 1};
}

void bus_advance(BusState *bus, std::int64_t until_ns, const BusSink &sink) {
  for (int side = 0; side < (bus->cut ? 2 : 1); ++side) run_wire(bus, side, until_ns);
  if (!bus->cut) bus->free_ns[1] = bus->free_ns[0];
  deliver_due(bus, until_ns, sink);
  bus->now_ns = until_ns;
}

std::int64_t bus_pending(const BusState &bus) {
  std::int64_t pending = 0;
  for (const BusState::Flight &flight : bus.flight) pending += flight.used;
  for (const BusNode &node : bus.node) {
    for (const BusNode::Mailbox &box : node.box) pending += box.used;
  }
  return pending;
}

}  // namespace hoap2_sim
