// One transmission after the other on a wire.
#ifndef HOAP2_SIM_CAN_WIRE_H
#define HOAP2_SIM_CAN_WIRE_H

#include "can/bus.h"

namespace hoap2_sim {

// Sends what waits on this side of the bus until the time has come; what has been sent is then in flight.
void run_wire(BusState *bus, int side, std::int64_t until_ns);

// What decides an arbitration: the smaller wins; with equal first eleven bits a base frame beats an extended
// one.
inline std::uint64_t arbitration_key(const hoap2_can_frame_t &f) {
  const bool extended = f.flags & HOAP2_CAN_EXTENDED;
  const std::uint64_t base = extended ? f.identifier >> 18 & 0x7FFU : f.identifier & 0x7FFU;
  const std::uint64_t rest = extended ? (1ULL << 19 | (f.identifier & 0x3FFFFU) << 1) : 0ULL;
  return base << 20 | rest;
}

inline void lose(BusState *bus, LossCause cause) { ++bus->counts.lost[cause]; }

}  // namespace hoap2_sim
#endif
