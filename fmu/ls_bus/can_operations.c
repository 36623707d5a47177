#include "ls_bus/can_operations.h"

#include <string.h>

enum { HEADER = 8, STANDARD_BITS = 11, EXTENDED_BITS = 29, CAN_BYTES = 8 };

/* Bytes to read from or to write to: `at` never passes `end`. */
typedef struct {
  const uint8_t *bytes;
  size_t at, end;
} source_t;

typedef struct {
  uint8_t *bytes;
  size_t at;
} target_t;

static uint32_t take(source_t *from, size_t count) {
  uint32_t value = 0;
  for (size_t i = 0; i < count && from->at < from->end; ++i) value |= (uint32_t)from->bytes[from->at++] << (8 * i);
  return value;
}

static uint8_t take_byte(source_t *from) { return (uint8_t)take(from, 1); }

static void put(target_t *to, size_t count, uint32_t value) {
  for (size_t i = 0; i < count; ++i) to->bytes[to->at++] = (uint8_t)(value >> (8 * i));
}

static int is_switch(uint8_t value) { return value <= 1; }

static int is_between(uint32_t value, uint32_t low, uint32_t high) { return value >= low && value <= high; }

static int is_identifier(uint32_t identifier, uint8_t extended) {
  return is_switch(extended) && identifier < (1U << (extended ? EXTENDED_BITS : STANDARD_BITS));
}

/* CAN FD has no frames of any other length. */
static int is_fd_length(uint16_t length) {
  return length <= 8 || length == 12 || length == 16 || length == 20 || length == 24 || length == 32 ||
         length == 48 || length == 64;
}

static int is_valid(const hoap2_ls_operation_t *o) {
  switch (o->code) {
    case HOAP2_LS_FORMAT_ERROR: return o->length <= HOAP2_LS_DATA_BYTES;
    case HOAP2_LS_CAN_TRANSMIT:
      return is_identifier(o->identifier, o->extended) && is_switch(o->remote) && o->length <= CAN_BYTES;
    case HOAP2_LS_CAN_FD_TRANSMIT:
      return is_identifier(o->identifier, o->extended) && is_switch(o->bit_rate_switch) &&
             is_switch(o->error_passive) && is_fd_length(o->length);
    case HOAP2_LS_CONFIRM:
    case HOAP2_LS_ARBITRATION_LOST: return is_identifier(o->identifier, 1);
    case HOAP2_LS_BUS_ERROR:
      return is_identifier(o->identifier, 1) &&
             is_between(o->error_code, HOAP2_LS_BIT_ERROR, HOAP2_LS_BROKEN_ERROR_FRAME) &&
             is_between(o->error_flag, HOAP2_LS_PRIMARY_ERROR, HOAP2_LS_SECONDARY_ERROR) && is_switch(o->is_sender);
    case HOAP2_LS_CONFIGURATION:
      if (o->kind == HOAP2_LS_ARBITRATION_LOST_BEHAVIOR)
        return is_between(o->value, HOAP2_LS_BUFFER_AND_RETRANSMIT, HOAP2_LS_DISCARD_AND_NOTIFY);
      return is_between(o->kind, HOAP2_LS_CAN_BAUDRATE, HOAP2_LS_CAN_XL_BAUDRATE) && o->value > 0;
    case HOAP2_LS_STATUS: return is_between(o->kind, HOAP2_LS_ERROR_ACTIVE, HOAP2_LS_BUS_OFF);
    case HOAP2_LS_WAKEUP: return 1;
    default: return 0;
  }
}

/* Whole length of a valid operation. */
static size_t length_of(const hoap2_ls_operation_t *o) {
  switch (o->code) {
    case HOAP2_LS_FORMAT_ERROR: return 10 + (size_t)o->length;
    case HOAP2_LS_CAN_TRANSMIT: return 16 + (size_t)o->length;
    case HOAP2_LS_CAN_FD_TRANSMIT: return 17 + (size_t)o->length;
    case HOAP2_LS_CONFIRM:
    case HOAP2_LS_ARBITRATION_LOST: return 12;
    case HOAP2_LS_BUS_ERROR: return 15;
    case HOAP2_LS_CONFIGURATION: return o->kind == HOAP2_LS_ARBITRATION_LOST_BEHAVIOR ? 10 : 13;
    case HOAP2_LS_STATUS: return 9;
    default: return HEADER;
  }
}

static void put_transmit(target_t *to, const hoap2_ls_operation_t *o) {
  put(to, 4, o->identifier);
  put(to, 1, o->extended);
  if (o->code == HOAP2_LS_CAN_TRANSMIT) {
    put(to, 1, o->remote);
  } else {
    put(to, 1, o->bit_rate_switch);
    put(to, 1, o->error_passive);
  }
}

static void put_data(target_t *to, const hoap2_ls_operation_t *o) {
  put(to, 2, o->length);
  for (size_t i = 0; i < o->length; ++i) put(to, 1, o->data[i]);
}

int hoap2_ls_write(const hoap2_ls_operation_t *o, uint8_t *out, size_t room, size_t *size) {
  if (!is_valid(o) || *size > room || length_of(o) > room - *size) return -1;
  target_t to = {out, *size};
  put(&to, 4, o->code);
  put(&to, 4, (uint32_t)length_of(o));
  switch (o->code) {
    case HOAP2_LS_CAN_TRANSMIT:
    case HOAP2_LS_CAN_FD_TRANSMIT: put_transmit(&to, o); put_data(&to, o); break;
    case HOAP2_LS_FORMAT_ERROR: put_data(&to, o); break;
    case HOAP2_LS_CONFIRM:
    case HOAP2_LS_ARBITRATION_LOST: put(&to, 4, o->identifier); break;
    case HOAP2_LS_BUS_ERROR:
      put(&to, 4, o->identifier);
      put(&to, 1, o->error_code);
      put(&to, 1, o->error_flag);
      put(&to, 1, o->is_sender);
      break;
    case HOAP2_LS_CONFIGURATION:
      put(&to, 1, o->kind);
      put(&to, o->kind == HOAP2_LS_ARBITRATION_LOST_BEHAVIOR ? 1 : 4, o->value);
      break;
    case HOAP2_LS_STATUS: put(&to, 1, o->kind); break;
    default: break;
  }
  *size = to.at;
  return 0;
}

static void take_data(source_t *from, hoap2_ls_operation_t *o) {
  o->length = (uint16_t)take(from, 2);
  for (size_t i = 0; i < o->length && i < HOAP2_LS_DATA_BYTES; ++i) o->data[i] = take_byte(from);
}

static void take_transmit(source_t *from, hoap2_ls_operation_t *o) {
  o->identifier = take(from, 4);
  o->extended = take_byte(from);
  if (o->code == HOAP2_LS_CAN_TRANSMIT) {
    o->remote = take_byte(from);
  } else {
    o->bit_rate_switch = take_byte(from);
    o->error_passive = take_byte(from);
  }
}

static void take_arguments(source_t *from, hoap2_ls_operation_t *o) {
  switch (o->code) {
    case HOAP2_LS_CAN_TRANSMIT:
    case HOAP2_LS_CAN_FD_TRANSMIT: take_transmit(from, o); take_data(from, o); break;
    case HOAP2_LS_FORMAT_ERROR: take_data(from, o); break;
    case HOAP2_LS_CONFIRM:
    case HOAP2_LS_ARBITRATION_LOST: o->identifier = take(from, 4); break;
    case HOAP2_LS_BUS_ERROR:
      o->identifier = take(from, 4);
      o->error_code = take_byte(from);
      o->error_flag = take_byte(from);
      o->is_sender = take_byte(from);
      break;
    case HOAP2_LS_CONFIGURATION:
      o->kind = take_byte(from);
      o->value = take(from, o->kind == HOAP2_LS_ARBITRATION_LOST_BEHAVIOR ? 1 : 4);
      break;
    case HOAP2_LS_STATUS: o->kind = take_byte(from); break;
    default: break;
  }
}

/* The answer to bytes that are no operation. A damaged format error has none: two nodes would go on for ever. */
static void refuse(const uint8_t *bytes, size_t count, hoap2_ls_operation_t *answer) {
  const int is_answer = answer->code == HOAP2_LS_FORMAT_ERROR;
  const hoap2_ls_operation_t empty = {0};
  *answer = empty;
  if (is_answer) return;
  answer->code = HOAP2_LS_FORMAT_ERROR;
  answer->length = (uint16_t)(count < HOAP2_LS_DATA_BYTES ? count : HOAP2_LS_DATA_BYTES);
  memcpy(answer->data, bytes, answer->length);
}

hoap2_ls_read_t hoap2_ls_read(const uint8_t *in, size_t size, size_t *at, hoap2_ls_operation_t *operation) {
  const hoap2_ls_operation_t empty = {0};
  *operation = empty;
  if (*at >= size) return HOAP2_LS_READ_END;
  const uint8_t *const begin = in + *at;
  const size_t left = size - *at;
  source_t from = {begin, 0, left};
  operation->code = take(&from, 4);
  const size_t length = take(&from, 4);
  if (left < HEADER || length < HEADER || length > left) {
    refuse(begin, left, operation);
    *at = size;
    return HOAP2_LS_READ_BROKEN;
  }
  *at += length;
  from.end = length;
  take_arguments(&from, operation);
  size_t cut = 0; /* of a format error about a long operation only the beginning is kept */
  if (operation->code == HOAP2_LS_FORMAT_ERROR && operation->length > HOAP2_LS_DATA_BYTES) {
    cut = (size_t)operation->length - HOAP2_LS_DATA_BYTES;
    operation->length = HOAP2_LS_DATA_BYTES;
  }
  if (is_valid(operation) && length_of(operation) + cut == length) return HOAP2_LS_READ_OPERATION;
  refuse(begin, length, operation);
  return HOAP2_LS_READ_REFUSED;
}
