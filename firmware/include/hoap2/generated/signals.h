/* Generated from firmware/signals.toml and firmware/hoap2.json by ./hoap2 generate: do not edit. */
#ifndef HOAP2_GENERATED_SIGNALS_H
#define HOAP2_GENERATED_SIGNALS_H
#include <math.h>
#include <stddef.h>
#include <stdint.h>

enum { HOAP2_TICK_US = 1000, HOAP2_SCHEMA = 1 };
enum { HOAP2_SIZE_JOINT = 25 };
enum { HOAP2_SIZE_CELL = 8 };
enum { HOAP2_SIZE_XYZ = 3 };
enum { HOAP2_SIZE_XY = 2 };
enum { HOAP2_SIZE_QUAT = 4 };
enum { HOAP2_SIZE_FOOT = 2 };
enum { HOAP2_SIZE_PUSH = 8 };
enum { HOAP2_SIZE_BLOCK = 16 };
enum { HOAP2_FAULT_BAD_INPUT = 1 };
enum { HOAP2_FAULT_STALE_INPUT = 2 };
enum { HOAP2_FAULT_FOOTPRINT_OUT_OF_REACH = 4 };
enum { HOAP2_FAULT_JOINT_LIMIT = 8 };
enum { HOAP2_FAULT_BAD_PARAMETER = 16 };
enum { HOAP2_FAULT_REACH_LIMIT = 32 };
enum { HOAP2_FAULT_CAPTURE_POINT_LOST = 128 };
enum { HOAP2_FAULT_JOINT_TOO_FAST = 64 };
enum { HOAP2_DRIVE_MODE_OFF = 0, HOAP2_DRIVE_MODE_POSITION = 1, HOAP2_DRIVE_MODE_TORQUE = 2, HOAP2_DRIVE_MODE_DAMPED_TORQUE = 3 };
enum { HOAP2_BEHAVIOUR_STAND = 0, HOAP2_BEHAVIOUR_WALK_CP = 1 };
enum { HOAP2_MODE_START_UP = 0, HOAP2_MODE_CALIBRATE = 1, HOAP2_MODE_STAND = 2, HOAP2_MODE_WALK = 3, HOAP2_MODE_HOLD = 4, HOAP2_MODE_CROUCH = 5, HOAP2_MODE_SAFE = 6 };
enum { HOAP2_PHASE_STAND = 0, HOAP2_PHASE_DOUBLE_SUPPORT = 1, HOAP2_PHASE_SINGLE_SUPPORT = 2 };
enum { HOAP2_CP_CONTROLLER_PLAN = 0, HOAP2_CP_CONTROLLER_CPS = 1, HOAP2_CP_CONTROLLER_CPT = 2 };
enum { HOAP2_COP_PROFILE_CONSTANT = 0, HOAP2_COP_PROFILE_RAMP = 1 };
enum { HOAP2_SENSOR_PRESET_IDEAL = 0, HOAP2_SENSOR_PRESET_HOAP2 = 1 };
enum { HOAP2_WALK_REQUEST_AS_PLANNED = 0, HOAP2_WALK_REQUEST_STOP = 1, HOAP2_WALK_REQUEST_WALK = 2 };
enum { HOAP2_REQUEST_STATE_NONE = 0, HOAP2_REQUEST_STATE_WAITING = 1, HOAP2_REQUEST_STATE_TAKEN = 2, HOAP2_REQUEST_STATE_LIMITED = 3, HOAP2_REQUEST_STATE_REFUSED = 4 };
enum { HOAP2_SWITCH_OFF = 0, HOAP2_SWITCH_ON = 1 };

typedef struct {
  double q_enc_rad[25]; /* joint angles as the encoders count them [rad] */
  double gyro_S_rad_s[3]; /* angular velocity of the chest [rad/s] */
  double accel_S_m_s2[3]; /* specific force at the sensor (at rest: +g upward) [m/s2] */
  double cell_force_N[8]; /* foot force cells [N] */
  double step_length_request_m; /* walk_request walk: advance a step; beyond its range it is limited [m] */
  double step_sideways_request_m; /* walk_request walk: sideways advance a step (left positive); beyond its range it is limited [m] */
  double step_turn_request_rad; /* walk_request walk: turn a step (left positive); beyond its range it is limited [rad] */
  int32_t sensor_tick; /* counter of sensor frames; a value that does not change is a stale input */
  int32_t walk_request; /* as_planned: the walk of the parameters; stop: the next step brings the feet side by side and ends the walk; walk: from standing or in mid-walk, requested steps until stop */
} hoap2_inputs_t;
/* bytes of its members, without the padding behind the last one */
#define HOAP2_INPUTS_BYTES (offsetof(hoap2_inputs_t, walk_request) + sizeof(((const hoap2_inputs_t *)0)->walk_request))

typedef struct {
  double q_ref_rad[25]; /* joint angle reference [rad] */
  double qd_ref_rad_s[25]; /* joint rate reference (0 in position mode: the maker's servo has no feed-forward) [rad/s] */
  double tau_ff_Nm[25]; /* joint torque feed-forward [N.m] */
  double kp_Nm_rad[25]; /* drive stiffness [N.m/rad] */
  double kd_Nms_rad[25]; /* drive damping [N.m.s/rad] */
  double roll_est_rad; /* roll of the chest as estimated [rad] */
  double pitch_est_rad; /* pitch of the chest as estimated [rad] */
  double base_pos_W_m[3]; /* pelvis position as estimated from the stance leg and the attitude [m] */
  double base_quat_W[4]; /* pelvis orientation as estimated [1] */
  double com_ref_W_m[3]; /* CoM reference handed to the inverse kinematics (plan + TPCC) [m] */
  double com_plan_W_m[2]; /* CoM of the plan, (7.13) [m] */
  double com_est_W_m[3]; /* CoM as the robot senses it [m] */
  double com_rate_est_W_m_s[3]; /* CoM rate as the robot senses it [m/s] */
  double cop_ref_W_m[2]; /* desired CoP inside the support polygon [m] */
  double cop_est_W_m[2]; /* CoP from the force cells, (7.65) [m] */
  double cp_ref_W_m[2]; /* desired capture point, (7.10) [m] */
  double cp_est_W_m[2]; /* capture point as the robot senses it, (7.1) [m] */
  double cp_eos_W_m[2]; /* desired capture point at the end of the step [m] */
  double tpcc_shift_W_m[2]; /* shift of the CoM reference by the torso position compliance control [m] */
  double com_deviation_W_m[2]; /* CoM as the robot senses it minus its reference, along the ground [m] */
  double landing_shift_W_m[2]; /* shift of the landing position of the present step, (7.14) [m] */
  double foot_ref_W_m[2][3]; /* reference of the sole point under each ankle [m] */
  double foot_ref_yaw_W_rad[2]; /* reference yaw of each foot [rad] */
  double footprint_W_m_rad[3]; /* landing target of the present step: x (m), y (m), yaw (rad) [1] */
  double step_advance_m_rad[3]; /* advance of the present step as planned or as requested, after limits: length (m), sideways (m), turn (rad) [1] */
  double foot_force_est_N[2]; /* sum of the cells of each foot [N] */
  int32_t drive_mode[25]; /* what the drive does with the five values below */
  int32_t tick; /* ticks done since reset */
  int32_t mode; /* mode manager */
  int32_t fault; /* fault word, bits as in [fault] */
  int32_t phase; /* gait phase */
  int32_t step_index; /* 0 before the first step, then 1-based number of the step under way or last done */
  int32_t steps_done; /* completed steps */
  int32_t stance_foot; /* 0 right, 1 left, 2 both */
  int32_t walk_done; /* 1 when the planned walk is finished and the robot stands */
  int32_t request_state; /* what became of the walk request: waiting until a step can follow it, taken, limited (beyond its range, or drawn in to what the legs can do), or refused (not finite, unknown, or no walk is possible) */
} hoap2_outputs_t;
/* bytes of its members, without the padding behind the last one */
#define HOAP2_OUTPUTS_BYTES (offsetof(hoap2_outputs_t, request_state) + sizeof(((const hoap2_outputs_t *)0)->request_state))

typedef struct {
  double start_pos_W_m[2]; /* where the robot starts: the point midway between the soles [m] */
  double start_yaw_W_rad; /* heading at the start [rad] */
  double calibrate_s; /* standing still while the gyro bias and the attitude are found [s] */
  double start_up_s; /* from the start posture to the walking stance, before the calibration [s] */
  double hip_height_m; /* pelvis origin above the soles in walking and standing [m] */
  double posture_rad[25]; /* start posture; arms, waist and head keep it, the legs go to the walking stance [rad] */
  double step_length_m; /* L_x, advance a step [m] */
  double step_width_m; /* L_y, ankle to ankle [m] */
  double step_sideways_m; /* sideways advance a step (left positive), taken by the leading foot [m] */
  double step_turn_rad; /* L_theta, turn a step (left positive), taken by the outer foot's step [rad] */
  double step_time_s; /* T_step [s] */
  double ds_fraction; /* part of the step in double support, at each end [1] */
  double lift_m; /* apex of the swing foot [m] */
  double start_shift_s; /* double support before the first lift: the capture point travels to the first stance foot [s] */
  double cp_offset_x_m; /* capture point at the end of a step ahead of the ankle [m] */
  double cp_offset_inward_m; /* capture point at the end of a step, inward of the ankle [m] */
  double cop_margin_m; /* the sole is shrunk by this for the clamping of the CoP [m] */
  double cps_min_dt_s; /* floor of the shrinking horizon of (7.11), which is singular at the end of the step [s] */
  double cpt_dt_s; /* control period of (7.12) [s] */
  double cp_filter_s; /* CPS and CPT: low-pass of the deviation of the sensed capture point from the reference's [s] */
  double cp_deviation_limit_m; /* CPS and CPT: that deviation is clipped here [m] */
  double cop_ramp_s; /* length of the CoP ramp; in a step it ends with the double support the step begins with [s] */
  double tpcc_kp_1_s2; /* torso position compliance: gain of the CoP error [1/s2] */
  double tpcc_kv_1_s; /* torso position compliance: damping [1/s] */
  double tpcc_kx_1_s2; /* torso position compliance: spring back [1/s2] */
  double tpcc_error_limit_m; /* the CoP error is clipped here [m] */
  double tpcc_shift_limit_m; /* the shift is clipped here [m] */
  double tpcc_filter_s; /* low-pass of the CoP error [s] */
  double lpc_threshold_m[2]; /* deviations of the CoM below this, along and across the walk, do not shift the landing [m] */
  double lpc_gain[2]; /* K_L of (7.14), along and across the walk [1] */
  double lpc_forget[2]; /* forgetting factor lambda of (7.14), along and across the walk [1] */
  double lpc_limit_m; /* the landing shift is clipped here [m] */
  double lpc_min_spacing_m; /* least distance of the ankles across the walk that a landing shift may leave [m] */
  double attitude_tau_s; /* time constant of the attitude fusion of gyro and accelerometer [s] */
  double com_rate_filter_s; /* low-pass of the sensed CoM rate [s] */
  double contact_on_N; /* a foot is in contact above this force [N] */
  double contact_off_N; /* and out of contact below this one [N] */
  double hold_s; /* rest between the end of the step under way at a fault and the crouch [s] */
  double crouch_s; /* duration of the crouch to the safe posture [s] */
  double crouch_posture_rad[25]; /* safe posture after a fault [rad] */
  double servo_kp_Nm_rad[25]; /* drive stiffness in position mode (armature x velocity loop x position loop) [N.m/rad] */
  double servo_kd_Nms_rad[25]; /* drive damping in position mode (armature x velocity loop) [N.m.s/rad] */
  int32_t behaviour; /* what the robot does after calibration */
  int32_t steps_forward; /* steps that advance */
  int32_t steps_in_place; /* steps in place after them; at least one brings the feet side by side */
  int32_t first_swing_foot; /* foot of the first step: 0 right, 1 left */
  int32_t cp_controller; /* plan (7.9), CPS (7.11) or CPT (7.12) */
  int32_t cop_profile; /* CoP within a step: constant, or a ramp over the first part */
  int32_t landing_control; /* landing position control (7.14) */
  int32_t lpc_moves_cp; /* the capture point at the end of the step moves with the shifted landing */
  int32_t stale_limit_ticks; /* watchdog: bad or stale sensor frames that are bridged by holding */
} hoap2_params_t;
/* bytes of its members, without the padding behind the last one */
#define HOAP2_PARAMS_BYTES (offsetof(hoap2_params_t, stale_limit_ticks) + sizeof(((const hoap2_params_t *)0)->stale_limit_ticks))

static inline void hoap2_inputs_defaults(hoap2_inputs_t *p) {
  { static const double v_[25] = {0.0, 0.0, -0.29717399332586975, 0.6951889664830044, -0.3980149731571346, 0.0, 1.5707963267948966, -0.17453292519943295, 0.17453292519943295, -0.4363323129985824, 0.0, 0.0, -0.29717399332586975, 0.6951889664830044, -0.3980149731571346, 0.0, 1.5707963267948966, 0.17453292519943295, -0.17453292519943295, -0.4363323129985824, 0.0, 0.0, 0.0, 0.0, 0.0};
    for (int i_ = 0; i_ < 25; ++i_) ((double *)(void *)&(p)->q_enc_rad)[i_] = v_[i_]; }
  for (int i_ = 0; i_ < 3; ++i_) ((double *)(void *)&(p)->gyro_S_rad_s)[i_] = 0.0;
  { static const double v_[3] = {0.0, 0.0, 9.81};
    for (int i_ = 0; i_ < 3; ++i_) ((double *)(void *)&(p)->accel_S_m_s2)[i_] = v_[i_]; }
  for (int i_ = 0; i_ < 8; ++i_) ((double *)(void *)&(p)->cell_force_N)[i_] = 0.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->step_length_request_m)[i_] = 0.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->step_sideways_request_m)[i_] = 0.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->step_turn_request_rad)[i_] = 0.0;
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->sensor_tick)[i_] = 0;
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->walk_request)[i_] = 0;
}

static inline void hoap2_params_defaults(hoap2_params_t *p) {
  for (int i_ = 0; i_ < 2; ++i_) ((double *)(void *)&(p)->start_pos_W_m)[i_] = 0.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->start_yaw_W_rad)[i_] = 0.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->calibrate_s)[i_] = 1.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->start_up_s)[i_] = 0.5;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->hip_height_m)[i_] = 0.2248;
  { static const double v_[25] = {0.0, 0.0, -0.29717399332586975, 0.6951889664830044, -0.3980149731571346, 0.0, 1.5707963267948966, -0.17453292519943295, 0.17453292519943295, -0.4363323129985824, 0.0, 0.0, -0.29717399332586975, 0.6951889664830044, -0.3980149731571346, 0.0, 1.5707963267948966, 0.17453292519943295, -0.17453292519943295, -0.4363323129985824, 0.0, 0.0, 0.0, 0.0, 0.0};
    for (int i_ = 0; i_ < 25; ++i_) ((double *)(void *)&(p)->posture_rad)[i_] = v_[i_]; }
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->step_length_m)[i_] = 0.015;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->step_width_m)[i_] = 0.078;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->step_sideways_m)[i_] = 0.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->step_turn_rad)[i_] = 0.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->step_time_s)[i_] = 0.4;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->ds_fraction)[i_] = 0.1;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->lift_m)[i_] = 0.018;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->start_shift_s)[i_] = 0.4;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->cp_offset_x_m)[i_] = 0.0093;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->cp_offset_inward_m)[i_] = 0.012;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->cop_margin_m)[i_] = 0.004;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->cps_min_dt_s)[i_] = 0.05;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->cpt_dt_s)[i_] = 0.2;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->cp_filter_s)[i_] = 0.1;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->cp_deviation_limit_m)[i_] = 0.003;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->cop_ramp_s)[i_] = 0.08;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->tpcc_kp_1_s2)[i_] = 16.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->tpcc_kv_1_s)[i_] = 20.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->tpcc_kx_1_s2)[i_] = 100.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->tpcc_error_limit_m)[i_] = 0.03;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->tpcc_shift_limit_m)[i_] = 0.03;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->tpcc_filter_s)[i_] = 0.05;
  { static const double v_[2] = {0.002, 0.006};
    for (int i_ = 0; i_ < 2; ++i_) ((double *)(void *)&(p)->lpc_threshold_m)[i_] = v_[i_]; }
  for (int i_ = 0; i_ < 2; ++i_) ((double *)(void *)&(p)->lpc_gain)[i_] = 0.2;
  for (int i_ = 0; i_ < 2; ++i_) ((double *)(void *)&(p)->lpc_forget)[i_] = 0.7;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->lpc_limit_m)[i_] = 0.04;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->lpc_min_spacing_m)[i_] = 0.068;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->attitude_tau_s)[i_] = 3.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->com_rate_filter_s)[i_] = 0.02;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->contact_on_N)[i_] = 5.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->contact_off_N)[i_] = 2.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->hold_s)[i_] = 0.05;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->crouch_s)[i_] = 1.5;
  { static const double v_[25] = {0.0, 0.0, -0.5235987755982988, 1.0471975511965976, -0.5235987755982988, 0.0, 1.7453292519943295, 0.0, 0.0, -0.5235987755982988, 0.0, 0.0, -0.5235987755982988, 1.0471975511965976, -0.5235987755982988, 0.0, 1.7453292519943295, 0.0, 0.0, -0.5235987755982988, 0.0, 0.0, 0.0, 0.0, 0.0};
    for (int i_ = 0; i_ < 25; ++i_) ((double *)(void *)&(p)->crouch_posture_rad)[i_] = v_[i_]; }
  { static const double v_[25] = {1753.1250000000002, 2250.0, 1753.1250000000002, 2250.0, 1753.1250000000002, 1753.1250000000002, 1753.1250000000002, 1753.1250000000002, 1753.1250000000002, 1753.1250000000002, 1753.1250000000002, 2250.0, 1753.1250000000002, 2250.0, 1753.1250000000002, 1753.1250000000002, 1753.1250000000002, 1753.1250000000002, 1753.1250000000002, 1753.1250000000002, 2250.0, 187.5, 187.5, 46.875, 46.875};
    for (int i_ = 0; i_ < 25; ++i_) ((double *)(void *)&(p)->servo_kp_Nm_rad)[i_] = v_[i_]; }
  { static const double v_[25] = {9.350000000000001, 12.0, 9.350000000000001, 12.0, 9.350000000000001, 9.350000000000001, 9.350000000000001, 9.350000000000001, 9.350000000000001, 9.350000000000001, 9.350000000000001, 12.0, 9.350000000000001, 12.0, 9.350000000000001, 9.350000000000001, 9.350000000000001, 9.350000000000001, 9.350000000000001, 9.350000000000001, 12.0, 1.0, 1.0, 0.25, 0.25};
    for (int i_ = 0; i_ < 25; ++i_) ((double *)(void *)&(p)->servo_kd_Nms_rad)[i_] = v_[i_]; }
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->behaviour)[i_] = 1;
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->steps_forward)[i_] = 28;
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->steps_in_place)[i_] = 8;
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->first_swing_foot)[i_] = 0;
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->cp_controller)[i_] = 0;
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->cop_profile)[i_] = 0;
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->landing_control)[i_] = 0;
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->lpc_moves_cp)[i_] = 0;
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->stale_limit_ticks)[i_] = 5;
}

#define HOAP2_STEP_LENGTH_REQUEST_M_LOW -0.08
#define HOAP2_STEP_LENGTH_REQUEST_M_HIGH 0.08
#define HOAP2_STEP_SIDEWAYS_REQUEST_M_LOW -0.03
#define HOAP2_STEP_SIDEWAYS_REQUEST_M_HIGH 0.03
#define HOAP2_STEP_TURN_REQUEST_RAD_LOW -0.25
#define HOAP2_STEP_TURN_REQUEST_RAD_HIGH 0.25
#define HOAP2_WALK_REQUEST_LOW 0
#define HOAP2_WALK_REQUEST_HIGH 2

static inline int hoap2_params_out_of_range(const hoap2_params_t *p) {
  int bad_ = 0;
  for (int i_ = 0; i_ < 2; ++i_) { const double v_ = ((const double *)(const void *)&p->start_pos_W_m)[i_]; if (!(v_ >= -1000000.0 && v_ <= 1000000.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->start_yaw_W_rad)[i_]; if (!(v_ >= -7.0 && v_ <= 7.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->calibrate_s)[i_]; if (!(v_ >= 0.1 && v_ <= 10.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->start_up_s)[i_]; if (!(v_ >= 0.1 && v_ <= 10.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->hip_height_m)[i_]; if (!(v_ >= 0.15 && v_ <= 0.2365)) ++bad_; }
  for (int i_ = 0; i_ < 25; ++i_) { const double v_ = ((const double *)(const void *)&p->posture_rad)[i_]; if (!(v_ >= -3.2 && v_ <= 3.2)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->step_length_m)[i_]; if (!(v_ >= -0.08 && v_ <= 0.08)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->step_width_m)[i_]; if (!(v_ >= 0.068 && v_ <= 0.13)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->step_sideways_m)[i_]; if (!(v_ >= -0.03 && v_ <= 0.03)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->step_turn_rad)[i_]; if (!(v_ >= -0.25 && v_ <= 0.25)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->step_time_s)[i_]; if (!(v_ >= 0.25 && v_ <= 2.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->ds_fraction)[i_]; if (!(v_ >= 0.02 && v_ <= 0.4)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->lift_m)[i_]; if (!(v_ >= 0.005 && v_ <= 0.04)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->start_shift_s)[i_]; if (!(v_ >= 0.2 && v_ <= 2.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->cp_offset_x_m)[i_]; if (!(v_ >= -0.03 && v_ <= 0.05)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->cp_offset_inward_m)[i_]; if (!(v_ >= -0.02 && v_ <= 0.03)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->cop_margin_m)[i_]; if (!(v_ >= 0.0 && v_ <= 0.02)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->cps_min_dt_s)[i_]; if (!(v_ >= 0.01 && v_ <= 0.4)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->cpt_dt_s)[i_]; if (!(v_ >= 0.01 && v_ <= 0.4)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->cp_filter_s)[i_]; if (!(v_ >= 0.0 && v_ <= 1.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->cp_deviation_limit_m)[i_]; if (!(v_ >= 0.0 && v_ <= 0.1)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->cop_ramp_s)[i_]; if (!(v_ >= 0.01 && v_ <= 0.2)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->tpcc_kp_1_s2)[i_]; if (!(v_ >= 0.0 && v_ <= 100.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->tpcc_kv_1_s)[i_]; if (!(v_ >= 0.0 && v_ <= 200.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->tpcc_kx_1_s2)[i_]; if (!(v_ >= 0.0 && v_ <= 1000.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->tpcc_error_limit_m)[i_]; if (!(v_ >= 0.0 && v_ <= 0.1)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->tpcc_shift_limit_m)[i_]; if (!(v_ >= 0.0 && v_ <= 0.1)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->tpcc_filter_s)[i_]; if (!(v_ >= 0.0 && v_ <= 0.2)) ++bad_; }
  for (int i_ = 0; i_ < 2; ++i_) { const double v_ = ((const double *)(const void *)&p->lpc_threshold_m)[i_]; if (!(v_ >= 0.0 && v_ <= 0.1)) ++bad_; }
  for (int i_ = 0; i_ < 2; ++i_) { const double v_ = ((const double *)(const void *)&p->lpc_gain)[i_]; if (!(v_ >= 0.0 && v_ <= 2.0)) ++bad_; }
  for (int i_ = 0; i_ < 2; ++i_) { const double v_ = ((const double *)(const void *)&p->lpc_forget)[i_]; if (!(v_ >= 0.0 && v_ <= 0.99)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->lpc_limit_m)[i_]; if (!(v_ >= 0.0 && v_ <= 0.1)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->lpc_min_spacing_m)[i_]; if (!(v_ >= 0.066 && v_ <= 0.2)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->attitude_tau_s)[i_]; if (!(v_ >= 0.2 && v_ <= 60.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->com_rate_filter_s)[i_]; if (!(v_ >= 0.001 && v_ <= 0.2)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->contact_on_N)[i_]; if (!(v_ >= 0.5 && v_ <= 50.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->contact_off_N)[i_]; if (!(v_ >= 0.1 && v_ <= 50.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->hold_s)[i_]; if (!(v_ >= 0.0 && v_ <= 1.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->crouch_s)[i_]; if (!(v_ >= 0.3 && v_ <= 10.0)) ++bad_; }
  for (int i_ = 0; i_ < 25; ++i_) { const double v_ = ((const double *)(const void *)&p->crouch_posture_rad)[i_]; if (!(v_ >= -3.2 && v_ <= 3.2)) ++bad_; }
  for (int i_ = 0; i_ < 25; ++i_) { const double v_ = ((const double *)(const void *)&p->servo_kp_Nm_rad)[i_]; if (!(v_ >= 0.0 && v_ <= 100000.0)) ++bad_; }
  for (int i_ = 0; i_ < 25; ++i_) { const double v_ = ((const double *)(const void *)&p->servo_kd_Nms_rad)[i_]; if (!(v_ >= 0.0 && v_ <= 1000.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const int32_t v_ = ((const int32_t *)(const void *)&p->behaviour)[i_]; if (!(v_ >= 0 && v_ <= 1)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const int32_t v_ = ((const int32_t *)(const void *)&p->steps_forward)[i_]; if (!(v_ >= 0 && v_ <= 1000)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const int32_t v_ = ((const int32_t *)(const void *)&p->steps_in_place)[i_]; if (!(v_ >= 0 && v_ <= 1000)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const int32_t v_ = ((const int32_t *)(const void *)&p->first_swing_foot)[i_]; if (!(v_ >= 0 && v_ <= 1)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const int32_t v_ = ((const int32_t *)(const void *)&p->cp_controller)[i_]; if (!(v_ >= 0 && v_ <= 2)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const int32_t v_ = ((const int32_t *)(const void *)&p->cop_profile)[i_]; if (!(v_ >= 0 && v_ <= 1)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const int32_t v_ = ((const int32_t *)(const void *)&p->landing_control)[i_]; if (!(v_ >= 0 && v_ <= 1)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const int32_t v_ = ((const int32_t *)(const void *)&p->lpc_moves_cp)[i_]; if (!(v_ >= 0 && v_ <= 1)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const int32_t v_ = ((const int32_t *)(const void *)&p->stale_limit_ticks)[i_]; if (!(v_ >= 1 && v_ <= 100)) ++bad_; }
  return bad_;
}
static inline void hoap2_params_tune(hoap2_params_t *to, const hoap2_params_t *from) {
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&to->cp_offset_x_m)[i_] = ((const double *)(const void *)&from->cp_offset_x_m)[i_];
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&to->cp_offset_inward_m)[i_] = ((const double *)(const void *)&from->cp_offset_inward_m)[i_];
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&to->cps_min_dt_s)[i_] = ((const double *)(const void *)&from->cps_min_dt_s)[i_];
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&to->cpt_dt_s)[i_] = ((const double *)(const void *)&from->cpt_dt_s)[i_];
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&to->cp_filter_s)[i_] = ((const double *)(const void *)&from->cp_filter_s)[i_];
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&to->cp_deviation_limit_m)[i_] = ((const double *)(const void *)&from->cp_deviation_limit_m)[i_];
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&to->tpcc_kp_1_s2)[i_] = ((const double *)(const void *)&from->tpcc_kp_1_s2)[i_];
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&to->tpcc_kv_1_s)[i_] = ((const double *)(const void *)&from->tpcc_kv_1_s)[i_];
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&to->tpcc_kx_1_s2)[i_] = ((const double *)(const void *)&from->tpcc_kx_1_s2)[i_];
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&to->tpcc_error_limit_m)[i_] = ((const double *)(const void *)&from->tpcc_error_limit_m)[i_];
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&to->tpcc_filter_s)[i_] = ((const double *)(const void *)&from->tpcc_filter_s)[i_];
  for (int i_ = 0; i_ < 2; ++i_) ((double *)(void *)&to->lpc_threshold_m)[i_] = ((const double *)(const void *)&from->lpc_threshold_m)[i_];
  for (int i_ = 0; i_ < 2; ++i_) ((double *)(void *)&to->lpc_gain)[i_] = ((const double *)(const void *)&from->lpc_gain)[i_];
  for (int i_ = 0; i_ < 2; ++i_) ((double *)(void *)&to->lpc_forget)[i_] = ((const double *)(const void *)&from->lpc_forget)[i_];
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&to->lpc_limit_m)[i_] = ((const double *)(const void *)&from->lpc_limit_m)[i_];
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&to->attitude_tau_s)[i_] = ((const double *)(const void *)&from->attitude_tau_s)[i_];
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&to->com_rate_filter_s)[i_] = ((const double *)(const void *)&from->com_rate_filter_s)[i_];
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&to->contact_on_N)[i_] = ((const double *)(const void *)&from->contact_on_N)[i_];
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&to->contact_off_N)[i_] = ((const double *)(const void *)&from->contact_off_N)[i_];
}

#endif
