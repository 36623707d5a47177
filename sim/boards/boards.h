// The robot's nine boards between the plant's signals and the frames: what each board measures, and what its
// drives do.
#ifndef HOAP2_SIM_BOARDS_BOARDS_H
#define HOAP2_SIM_BOARDS_BOARDS_H

#include <cstdint>

#include "can/board.h"
#include "hoap2_link/link.h"

namespace hoap2_sim {

// The part of the plant's outputs that this board's own sensors see. sample: number of this measurement.
hoap2_can_sensed_t sensed_by(int board, const hoap2_link_measured_t &plant, std::int32_t sample);

// Puts what the board's drives are set to into the plant's inputs.
void drive_plant(const hoap2_can_board_t &board, hoap2_link_command_t *plant);

}  // namespace hoap2_sim
#endif
