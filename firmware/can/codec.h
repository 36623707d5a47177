/* Frames to field values and back, by the generated tables. Nothing is allocated, no byte beyond a frame is
 * touched, and what is not exactly as the table says is refused with its reason (HOAP2_CAN_REFUSED_*).
 *
 *   data[0]  CRC-8 over the identifier (low byte, high byte) and data[1 ... length - 1]
 *   data[1]  message counter
 *   data[2]  fields, least significant bit first, without gaps; spare bits zero
 */
#ifndef HOAP2_CAN_CODEC_H
#define HOAP2_CAN_CODEC_H

#include "can/frame.h"
#include "can/generated/can_table.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A frame taken apart. raw: as the table's places name them (HOAP2_CAN_<message>_<field>). */
typedef struct {
  int32_t raw[HOAP2_CAN_MAX_FIELDS];
  int16_t layout; /* index in HOAP2_CAN_LAYOUT */
  uint8_t kind;
  int8_t board;
  uint8_t counter;
} hoap2_can_message_t;

/* HOAP2_CAN_PROTOCOL as it was compiled in. */
int hoap2_can_protocol(void);

/* Index in HOAP2_CAN_LAYOUT of a message, -1 when the bus does not have it. node: the board's, or 0. */
int hoap2_can_find(int bus, int kind, int node);

/* Makes the frame. Returns 0, or HOAP2_CAN_REFUSED_VALUE when a raw value is beyond its range. */
int hoap2_can_encode(int layout, uint8_t counter, const int32_t raw[], hoap2_can_frame_t *frame);

/* Takes a frame of this bus apart. Returns 0, or why it is refused; then only message->layout is set (-1 if
 * unknown). */
int hoap2_can_decode(int bus, const hoap2_can_frame_t *frame, hoap2_can_message_t *message);

/* Nearest raw value of a field, pulled to its range; NaN becomes 0. */
int32_t hoap2_can_raw(const hoap2_can_field_t *field, double value);
/* Value of a raw one. */
double hoap2_can_value(const hoap2_can_field_t *field, int32_t raw);

/* IEEE single of a field of kind FLOAT, as its raw bits. */
int32_t hoap2_can_float_bits(float value);
float hoap2_can_bits_float(int32_t raw);

#ifdef __cplusplus
}
#endif
#endif
