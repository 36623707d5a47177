/* Operations of FMI-LS-BUS 1.0.0 on a CAN network, as bytes and back.
 *
 * A Binary of a bus terminal holds zero or more operations back to back, little-endian and packed:
 * u32 code, u32 length of the whole operation, arguments. Nothing here trusts a length.
 */
#ifndef HOAP2_LS_BUS_CAN_OPERATIONS_H
#define HOAP2_LS_BUS_CAN_OPERATIONS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
  HOAP2_LS_FORMAT_ERROR = 0x01,
  HOAP2_LS_CAN_TRANSMIT = 0x10,
  HOAP2_LS_CAN_FD_TRANSMIT = 0x11,
  HOAP2_LS_CAN_XL_TRANSMIT = 0x12, /* known, not carried */
  HOAP2_LS_CONFIRM = 0x20,
  HOAP2_LS_ARBITRATION_LOST = 0x30,
  HOAP2_LS_BUS_ERROR = 0x31,
  HOAP2_LS_CONFIGURATION = 0x40,
  HOAP2_LS_STATUS = 0x41,
  HOAP2_LS_WAKEUP = 0x42
};

/* Kinds of a configuration: the bit rates carry bit/s, the last one a behaviour. */
enum {
  HOAP2_LS_CAN_BAUDRATE = 1,
  HOAP2_LS_CAN_FD_BAUDRATE = 2,
  HOAP2_LS_CAN_XL_BAUDRATE = 3,
  HOAP2_LS_ARBITRATION_LOST_BEHAVIOR = 4
};
enum { HOAP2_LS_BUFFER_AND_RETRANSMIT = 1, HOAP2_LS_DISCARD_AND_NOTIFY = 2 };
enum {
  HOAP2_LS_BIT_ERROR = 1,
  HOAP2_LS_STUFFING_ERROR = 2,
  HOAP2_LS_FORM_ERROR = 3,
  HOAP2_LS_CRC_ERROR = 4,
  HOAP2_LS_ACK_ERROR = 5,
  HOAP2_LS_BROKEN_ERROR_FRAME = 6
};
enum { HOAP2_LS_PRIMARY_ERROR = 1, HOAP2_LS_SECONDARY_ERROR = 2 };
enum { HOAP2_LS_ERROR_ACTIVE = 1, HOAP2_LS_ERROR_PASSIVE = 2, HOAP2_LS_BUS_OFF = 3 };

/* Data of one operation: 64 bytes of a CAN FD frame; of a format error as much of the other one as fits. */
enum { HOAP2_LS_DATA_BYTES = 64, HOAP2_LS_LARGEST_OPERATION = 17 + HOAP2_LS_DATA_BYTES };

/* One operation; what its code does not use is 0. */
typedef struct {
  uint32_t code;
  uint32_t identifier;      /* transmit, confirm, arbitration lost, bus error: the number alone, no flag bits */
  uint32_t value;           /* configuration: bit/s or the behaviour */
  uint16_t length;          /* transmit, format error: bytes of data */
  uint8_t extended;         /* transmit: 29 bits of identifier instead of 11 */
  uint8_t remote;           /* CAN transmit */
  uint8_t bit_rate_switch;  /* CAN FD transmit */
  uint8_t error_passive;    /* CAN FD transmit: the sender's error state indicator */
  uint8_t error_code;       /* bus error */
  uint8_t error_flag;       /* bus error */
  uint8_t is_sender;        /* bus error */
  uint8_t kind;             /* configuration: its kind; status: the state */
  uint8_t data[HOAP2_LS_DATA_BYTES];
} hoap2_ls_operation_t;

typedef enum {
  HOAP2_LS_READ_END = 0,     /* no bytes are left */
  HOAP2_LS_READ_OPERATION,   /* *operation holds it */
  HOAP2_LS_READ_REFUSED,     /* its length fits the bytes, its content is not one of ours: passed over */
  HOAP2_LS_READ_BROKEN       /* its length cannot be: nothing after it can be read */
} hoap2_ls_read_t;

/* Append an operation at out[*size], whose room is `room` bytes in all; *size grows by its length.
 * Returns 0, or -1 and leaves all as it is when there is no room or the operation is not one. */
int hoap2_ls_write(const hoap2_ls_operation_t *operation, uint8_t *out, size_t room, size_t *size);

/* Read the operation at in[*at] of `size` bytes and go on behind it. For a refused or broken one *operation is the
 * format error that answers it (with its first HOAP2_LS_DATA_BYTES bytes); code 0 when it is not to be answered. */
hoap2_ls_read_t hoap2_ls_read(const uint8_t *in, size_t size, size_t *at, hoap2_ls_operation_t *operation);

#ifdef __cplusplus
}
#endif
#endif
