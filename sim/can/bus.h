// A CAN bus: arbitration by identifier, frames as long as their bits, error counters and states of each node,
// and what can go wrong. All state is one plain struct; time is an integer count of nanoseconds.
//
// A node has a mailbox for each identifier that it sends: a newer frame replaces one that still waits. Frames
// go on the bus by priority, are repeated after an error, and are dropped only with a cause that is counted.
#ifndef HOAP2_SIM_CAN_BUS_H
#define HOAP2_SIM_CAN_BUS_H

#include <cstdint>
#include <type_traits>

#include "can/frame.h"

namespace hoap2_sim {

constexpr int kBusNodes = 16;
constexpr int kMailboxes = 16;   // of a node
constexpr int kInFlight = 64;    // frames on their way: the one on the wire, and late ones
constexpr int kPriorities = 16;  // identifier >> 5

enum class NodeMode : std::int32_t { kActive = 0, kPassive = 1, kOff = 2 };

// Why a frame that was queued reached nobody.
enum LossCause : int {
  kLostOnTheWay,
  kLostSuperseded,
  kLostNoRoom,
  kLostNodeDown,
  kLostCut,
  kLostBad,
  kLossCauses
};

struct BusNode {
  struct Mailbox {
    hoap2_can_frame_t frame;
    std::int64_t queued_ns;
    std::int32_t used;
  };
  Mailbox box[kMailboxes];
  std::int64_t silent_until_ns;  // an error passive sender waits after its frame
  std::int32_t send_errors;      // TEC
  std::int32_t receive_errors;   // REC
  NodeMode mode;
  std::int32_t recovery;  // 11 recessive bits seen since bus-off
  std::int32_t present;   // wired to this bus
  std::int32_t powered;
  std::int32_t side;  // of the cut
};

// Probabilities a transmission, as in firmware/can.toml.
struct BusFaults {
  double loss, corrupt, corrupt_at_one, residual, delay;
  std::int64_t delay_ns;
};

struct BusCounts {
  std::int64_t queued, delivered, lost[kLossCauses];
  std::int64_t errors;            // error frames
  std::int64_t not_acknowledged;  // of them: nobody acknowledged
  std::int64_t changed;           // delivered with a changed byte
  std::int64_t busy_ns;
  std::int64_t frames[kPriorities], latency_sum_ns[kPriorities], latency_max_ns[kPriorities];
};

struct BusState {
  struct Flight {
    hoap2_can_frame_t frame;
    std::int64_t queued_ns, due_ns;
    std::int32_t sender;
    std::int32_t used;
  };
  BusNode node[kBusNodes];
  Flight flight[kInFlight];
  BusFaults faults;
  BusCounts counts;
  std::int64_t now_ns;
  std::int64_t free_ns[2];  // the wire is free from here on; [1] is the far side of a cut
  std::int32_t cut;
  std::int32_t babbling_node;  // -1: none
  std::uint32_t babbling_identifier;
  std::uint64_t random[4];
};

static_assert(std::is_trivially_copyable<BusState>::value, "the state is saved by memcpy");

// Called for each node that a frame reaches.
struct BusSink {
  void *owner;
  void (*deliver)(void *owner, int node, const hoap2_can_frame_t &frame);
};

void bus_init(BusState *bus, std::uint64_t seed);
void bus_add_node(BusState *bus, int node);
// A node that is off neither sends, receives nor acknowledges; what waits in it is dropped.
void bus_power(BusState *bus, int node, bool on);
// Cuts the wire: the nodes of this mask are on the far side, which goes on as a bus of its own.
void bus_cut(BusState *bus, bool cut, std::uint32_t far_nodes);

// Puts a frame in the node's mailboxes at a time that is not before the bus's own.
void bus_queue(BusState *bus, int node, const hoap2_can_frame_t &frame, std::int64_t at_ns);
// Runs the bus up to this time.
void bus_advance(BusState *bus, std::int64_t until_ns, const BusSink &sink);

// Frames that wait or are on their way: queued = delivered + lost + pending.
std::int64_t bus_pending(const BusState &bus);

}  // namespace hoap2_sim
#endif
