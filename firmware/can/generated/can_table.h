/* Generated from firmware/can.toml and firmware/hoap2.json by ./hoap2 generate: do not edit. */
#ifndef HOAP2_CAN_GENERATED_CAN_TABLE_H
#define HOAP2_CAN_GENERATED_CAN_TABLE_H
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { HOAP2_CAN_SCHEMA = 1, HOAP2_CAN_PROTOCOL = 23088, HOAP2_CAN_BUSES = 2, HOAP2_CAN_BOARDS = 9, HOAP2_CAN_FRAMES = 69, HOAP2_CAN_FIELDS = 390, HOAP2_CAN_MAX_FIELDS = 24, HOAP2_CAN_MAX_LENGTH = 32, HOAP2_CAN_BOARD_JOINTS = 6, HOAP2_CAN_NODE_BITS = 5, HOAP2_CAN_NODES = 32, HOAP2_CAN_KINDS = 12, HOAP2_CAN_PARAMETERS = 5, HOAP2_CAN_CONTROLLER_NODE = 0, HOAP2_CAN_ALIVE_LIMIT_TICKS = 5, HOAP2_CAN_COUNTER_WINDOW = 100, HOAP2_CAN_NOMINAL_BIT_S = 1000000, HOAP2_CAN_DATA_BIT_S = 5000000 };
enum { HOAP2_CAN_UNSIGNED = 0, HOAP2_CAN_SIGNED = 1, HOAP2_CAN_FLOAT = 2 };
enum { HOAP2_CAN_BUS_RIGHT = 0, HOAP2_CAN_BUS_LEFT = 1 };
enum { HOAP2_CAN_B_R_LEG = 0, HOAP2_CAN_B_R_ARM = 1, HOAP2_CAN_B_R_FOOT = 2, HOAP2_CAN_B_POSTURE = 3, HOAP2_CAN_B_HEAD_HANDS = 4, HOAP2_CAN_B_L_LEG = 5, HOAP2_CAN_B_L_ARM = 6, HOAP2_CAN_B_L_FOOT = 7, HOAP2_CAN_B_WAIST = 8 };
enum { HOAP2_CAN_BOARD_DRIVE = 0, HOAP2_CAN_BOARD_RC = 1, HOAP2_CAN_BOARD_FOOT = 2, HOAP2_CAN_BOARD_POSTURE = 3 };
enum { HOAP2_CAN_K_STOP = 0, HOAP2_CAN_K_BEAT = 1, HOAP2_CAN_K_SETTINGS = 2, HOAP2_CAN_K_COMMAND = 3, HOAP2_CAN_K_CELLS = 4, HOAP2_CAN_K_IMU = 5, HOAP2_CAN_K_STATUS = 6, HOAP2_CAN_K_ANSWER = 7, HOAP2_CAN_K_BOARD_BEAT = 8, HOAP2_CAN_K_TIME_SYNC = 9, HOAP2_CAN_K_REQUEST = 10, HOAP2_CAN_K_REPLY = 11 };
enum { HOAP2_CAN_BOARD_MODE_BOOT = 0, HOAP2_CAN_BOARD_MODE_FOLLOW = 1, HOAP2_CAN_BOARD_MODE_HOLD = 2, HOAP2_CAN_BOARD_MODE_STOPPED = 3 };
enum { HOAP2_CAN_CONTROLLER_STATE_BOOT = 0, HOAP2_CAN_CONTROLLER_STATE_RUN = 1, HOAP2_CAN_CONTROLLER_STATE_STOPPED = 2, HOAP2_CAN_CONTROLLER_STATE_DOUBLED = 3 };
enum { HOAP2_CAN_STOP_REASON_OPERATOR = 0, HOAP2_CAN_STOP_REASON_BOARD = 1, HOAP2_CAN_STOP_REASON_CONTROLLER = 2, HOAP2_CAN_STOP_REASON_RELAYED = 3 };
enum { HOAP2_CAN_OPERATION_READ = 0, HOAP2_CAN_OPERATION_WRITE = 1 };
enum { HOAP2_CAN_RESULT_OK = 0, HOAP2_CAN_RESULT_UNKNOWN_PARAMETER = 1, HOAP2_CAN_RESULT_READ_ONLY = 2, HOAP2_CAN_RESULT_OUT_OF_RANGE = 3, HOAP2_CAN_RESULT_UNKNOWN_JOINT = 4 };
enum { HOAP2_CAN_P_ALIVE_LIMIT_TICKS = 0, HOAP2_CAN_P_VELOCITY_LIMIT_RAD_S = 1, HOAP2_CAN_P_REFUSED = 2, HOAP2_CAN_P_HOLDS = 3, HOAP2_CAN_P_CLOCK_OFFSET_TICKS = 4 };
/* why a frame is refused */
enum { HOAP2_CAN_REFUSED_NONE = 0, HOAP2_CAN_REFUSED_UNKNOWN = 1, HOAP2_CAN_REFUSED_NODE = 2, HOAP2_CAN_REFUSED_LENGTH = 3, HOAP2_CAN_REFUSED_CRC = 4, HOAP2_CAN_REFUSED_VALUE = 5, HOAP2_CAN_REFUSED_COUNTER = 6, HOAP2_CAN_REFUSED_VERSION = 7, HOAP2_CAN_REFUSED_LIMIT = 8 };
enum { HOAP2_CAN_REFUSALS = 9 };
/* places of a message's fields among its raw values; J: within the stride of a joint */
enum { HOAP2_CAN_STOP_REASON = 0 };
enum { HOAP2_CAN_BEAT_TICK = 0, HOAP2_CAN_BEAT_STATE = 1, HOAP2_CAN_BEAT_PROTOCOL = 2 };
enum { HOAP2_CAN_SETTINGS_FIXED = 0, HOAP2_CAN_SETTINGS_STRIDE = 4, HOAP2_CAN_SETTINGS_J_MODE = 0, HOAP2_CAN_SETTINGS_J_QD_SCALE = 1, HOAP2_CAN_SETTINGS_J_KP = 2, HOAP2_CAN_SETTINGS_J_KD = 3 };
enum { HOAP2_CAN_COMMAND_FIXED = 0, HOAP2_CAN_COMMAND_STRIDE = 2, HOAP2_CAN_COMMAND_J_Q_REF = 0, HOAP2_CAN_COMMAND_J_TAU_FF = 1 };
enum { HOAP2_CAN_CELLS_FORCE = 0 };
enum { HOAP2_CAN_IMU_GYRO = 0, HOAP2_CAN_IMU_ACCEL = 3 };
enum { HOAP2_CAN_STATUS_FIXED = 0, HOAP2_CAN_STATUS_STRIDE = 4, HOAP2_CAN_STATUS_J_Q_ENC = 0, HOAP2_CAN_STATUS_J_CURRENT = 1, HOAP2_CAN_STATUS_J_MODE = 2, HOAP2_CAN_STATUS_J_FAULT = 3 };
enum { HOAP2_CAN_ANSWER_SETTINGS_COUNTER = 0 };
enum { HOAP2_CAN_BOARD_BEAT_TICK = 0, HOAP2_CAN_BOARD_BEAT_MODE = 1, HOAP2_CAN_BOARD_BEAT_PROTOCOL = 2 };
enum { HOAP2_CAN_TIME_SYNC_TICK = 0, HOAP2_CAN_TIME_SYNC_OFFSET_US = 1 };
enum { HOAP2_CAN_REQUEST_OPERATION = 0, HOAP2_CAN_REQUEST_JOINT = 1, HOAP2_CAN_REQUEST_PARAMETER = 2, HOAP2_CAN_REQUEST_VALUE = 3 };
enum { HOAP2_CAN_REPLY_RESULT = 0, HOAP2_CAN_REPLY_JOINT = 1, HOAP2_CAN_REPLY_PARAMETER = 2, HOAP2_CAN_REPLY_VALUE = 3 };

/* A field of a frame: value = raw * lsb. */
typedef struct {
  uint16_t first_bit;
  uint8_t bits;
  uint8_t kind; /* HOAP2_CAN_UNSIGNED, _SIGNED, _FLOAT */
  int32_t low;  /* raw */
  int32_t high;
  double lsb;
  double steps; /* 1 / lsb */
} hoap2_can_field_t;

/* A message on a bus. board: of the boards' table, -1 for the controller's frames to all. */
typedef struct {
  uint16_t identifier;
  uint16_t first_field;
  uint16_t used_bits;
  uint8_t length;
  uint8_t fields;
  uint8_t bus;
  uint8_t kind;   /* HOAP2_CAN_K_* */
  uint8_t sender; /* node */
  int8_t board;
  uint16_t period_ticks; /* 0: when needed */
  uint16_t offset_ticks;
} hoap2_can_layout_t;

typedef struct {
  uint8_t node;
  uint8_t bus;
  uint8_t kind; /* HOAP2_CAN_BOARD_* */
  uint8_t foot; /* of a foot board: 0 right, 1 left */
  uint8_t joints;
  uint8_t joint[HOAP2_CAN_BOARD_JOINTS];
} hoap2_can_board_data_t;

/* Gains of a drive that has lost its controller: the maker's servo. */
typedef struct {
  double kp_Nm_rad;
  double kd_Nms_rad;
} hoap2_can_servo_t;

typedef struct {
  float low;
  float high;
  uint8_t writable;
  uint8_t of_joint;
} hoap2_can_parameter_t;

extern const hoap2_can_field_t HOAP2_CAN_FIELD[HOAP2_CAN_FIELDS];
extern const hoap2_can_layout_t HOAP2_CAN_LAYOUT[HOAP2_CAN_FRAMES];
/* index of a layout, -1 for none: [bus][identifier] */
extern const int8_t HOAP2_CAN_LOOKUP[HOAP2_CAN_BUSES][HOAP2_CAN_KINDS << HOAP2_CAN_NODE_BITS];
extern const hoap2_can_board_data_t HOAP2_CAN_BOARD[HOAP2_CAN_BOARDS];
extern const hoap2_can_servo_t HOAP2_CAN_SERVO[25];
extern const hoap2_can_parameter_t HOAP2_CAN_PARAMETER[HOAP2_CAN_PARAMETERS];
extern const uint8_t HOAP2_CAN_CRC8[4][256];

#ifdef __cplusplus
}
#endif
#endif
