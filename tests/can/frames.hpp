// Frames for the tests: random valid ones, and ones made by hand with an own CRC.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "can/codec.h"

namespace can_test {

using Random = std::mt19937_64;

inline std::int64_t pick(Random &random, std::int64_t low, std::int64_t high) {
  return std::uniform_int_distribution<std::int64_t>(low, high)(random);
}

inline std::vector<std::int32_t> random_raw(int layout, Random &random) {
  const hoap2_can_layout_t &l = HOAP2_CAN_LAYOUT[layout];
  std::vector<std::int32_t> raw(HOAP2_CAN_MAX_FIELDS, 0);
  for (int i = 0; i < l.fields; ++i) {
    const hoap2_can_field_t &f = HOAP2_CAN_FIELD[l.first_field + i];
    const auto kind = pick(random, 0, 5);  // the ends of the range too
    raw[static_cast<std::size_t>(i)] = kind == 0   ? f.low
                                       : kind == 1 ? f.high
                                                   : static_cast<std::int32_t>(pick(random, f.low, f.high));
  }
  return raw;
}

inline hoap2_can_frame_t random_frame(int layout, Random &random) {
  hoap2_can_frame_t frame;
  hoap2_can_encode(layout, static_cast<std::uint8_t>(pick(random, 0, 255)), random_raw(layout, random).data(),
                   &frame);
  return frame;
}

// CRC-8 bit by bit, apart from the codec's tables: polynomial 0x2F, start and final XOR 0xFF.
inline std::uint8_t crc8(const hoap2_can_frame_t &frame) {
  std::vector<std::uint8_t> bytes = {static_cast<std::uint8_t>(frame.identifier),
                                     static_cast<std::uint8_t>(frame.identifier >> 8)};
  bytes.insert(bytes.end(), frame.data + 1, frame.data + frame.length);
  unsigned crc = 0xFF;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int i = 0; i < 8; ++i) crc = (crc & 0x80U) ? (crc << 1 ^ 0x2FU) & 0xFFU : crc << 1 & 0xFFU;
  }
  return static_cast<std::uint8_t>(crc ^ 0xFF);
}

inline void seal(hoap2_can_frame_t *frame) { frame->data[0] = crc8(*frame); }

// A frame of a message to or from a board, its raw values set by `set`.
template <class Set>
hoap2_can_frame_t frame_of(int bus, int kind, int node, int counter, Set &&set) {
  std::int32_t raw[HOAP2_CAN_MAX_FIELDS] = {};
  set(raw);
  hoap2_can_frame_t frame;
  hoap2_can_encode(hoap2_can_find(bus, kind, node), static_cast<std::uint8_t>(counter), raw, &frame);
  return frame;
}

inline hoap2_can_frame_t beat(int bus, int counter, int protocol = HOAP2_CAN_PROTOCOL) {
  return frame_of(bus, HOAP2_CAN_K_BEAT, 0, counter,
                  [&](std::int32_t *raw) { raw[HOAP2_CAN_BEAT_PROTOCOL] = protocol; });
}

}  // namespace can_test
