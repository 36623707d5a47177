/* Memory of the capture-point gait. Everything is in the start frame O. */
#ifndef HOAP2_GAIT_CP_GAIT_STATE_H
#define HOAP2_GAIT_CP_GAIT_STATE_H

#include <stdint.h>

#include "hoap2/generated/signals.h"
#include "sense/sense_state.h"

/* What the operator asks for, as the firmware has taken it: finite, and within its range. */
typedef struct {
  double step[3]; /* advance of a step: length (m), sideways (m), turn (rad) */
  int32_t walk;   /* HOAP2_WALK_REQUEST_* */
} hoap2_request_t;

typedef struct {
  /* pendulum constants */
  double omega_1_s; /* sqrt(g / com_height) */
  double cosh_tick; /* cosh and sinh of omega times one tick */
  double sinh_tick;
  double exp_tick;

  /* footprints: x (m), y (m), yaw (rad) */
  double centre[3];       /* walking centre: where the middle between the feet would be */
  double foot[2][3];      /* where each foot stands or last stood */
  double land[3];         /* landing target of the step under way */
  double land_nominal[3]; /* the same without landing position control */
  double heading_from_rad;
  double heading_to_rad;
  double heading_rad; /* of the pelvis now */

  /* plan of the step */
  double com_m[2]; /* CoM of the plan, (7.13) */
  double com_rate_m_s[2];
  double cp_start_m[2]; /* (7.8) */
  double cp_eos_m[2];
  double cop_step_m[2];     /* desired CoP of the step, (7.9) after the clamp */
  double cop_from_m[2];     /* CoP when the step began, for the ramp */
  double cop_m[2];          /* desired CoP now */
  double cp_ref_m[2];       /* (7.10) */
  double cp_deviation_m[2]; /* sensed capture point against that of the CoM reference, low-passed */

  /* torso position compliance */
  double cop_error_m[2];
  double tpcc_m[2];
  double tpcc_rate_m_s[2];

  /* landing position control, (7.14) */
  double com_late_m[2];      /* CoM reference, as late as the sensors show the CoM */
  double com_deviation_m[2]; /* sensed CoM minus that */
  double lpc_axes_rad;       /* direction of the walk: along, across */
  double lpc_extreme_m[2];   /* along, across: signed extreme of the deviation in the step under way */
  double lpc_shift_m[2];     /* along, across: shift of the landing of the step under way */
  double land_shift_m[2];    /* the same in O */
  double foot_shift_m[2][2]; /* in O: of each foot where it stands, against its nominal footprint */
  double com_by_legs; /* how far the CoM moves in the pelvis for each metre that both feet move under it */

  /* whole-body map */
  double com_over_base_B_m[3]; /* CoM against the pelvis, last solution */
  double q_ref_rad[HOAP2_SIZE_JOINT];
  hoap2_feet_t feet;

  /* requests */
  hoap2_request_t request;
  double advance[3];      /* of the step under way, as request.step */
  int32_t on_request;     /* 1: the walk takes the requested steps and goes on until it is told to stop */
  int32_t drawn_in;       /* 1: the step under way is shorter than requested, the legs could not do it */
  int32_t closing;        /* 1: the step under way ends the walk */
  int32_t in_place_fault; /* faults of steps in place with these parameters; 0: a walk on request may begin */

  int32_t phase;
  int32_t step_index; /* 0 while the capture point travels to the first stance foot */
  int32_t steps_done;
  int32_t step_tick; /* ticks since the step began */
  int32_t step_ticks;
  int32_t swing_foot; /* 0 right, 1 left; 2 none */
  int32_t walking;    /* 1 from the first shift to the end of the settling */
  int32_t walk_done;
  int32_t stop_requested; /* the step under way is the last */
  int32_t pulled_back;    /* 1 when a leg target of this tick was out of reach */
  int32_t joint_limit;    /* 1 when a leg target of this tick met a joint limit */
  int32_t cp_lost;        /* 1: the walk ended with the capture point off the soles */
  int32_t feedback;       /* 1: sensed values are used, 0: open loop */
} hoap2_gait_t;

#endif
