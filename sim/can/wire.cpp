#include "can/wire.h"

#include <cstring>

#include "can/error_counters.h"
#include "can/frame_bits.h"
#include "can/generated/can_table.h"
#include "sensors/noise.h"

namespace hoap2_sim {
namespace {

constexpr std::int64_t kNominal_ns = 1000000000 / HOAP2_CAN_NOMINAL_BIT_S;
constexpr std::int64_t kData_ns = 1000000000 / HOAP2_CAN_DATA_BIT_S;
constexpr std::int64_t kTransceivers_ns = 300;  // two of them, and two metres of wire
constexpr int kRecessive = 11;
constexpr int kSuspendBits = 8;
// Flag of 6 bits, up to 6 more of the others' flags, delimiter of 8, intermission of 3.
constexpr int kErrorFrameBits = 6 + 6 + 8 + 3;
constexpr int kBabbleBytes = 8;

double draw(BusState *bus) { return noise_uniform(bus->random); }
bool happens(BusState *bus, double probability) { return probability > 0.0 && draw(bus) < probability; }
std::int64_t below(BusState *bus, std::int64_t count) {
  return static_cast<std::int64_t>(draw(bus) * static_cast<double>(count));
}

bool takes_part(const BusNode &node, int side) {
  return node.present && node.powered && node.mode != NodeMode::kOff && node.side == side;
}

std::int64_t duration_ns(const hoap2_can_frame_t &frame) {
  const FrameBits bits = frame_bits(frame);
  return bits.nominal * kNominal_ns + bits.data * kData_ns;
}

void put_in_flight(BusState *bus, const BusState::Flight &flight) {
  for (BusState::Flight &place : bus->flight) {
    if (place.used) continue;
    place = flight;
    place.used = 1;
    return;
  }
  lose(bus, kLostNoRoom);
}

// One transmission that may begin: the mailbox, or -1 for what a babbling node makes up.
struct Contender {
  int node;
  int box;
  std::uint64_t key;
};

// The first that may send at this time; `rivals` are the nodes whose frame has the same identifier.
Contender find_winner(const BusState &bus, int side, std::int64_t at_ns, std::uint32_t *rivals) {
  Contender best = {-1, -1, ~0ULL};
  *rivals = 0;
  for (int n = 0; n < kBusNodes; ++n) {
    const BusNode &node = bus.node[n];
    if (!takes_part(node, side) || node.silent_until_ns > at_ns) continue;
    Contender own = {n, -1, ~0ULL};
    if (bus.babbling_node == n) own.key = static_cast<std::uint64_t>(bus.babbling_identifier) << 20;
    for (int b = 0; b < kMailboxes; ++b) {
      const BusNode::Mailbox &box = node.box[b];
      if (!box.used || box.queued_ns > at_ns) continue;
      const std::uint64_t key = arbitration_key(box.frame);
      if (key < own.key) own = {n, b, key};
    }
    if (own.key == ~0ULL) continue;
    if (own.key < best.key) {
      best = own;
      *rivals = 0;
    } else if (own.key == best.key) {
      *rivals |= 1U << n;
    }
  }
  return best;
}

// When something may next begin on an idle wire.
std::int64_t next_start(const BusState &bus, int side, std::int64_t at_ns, std::int64_t until_ns) {
  std::int64_t next = until_ns;
  for (int n = 0; n < kBusNodes; ++n) {
    const BusNode &node = bus.node[n];
    if (!takes_part(node, side)) continue;
    for (const BusNode::Mailbox &box : node.box) {
      if (!box.used) continue;
      const std::int64_t ready = box.queued_ns > node.silent_until_ns ? box.queued_ns : node.silent_until_ns;
      if (ready > at_ns && ready < next) next = ready;
    }
    if (bus.babbling_node == n && node.silent_until_ns > at_ns && node.silent_until_ns < next)
      next = node.silent_until_ns;
  }
  return next;
}

void count_recessive(BusState *bus, int side, std::int64_t sequences) {
  for (BusNode &node : bus->node) {
    if (node.present && node.powered && node.side == side) saw_recessive(&node, sequences);
  }
}

hoap2_can_frame_t babble(BusState *bus) {
  hoap2_can_frame_t frame = {};
  frame.identifier = bus->babbling_identifier;
  frame.length = kBabbleBytes;
  frame.flags = HOAP2_CAN_FD | HOAP2_CAN_BRS;
  for (int i = 0; i < kBabbleBytes; ++i) frame.data[i] = static_cast<std::uint8_t>(below(bus, 256));
  return frame;
}

bool anyone_else(const BusState &bus, int side, int sender) {
  for (int n = 0; n < kBusNodes; ++n) {
    if (n != sender && takes_part(bus.node[n], side)) return true;
  }
  return false;
}

// An error frame: the senders (bits of a mask) and all receivers count it. first: the receiver that saw it
// first, or -1.
void count_error(BusState *bus, int side, std::uint32_t senders, bool acknowledged, int first) {
  ++bus->counts.errors;
  for (int n = 0; n < kBusNodes; ++n) {
    BusNode &node = bus->node[n];
    if (!takes_part(node, side)) continue;
    if (senders >> n & 1U) {
      send_failed(&node, acknowledged);
    } else if (acknowledged) {
      receive_failed(&node, n == first);
    }
  }
}

int random_receiver(BusState *bus, int side, int sender) {
  int receivers[kBusNodes], count = 0;
  for (int n = 0; n < kBusNodes; ++n) {
    if (n != sender && takes_part(bus->node[n], side)) receivers[count++] = n;
  }
  return count == 0 ? -1 : receivers[below(bus, count)];
}

void after_frame(BusState *bus, int node, std::int64_t end_ns) {
  BusNode &sender = bus->node[node];
  if (sender.mode == NodeMode::kPassive) sender.silent_until_ns = end_ns + kSuspendBits * kNominal_ns;
}

// The transmission fails: everyone counts it, the wire is free again when this returns' time has come.
std::int64_t fail(BusState *bus, int side, std::int64_t start_ns, std::int64_t spoiled_ns,
                  std::uint32_t senders, bool acknowledged, int first) {
  count_error(bus, side, senders, acknowledged, first);
  if (!acknowledged) ++bus->counts.not_acknowledged;
  const std::int64_t end_ns = start_ns + spoiled_ns + kErrorFrameBits * kNominal_ns;
  for (int n = 0; n < kBusNodes; ++n) {
    if (senders >> n & 1U) after_frame(bus, n, end_ns);
  }
  return end_ns;
}

bool same_frame(const hoap2_can_frame_t &a, const hoap2_can_frame_t &b) {
  return a.length == b.length && a.flags == b.flags && std::memcmp(a.data, b.data, a.length) == 0;
}

// The rivals' frame with the winner's identifier: equal ones go through together, others spoil each other.
bool rivals_agree(BusState *bus, const Contender &winner, std::uint32_t rivals,
                  const hoap2_can_frame_t &frame, BusNode::Mailbox *boxes[kBusNodes]) {
  for (int n = 0; n < kBusNodes; ++n) {
    boxes[n] = nullptr;
    if (!(rivals >> n & 1U)) continue;
    for (BusNode::Mailbox &box : bus->node[n].box) {
      if (box.used && arbitration_key(box.frame) == winner.key) boxes[n] = &box;
    }
    if (boxes[n] == nullptr || !same_frame(boxes[n]->frame, frame)) return false;
  }
  return true;
}

void send_off(BusState *bus, int side, int sender, const hoap2_can_frame_t &frame, std::int64_t queued_ns,
              std::int64_t end_ns) {
  BusState::Flight flight = {frame, queued_ns, end_ns + kTransceivers_ns, sender, 1};
  if (happens(bus, bus->faults.loss)) return lose(bus, kLostOnTheWay);
  if (bus->cut) {
    for (const BusNode &node : bus->node) {
      if (node.present && node.powered && node.side != side) return lose(bus, kLostCut);
    }
  }
  if (happens(bus, bus->faults.residual) && frame.length > 0) {
    ++bus->counts.changed;
    flight.frame.data[below(bus, frame.length)] ^= static_cast<std::uint8_t>(1 + below(bus, 255));
  }
  if (happens(bus, bus->faults.delay)) flight.due_ns += bus->faults.delay_ns;
  put_in_flight(bus, flight);
}

// One transmission from its start of frame; returns when the wire is free again.
std::int64_t transmit(BusState *bus, int side, std::int64_t start_ns, const Contender &winner,
                      std::uint32_t rivals) {
  BusNode &sender = bus->node[winner.node];
  const bool made_up = winner.box < 0;
  if (made_up) ++bus->counts.queued;
  const hoap2_can_frame_t frame = made_up ? babble(bus) : sender.box[winner.box].frame;
  const std::int64_t queued_ns = made_up ? start_ns : sender.box[winner.box].queued_ns;
  const std::int64_t length_ns = duration_ns(frame);
  const std::uint32_t senders = rivals | 1U << winner.node;
  BusNode::Mailbox *rival_box[kBusNodes];
  if (!rivals_agree(bus, winner, rivals, frame, rival_box)) {
    if (made_up) lose(bus, kLostBad);
    return fail(bus, side, start_ns, below(bus, length_ns), senders, true, -1);
  }
  if (!anyone_else(*bus, side, winner.node)) {
    if (made_up) lose(bus, kLostBad);
    return fail(bus, side, start_ns, length_ns - 10 * kNominal_ns, senders, false, -1);
  }
  const bool at_all = happens(bus, bus->faults.corrupt),
             at_one = !at_all && happens(bus, bus->faults.corrupt_at_one);
  if (at_all || at_one) {
    if (made_up) lose(bus, kLostBad);
    const int first = at_one ? random_receiver(bus, side, winner.node) : -1;
    return fail(bus, side, start_ns, below(bus, length_ns), senders, true, first);
  }
  const std::int64_t end_ns = start_ns + length_ns;
  send_off(bus, side, winner.node, frame, queued_ns, end_ns);
  if (!made_up) sender.box[winner.box].used = 0;
  for (int n = 0; n < kBusNodes; ++n) {
    if (rivals >> n & 1U) {  // the same bits at the same time: one frame on the wire
      rival_box[n]->used = 0;
      ++bus->counts.delivered;
    }
    if (!takes_part(bus->node[n], side)) continue;
    if (senders >> n & 1U) {
      sent_well(&bus->node[n]);
      after_frame(bus, n, end_ns);
    } else {
      received_well(&bus->node[n]);
    }
  }
  count_recessive(bus, side, 1);
  return end_ns;
}

}  // namespace

void run_wire(BusState *bus, int side, std::int64_t until_ns) {
  // a frame is at least 40 bits long, so this bound is never met before the time is
  const std::int64_t most = 2 + (until_ns - bus->free_ns[side]) / (20 * kData_ns);
  for (std::int64_t round = 0; round < 2 * most && bus->free_ns[side] < until_ns; ++round) {
    std::uint32_t rivals = 0;
    const std::int64_t start_ns = bus->free_ns[side];
    const Contender winner = find_winner(*bus, side, start_ns, &rivals);
    if (winner.node < 0) {
      const std::int64_t next_ns = next_start(*bus, side, start_ns, until_ns);
      count_recessive(bus, side, (next_ns - start_ns) / (kRecessive * kNominal_ns));
      bus->free_ns[side] = next_ns;
      continue;
    }
    bus->free_ns[side] = transmit(bus, side, start_ns, winner, rivals);
    if (side == 0) bus->counts.busy_ns += bus->free_ns[side] - start_ns;
  }
}

}  // namespace hoap2_sim
