/* What a board sends in a tick. */
#ifndef HOAP2_CAN_BOARD_SEND_H
#define HOAP2_CAN_BOARD_SEND_H

#include "can/board.h"

/* Emergency stop, heartbeat, measurements, answers, as they are due. */
void hoap2_can_board_send(hoap2_can_board_t *board, const hoap2_can_sensed_t *sensed,
                          hoap2_can_outbox_t *out);

#endif
