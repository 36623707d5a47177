// How many bits a frame has on the wire, stuff bits counted as its content makes them (ISO 11898-1).
#ifndef HOAP2_SIM_CAN_FRAME_BITS_H
#define HOAP2_SIM_CAN_FRAME_BITS_H

#include <cstdint>

#include "can/frame.h"

namespace hoap2_sim {

// From start of frame to the end of the intermission. BRS and CRC delimiter, in which the rate changes at the
// sample point, count as one nominal and one data bit together.
struct FrameBits {
  std::int32_t nominal;
  std::int32_t data;  // at the higher rate; 0 without BRS
};

FrameBits frame_bits(const hoap2_can_frame_t &frame);

// The code of a payload's length in the frame, -1 for a length that CAN FD (or classic CAN) does not have.
int length_code(int length, bool fd);

}  // namespace hoap2_sim
#endif
