#include "can/codec.h"

#include <string.h>

/* Least significant byte first whatever the machine; compilers make one load of it. */
static uint64_t load_bytes(const uint8_t *at) {
  return (uint64_t)at[0] | (uint64_t)at[1] << 8 | (uint64_t)at[2] << 16 | (uint64_t)at[3] << 24 |
         (uint64_t)at[4] << 32;
}

static void add_bytes(uint8_t *at, uint64_t bits) {
  for (int i = 0; i < 5; ++i) at[i] = (uint8_t)(at[i] | (uint8_t)(bits >> (8 * i)));
}

static uint8_t crc_of(uint32_t identifier, const uint8_t data[], int length) {
  uint8_t crc = HOAP2_CAN_CRC8[0][0xFF ^ (uint8_t)identifier];
  crc = HOAP2_CAN_CRC8[0][crc ^ (uint8_t)(identifier >> 8)];
  int i = 1;
  for (; i + 4 <= length; i += 4)
    crc = (uint8_t)(HOAP2_CAN_CRC8[3][crc ^ data[i]] ^ HOAP2_CAN_CRC8[2][data[i + 1]] ^
                    HOAP2_CAN_CRC8[1][data[i + 2]] ^ HOAP2_CAN_CRC8[0][data[i + 3]]);
  for (; i < length; ++i) crc = HOAP2_CAN_CRC8[0][crc ^ data[i]];
  return (uint8_t)(crc ^ 0xFF);
}

int hoap2_can_protocol(void) { return HOAP2_CAN_PROTOCOL; }

int hoap2_can_find(int bus, int kind, int node) {
  if (bus < 0 || bus >= HOAP2_CAN_BUSES || kind < 0 || kind >= HOAP2_CAN_KINDS || node < 0 ||
      node >= HOAP2_CAN_NODES)
    return -1;
  return HOAP2_CAN_LOOKUP[bus][kind << HOAP2_CAN_NODE_BITS | node];
}

int hoap2_can_encode(int layout_index, uint8_t counter, const int32_t raw[], hoap2_can_frame_t *frame) {
  const hoap2_can_layout_t *layout = &HOAP2_CAN_LAYOUT[layout_index];
  const hoap2_can_field_t *field = &HOAP2_CAN_FIELD[layout->first_field];
  memset(frame, 0, sizeof *frame);
  frame->identifier = layout->identifier;
  frame->length = layout->length;
  frame->flags = HOAP2_CAN_FD | HOAP2_CAN_BRS;
  frame->data[1] = counter;
  for (int i = 0; i < layout->fields; ++i) {
    if (raw[i] < field[i].low || raw[i] > field[i].high) return HOAP2_CAN_REFUSED_VALUE;
    const uint64_t mask = (UINT64_C(1) << field[i].bits) - 1;
    add_bytes(&frame->data[field[i].first_bit >> 3], ((uint64_t)(uint32_t)raw[i] & mask)
                                                         << (field[i].first_bit & 7));
  }
  frame->data[0] = crc_of(frame->identifier, frame->data, frame->length);
  return HOAP2_CAN_REFUSED_NONE;
}

/* Bits behind the last field. */
static int spare_bits_clear(const hoap2_can_layout_t *layout, const uint8_t data[]) {
  int byte = layout->used_bits >> 3;
  if (byte < layout->length && (data[byte] >> (layout->used_bits & 7)) != 0) return 0;
  for (++byte; byte < layout->length; ++byte)
    if (data[byte] != 0) return 0;
  return 1;
}

static int32_t extract(const hoap2_can_field_t *field, const uint8_t data[]) {
  const uint64_t bits = load_bytes(&data[field->first_bit >> 3]) >> (field->first_bit & 7);
  const uint32_t mask = (uint32_t)((UINT64_C(1) << field->bits) - 1);
  const uint32_t value = (uint32_t)bits & mask;
  const uint32_t sign = UINT32_C(1) << (field->bits - 1);
  if (field->kind == HOAP2_CAN_UNSIGNED || !(value & sign)) return (int32_t)value;
  return (int32_t)((int64_t)value - ((int64_t)mask + 1));
}

int hoap2_can_decode(int bus, const hoap2_can_frame_t *frame, hoap2_can_message_t *message) {
  message->layout = -1;
  if (bus < 0 || bus >= HOAP2_CAN_BUSES || frame->identifier >= HOAP2_CAN_KINDS << HOAP2_CAN_NODE_BITS ||
      (frame->flags & (HOAP2_CAN_EXTENDED | HOAP2_CAN_REMOTE)))
    return HOAP2_CAN_REFUSED_UNKNOWN;
  const int index = HOAP2_CAN_LOOKUP[bus][frame->identifier];
  if (index < 0) return HOAP2_CAN_REFUSED_UNKNOWN;
  const hoap2_can_layout_t *layout = &HOAP2_CAN_LAYOUT[index];
  message->layout = (int16_t)index;
  message->kind = layout->kind;
  message->board = layout->board;
  if (frame->length != layout->length) return HOAP2_CAN_REFUSED_LENGTH;
  if (frame->data[0] != crc_of(frame->identifier, frame->data, frame->length)) return HOAP2_CAN_REFUSED_CRC;
  if (!spare_bits_clear(layout, frame->data)) return HOAP2_CAN_REFUSED_VALUE;
  message->counter = frame->data[1];
  const hoap2_can_field_t *field = &HOAP2_CAN_FIELD[layout->first_field];
  for (int i = 0; i < layout->fields; ++i) {
    message->raw[i] = extract(&field[i], frame->data);
    if (message->raw[i] < field[i].low || message->raw[i] > field[i].high) return HOAP2_CAN_REFUSED_VALUE;
  }
  return HOAP2_CAN_REFUSED_NONE;
}

int32_t hoap2_can_raw(const hoap2_can_field_t *field, double value) {
  const double steps = value * field->steps;
  if (steps >= (double)field->high) return field->high;
  if (steps <= (double)field->low) return field->low;
  if (!(steps >= 0.0 || steps < 0.0)) return 0;
  return (int32_t)(steps + (steps < 0.0 ? -0.5 : 0.5));
}

double hoap2_can_value(const hoap2_can_field_t *field, int32_t raw) { return field->lsb * raw; }

int32_t hoap2_can_float_bits(float value) {
  int32_t raw;
  memcpy(&raw, &value, sizeof raw);
  return raw;
}

float hoap2_can_bits_float(int32_t raw) {
  float value;
  memcpy(&value, &raw, sizeof value);
  return value;
}
