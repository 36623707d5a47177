/* Generated from firmware/signals.toml and firmware/hoap2.json by ./hoap2 generate: do not edit. */
#ifndef HOAP2_GENERATED_NAMES_H
#define HOAP2_GENERATED_NAMES_H

static const char *const HOAP2_JOINT_NAME[] = {"r_hip_yaw", "r_hip_roll", "r_hip_pitch", "r_knee", "r_ankle_pitch", "r_ankle_roll", "r_shoulder_pitch", "r_shoulder_roll", "r_shoulder_yaw", "r_elbow", "l_hip_yaw", "l_hip_roll", "l_hip_pitch", "l_knee", "l_ankle_pitch", "l_ankle_roll", "l_shoulder_pitch", "l_shoulder_roll", "l_shoulder_yaw", "l_elbow", "waist_pitch", "head_pan", "head_tilt", "r_hand", "l_hand"};
static const char *const HOAP2_LINK_NAME[] = {"pelvis", "chest", "head_pan_link", "head", "r_shoulder_pitch_link", "r_shoulder_roll_link", "r_upper_arm", "r_forearm", "r_hand", "l_shoulder_pitch_link", "l_shoulder_roll_link", "l_upper_arm", "l_forearm", "l_hand", "r_hip_yaw_link", "r_hip_roll_link", "r_thigh", "r_shank", "r_ankle_link", "r_foot", "l_hip_yaw_link", "l_hip_roll_link", "l_thigh", "l_shank", "l_ankle_link", "l_foot"};
typedef struct {
  int bit;
  const char *name;
  const char *text;
} hoap2_fault_name_t;
static const hoap2_fault_name_t HOAP2_FAULT_NAME[8] = {
  {1, "bad_input", "a sensor value was not finite or not possible for longer than the watchdog bridges"},
  {2, "stale_input", "sensor_tick stopped"},
  {4, "footprint_out_of_reach", "a footprint is out of reach: a leg is too short, a joint limit is met, or the soles would touch; take a shorter step, less turn or another width"},
  {8, "joint_limit", "a reference was clipped at a soft joint limit"},
  {16, "bad_parameter", "a parameter is outside its range, or some do not go together: contact_off_N <= contact_on_N, tpcc_kx_1_s2 > tpcc_kp_1_s2 unless that is 0, crouch_posture_rad within the soft joint limits"},
  {32, "reach_limit", "a leg target beyond the straight leg was pulled back"},
  {128, "capture_point_lost", "the walk ended with the capture point off the soles; the CoM was brought back over them at once"},
  {64, "joint_too_fast", "the walk asks for more joint rate than the drives have; take a shorter step, a lower lift or a longer step time"}};
enum { HOAP2_FAULT_NAMES = 8 };
#endif
