/* Generated from firmware/can.toml and firmware/hoap2.json by ./hoap2 generate: do not edit. */
#include "can/generated/can_table.h"

const hoap2_can_field_t HOAP2_CAN_FIELD[HOAP2_CAN_FIELDS] = {
  /* right: stop_controller */
  {16, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* reason */
  /* right: stop_r_leg */
  {16, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* reason */
  /* right: stop_r_arm */
  {16, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* reason */
  /* right: stop_r_foot */
  {16, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* reason */
  /* right: stop_posture */
  {16, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* reason */
  /* right: stop_head_hands */
  {16, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* reason */
  /* right: beat */
  {16, 24, HOAP2_CAN_UNSIGNED, 0, 16777215, 1.0, 1.0}, /* tick */
  {40, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* state */
  {48, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 1.0, 1.0}, /* protocol */
  /* right: settings_r_leg */
  {16, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_hip_yaw_mode */
  {18, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* r_hip_yaw_qd_scale */
  {24, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* r_hip_yaw_kp */
  {40, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* r_hip_yaw_kd */
  {56, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_hip_roll_mode */
  {58, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* r_hip_roll_qd_scale */
  {64, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* r_hip_roll_kp */
  {80, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* r_hip_roll_kd */
  {96, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_hip_pitch_mode */
  {98, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* r_hip_pitch_qd_scale */
  {104, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* r_hip_pitch_kp */
  {120, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* r_hip_pitch_kd */
  {136, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_knee_mode */
  {138, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* r_knee_qd_scale */
  {144, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* r_knee_kp */
  {160, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* r_knee_kd */
  {176, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_ankle_pitch_mode */
  {178, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* r_ankle_pitch_qd_scale */
  {184, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* r_ankle_pitch_kp */
  {200, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* r_ankle_pitch_kd */
  {216, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_ankle_roll_mode */
  {218, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* r_ankle_roll_qd_scale */
  {224, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* r_ankle_roll_kp */
  {240, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* r_ankle_roll_kd */
  /* right: settings_r_arm */
  {16, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_shoulder_pitch_mode */
  {18, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* r_shoulder_pitch_qd_scale */
  {24, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* r_shoulder_pitch_kp */
  {40, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* r_shoulder_pitch_kd */
  {56, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_shoulder_roll_mode */
  {58, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* r_shoulder_roll_qd_scale */
  {64, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* r_shoulder_roll_kp */
  {80, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* r_shoulder_roll_kd */
  {96, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_shoulder_yaw_mode */
  {98, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* r_shoulder_yaw_qd_scale */
  {104, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* r_shoulder_yaw_kp */
  {120, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* r_shoulder_yaw_kd */
  {136, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_elbow_mode */
  {138, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* r_elbow_qd_scale */
  {144, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* r_elbow_kp */
  {160, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* r_elbow_kd */
  /* right: settings_head_hands */
  {16, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* head_pan_mode */
  {18, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* head_pan_qd_scale */
  {24, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* head_pan_kp */
  {40, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* head_pan_kd */
  {56, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* head_tilt_mode */
  {58, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* head_tilt_qd_scale */
  {64, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* head_tilt_kp */
  {80, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* head_tilt_kd */
  {96, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_hand_mode */
  {98, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* r_hand_qd_scale */
  {104, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* r_hand_kp */
  {120, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* r_hand_kd */
  {136, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_hand_mode */
  {138, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* l_hand_qd_scale */
  {144, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* l_hand_kp */
  {160, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* l_hand_kd */
  /* right: command_r_leg */
  {16, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_hip_yaw_q_ref */
  {40, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* r_hip_yaw_tau_ff */
  {56, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_hip_roll_q_ref */
  {80, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* r_hip_roll_tau_ff */
  {96, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_hip_pitch_q_ref */
  {120, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* r_hip_pitch_tau_ff */
  {136, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_knee_q_ref */
  {160, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* r_knee_tau_ff */
  {176, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_ankle_pitch_q_ref */
  {200, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* r_ankle_pitch_tau_ff */
  {216, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_ankle_roll_q_ref */
  {240, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* r_ankle_roll_tau_ff */
  /* right: command_r_arm */
  {16, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_shoulder_pitch_q_ref */
  {40, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* r_shoulder_pitch_tau_ff */
  {56, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_shoulder_roll_q_ref */
  {80, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* r_shoulder_roll_tau_ff */
  {96, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_shoulder_yaw_q_ref */
  {120, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* r_shoulder_yaw_tau_ff */
  {136, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_elbow_q_ref */
  {160, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* r_elbow_tau_ff */
  /* right: command_head_hands */
  {16, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* head_pan_q_ref */
  {40, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* head_pan_tau_ff */
  {56, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* head_tilt_q_ref */
  {80, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* head_tilt_tau_ff */
  {96, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_hand_q_ref */
  {120, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* r_hand_tau_ff */
  {136, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_hand_q_ref */
  {160, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* l_hand_tau_ff */
  /* right: cells_r_foot */
  {16, 20, HOAP2_CAN_UNSIGNED, 0, 1000000, 0.001, 1000.0}, /* force_0 */
  {36, 20, HOAP2_CAN_UNSIGNED, 0, 1000000, 0.001, 1000.0}, /* force_1 */
  {56, 20, HOAP2_CAN_UNSIGNED, 0, 1000000, 0.001, 1000.0}, /* force_2 */
  {76, 20, HOAP2_CAN_UNSIGNED, 0, 1000000, 0.001, 1000.0}, /* force_3 */
  /* right: imu_posture */
  {16, 24, HOAP2_CAN_SIGNED, -5926351, 5926351, 3.374757733348411e-06, 296317.56677472877}, /* gyro_0 */
  {40, 24, HOAP2_CAN_SIGNED, -5926351, 5926351, 3.374757733348411e-06, 296317.56677472877}, /* gyro_1 */
  {64, 24, HOAP2_CAN_SIGNED, -5926351, 5926351, 3.374757733348411e-06, 296317.56677472877}, /* gyro_2 */
  {88, 24, HOAP2_CAN_SIGNED, -1638400, 1638400, 0.0001220703125, 8192.0}, /* accel_0 */
  {112, 24, HOAP2_CAN_SIGNED, -1638400, 1638400, 0.0001220703125, 8192.0}, /* accel_1 */
  {136, 24, HOAP2_CAN_SIGNED, -1638400, 1638400, 0.0001220703125, 8192.0}, /* accel_2 */
  /* right: status_r_leg */
  {16, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_hip_yaw_q_enc */
  {40, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* r_hip_yaw_current */
  {52, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_hip_yaw_mode */
  {54, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_hip_yaw_fault */
  {56, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_hip_roll_q_enc */
  {80, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* r_hip_roll_current */
  {92, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_hip_roll_mode */
  {94, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_hip_roll_fault */
  {96, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_hip_pitch_q_enc */
  {120, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* r_hip_pitch_current */
  {132, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_hip_pitch_mode */
  {134, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_hip_pitch_fault */
  {136, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_knee_q_enc */
  {160, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* r_knee_current */
  {172, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_knee_mode */
  {174, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_knee_fault */
  {176, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_ankle_pitch_q_enc */
  {200, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* r_ankle_pitch_current */
  {212, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_ankle_pitch_mode */
  {214, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_ankle_pitch_fault */
  {216, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_ankle_roll_q_enc */
  {240, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* r_ankle_roll_current */
  {252, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_ankle_roll_mode */
  {254, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_ankle_roll_fault */
  /* right: status_r_arm */
  {16, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_shoulder_pitch_q_enc */
  {40, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* r_shoulder_pitch_current */
  {52, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_shoulder_pitch_mode */
  {54, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_shoulder_pitch_fault */
  {56, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_shoulder_roll_q_enc */
  {80, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* r_shoulder_roll_current */
  {92, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_shoulder_roll_mode */
  {94, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_shoulder_roll_fault */
  {96, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_shoulder_yaw_q_enc */
  {120, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* r_shoulder_yaw_current */
  {132, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_shoulder_yaw_mode */
  {134, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_shoulder_yaw_fault */
  {136, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_elbow_q_enc */
  {160, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* r_elbow_current */
  {172, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_elbow_mode */
  {174, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_elbow_fault */
  /* right: status_head_hands */
  {16, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* head_pan_q_enc */
  {40, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* head_pan_current */
  {52, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* head_pan_mode */
  {54, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* head_pan_fault */
  {56, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* head_tilt_q_enc */
  {80, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* head_tilt_current */
  {92, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* head_tilt_mode */
  {94, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* head_tilt_fault */
  {96, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* r_hand_q_enc */
  {120, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* r_hand_current */
  {132, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_hand_mode */
  {134, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* r_hand_fault */
  {136, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_hand_q_enc */
  {160, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* l_hand_current */
  {172, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_hand_mode */
  {174, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_hand_fault */
  /* right: answer_r_leg */
  {16, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* settings_counter */
  /* right: answer_r_arm */
  {16, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* settings_counter */
  /* right: answer_head_hands */
  {16, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* settings_counter */
  /* right: board_beat_r_leg */
  {16, 24, HOAP2_CAN_UNSIGNED, 0, 16777215, 1.0, 1.0}, /* tick */
  {40, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* mode */
  {48, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 1.0, 1.0}, /* protocol */
  /* right: board_beat_r_arm */
  {16, 24, HOAP2_CAN_UNSIGNED, 0, 16777215, 1.0, 1.0}, /* tick */
  {40, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* mode */
  {48, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 1.0, 1.0}, /* protocol */
  /* right: board_beat_r_foot */
  {16, 24, HOAP2_CAN_UNSIGNED, 0, 16777215, 1.0, 1.0}, /* tick */
  {40, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* mode */
  {48, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 1.0, 1.0}, /* protocol */
  /* right: board_beat_posture */
  {16, 24, HOAP2_CAN_UNSIGNED, 0, 16777215, 1.0, 1.0}, /* tick */
  {40, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* mode */
  {48, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 1.0, 1.0}, /* protocol */
  /* right: board_beat_head_hands */
  {16, 24, HOAP2_CAN_UNSIGNED, 0, 16777215, 1.0, 1.0}, /* tick */
  {40, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* mode */
  {48, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 1.0, 1.0}, /* protocol */
  /* right: time_sync */
  {16, 31, HOAP2_CAN_UNSIGNED, 0, 2147483647, 1.0, 1.0}, /* tick */
  {47, 10, HOAP2_CAN_UNSIGNED, 0, 999, 1.0, 1.0}, /* offset_us */
  /* right: request_r_leg */
  {16, 1, HOAP2_CAN_UNSIGNED, 0, 1, 1.0, 1.0}, /* operation */
  {17, 7, HOAP2_CAN_UNSIGNED, 0, 127, 1.0, 1.0}, /* joint */
  {24, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* parameter */
  {32, 32, HOAP2_CAN_FLOAT, INT32_MIN, 2147483647, 1.0, 1.0}, /* value */
  /* right: request_r_arm */
  {16, 1, HOAP2_CAN_UNSIGNED, 0, 1, 1.0, 1.0}, /* operation */
  {17, 7, HOAP2_CAN_UNSIGNED, 0, 127, 1.0, 1.0}, /* joint */
  {24, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* parameter */
  {32, 32, HOAP2_CAN_FLOAT, INT32_MIN, 2147483647, 1.0, 1.0}, /* value */
  /* right: request_r_foot */
  {16, 1, HOAP2_CAN_UNSIGNED, 0, 1, 1.0, 1.0}, /* operation */
  {17, 7, HOAP2_CAN_UNSIGNED, 0, 127, 1.0, 1.0}, /* joint */
  {24, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* parameter */
  {32, 32, HOAP2_CAN_FLOAT, INT32_MIN, 2147483647, 1.0, 1.0}, /* value */
  /* right: request_posture */
  {16, 1, HOAP2_CAN_UNSIGNED, 0, 1, 1.0, 1.0}, /* operation */
  {17, 7, HOAP2_CAN_UNSIGNED, 0, 127, 1.0, 1.0}, /* joint */
  {24, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* parameter */
  {32, 32, HOAP2_CAN_FLOAT, INT32_MIN, 2147483647, 1.0, 1.0}, /* value */
  /* right: request_head_hands */
  {16, 1, HOAP2_CAN_UNSIGNED, 0, 1, 1.0, 1.0}, /* operation */
  {17, 7, HOAP2_CAN_UNSIGNED, 0, 127, 1.0, 1.0}, /* joint */
  {24, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* parameter */
  {32, 32, HOAP2_CAN_FLOAT, INT32_MIN, 2147483647, 1.0, 1.0}, /* value */
  /* right: reply_r_leg */
  {16, 3, HOAP2_CAN_UNSIGNED, 0, 4, 1.0, 1.0}, /* result */
  {19, 5, HOAP2_CAN_UNSIGNED, 0, 31, 1.0, 1.0}, /* joint */
  {24, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* parameter */
  {32, 32, HOAP2_CAN_FLOAT, INT32_MIN, 2147483647, 1.0, 1.0}, /* value */
  /* right: reply_r_arm */
  {16, 3, HOAP2_CAN_UNSIGNED, 0, 4, 1.0, 1.0}, /* result */
  {19, 5, HOAP2_CAN_UNSIGNED, 0, 31, 1.0, 1.0}, /* joint */
  {24, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* parameter */
  {32, 32, HOAP2_CAN_FLOAT, INT32_MIN, 2147483647, 1.0, 1.0}, /* value */
  /* right: reply_r_foot */
  {16, 3, HOAP2_CAN_UNSIGNED, 0, 4, 1.0, 1.0}, /* result */
  {19, 5, HOAP2_CAN_UNSIGNED, 0, 31, 1.0, 1.0}, /* joint */
  {24, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* parameter */
  {32, 32, HOAP2_CAN_FLOAT, INT32_MIN, 2147483647, 1.0, 1.0}, /* value */
  /* right: reply_posture */
  {16, 3, HOAP2_CAN_UNSIGNED, 0, 4, 1.0, 1.0}, /* result */
  {19, 5, HOAP2_CAN_UNSIGNED, 0, 31, 1.0, 1.0}, /* joint */
  {24, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* parameter */
  {32, 32, HOAP2_CAN_FLOAT, INT32_MIN, 2147483647, 1.0, 1.0}, /* value */
  /* right: reply_head_hands */
  {16, 3, HOAP2_CAN_UNSIGNED, 0, 4, 1.0, 1.0}, /* result */
  {19, 5, HOAP2_CAN_UNSIGNED, 0, 31, 1.0, 1.0}, /* joint */
  {24, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* parameter */
  {32, 32, HOAP2_CAN_FLOAT, INT32_MIN, 2147483647, 1.0, 1.0}, /* value */
  /* left: stop_controller */
  {16, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* reason */
  /* left: stop_l_leg */
  {16, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* reason */
  /* left: stop_l_arm */
  {16, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* reason */
  /* left: stop_l_foot */
  {16, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* reason */
  /* left: stop_waist */
  {16, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* reason */
  /* left: beat */
  {16, 24, HOAP2_CAN_UNSIGNED, 0, 16777215, 1.0, 1.0}, /* tick */
  {40, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* state */
  {48, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 1.0, 1.0}, /* protocol */
  /* left: settings_l_leg */
  {16, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_hip_yaw_mode */
  {18, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* l_hip_yaw_qd_scale */
  {24, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* l_hip_yaw_kp */
  {40, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* l_hip_yaw_kd */
  {56, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_hip_roll_mode */
  {58, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* l_hip_roll_qd_scale */
  {64, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* l_hip_roll_kp */
  {80, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* l_hip_roll_kd */
  {96, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_hip_pitch_mode */
  {98, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* l_hip_pitch_qd_scale */
  {104, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* l_hip_pitch_kp */
  {120, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* l_hip_pitch_kd */
  {136, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_knee_mode */
  {138, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* l_knee_qd_scale */
  {144, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* l_knee_kp */
  {160, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* l_knee_kd */
  {176, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_ankle_pitch_mode */
  {178, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* l_ankle_pitch_qd_scale */
  {184, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* l_ankle_pitch_kp */
  {200, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* l_ankle_pitch_kd */
  {216, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_ankle_roll_mode */
  {218, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* l_ankle_roll_qd_scale */
  {224, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* l_ankle_roll_kp */
  {240, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* l_ankle_roll_kd */
  /* left: settings_l_arm */
  {16, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_shoulder_pitch_mode */
  {18, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* l_shoulder_pitch_qd_scale */
  {24, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* l_shoulder_pitch_kp */
  {40, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* l_shoulder_pitch_kd */
  {56, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_shoulder_roll_mode */
  {58, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* l_shoulder_roll_qd_scale */
  {64, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* l_shoulder_roll_kp */
  {80, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* l_shoulder_roll_kd */
  {96, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_shoulder_yaw_mode */
  {98, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* l_shoulder_yaw_qd_scale */
  {104, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* l_shoulder_yaw_kp */
  {120, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* l_shoulder_yaw_kd */
  {136, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_elbow_mode */
  {138, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* l_elbow_qd_scale */
  {144, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* l_elbow_kp */
  {160, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* l_elbow_kd */
  /* left: settings_waist */
  {16, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* waist_pitch_mode */
  {18, 6, HOAP2_CAN_UNSIGNED, 0, 63, 0.03125, 32.0}, /* waist_pitch_qd_scale */
  {24, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.125, 8.0}, /* waist_pitch_kp */
  {40, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 0.001, 1000.0}, /* waist_pitch_kd */
  /* left: command_l_leg */
  {16, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_hip_yaw_q_ref */
  {40, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* l_hip_yaw_tau_ff */
  {56, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_hip_roll_q_ref */
  {80, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* l_hip_roll_tau_ff */
  {96, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_hip_pitch_q_ref */
  {120, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* l_hip_pitch_tau_ff */
  {136, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_knee_q_ref */
  {160, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* l_knee_tau_ff */
  {176, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_ankle_pitch_q_ref */
  {200, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* l_ankle_pitch_tau_ff */
  {216, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_ankle_roll_q_ref */
  {240, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* l_ankle_roll_tau_ff */
  /* left: command_l_arm */
  {16, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_shoulder_pitch_q_ref */
  {40, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* l_shoulder_pitch_tau_ff */
  {56, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_shoulder_roll_q_ref */
  {80, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* l_shoulder_roll_tau_ff */
  {96, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_shoulder_yaw_q_ref */
  {120, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* l_shoulder_yaw_tau_ff */
  {136, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_elbow_q_ref */
  {160, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* l_elbow_tau_ff */
  /* left: command_waist */
  {16, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* waist_pitch_q_ref */
  {40, 16, HOAP2_CAN_SIGNED, -32768, 32767, 0.0002, 5000.0}, /* waist_pitch_tau_ff */
  /* left: cells_l_foot */
  {16, 20, HOAP2_CAN_UNSIGNED, 0, 1000000, 0.001, 1000.0}, /* force_0 */
  {36, 20, HOAP2_CAN_UNSIGNED, 0, 1000000, 0.001, 1000.0}, /* force_1 */
  {56, 20, HOAP2_CAN_UNSIGNED, 0, 1000000, 0.001, 1000.0}, /* force_2 */
  {76, 20, HOAP2_CAN_UNSIGNED, 0, 1000000, 0.001, 1000.0}, /* force_3 */
  /* left: status_l_leg */
  {16, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_hip_yaw_q_enc */
  {40, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* l_hip_yaw_current */
  {52, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_hip_yaw_mode */
  {54, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_hip_yaw_fault */
  {56, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_hip_roll_q_enc */
  {80, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* l_hip_roll_current */
  {92, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_hip_roll_mode */
  {94, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_hip_roll_fault */
  {96, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_hip_pitch_q_enc */
  {120, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* l_hip_pitch_current */
  {132, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_hip_pitch_mode */
  {134, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_hip_pitch_fault */
  {136, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_knee_q_enc */
  {160, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* l_knee_current */
  {172, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_knee_mode */
  {174, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_knee_fault */
  {176, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_ankle_pitch_q_enc */
  {200, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* l_ankle_pitch_current */
  {212, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_ankle_pitch_mode */
  {214, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_ankle_pitch_fault */
  {216, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_ankle_roll_q_enc */
  {240, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* l_ankle_roll_current */
  {252, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_ankle_roll_mode */
  {254, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_ankle_roll_fault */
  /* left: status_l_arm */
  {16, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_shoulder_pitch_q_enc */
  {40, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* l_shoulder_pitch_current */
  {52, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_shoulder_pitch_mode */
  {54, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_shoulder_pitch_fault */
  {56, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_shoulder_roll_q_enc */
  {80, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* l_shoulder_roll_current */
  {92, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_shoulder_roll_mode */
  {94, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_shoulder_roll_fault */
  {96, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_shoulder_yaw_q_enc */
  {120, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* l_shoulder_yaw_current */
  {132, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_shoulder_yaw_mode */
  {134, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_shoulder_yaw_fault */
  {136, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* l_elbow_q_enc */
  {160, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* l_elbow_current */
  {172, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_elbow_mode */
  {174, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* l_elbow_fault */
  /* left: status_waist */
  {16, 24, HOAP2_CAN_SIGNED, -8388608, 8388607, 3.262053775408062e-07, 3065553.3870679564}, /* waist_pitch_q_enc */
  {40, 12, HOAP2_CAN_SIGNED, -2048, 2047, 0.002, 500.0}, /* waist_pitch_current */
  {52, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* waist_pitch_mode */
  {54, 2, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* waist_pitch_fault */
  /* left: answer_l_leg */
  {16, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* settings_counter */
  /* left: answer_l_arm */
  {16, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* settings_counter */
  /* left: answer_waist */
  {16, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* settings_counter */
  /* left: board_beat_l_leg */
  {16, 24, HOAP2_CAN_UNSIGNED, 0, 16777215, 1.0, 1.0}, /* tick */
  {40, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* mode */
  {48, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 1.0, 1.0}, /* protocol */
  /* left: board_beat_l_arm */
  {16, 24, HOAP2_CAN_UNSIGNED, 0, 16777215, 1.0, 1.0}, /* tick */
  {40, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* mode */
  {48, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 1.0, 1.0}, /* protocol */
  /* left: board_beat_l_foot */
  {16, 24, HOAP2_CAN_UNSIGNED, 0, 16777215, 1.0, 1.0}, /* tick */
  {40, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* mode */
  {48, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 1.0, 1.0}, /* protocol */
  /* left: board_beat_waist */
  {16, 24, HOAP2_CAN_UNSIGNED, 0, 16777215, 1.0, 1.0}, /* tick */
  {40, 8, HOAP2_CAN_UNSIGNED, 0, 3, 1.0, 1.0}, /* mode */
  {48, 16, HOAP2_CAN_UNSIGNED, 0, 65535, 1.0, 1.0}, /* protocol */
  /* left: time_sync */
  {16, 31, HOAP2_CAN_UNSIGNED, 0, 2147483647, 1.0, 1.0}, /* tick */
  {47, 10, HOAP2_CAN_UNSIGNED, 0, 999, 1.0, 1.0}, /* offset_us */
  /* left: request_l_leg */
  {16, 1, HOAP2_CAN_UNSIGNED, 0, 1, 1.0, 1.0}, /* operation */
  {17, 7, HOAP2_CAN_UNSIGNED, 0, 127, 1.0, 1.0}, /* joint */
  {24, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* parameter */
  {32, 32, HOAP2_CAN_FLOAT, INT32_MIN, 2147483647, 1.0, 1.0}, /* value */
  /* left: request_l_arm */
  {16, 1, HOAP2_CAN_UNSIGNED, 0, 1, 1.0, 1.0}, /* operation */
  {17, 7, HOAP2_CAN_UNSIGNED, 0, 127, 1.0, 1.0}, /* joint */
  {24, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* parameter */
  {32, 32, HOAP2_CAN_FLOAT, INT32_MIN, 2147483647, 1.0, 1.0}, /* value */
  /* left: request_l_foot */
  {16, 1, HOAP2_CAN_UNSIGNED, 0, 1, 1.0, 1.0}, /* operation */
  {17, 7, HOAP2_CAN_UNSIGNED, 0, 127, 1.0, 1.0}, /* joint */
  {24, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* parameter */
  {32, 32, HOAP2_CAN_FLOAT, INT32_MIN, 2147483647, 1.0, 1.0}, /* value */
  /* left: request_waist */
  {16, 1, HOAP2_CAN_UNSIGNED, 0, 1, 1.0, 1.0}, /* operation */
  {17, 7, HOAP2_CAN_UNSIGNED, 0, 127, 1.0, 1.0}, /* joint */
  {24, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* parameter */
  {32, 32, HOAP2_CAN_FLOAT, INT32_MIN, 2147483647, 1.0, 1.0}, /* value */
  /* left: reply_l_leg */
  {16, 3, HOAP2_CAN_UNSIGNED, 0, 4, 1.0, 1.0}, /* result */
  {19, 5, HOAP2_CAN_UNSIGNED, 0, 31, 1.0, 1.0}, /* joint */
  {24, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* parameter */
  {32, 32, HOAP2_CAN_FLOAT, INT32_MIN, 2147483647, 1.0, 1.0}, /* value */
  /* left: reply_l_arm */
  {16, 3, HOAP2_CAN_UNSIGNED, 0, 4, 1.0, 1.0}, /* result */
  {19, 5, HOAP2_CAN_UNSIGNED, 0, 31, 1.0, 1.0}, /* joint */
  {24, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* parameter */
  {32, 32, HOAP2_CAN_FLOAT, INT32_MIN, 2147483647, 1.0, 1.0}, /* value */
  /* left: reply_l_foot */
  {16, 3, HOAP2_CAN_UNSIGNED, 0, 4, 1.0, 1.0}, /* result */
  {19, 5, HOAP2_CAN_UNSIGNED, 0, 31, 1.0, 1.0}, /* joint */
  {24, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* parameter */
  {32, 32, HOAP2_CAN_FLOAT, INT32_MIN, 2147483647, 1.0, 1.0}, /* value */
  /* left: reply_waist */
  {16, 3, HOAP2_CAN_UNSIGNED, 0, 4, 1.0, 1.0}, /* result */
  {19, 5, HOAP2_CAN_UNSIGNED, 0, 31, 1.0, 1.0}, /* joint */
  {24, 8, HOAP2_CAN_UNSIGNED, 0, 255, 1.0, 1.0}, /* parameter */
  {32, 32, HOAP2_CAN_FLOAT, INT32_MIN, 2147483647, 1.0, 1.0}, /* value */
};

const hoap2_can_layout_t HOAP2_CAN_LAYOUT[HOAP2_CAN_FRAMES] = {
  {0x000, 0, 24, 3, 1, 0, HOAP2_CAN_K_STOP, 0, -1, 0, 0}, /* right: stop_controller */
  {0x001, 1, 24, 3, 1, 0, HOAP2_CAN_K_STOP, 1, 0, 0, 0}, /* right: stop_r_leg */
  {0x002, 2, 24, 3, 1, 0, HOAP2_CAN_K_STOP, 2, 1, 0, 0}, /* right: stop_r_arm */
  {0x003, 3, 24, 3, 1, 0, HOAP2_CAN_K_STOP, 3, 2, 0, 0}, /* right: stop_r_foot */
  {0x004, 4, 24, 3, 1, 0, HOAP2_CAN_K_STOP, 4, 3, 0, 0}, /* right: stop_posture */
  {0x005, 5, 24, 3, 1, 0, HOAP2_CAN_K_STOP, 5, 4, 0, 0}, /* right: stop_head_hands */
  {0x020, 6, 64, 8, 3, 0, HOAP2_CAN_K_BEAT, 0, -1, 1, 0}, /* right: beat */
  {0x041, 9, 256, 32, 24, 0, HOAP2_CAN_K_SETTINGS, 0, 0, 100, 9}, /* right: settings_r_leg */
  {0x042, 33, 176, 24, 16, 0, HOAP2_CAN_K_SETTINGS, 0, 1, 100, 18}, /* right: settings_r_arm */
  {0x045, 49, 176, 24, 16, 0, HOAP2_CAN_K_SETTINGS, 0, 4, 100, 45}, /* right: settings_head_hands */
  {0x061, 65, 256, 32, 12, 0, HOAP2_CAN_K_COMMAND, 0, 0, 1, 0}, /* right: command_r_leg */
  {0x062, 77, 176, 24, 8, 0, HOAP2_CAN_K_COMMAND, 0, 1, 1, 0}, /* right: command_r_arm */
  {0x065, 85, 176, 24, 8, 0, HOAP2_CAN_K_COMMAND, 0, 4, 10, 5}, /* right: command_head_hands */
  {0x083, 93, 96, 12, 4, 0, HOAP2_CAN_K_CELLS, 3, 2, 1, 0}, /* right: cells_r_foot */
  {0x0A4, 97, 160, 20, 6, 0, HOAP2_CAN_K_IMU, 4, 3, 1, 0}, /* right: imu_posture */
  {0x0C1, 103, 256, 32, 24, 0, HOAP2_CAN_K_STATUS, 1, 0, 1, 0}, /* right: status_r_leg */
  {0x0C2, 127, 176, 24, 16, 0, HOAP2_CAN_K_STATUS, 2, 1, 1, 0}, /* right: status_r_arm */
  {0x0C5, 143, 176, 24, 16, 0, HOAP2_CAN_K_STATUS, 5, 4, 10, 5}, /* right: status_head_hands */
  {0x0E1, 159, 24, 3, 1, 0, HOAP2_CAN_K_ANSWER, 1, 0, 0, 0}, /* right: answer_r_leg */
  {0x0E2, 160, 24, 3, 1, 0, HOAP2_CAN_K_ANSWER, 2, 1, 0, 0}, /* right: answer_r_arm */
  {0x0E5, 161, 24, 3, 1, 0, HOAP2_CAN_K_ANSWER, 5, 4, 0, 0}, /* right: answer_head_hands */
  {0x101, 162, 64, 8, 3, 0, HOAP2_CAN_K_BOARD_BEAT, 1, 0, 50, 9}, /* right: board_beat_r_leg */
  {0x102, 165, 64, 8, 3, 0, HOAP2_CAN_K_BOARD_BEAT, 2, 1, 50, 18}, /* right: board_beat_r_arm */
  {0x103, 168, 64, 8, 3, 0, HOAP2_CAN_K_BOARD_BEAT, 3, 2, 50, 27}, /* right: board_beat_r_foot */
  {0x104, 171, 64, 8, 3, 0, HOAP2_CAN_K_BOARD_BEAT, 4, 3, 50, 36}, /* right: board_beat_posture */
  {0x105, 174, 64, 8, 3, 0, HOAP2_CAN_K_BOARD_BEAT, 5, 4, 50, 45}, /* right: board_beat_head_hands */
  {0x120, 177, 57, 8, 2, 0, HOAP2_CAN_K_TIME_SYNC, 0, -1, 100, 0}, /* right: time_sync */
  {0x141, 179, 64, 8, 4, 0, HOAP2_CAN_K_REQUEST, 0, 0, 0, 0}, /* right: request_r_leg */
  {0x142, 183, 64, 8, 4, 0, HOAP2_CAN_K_REQUEST, 0, 1, 0, 0}, /* right: request_r_arm */
  {0x143, 187, 64, 8, 4, 0, HOAP2_CAN_K_REQUEST, 0, 2, 0, 0}, /* right: request_r_foot */
  {0x144, 191, 64, 8, 4, 0, HOAP2_CAN_K_REQUEST, 0, 3, 0, 0}, /* right: request_posture */
  {0x145, 195, 64, 8, 4, 0, HOAP2_CAN_K_REQUEST, 0, 4, 0, 0}, /* right: request_head_hands */
  {0x161, 199, 64, 8, 4, 0, HOAP2_CAN_K_REPLY, 1, 0, 0, 0}, /* right: reply_r_leg */
  {0x162, 203, 64, 8, 4, 0, HOAP2_CAN_K_REPLY, 2, 1, 0, 0}, /* right: reply_r_arm */
  {0x163, 207, 64, 8, 4, 0, HOAP2_CAN_K_REPLY, 3, 2, 0, 0}, /* right: reply_r_foot */
  {0x164, 211, 64, 8, 4, 0, HOAP2_CAN_K_REPLY, 4, 3, 0, 0}, /* right: reply_posture */
  {0x165, 215, 64, 8, 4, 0, HOAP2_CAN_K_REPLY, 5, 4, 0, 0}, /* right: reply_head_hands */
  {0x000, 219, 24, 3, 1, 1, HOAP2_CAN_K_STOP, 0, -1, 0, 0}, /* left: stop_controller */
  {0x006, 220, 24, 3, 1, 1, HOAP2_CAN_K_STOP, 6, 5, 0, 0}, /* left: stop_l_leg */
  {0x007, 221, 24, 3, 1, 1, HOAP2_CAN_K_STOP, 7, 6, 0, 0}, /* left: stop_l_arm */
  {0x008, 222, 24, 3, 1, 1, HOAP2_CAN_K_STOP, 8, 7, 0, 0}, /* left: stop_l_foot */
  {0x009, 223, 24, 3, 1, 1, HOAP2_CAN_K_STOP, 9, 8, 0, 0}, /* left: stop_waist */
  {0x020, 224, 64, 8, 3, 1, HOAP2_CAN_K_BEAT, 0, -1, 1, 0}, /* left: beat */
  {0x046, 227, 256, 32, 24, 1, HOAP2_CAN_K_SETTINGS, 0, 5, 100, 54}, /* left: settings_l_leg */
  {0x047, 251, 176, 24, 16, 1, HOAP2_CAN_K_SETTINGS, 0, 6, 100, 63}, /* left: settings_l_arm */
  {0x049, 267, 56, 7, 4, 1, HOAP2_CAN_K_SETTINGS, 0, 8, 100, 81}, /* left: settings_waist */
  {0x066, 271, 256, 32, 12, 1, HOAP2_CAN_K_COMMAND, 0, 5, 1, 0}, /* left: command_l_leg */
  {0x067, 283, 176, 24, 8, 1, HOAP2_CAN_K_COMMAND, 0, 6, 1, 0}, /* left: command_l_arm */
  {0x069, 291, 56, 7, 2, 1, HOAP2_CAN_K_COMMAND, 0, 8, 1, 0}, /* left: command_waist */
  {0x088, 293, 96, 12, 4, 1, HOAP2_CAN_K_CELLS, 8, 7, 1, 0}, /* left: cells_l_foot */
  {0x0C6, 297, 256, 32, 24, 1, HOAP2_CAN_K_STATUS, 6, 5, 1, 0}, /* left: status_l_leg */
  {0x0C7, 321, 176, 24, 16, 1, HOAP2_CAN_K_STATUS, 7, 6, 1, 0}, /* left: status_l_arm */
  {0x0C9, 337, 56, 7, 4, 1, HOAP2_CAN_K_STATUS, 9, 8, 1, 0}, /* left: status_waist */
  {0x0E6, 341, 24, 3, 1, 1, HOAP2_CAN_K_ANSWER, 6, 5, 0, 0}, /* left: answer_l_leg */
  {0x0E7, 342, 24, 3, 1, 1, HOAP2_CAN_K_ANSWER, 7, 6, 0, 0}, /* left: answer_l_arm */
  {0x0E9, 343, 24, 3, 1, 1, HOAP2_CAN_K_ANSWER, 9, 8, 0, 0}, /* left: answer_waist */
  {0x106, 344, 64, 8, 3, 1, HOAP2_CAN_K_BOARD_BEAT, 6, 5, 50, 4}, /* left: board_beat_l_leg */
  {0x107, 347, 64, 8, 3, 1, HOAP2_CAN_K_BOARD_BEAT, 7, 6, 50, 13}, /* left: board_beat_l_arm */
  {0x108, 350, 64, 8, 3, 1, HOAP2_CAN_K_BOARD_BEAT, 8, 7, 50, 22}, /* left: board_beat_l_foot */
  {0x109, 353, 64, 8, 3, 1, HOAP2_CAN_K_BOARD_BEAT, 9, 8, 50, 31}, /* left: board_beat_waist */
  {0x120, 356, 57, 8, 2, 1, HOAP2_CAN_K_TIME_SYNC, 0, -1, 100, 0}, /* left: time_sync */
  {0x146, 358, 64, 8, 4, 1, HOAP2_CAN_K_REQUEST, 0, 5, 0, 0}, /* left: request_l_leg */
  {0x147, 362, 64, 8, 4, 1, HOAP2_CAN_K_REQUEST, 0, 6, 0, 0}, /* left: request_l_arm */
  {0x148, 366, 64, 8, 4, 1, HOAP2_CAN_K_REQUEST, 0, 7, 0, 0}, /* left: request_l_foot */
  {0x149, 370, 64, 8, 4, 1, HOAP2_CAN_K_REQUEST, 0, 8, 0, 0}, /* left: request_waist */
  {0x166, 374, 64, 8, 4, 1, HOAP2_CAN_K_REPLY, 6, 5, 0, 0}, /* left: reply_l_leg */
  {0x167, 378, 64, 8, 4, 1, HOAP2_CAN_K_REPLY, 7, 6, 0, 0}, /* left: reply_l_arm */
  {0x168, 382, 64, 8, 4, 1, HOAP2_CAN_K_REPLY, 8, 7, 0, 0}, /* left: reply_l_foot */
  {0x169, 386, 64, 8, 4, 1, HOAP2_CAN_K_REPLY, 9, 8, 0, 0}, /* left: reply_waist */
};

const int8_t HOAP2_CAN_LOOKUP[HOAP2_CAN_BUSES][HOAP2_CAN_KINDS << HOAP2_CAN_NODE_BITS] = {
  {0, 1, 2, 3, 4, 5, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 6, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 7, 8, -1, -1, 9, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 10, 11, -1, -1, 12, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 13, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 14, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 15, 16, -1, -1, 17, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 18, 19, -1, -1, 20, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 21, 22, 23, 24, 25, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 26, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 27, 28, 29, 30, 31, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 32, 33, 34, 35, 36, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1},
  {37, -1, -1, -1, -1, -1, 38, 39, 40, 41, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 42, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 43, 44, -1, 45, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 46, 47, -1, 48, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 49, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 50, 51, -1, 52, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 53, 54, -1, 55, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 56, 57, 58, 59, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 60, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 61, 62, 63, 64, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 65, 66, 67, 68, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1}
};

const hoap2_can_board_data_t HOAP2_CAN_BOARD[HOAP2_CAN_BOARDS] = {
  {1, 0, HOAP2_CAN_BOARD_DRIVE, 0, 6, {0, 1, 2, 3, 4, 5}}, /* r_leg */
  {2, 0, HOAP2_CAN_BOARD_DRIVE, 0, 4, {6, 7, 8, 9}}, /* r_arm */
  {3, 0, HOAP2_CAN_BOARD_FOOT, 0, 0, {0}}, /* r_foot */
  {4, 0, HOAP2_CAN_BOARD_POSTURE, 0, 0, {0}}, /* posture */
  {5, 0, HOAP2_CAN_BOARD_RC, 0, 4, {21, 22, 23, 24}}, /* head_hands */
  {6, 1, HOAP2_CAN_BOARD_DRIVE, 0, 6, {10, 11, 12, 13, 14, 15}}, /* l_leg */
  {7, 1, HOAP2_CAN_BOARD_DRIVE, 0, 4, {16, 17, 18, 19}}, /* l_arm */
  {8, 1, HOAP2_CAN_BOARD_FOOT, 1, 0, {0}}, /* l_foot */
  {9, 1, HOAP2_CAN_BOARD_DRIVE, 0, 1, {20}}, /* waist */
};

const hoap2_can_servo_t HOAP2_CAN_SERVO[25] = {
  {1753.1250000000002, 9.350000000000001}, /* r_hip_yaw */
  {2250.0, 12.0}, /* r_hip_roll */
  {1753.1250000000002, 9.350000000000001}, /* r_hip_pitch */
  {2250.0, 12.0}, /* r_knee */
  {1753.1250000000002, 9.350000000000001}, /* r_ankle_pitch */
  {1753.1250000000002, 9.350000000000001}, /* r_ankle_roll */
  {1753.1250000000002, 9.350000000000001}, /* r_shoulder_pitch */
  {1753.1250000000002, 9.350000000000001}, /* r_shoulder_roll */
  {1753.1250000000002, 9.350000000000001}, /* r_shoulder_yaw */
  {1753.1250000000002, 9.350000000000001}, /* r_elbow */
  {1753.1250000000002, 9.350000000000001}, /* l_hip_yaw */
  {2250.0, 12.0}, /* l_hip_roll */
  {1753.1250000000002, 9.350000000000001}, /* l_hip_pitch */
  {2250.0, 12.0}, /* l_knee */
  {1753.1250000000002, 9.350000000000001}, /* l_ankle_pitch */
  {1753.1250000000002, 9.350000000000001}, /* l_ankle_roll */
  {1753.1250000000002, 9.350000000000001}, /* l_shoulder_pitch */
  {1753.1250000000002, 9.350000000000001}, /* l_shoulder_roll */
  {1753.1250000000002, 9.350000000000001}, /* l_shoulder_yaw */
  {1753.1250000000002, 9.350000000000001}, /* l_elbow */
  {2250.0, 12.0}, /* waist_pitch */
  {187.5, 1.0}, /* head_pan */
  {187.5, 1.0}, /* head_tilt */
  {46.875, 0.25}, /* r_hand */
  {46.875, 0.25}, /* l_hand */
};

const hoap2_can_parameter_t HOAP2_CAN_PARAMETER[HOAP2_CAN_PARAMETERS] = {
  {1.0F, 20.0F, 1, 0}, /* alive_limit_ticks */
  {0.1F, 5.0F, 1, 1}, /* velocity_limit_rad_s */
  {0.0F, 0.0F, 0, 0}, /* refused */
  {0.0F, 0.0F, 0, 0}, /* holds */
  {0.0F, 0.0F, 0, 0}, /* clock_offset_ticks */
};

const uint8_t HOAP2_CAN_CRC8[4][256] = {
  {0, 47, 94, 113, 188, 147, 226, 205, 87, 120, 9, 38, 235, 196, 181, 154, 174, 129, 240, 223, 18, 61, 76, 99, 249, 214, 167, 136, 69, 106, 27, 52, 115, 92, 45, 2, 207, 224, 145, 190, 36, 11, 122, 85, 152, 183, 198, 233, 221, 242, 131, 172, 97, 78, 63, 16, 138, 165, 212, 251, 54, 25, 104, 71, 230, 201, 184, 151, 90, 117, 4, 43, 177, 158, 239, 192, 13, 34, 83, 124, 72, 103, 22, 57, 244, 219, 170, 133, 31, 48, 65, 110, 163, 140, 253, 210, 149, 186, 203, 228, 41, 6, 119, 88, 194, 237, 156, 179, 126, 81, 32, 15, 59, 20, 101, 74, 135, 168, 217, 246, 108, 67, 50, 29, 208, 255, 142, 161, 227, 204, 189, 146, 95, 112, 1, 46, 180, 155, 234, 197, 8, 39, 86, 121, 77, 98, 19, 60, 241, 222, 175, 128, 26, 53, 68, 107, 166, 137, 248, 215, 144, 191, 206, 225, 44, 3, 114, 93, 199, 232, 153, 182, 123, 84, 37, 10, 62, 17, 96, 79, 130, 173, 220, 243, 105, 70, 55, 24, 213, 250, 139, 164, 5, 42, 91, 116, 185, 150, 231, 200, 82, 125, 12, 35, 238, 193, 176, 159, 171, 132, 245, 218, 23, 56, 73, 102, 252, 211, 162, 141, 64, 111, 30, 49, 118, 89, 40, 7, 202, 229, 148, 187, 33, 14, 127, 80, 157, 178, 195, 236, 216, 247, 134, 169, 100, 75, 58, 21, 143, 160, 209, 254, 51, 28, 109, 66},
  {0, 233, 253, 20, 213, 60, 40, 193, 133, 108, 120, 145, 80, 185, 173, 68, 37, 204, 216, 49, 240, 25, 13, 228, 160, 73, 93, 180, 117, 156, 136, 97, 74, 163, 183, 94, 159, 118, 98, 139, 207, 38, 50, 219, 26, 243, 231, 14, 111, 134, 146, 123, 186, 83, 71, 174, 234, 3, 23, 254, 63, 214, 194, 43, 148, 125, 105, 128, 65, 168, 188, 85, 17, 248, 236, 5, 196, 45, 57, 208, 177, 88, 76, 165, 100, 141, 153, 112, 52, 221, 201, 32, 225, 8, 28, 245, 222, 55, 35, 202, 11, 226, 246, 31, 91, 178, 166, 79, 142, 103, 115, 154, 251, 18, 6, 239, 46, 199, 211, 58, 126, 151, 131, 106, 171, 66, 86, 191, 7, 238, 250, 19, 210, 59, 47, 198, 130, 107, 127, 150, 87, 190, 170, 67, 34, 203, 223, 54, 247, 30, 10, 227, 167, 78, 90, 179, 114, 155, 143, 102, 77, 164, 176, 89, 152, 113, 101, 140, 200, 33, 53, 220, 29, 244, 224, 9, 104, 129, 149, 124, 189, 84, 64, 169, 237, 4, 16, 249, 56, 209, 197, 44, 147, 122, 110, 135, 70, 175, 187, 82, 22, 255, 235, 2, 195, 42, 62, 215, 182, 95, 75, 162, 99, 138, 158, 119, 51, 218, 206, 39, 230, 15, 27, 242, 217, 48, 36, 205, 12, 229, 241, 24, 92, 181, 161, 72, 137, 96, 116, 157, 252, 21, 1, 232, 41, 192, 212, 61, 121, 144, 132, 109, 172, 69, 81, 184},
  {0, 14, 28, 18, 56, 54, 36, 42, 112, 126, 108, 98, 72, 70, 84, 90, 224, 238, 252, 242, 216, 214, 196, 202, 144, 158, 140, 130, 168, 166, 180, 186, 239, 225, 243, 253, 215, 217, 203, 197, 159, 145, 131, 141, 167, 169, 187, 181, 15, 1, 19, 29, 55, 57, 43, 37, 127, 113, 99, 109, 71, 73, 91, 85, 241, 255, 237, 227, 201, 199, 213, 219, 129, 143, 157, 147, 185, 183, 165, 171, 17, 31, 13, 3, 41, 39, 53, 59, 97, 111, 125, 115, 89, 87, 69, 75, 30, 16, 2, 12, 38, 40, 58, 52, 110, 96, 114, 124, 86, 88, 74, 68, 254, 240, 226, 236, 198, 200, 218, 212, 142, 128, 146, 156, 182, 184, 170, 164, 205, 195, 209, 223, 245, 251, 233, 231, 189, 179, 161, 175, 133, 139, 153, 151, 45, 35, 49, 63, 21, 27, 9, 7, 93, 83, 65, 79, 101, 107, 121, 119, 34, 44, 62, 48, 26, 20, 6, 8, 82, 92, 78, 64, 106, 100, 118, 120, 194, 204, 222, 208, 250, 244, 230, 232, 178, 188, 174, 160, 138, 132, 150, 152, 60, 50, 32, 46, 4, 10, 24, 22, 76, 66, 80, 94, 116, 122, 104, 102, 220, 210, 192, 206, 228, 234, 248, 246, 172, 162, 176, 190, 148, 154, 136, 134, 211, 221, 207, 193, 235, 229, 247, 249, 163, 173, 191, 177, 155, 149, 135, 137, 51, 61, 47, 33, 11, 5, 23, 25, 67, 77, 95, 81, 123, 117, 103, 105},
  {0, 181, 69, 240, 138, 63, 207, 122, 59, 142, 126, 203, 177, 4, 244, 65, 118, 195, 51, 134, 252, 73, 185, 12, 77, 248, 8, 189, 199, 114, 130, 55, 236, 89, 169, 28, 102, 211, 35, 150, 215, 98, 146, 39, 93, 232, 24, 173, 154, 47, 223, 106, 16, 165, 85, 224, 161, 20, 228, 81, 43, 158, 110, 219, 247, 66, 178, 7, 125, 200, 56, 141, 204, 121, 137, 60, 70, 243, 3, 182, 129, 52, 196, 113, 11, 190, 78, 251, 186, 15, 255, 74, 48, 133, 117, 192, 27, 174, 94, 235, 145, 36, 212, 97, 32, 149, 101, 208, 170, 31, 239, 90, 109, 216, 40, 157, 231, 82, 162, 23, 86, 227, 19, 166, 220, 105, 153, 44, 193, 116, 132, 49, 75, 254, 14, 187, 250, 79, 191, 10, 112, 197, 53, 128, 183, 2, 242, 71, 61, 136, 120, 205, 140, 57, 201, 124, 6, 179, 67, 246, 45, 152, 104, 221, 167, 18, 226, 87, 22, 163, 83, 230, 156, 41, 217, 108, 91, 238, 30, 171, 209, 100, 148, 33, 96, 213, 37, 144, 234, 95, 175, 26, 54, 131, 115, 198, 188, 9, 249, 76, 13, 184, 72, 253, 135, 50, 194, 119, 64, 245, 5, 176, 202, 127, 143, 58, 123, 206, 62, 139, 241, 68, 180, 1, 218, 111, 159, 42, 80, 229, 21, 160, 225, 84, 164, 17, 107, 222, 46, 155, 172, 25, 233, 92, 38, 147, 99, 214, 151, 34, 210, 103, 29, 168, 88, 237}
};
