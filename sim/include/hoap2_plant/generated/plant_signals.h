/* Generated from firmware/signals.toml and firmware/hoap2.json by ./hoap2 generate: do not edit. */
#ifndef HOAP2_PLANT_GENERATED_SIGNALS_H
#define HOAP2_PLANT_GENERATED_SIGNALS_H
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include "hoap2/generated/signals.h"

enum { HOAP2_SOLVER_ARTICULATED = 0, HOAP2_SOLVER_ODE = 1 };
enum { HOAP2_FRICTION_LAW_OF_SOLVER = 0, HOAP2_FRICTION_LAW_CONE = 1, HOAP2_FRICTION_LAW_PYRAMID = 2 };
enum { HOAP2_GROUND_RIGID = 0, HOAP2_GROUND_SOIL = 1 };
enum { HOAP2_SOIL_LAW_BEKKER = 0, HOAP2_SOIL_LAW_RFT = 1 };
enum { HOAP2_SOIL_LINKS_SOLES = 0, HOAP2_SOIL_LINKS_ALL = 1 };

typedef struct {
  double q_ref_rad[25]; /* joint angle reference [rad] */
  double qd_ref_rad_s[25]; /* joint rate reference [rad/s] */
  double tau_ff_Nm[25]; /* joint torque feed-forward [N.m] */
  double kp_Nm_rad[25]; /* drive stiffness [N.m/rad] */
  double kd_Nms_rad[25]; /* drive damping [N.m.s/rad] */
  double push_now_force_W_N[3]; /* a force from outside while it is not zero, added to the planned pushes; a step with a value beyond its range fails [N] */
  double push_now_point_L_m[3]; /* its point of application in the link frame [m] */
  int32_t drive_mode[25]; /* drive setting, as the controller's output */
  int32_t push_now_link; /* its link, in the order of hoap2.json */
} hoap2_plant_inputs_t;
/* bytes of its members, without the padding behind the last one */
#define HOAP2_PLANT_INPUTS_BYTES (offsetof(hoap2_plant_inputs_t, push_now_link) + sizeof(((const hoap2_plant_inputs_t *)0)->push_now_link))

typedef struct {
  double q_enc_rad[25]; /* joint angles as the encoders count them [rad] */
  double gyro_S_rad_s[3]; /* rate gyro in the chest [rad/s] */
  double accel_S_m_s2[3]; /* accelerometer in the chest (specific force) [m/s2] */
  double cell_force_N[8]; /* foot force cells [N] */
  double true_base_pos_W_m[3]; /* pelvis origin (midway between the hips), truth [m] */
  double true_base_quat_W[4]; /* pelvis orientation, truth [1] */
  double true_base_vel_W_m_s[3]; /* velocity of the pelvis origin, truth [m/s] */
  double true_base_omega_W_rad_s[3]; /* angular velocity of the pelvis, truth [rad/s] */
  double true_q_rad[25]; /* joint angles at the link, truth [rad] */
  double true_qd_rad_s[25]; /* joint rates at the link, truth [rad/s] */
  double true_tau_Nm[25]; /* drive torque after limits, before rotor inertia and friction [N.m] */
  double true_com_W_m[3]; /* CoM, truth [m] */
  double true_com_rate_W_m_s[3]; /* CoM rate, truth [m/s] */
  double true_cop_W_m[2]; /* net CoP of the sole contacts, truth; held in flight [m] */
  double true_sinkage_m[2]; /* mean depth of each sole below the untouched ground, truth (0 on the rigid floor) [m] */
  double true_chest_rpy_rad[3]; /* roll, pitch and yaw of the chest (yaw-pitch-roll order), truth [rad] */
  double true_foot_pos_W_m[2][3]; /* sole point under each ankle, truth [m] */
  double true_foot_yaw_W_rad[2]; /* yaw of each foot, truth [rad] */
  double true_foot_force_W_N[2][3]; /* contact force on each foot, truth [N] */
  double true_foot_moment_W_Nm[2][3]; /* contact moment on each foot about the sole point under its ankle, truth [N.m] */
  double true_push_force_W_N[3]; /* sum of the pushes acting now [N] */
  int32_t sensor_tick; /* counter of sensor frames */
  int32_t plant_tick; /* ticks done */
  int32_t other_contacts; /* contact points of anything but the soles in this tick */
} hoap2_plant_outputs_t;
/* bytes of its members, without the padding behind the last one */
#define HOAP2_PLANT_OUTPUTS_BYTES (offsetof(hoap2_plant_outputs_t, other_contacts) + sizeof(((const hoap2_plant_outputs_t *)0)->other_contacts))

typedef struct {
  double start_pos_W_m[2]; /* where the robot starts: the point midway between the soles [m] */
  double start_yaw_W_rad; /* heading at the start [rad] */
  double start_height_m; /* soles above the floor at the start [m] */
  double start_posture_rad[25]; /* joint angles at the start [rad] */
  double start_vel_W_m_s[3]; /* velocity of the whole robot at the start [m/s] */
  double start_omega_W_rad_s[3]; /* angular velocity of the whole robot about its CoM at the start [rad/s] */
  double gravity_m_s2; /* gravity [m/s2] */
  double gyro_bias_S_rad_s[3]; /* gyro bias (preset hoap2) [rad/s] */
  double cell_gain[8]; /* gain of each foot cell (preset hoap2) [1] */
  double chest_com_shift_L_m[3]; /* shift of the chest's CoM against the model [m] */
  double floor_tilt_rad[2]; /* floor tilt about x and about y through the start point [rad] */
  double soil_size_m[3]; /* pool: length, width, depth [m] */
  double soil_centre_m[2]; /* middle of the pool from the start point, ahead and to the left [m] */
  double soil_cell_m; /* cell of the height field [m] */
  double soil_kc_N_m_n1; /* k_c of (k_c/b + k_phi) z^n, N/m^(n+1), b the smaller side of the sole [1] */
  double soil_kphi_N_m_n2; /* k_phi of (k_c/b + k_phi) z^n, N/m^(n+2) [1] */
  double soil_n; /* exponent n of the sinkage [1] */
  double soil_cohesion_Pa; /* cohesion c [Pa] */
  double soil_friction_rad; /* angle of internal friction phi [rad] */
  double soil_shear_m; /* shear displacement K of Janosi-Hanamoto [m] */
  double soil_unload_Pa_m; /* k_0 of the unloading stiffness k_0 + A_u z_u [Pa/m] */
  double soil_unload_Pa_m2; /* A_u of the unloading stiffness k_0 + A_u z_u [Pa/m2] */
  double soil_damping_Pas_m; /* damping of the pressure [Pa.s/m] */
  double soil_heave; /* share of the displaced volume that rises around what displaced it; the rest is compacted [1] */
  double soil_repose_rad; /* angle of repose [rad] */
  double soil_edge_loss; /* share of the bearing pressure that is lost at the edge of a sole [1] */
  double soil_edge_m; /* width of the strip at the edge over which that loss fades [m] */
  double soil_rft_zeta; /* scale of the generic stresses of resistive force theory [1] */
  double soil_roughness_m; /* initial roughness of the surface, rms [m] */
  double soil_roughness_length_m; /* correlation length of the roughness [m] */
  double friction_mu; /* Coulomb friction of the floor [1] */
  double contact_stiffness_N_m; /* spring of a contact point (a corner of a sole) with the floor [N/m] */
  double contact_damping_Ns_m; /* damper of a contact point with the floor [N.s/m] */
  double block_centre_W_m[16][3]; /* centre of each block [m] */
  double block_size_m[16][3]; /* full size of each block [m] */
  double block_yaw_W_rad[16]; /* yaw of each block [rad] */
  double joint_friction_scale; /* factor on the Coulomb and viscous friction of the drives [1] */
  double roll_stiffness_Nm_rad; /* compliance of the hip and ankle roll joints behind the encoder; 0 = rigid [N.m/rad] */
  double roll_damping_Nms_rad; /* damping of that compliance [N.m.s/rad] */
  double push_force_W_N[8][3]; /* force of each push [N] */
  double push_point_L_m[8][3]; /* point of application in the link frame [m] */
  double push_start_s[8]; /* start of each push [s] */
  double push_duration_s[8]; /* length of each push, ramps included; 0 = no push [s] */
  double push_ramp_s[8]; /* quintic ramp at each end; 0 = rectangular [s] */
  int32_t seed; /* seed of the sensor noise */
  int32_t sensor_preset; /* ideal, or hoap2: quantised, band-limited, noisy, one frame late */
  int32_t solver; /* what solves a tick's equations: the articulated solver, or ODE's dWorldStep */
  int32_t friction_law; /* Coulomb friction as a cone, or as ODE's pyramid; of_solver: cone for articulated, pyramid for ode (which has no cone) */
  int32_t ground; /* what the robot stands on: the rigid floor with its blocks, or a pool of soil in the floor */
  int32_t soil_law; /* bekker: pressure-sinkage and Janosi-Hanamoto shear; rft: three-dimensional resistive force theory */
  int32_t soil_links; /* which links the soil carries */
  int32_t soil_patches[2]; /* patches of a sole, along and across */
  int32_t soil_seed; /* seed of the roughness */
  int32_t block_count; /* number of terrain blocks (steps, edges) */
  int32_t push_link[8]; /* link of each push, in the order of hoap2.json */
} hoap2_plant_params_t;
/* bytes of its members, without the padding behind the last one */
#define HOAP2_PLANT_PARAMS_BYTES (offsetof(hoap2_plant_params_t, push_link) + sizeof(((const hoap2_plant_params_t *)0)->push_link))

static inline void hoap2_plant_inputs_defaults(hoap2_plant_inputs_t *p) {
  { static const double v_[25] = {0.0, 0.0, -0.29717399332586975, 0.6951889664830044, -0.3980149731571346, 0.0, 1.5707963267948966, -0.17453292519943295, 0.17453292519943295, -0.4363323129985824, 0.0, 0.0, -0.29717399332586975, 0.6951889664830044, -0.3980149731571346, 0.0, 1.5707963267948966, 0.17453292519943295, -0.17453292519943295, -0.4363323129985824, 0.0, 0.0, 0.0, 0.0, 0.0};
    for (int i_ = 0; i_ < 25; ++i_) ((double *)(void *)&(p)->q_ref_rad)[i_] = v_[i_]; }
  for (int i_ = 0; i_ < 25; ++i_) ((double *)(void *)&(p)->qd_ref_rad_s)[i_] = 0.0;
  for (int i_ = 0; i_ < 25; ++i_) ((double *)(void *)&(p)->tau_ff_Nm)[i_] = 0.0;
  { static const double v_[25] = {1753.1250000000002, 2250.0, 1753.1250000000002, 2250.0, 1753.1250000000002, 1753.1250000000002, 1753.1250000000002, 1753.1250000000002, 1753.1250000000002, 1753.1250000000002, 1753.1250000000002, 2250.0, 1753.1250000000002, 2250.0, 1753.1250000000002, 1753.1250000000002, 1753.1250000000002, 1753.1250000000002, 1753.1250000000002, 1753.1250000000002, 2250.0, 187.5, 187.5, 46.875, 46.875};
    for (int i_ = 0; i_ < 25; ++i_) ((double *)(void *)&(p)->kp_Nm_rad)[i_] = v_[i_]; }
  { static const double v_[25] = {9.350000000000001, 12.0, 9.350000000000001, 12.0, 9.350000000000001, 9.350000000000001, 9.350000000000001, 9.350000000000001, 9.350000000000001, 9.350000000000001, 9.350000000000001, 12.0, 9.350000000000001, 12.0, 9.350000000000001, 9.350000000000001, 9.350000000000001, 9.350000000000001, 9.350000000000001, 9.350000000000001, 12.0, 1.0, 1.0, 0.25, 0.25};
    for (int i_ = 0; i_ < 25; ++i_) ((double *)(void *)&(p)->kd_Nms_rad)[i_] = v_[i_]; }
  for (int i_ = 0; i_ < 3; ++i_) ((double *)(void *)&(p)->push_now_force_W_N)[i_] = 0.0;
  for (int i_ = 0; i_ < 3; ++i_) ((double *)(void *)&(p)->push_now_point_L_m)[i_] = 0.0;
  for (int i_ = 0; i_ < 25; ++i_) ((int32_t *)(void *)&(p)->drive_mode)[i_] = 1;
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->push_now_link)[i_] = 1;
}

static inline void hoap2_plant_params_defaults(hoap2_plant_params_t *p) {
  for (int i_ = 0; i_ < 2; ++i_) ((double *)(void *)&(p)->start_pos_W_m)[i_] = 0.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->start_yaw_W_rad)[i_] = 0.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->start_height_m)[i_] = 0.0;
  { static const double v_[25] = {0.0, 0.0, -0.29717399332586975, 0.6951889664830044, -0.3980149731571346, 0.0, 1.5707963267948966, -0.17453292519943295, 0.17453292519943295, -0.4363323129985824, 0.0, 0.0, -0.29717399332586975, 0.6951889664830044, -0.3980149731571346, 0.0, 1.5707963267948966, 0.17453292519943295, -0.17453292519943295, -0.4363323129985824, 0.0, 0.0, 0.0, 0.0, 0.0};
    for (int i_ = 0; i_ < 25; ++i_) ((double *)(void *)&(p)->start_posture_rad)[i_] = v_[i_]; }
  for (int i_ = 0; i_ < 3; ++i_) ((double *)(void *)&(p)->start_vel_W_m_s)[i_] = 0.0;
  for (int i_ = 0; i_ < 3; ++i_) ((double *)(void *)&(p)->start_omega_W_rad_s)[i_] = 0.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->gravity_m_s2)[i_] = 9.81;
  for (int i_ = 0; i_ < 3; ++i_) ((double *)(void *)&(p)->gyro_bias_S_rad_s)[i_] = 0.0;
  for (int i_ = 0; i_ < 8; ++i_) ((double *)(void *)&(p)->cell_gain)[i_] = 1.0;
  for (int i_ = 0; i_ < 3; ++i_) ((double *)(void *)&(p)->chest_com_shift_L_m)[i_] = 0.0;
  for (int i_ = 0; i_ < 2; ++i_) ((double *)(void *)&(p)->floor_tilt_rad)[i_] = 0.0;
  { static const double v_[3] = {0.85, 0.56, 0.15};
    for (int i_ = 0; i_ < 3; ++i_) ((double *)(void *)&(p)->soil_size_m)[i_] = v_[i_]; }
  { static const double v_[2] = {0.21, 0.0};
    for (int i_ = 0; i_ < 2; ++i_) ((double *)(void *)&(p)->soil_centre_m)[i_] = v_[i_]; }
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->soil_cell_m)[i_] = 0.005;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->soil_kc_N_m_n1)[i_] = 0.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->soil_kphi_N_m_n2)[i_] = 6500000.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->soil_n)[i_] = 1.1;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->soil_cohesion_Pa)[i_] = 200.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->soil_friction_rad)[i_] = 0.5235987755982988;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->soil_shear_m)[i_] = 0.004;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->soil_unload_Pa_m)[i_] = 100000000.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->soil_unload_Pa_m2)[i_] = 0.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->soil_damping_Pas_m)[i_] = 40000.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->soil_heave)[i_] = 0.1;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->soil_repose_rad)[i_] = 0.5585053606381855;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->soil_edge_loss)[i_] = 0.4;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->soil_edge_m)[i_] = 0.01;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->soil_rft_zeta)[i_] = 1.4;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->soil_roughness_m)[i_] = 0.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->soil_roughness_length_m)[i_] = 0.02;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->friction_mu)[i_] = 0.7;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->contact_stiffness_N_m)[i_] = 500000.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->contact_damping_Ns_m)[i_] = 1500.0;
  for (int i_ = 0; i_ < 48; ++i_) ((double *)(void *)&(p)->block_centre_W_m)[i_] = 0.0;
  for (int i_ = 0; i_ < 48; ++i_) ((double *)(void *)&(p)->block_size_m)[i_] = 0.1;
  for (int i_ = 0; i_ < 16; ++i_) ((double *)(void *)&(p)->block_yaw_W_rad)[i_] = 0.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->joint_friction_scale)[i_] = 1.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->roll_stiffness_Nm_rad)[i_] = 0.0;
  for (int i_ = 0; i_ < 1; ++i_) ((double *)(void *)&(p)->roll_damping_Nms_rad)[i_] = 0.5;
  for (int i_ = 0; i_ < 24; ++i_) ((double *)(void *)&(p)->push_force_W_N)[i_] = 0.0;
  for (int i_ = 0; i_ < 24; ++i_) ((double *)(void *)&(p)->push_point_L_m)[i_] = 0.0;
  for (int i_ = 0; i_ < 8; ++i_) ((double *)(void *)&(p)->push_start_s)[i_] = 0.0;
  for (int i_ = 0; i_ < 8; ++i_) ((double *)(void *)&(p)->push_duration_s)[i_] = 0.0;
  for (int i_ = 0; i_ < 8; ++i_) ((double *)(void *)&(p)->push_ramp_s)[i_] = 0.0;
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->seed)[i_] = 0;
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->sensor_preset)[i_] = 1;
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->solver)[i_] = 0;
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->friction_law)[i_] = 0;
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->ground)[i_] = 0;
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->soil_law)[i_] = 0;
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->soil_links)[i_] = 1;
  { static const int32_t v_[2] = {10, 6};
    for (int i_ = 0; i_ < 2; ++i_) ((int32_t *)(void *)&(p)->soil_patches)[i_] = v_[i_]; }
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->soil_seed)[i_] = 0;
  for (int i_ = 0; i_ < 1; ++i_) ((int32_t *)(void *)&(p)->block_count)[i_] = 0;
  for (int i_ = 0; i_ < 8; ++i_) ((int32_t *)(void *)&(p)->push_link)[i_] = 0;
}

#define HOAP2_PUSH_NOW_FORCE_W_N_LOW -200.0
#define HOAP2_PUSH_NOW_FORCE_W_N_HIGH 200.0
#define HOAP2_PUSH_NOW_POINT_L_M_LOW -1.0
#define HOAP2_PUSH_NOW_POINT_L_M_HIGH 1.0
#define HOAP2_PUSH_NOW_LINK_LOW 0
#define HOAP2_PUSH_NOW_LINK_HIGH 25

static inline int hoap2_plant_params_out_of_range(const hoap2_plant_params_t *p) {
  int bad_ = 0;
  for (int i_ = 0; i_ < 2; ++i_) { const double v_ = ((const double *)(const void *)&p->start_pos_W_m)[i_]; if (!(v_ >= -1000000.0 && v_ <= 1000000.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->start_yaw_W_rad)[i_]; if (!(v_ >= -7.0 && v_ <= 7.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->start_height_m)[i_]; if (!(v_ >= 0.0 && v_ <= 100.0)) ++bad_; }
  for (int i_ = 0; i_ < 25; ++i_) { const double v_ = ((const double *)(const void *)&p->start_posture_rad)[i_]; if (!(v_ >= -3.2 && v_ <= 3.2)) ++bad_; }
  for (int i_ = 0; i_ < 3; ++i_) { const double v_ = ((const double *)(const void *)&p->start_vel_W_m_s)[i_]; if (!(v_ >= -100.0 && v_ <= 100.0)) ++bad_; }
  for (int i_ = 0; i_ < 3; ++i_) { const double v_ = ((const double *)(const void *)&p->start_omega_W_rad_s)[i_]; if (!(v_ >= -100.0 && v_ <= 100.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->gravity_m_s2)[i_]; if (!(v_ >= 0.0 && v_ <= 30.0)) ++bad_; }
  for (int i_ = 0; i_ < 3; ++i_) { const double v_ = ((const double *)(const void *)&p->gyro_bias_S_rad_s)[i_]; if (!(v_ >= -0.1 && v_ <= 0.1)) ++bad_; }
  for (int i_ = 0; i_ < 8; ++i_) { const double v_ = ((const double *)(const void *)&p->cell_gain)[i_]; if (!(v_ >= 0.0 && v_ <= 2.0)) ++bad_; }
  for (int i_ = 0; i_ < 3; ++i_) { const double v_ = ((const double *)(const void *)&p->chest_com_shift_L_m)[i_]; if (!(v_ >= -0.02 && v_ <= 0.02)) ++bad_; }
  for (int i_ = 0; i_ < 2; ++i_) { const double v_ = ((const double *)(const void *)&p->floor_tilt_rad)[i_]; if (!(v_ >= -0.4 && v_ <= 0.4)) ++bad_; }
  for (int i_ = 0; i_ < 3; ++i_) { const double v_ = ((const double *)(const void *)&p->soil_size_m)[i_]; if (!(v_ >= 0.05 && v_ <= 20.0)) ++bad_; }
  for (int i_ = 0; i_ < 2; ++i_) { const double v_ = ((const double *)(const void *)&p->soil_centre_m)[i_]; if (!(v_ >= -20.0 && v_ <= 20.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->soil_cell_m)[i_]; if (!(v_ >= 0.001 && v_ <= 0.05)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->soil_kc_N_m_n1)[i_]; if (!(v_ >= 0.0 && v_ <= 1000000000.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->soil_kphi_N_m_n2)[i_]; if (!(v_ >= 1000.0 && v_ <= 1000000000000.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->soil_n)[i_]; if (!(v_ >= 0.3 && v_ <= 2.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->soil_cohesion_Pa)[i_]; if (!(v_ >= 0.0 && v_ <= 100000.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->soil_friction_rad)[i_]; if (!(v_ >= 0.0 && v_ <= 1.2)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->soil_shear_m)[i_]; if (!(v_ >= 0.0001 && v_ <= 0.2)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->soil_unload_Pa_m)[i_]; if (!(v_ >= 100000.0 && v_ <= 1000000000000.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->soil_unload_Pa_m2)[i_]; if (!(v_ >= 0.0 && v_ <= 100000000000000.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->soil_damping_Pas_m)[i_]; if (!(v_ >= 0.0 && v_ <= 100000000.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->soil_heave)[i_]; if (!(v_ >= 0.0 && v_ <= 1.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->soil_repose_rad)[i_]; if (!(v_ >= 0.05 && v_ <= 1.4)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->soil_edge_loss)[i_]; if (!(v_ >= 0.0 && v_ <= 1.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->soil_edge_m)[i_]; if (!(v_ >= 0.0 && v_ <= 0.05)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->soil_rft_zeta)[i_]; if (!(v_ >= 0.01 && v_ <= 100.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->soil_roughness_m)[i_]; if (!(v_ >= 0.0 && v_ <= 0.02)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->soil_roughness_length_m)[i_]; if (!(v_ >= 0.002 && v_ <= 1.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->friction_mu)[i_]; if (!(v_ >= 0.0 && v_ <= 10.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->contact_stiffness_N_m)[i_]; if (!(v_ >= 1000.0 && v_ <= 100000000.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->contact_damping_Ns_m)[i_]; if (!(v_ >= 0.0 && v_ <= 1000000.0)) ++bad_; }
  for (int i_ = 0; i_ < 48; ++i_) { const double v_ = ((const double *)(const void *)&p->block_centre_W_m)[i_]; if (!(v_ >= -1000000.0 && v_ <= 1000000.0)) ++bad_; }
  for (int i_ = 0; i_ < 48; ++i_) { const double v_ = ((const double *)(const void *)&p->block_size_m)[i_]; if (!(v_ >= 0.001 && v_ <= 100.0)) ++bad_; }
  for (int i_ = 0; i_ < 16; ++i_) { const double v_ = ((const double *)(const void *)&p->block_yaw_W_rad)[i_]; if (!(v_ >= -7.0 && v_ <= 7.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->joint_friction_scale)[i_]; if (!(v_ >= 0.0 && v_ <= 10.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->roll_stiffness_Nm_rad)[i_]; if (!(v_ >= 0.0 && v_ <= 100000.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const double v_ = ((const double *)(const void *)&p->roll_damping_Nms_rad)[i_]; if (!(v_ >= 0.0 && v_ <= 100.0)) ++bad_; }
  for (int i_ = 0; i_ < 24; ++i_) { const double v_ = ((const double *)(const void *)&p->push_force_W_N)[i_]; if (!(v_ >= -500.0 && v_ <= 500.0)) ++bad_; }
  for (int i_ = 0; i_ < 24; ++i_) { const double v_ = ((const double *)(const void *)&p->push_point_L_m)[i_]; if (!(v_ >= -1.0 && v_ <= 1.0)) ++bad_; }
  for (int i_ = 0; i_ < 8; ++i_) { const double v_ = ((const double *)(const void *)&p->push_start_s)[i_]; if (!(v_ >= 0.0 && v_ <= 1000000.0)) ++bad_; }
  for (int i_ = 0; i_ < 8; ++i_) { const double v_ = ((const double *)(const void *)&p->push_duration_s)[i_]; if (!(v_ >= 0.0 && v_ <= 1000000.0)) ++bad_; }
  for (int i_ = 0; i_ < 8; ++i_) { const double v_ = ((const double *)(const void *)&p->push_ramp_s)[i_]; if (!(v_ >= 0.0 && v_ <= 100000.0)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const int32_t v_ = ((const int32_t *)(const void *)&p->seed)[i_]; if (!(v_ >= 0 && v_ <= 2147483647)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const int32_t v_ = ((const int32_t *)(const void *)&p->sensor_preset)[i_]; if (!(v_ >= 0 && v_ <= 1)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const int32_t v_ = ((const int32_t *)(const void *)&p->solver)[i_]; if (!(v_ >= 0 && v_ <= 1)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const int32_t v_ = ((const int32_t *)(const void *)&p->friction_law)[i_]; if (!(v_ >= 0 && v_ <= 2)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const int32_t v_ = ((const int32_t *)(const void *)&p->ground)[i_]; if (!(v_ >= 0 && v_ <= 1)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const int32_t v_ = ((const int32_t *)(const void *)&p->soil_law)[i_]; if (!(v_ >= 0 && v_ <= 1)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const int32_t v_ = ((const int32_t *)(const void *)&p->soil_links)[i_]; if (!(v_ >= 0 && v_ <= 1)) ++bad_; }
  for (int i_ = 0; i_ < 2; ++i_) { const int32_t v_ = ((const int32_t *)(const void *)&p->soil_patches)[i_]; if (!(v_ >= 1 && v_ <= 64)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const int32_t v_ = ((const int32_t *)(const void *)&p->soil_seed)[i_]; if (!(v_ >= 0 && v_ <= 2147483647)) ++bad_; }
  for (int i_ = 0; i_ < 1; ++i_) { const int32_t v_ = ((const int32_t *)(const void *)&p->block_count)[i_]; if (!(v_ >= 0 && v_ <= 16)) ++bad_; }
  for (int i_ = 0; i_ < 8; ++i_) { const int32_t v_ = ((const int32_t *)(const void *)&p->push_link)[i_]; if (!(v_ >= 0 && v_ <= 25)) ++bad_; }
  return bad_;
}

#endif
