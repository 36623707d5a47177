#include "core/outputs.h"

#include "core/requests.h"
#include "core/scalar_math.h"
#include "hoap2/generated/robot_model.h"

#define TICK_S (1e-6 * HOAP2_TICK_US)
#define LIMIT_TOLERANCE_RAD 1e-9

int hoap2_clip_to_limits(double q_rad[HOAP2_SIZE_JOINT]) {
  int met = 0;
  for (int i = 0; i < HOAP2_SIZE_JOINT; ++i) {
    const double low = HOAP2_JOINT[i].limit_soft_rad[0];
    const double high = HOAP2_JOINT[i].limit_soft_rad[1];
    if (q_rad[i] < low - LIMIT_TOLERANCE_RAD || q_rad[i] > high + LIMIT_TOLERANCE_RAD) met = 1;
    if (q_rad[i] < low) q_rad[i] = low;
    if (q_rad[i] > high) q_rad[i] = high;
  }
  return met;
}

int hoap2_limit_references(const double q_last_rad[HOAP2_SIZE_JOINT], double q_ref_rad[HOAP2_SIZE_JOINT]) {
  for (int i = 0; i < HOAP2_SIZE_JOINT; ++i)
    if (!(q_ref_rad[i] >= -1e3 && q_ref_rad[i] <= 1e3)) q_ref_rad[i] = q_last_rad[i];
  const int met = hoap2_clip_to_limits(q_ref_rad);
  for (int i = 0; i < HOAP2_SIZE_JOINT; ++i) {
    const double step = HOAP2_JOINT[i].velocity_limit_rad_s * TICK_S;
    if (q_ref_rad[i] > q_last_rad[i] + step) q_ref_rad[i] = q_last_rad[i] + step;
    if (q_ref_rad[i] < q_last_rad[i] - step) q_ref_rad[i] = q_last_rad[i] - step;
  }
  return met;
}

/* The start pose: cos and sin of its yaw, and its place. */
typedef struct {
  double c;
  double s;
  double x_m;
  double y_m;
  double yaw_rad;
} start_pose_t;

static void point_to_world(const start_pose_t *start, const double point_O[], double point_W[]) {
  point_W[0] = start->x_m + start->c * point_O[0] - start->s * point_O[1];
  point_W[1] = start->y_m + start->s * point_O[0] + start->c * point_O[1];
}

static void vector_to_world(const start_pose_t *start, const double vector_O[], double vector_W[]) {
  vector_W[0] = start->c * vector_O[0] - start->s * vector_O[1];
  vector_W[1] = start->s * vector_O[0] + start->c * vector_O[1];
}

/* Unit quaternion (w >= 0) of the pelvis in W: yaw by the start, then the estimate in O. */
static void base_quaternion(const start_pose_t *start, const double R[3][3], double quat[4]) {
  double M[3][3];
  for (int j = 0; j < 3; ++j) {
    M[0][j] = start->c * R[0][j] - start->s * R[1][j];
    M[1][j] = start->s * R[0][j] + start->c * R[1][j];
    M[2][j] = R[2][j];
  }
  const double trace = M[0][0] + M[1][1] + M[2][2];
  int largest = 0;
  for (int i = 1; i < 3; ++i)
    if (M[i][i] > M[largest][largest]) largest = i;
  if (trace > M[largest][largest]) {
    const double w2 = hoap2_sqrt(1.0 + trace);
    quat[0] = 0.5 * w2;
    quat[1] = (M[2][1] - M[1][2]) / (2.0 * w2);
    quat[2] = (M[0][2] - M[2][0]) / (2.0 * w2);
    quat[3] = (M[1][0] - M[0][1]) / (2.0 * w2);
  } else {
    const int i = largest;
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    const double v2 = hoap2_sqrt(1.0 + M[i][i] - M[j][j] - M[k][k]);
    quat[0] = (M[k][j] - M[j][k]) / (2.0 * v2);
    quat[1 + i] = 0.5 * v2;
    quat[1 + j] = (M[j][i] + M[i][j]) / (2.0 * v2);
    quat[1 + k] = (M[k][i] + M[i][k]) / (2.0 * v2);
  }
  if (quat[0] < 0.0)
    for (int i = 0; i < 4; ++i) quat[i] = -quat[i];
}

static void fill_drives(const hoap2_params_t *params, const double q_ref_rad[], hoap2_outputs_t *out) {
  for (int i = 0; i < HOAP2_SIZE_JOINT; ++i) {
    out->drive_mode[i] = HOAP2_DRIVE_MODE_POSITION;
    out->q_ref_rad[i] = q_ref_rad[i];
    out->qd_ref_rad_s[i] = 0.0;
    out->tau_ff_Nm[i] = 0.0;
    out->kp_Nm_rad[i] = params->servo_kp_Nm_rad[i];
    out->kd_Nms_rad[i] = params->servo_kd_Nms_rad[i];
  }
}

static void fill_estimates(const start_pose_t *start, const hoap2_sense_t *sense, hoap2_outputs_t *out) {
  out->roll_est_rad = sense->roll_rad;
  out->pitch_est_rad = sense->pitch_rad;
  point_to_world(start, sense->base_pos_O_m, out->base_pos_W_m);
  out->base_pos_W_m[2] = sense->base_pos_O_m[2];
  base_quaternion(start, sense->base_rot_O, out->base_quat_W);
  point_to_world(start, sense->com_O_m, out->com_est_W_m);
  out->com_est_W_m[2] = sense->com_O_m[2];
  vector_to_world(start, sense->com_rate_O_m_s, out->com_rate_est_W_m_s);
  out->com_rate_est_W_m_s[2] = sense->com_rate_O_m_s[2];
  point_to_world(start, sense->cop_O_m, out->cop_est_W_m);
  point_to_world(start, sense->cp_O_m, out->cp_est_W_m);
  for (int foot = 0; foot < 2; ++foot) out->foot_force_est_N[foot] = sense->foot_force_N[foot];
}

static void fill_gait(const start_pose_t *start, double hip_height_m, const hoap2_gait_t *gait,
                      hoap2_outputs_t *out) {
  const double com_ref_O_m[2] = {gait->com_m[0] + gait->tpcc_m[0], gait->com_m[1] + gait->tpcc_m[1]};
  point_to_world(start, com_ref_O_m, out->com_ref_W_m);
  out->com_ref_W_m[2] = hip_height_m + gait->com_over_base_B_m[2];
  point_to_world(start, gait->com_m, out->com_plan_W_m);
  point_to_world(start, gait->cop_m, out->cop_ref_W_m);
  point_to_world(start, gait->cp_ref_m, out->cp_ref_W_m);
  point_to_world(start, gait->cp_eos_m, out->cp_eos_W_m);
  vector_to_world(start, gait->tpcc_m, out->tpcc_shift_W_m);
  vector_to_world(start, gait->com_deviation_m, out->com_deviation_W_m);
  vector_to_world(start, gait->land_shift_m, out->landing_shift_W_m);
  for (int foot = 0; foot < 2; ++foot) {
    point_to_world(start, gait->feet.pos_O_m[foot], out->foot_ref_W_m[foot]);
    out->foot_ref_W_m[foot][2] = gait->feet.pos_O_m[foot][2];
    out->foot_ref_yaw_W_rad[foot] = start->yaw_rad + gait->feet.yaw_O_rad[foot];
  }
  point_to_world(start, gait->land, out->footprint_W_m_rad);
  out->footprint_W_m_rad[2] = start->yaw_rad + gait->land[2];
  out->phase = gait->phase;
  out->step_index = gait->step_index;
  out->steps_done = gait->steps_done;
  out->stance_foot = gait->swing_foot == 2 ? 2 : 1 - gait->swing_foot;
  out->walk_done = gait->walk_done;
  for (int i = 0; i < 3; ++i) out->step_advance_m_rad[i] = gait->advance[i];
}

void hoap2_fill_outputs(hoap2_state_t *state, const double q_ref_rad[HOAP2_SIZE_JOINT]) {
  const hoap2_params_t *params = &state->params;
  const start_pose_t start = {hoap2_cos(params->start_yaw_W_rad), hoap2_sin(params->start_yaw_W_rad),
                              params->start_pos_W_m[0], params->start_pos_W_m[1], params->start_yaw_W_rad};
  fill_drives(params, q_ref_rad, &state->out);
  fill_estimates(&start, &state->sense, &state->out);
  fill_gait(&start, params->hip_height_m, &state->gait, &state->out);
  state->out.tick = state->mode.tick;
  state->out.mode = state->mode.mode;
  state->out.fault = state->mode.fault;
  state->out.request_state = hoap2_request_state(state);
}
