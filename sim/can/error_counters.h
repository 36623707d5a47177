// Error counters of a node and the states that follow from them (ISO 11898-1, fault confinement).
#ifndef HOAP2_SIM_CAN_ERROR_COUNTERS_H
#define HOAP2_SIM_CAN_ERROR_COUNTERS_H

#include "can/bus.h"

namespace hoap2_sim {

constexpr int kPassiveAbove = 127, kOffAbove = 255, kSequencesToRecover = 128;
constexpr int kSendErrorStep = 8, kReceiveErrorStep = 1, kFirstToFlagStep = 8;
constexpr int kReceiveErrorAfterPassive = 119;

inline void update_mode(BusNode *node) {
  if (node->mode == NodeMode::kOff) return;
  if (node->send_errors > kOffAbove) {
    node->mode = NodeMode::kOff;
    node->recovery = 0;
  } else {
    const bool passive = node->send_errors > kPassiveAbove || node->receive_errors > kPassiveAbove;
    node->mode = passive ? NodeMode::kPassive : NodeMode::kActive;
  }
}

inline void sent_well(BusNode *node) {
  if (node->send_errors > 0) --node->send_errors;
  update_mode(node);
}

inline void received_well(BusNode *node) {
  if (node->receive_errors > kPassiveAbove) {
    node->receive_errors = kReceiveErrorAfterPassive;
  } else if (node->receive_errors > 0) {
    --node->receive_errors;
  }
  update_mode(node);
}

// acknowledged: an error passive sender that only misses the acknowledgement is not punished, or a node that
// is alone would go bus-off.
inline void send_failed(BusNode *node, bool acknowledged) {
  if (acknowledged || node->mode != NodeMode::kPassive) node->send_errors += kSendErrorStep;
  update_mode(node);
}

// first: this receiver saw the error before the others, and finds their flags behind its own.
inline void receive_failed(BusNode *node, bool first) {
  if (node->receive_errors <= kPassiveAbove)
    node->receive_errors += kReceiveErrorStep + (first ? kFirstToFlagStep : 0);
  update_mode(node);
}

// Sequences of 11 recessive bits on the wire: 128 of them bring a node back from bus-off.
inline void saw_recessive(BusNode *node, std::int64_t sequences) {
  if (node->mode != NodeMode::kOff) return;
  const std::int64_t seen = node->recovery + sequences;
  node->recovery = static_cast<std::int32_t>(seen < kSequencesToRecover ? seen : kSequencesToRecover);
  if (node->recovery < kSequencesToRecover) return;
  node->mode = NodeMode::kActive;
  node->send_errors = node->receive_errors = node->recovery = 0;
}

}  // namespace hoap2_sim
#endif
