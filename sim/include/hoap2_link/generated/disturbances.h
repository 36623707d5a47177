/* Generated from firmware/can.toml and firmware/hoap2.json by ./hoap2 generate: do not edit. */
#ifndef HOAP2_LINK_GENERATED_DISTURBANCES_H
#define HOAP2_LINK_GENERATED_DISTURBANCES_H
#include <stdint.h>

typedef struct {
  double loss; /* share of frames that reach nobody, unnoticed by the sender [1] */
  double corrupt; /* share of transmissions hit by a bit error that every node sees; they are repeated [1] */
  double corrupt_at_one; /* share of transmissions in which one receiver sees a bit error; they are repeated [1] */
  double residual; /* share of frames that arrive with one byte changed, unseen by the bus [1] */
  double delay; /* share of frames that arrive late [1] */
  double delay_s; /* how late [s] */
  double babble_start_s; /* when it begins [s] */
  double babble_s; /* how long; 0: never [s] */
  double drop_start_s; /* when it leaves [s] */
  double drop_s; /* how long; 0: never [s] */
  double cut_start_s; /* when it is cut [s] */
  double cut_s; /* how long; 0: never [s] */
  double stop_start_s; /* when the stop button of the posture board is pressed; 0: never [s] */
  double second_start_s; /* when a second controller comes on both buses; 0: never [s] */
  double second_late_s; /* its phase in the tick, behind the first one [s] */
  int32_t seed; /* seed of the random disturbances, together with that of the run [1] */
  int32_t babble_node; /* node that babbles [1] */
  int32_t babble_identifier; /* identifier that it babbles with [1] */
  int32_t drop_node; /* node that leaves its bus [1] */
  int32_t cut_bus; /* bus whose wire is cut between the controller and the boards [1] */
} hoap2_link_params_t;

static inline void hoap2_link_params_defaults(hoap2_link_params_t *p) {
  p->loss = 0.0;
  p->corrupt = 0.0;
  p->corrupt_at_one = 0.0;
  p->residual = 0.0;
  p->delay = 0.0;
  p->delay_s = 0.002;
  p->babble_start_s = 0.0;
  p->babble_s = 0.0;
  p->drop_start_s = 0.0;
  p->drop_s = 0.0;
  p->cut_start_s = 0.0;
  p->cut_s = 0.0;
  p->stop_start_s = 0.0;
  p->second_start_s = 0.0;
  p->second_late_s = 0.0004;
  p->seed = 0;
  p->babble_node = 5;
  p->babble_identifier = 16;
  p->drop_node = 1;
  p->cut_bus = 2;
}

/* false for NaN too */
static inline int hoap2_link_params_in_range(const hoap2_link_params_t *p) {
  return p->loss >= 0.0 && p->loss <= 1.0 &&
         p->corrupt >= 0.0 && p->corrupt <= 1.0 &&
         p->corrupt_at_one >= 0.0 && p->corrupt_at_one <= 1.0 &&
         p->residual >= 0.0 && p->residual <= 1.0 &&
         p->delay >= 0.0 && p->delay <= 1.0 &&
         p->delay_s >= 0.0 && p->delay_s <= 0.1 &&
         p->babble_start_s >= 0.0 && p->babble_start_s <= 1000.0 &&
         p->babble_s >= 0.0 && p->babble_s <= 1000.0 &&
         p->drop_start_s >= 0.0 && p->drop_start_s <= 1000.0 &&
         p->drop_s >= 0.0 && p->drop_s <= 1000.0 &&
         p->cut_start_s >= 0.0 && p->cut_start_s <= 1000.0 &&
         p->cut_s >= 0.0 && p->cut_s <= 1000.0 &&
         p->stop_start_s >= 0.0 && p->stop_start_s <= 1000.0 &&
         p->second_start_s >= 0.0 && p->second_start_s <= 1000.0 &&
         p->second_late_s >= 0.0 && p->second_late_s <= 0.001 &&
         p->seed >= 0 && p->seed <= 2147483647 &&
         p->babble_node >= 0 && p->babble_node <= 15 &&
         p->babble_identifier >= 0 && p->babble_identifier <= 2047 &&
         p->drop_node >= 0 && p->drop_node <= 15 &&
         p->cut_bus >= 0 && p->cut_bus <= 2;
}

#endif
