/* Parameter access of a board. */
#ifndef HOAP2_CAN_BOARD_PARAMETERS_H
#define HOAP2_CAN_BOARD_PARAMETERS_H

#include "can/board.h"

/* Does a request (raw values of its frame) and leaves the reply in the board. */
void hoap2_can_board_request(hoap2_can_board_t *board, const int32_t raw[]);

#endif
