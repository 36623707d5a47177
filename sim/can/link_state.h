// The link's whole state and its tick.
#ifndef HOAP2_SIM_CAN_LINK_STATE_H
#define HOAP2_SIM_CAN_LINK_STATE_H

#include <cstdint>
#include <type_traits>

#include "can/board.h"
#include "can/bus.h"
#include "can/controller_node.h"
#include "hoap2_link/link.h"

namespace hoap2_sim {

constexpr std::uint64_t kLinkMagic = 0x324e4143504f4148ULL;
constexpr std::uint32_t kLinkVersion = 1;
constexpr int kSecondNode = 15;  // a second controller's place on the buses

struct LinkState {
  std::uint64_t magic;
  std::uint32_t version;
  std::uint32_t size;
  hoap2_link_params_t params;
  BusState bus[HOAP2_CAN_BUSES];
  hoap2_can_controller_t controller;
  hoap2_can_controller_t second;
  hoap2_can_board_t board[HOAP2_CAN_BOARDS];
  BusCounts boot[HOAP2_CAN_BUSES];  // what the boot took, left out of the counts
  std::int64_t hold_ticks;
  std::int32_t tick;    // of the run; negative while booting
  std::int32_t sample;  // number of the plant's measurement
  std::int32_t last_sensor_tick;
};

static_assert(std::is_trivially_copyable<LinkState>::value, "the state is saved by memcpy");

// A block of bytes that may come from a file: nothing of it is believed that indexes a table or ends a loop.
bool link_is_whole(const LinkState &link);
void link_init(LinkState *link, const hoap2_link_params_t &params, std::uint32_t run_seed);
// Before the first exchange: everyone is switched on, and the robot does not move meanwhile. Later it does
// nothing.
void link_boot(LinkState *link, const hoap2_link_command_t &asked, const hoap2_link_measured_t &measured);
void link_exchange(LinkState *link, const hoap2_link_command_t &asked, const hoap2_link_measured_t &measured,
                   hoap2_link_command_t *to_plant, hoap2_link_measured_t *to_controller);

}  // namespace hoap2_sim
#endif
