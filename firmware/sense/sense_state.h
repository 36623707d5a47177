/* What the sensors say about the robot, and the memory needed to say it. */
#ifndef HOAP2_SENSE_SENSE_STATE_H
#define HOAP2_SENSE_SENSE_STATE_H

#include <stdint.h>

/* Feet as the gait commands them, in the start frame O. foot: 0 right, 1 left. */
typedef struct {
  double pos_O_m[2][3]; /* sole point under the ankle */
  double yaw_O_rad[2];
  int32_t support[2]; /* 1: planned to stand on the floor */
  int32_t pad;
} hoap2_feet_t;

typedef struct {
  /* attitude */
  double up_S[3]; /* vertical direction in the chest frame, unit length */
  double gyro_bias_S_rad_s[3];
  double gyro_sum_S_rad_s[3];
  double accel_sum_S_m_s2[3];
  double roll_rad; /* of the chest, yaw-pitch-roll order */
  double pitch_rad;
  /* base by the stance leg */
  double base_pos_O_m[3];
  double base_rot_O[3][3];
  /* CoM and capture point */
  double com_O_m[3];
  double com_rate_O_m_s[3];
  double com_over_foot_O_m[2][3]; /* CoM against each sole point, for the rate */
  double cp_O_m[2];
  /* force cells */
  double foot_force_N[2];
  double cop_O_m[2]; /* holds its last value without contact */
  int32_t contact[2];
  int32_t sum_count; /* samples in the calibration sums */
  int32_t started;   /* 1 after the first frame */
} hoap2_sense_t;

#endif
