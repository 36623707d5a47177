/* libFuzzer harness: any bytes as one frame, to the codec, as they are and with a right CRC.
 *
 * Input: bus (1 bit), flags, identifier (2 bytes), length, data. What decodes must encode to the same bytes,
 * and its values lie within the table's ranges.
 */
#include <stddef.h>
#include <string.h>

#include "fuzz.h"

static void round_trip(int bus, const hoap2_can_frame_t *frame) {
  hoap2_can_message_t message;
  if (hoap2_can_decode(bus, frame, &message) != 0) return;
  const hoap2_can_layout_t *layout = &HOAP2_CAN_LAYOUT[message.layout];
  const hoap2_can_field_t *field = &HOAP2_CAN_FIELD[layout->first_field];
  for (int i = 0; i < layout->fields; ++i) {
    require(message.raw[i] >= field[i].low && message.raw[i] <= field[i].high);
    if (field[i].kind != HOAP2_CAN_FLOAT)
      require(hoap2_can_raw(&field[i], hoap2_can_value(&field[i], message.raw[i])) == message.raw[i]);
  }
  hoap2_can_frame_t again;
  require(hoap2_can_encode(message.layout, message.counter, message.raw, &again) == 0);
  require(again.identifier == frame->identifier && again.length == frame->length);
  require(memcmp(again.data, frame->data, frame->length) == 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size) {
  if (size < 5) return 0;
  hoap2_can_frame_t frame;
  memset(&frame, 0, sizeof frame);
  frame.flags = bytes[1];
  frame.identifier = (uint32_t)bytes[2] | (uint32_t)bytes[3] << 8;
  frame.length = bytes[4];
  for (size_t i = 0; i < HOAP2_CAN_DATA_BYTES && 5 + i < size; ++i) frame.data[i] = bytes[5 + i];
  round_trip(bytes[0] & 1, &frame);
  seal(&frame);
  round_trip(bytes[0] & 1, &frame);
  return 0;
}
