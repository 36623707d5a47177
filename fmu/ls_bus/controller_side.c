/* The controller behind two bus terminals: its outputs become frames, the boards' frames its inputs. */
#include <string.h>

#include "can/controller_node.h"
#include "ls_bus/generated/tokens.h"
#include "ls_bus/side.h"

static void start(void *side) { hoap2_can_controller_init(side); }

static void receive(void *side, int terminal, const hoap2_can_frame_t *frame, int64_t now_ns) {
  (void)now_ns;
  hoap2_can_controller_receive(side, terminal, frame);
}

/* The step that began at the tick before, with what was measured there. The operator's inputs stay as they are. */
static void step(hoap2_fmu_instance_t *self, const hoap2_inputs_t *measured) {
  hoap2_inputs_t *inputs = self->group[HOAP2_FMU_INPUT];
  memcpy(inputs->q_enc_rad, measured->q_enc_rad, sizeof inputs->q_enc_rad);
  memcpy(inputs->gyro_S_rad_s, measured->gyro_S_rad_s, sizeof inputs->gyro_S_rad_s);
  memcpy(inputs->accel_S_m_s2, measured->accel_S_m_s2, sizeof inputs->accel_S_m_s2);
  memcpy(inputs->cell_force_N, measured->cell_force_N, sizeof inputs->cell_force_N);
  inputs->sensor_tick = measured->sensor_tick;
  hoap2_product_step(self->model, inputs); /* the controller never fails */
  hoap2_product_get_outputs(self->model, self->group[HOAP2_FMU_OUTPUT]);
}

static void tick(hoap2_fmu_instance_t *self, void *side, int64_t number) {
  hoap2_inputs_t measured;
  memset(&measured, 0, sizeof measured);
  if (number > 0) hoap2_can_controller_inputs(side, &measured);
  if (number > HOAP2_LS_BOOT_TICKS) step(self, &measured);
  hoap2_can_outbox_t out[HOAP2_CAN_BUSES];
  for (int b = 0; b < HOAP2_CAN_BUSES; ++b) out[b].count = 0;
  hoap2_can_controller_send(side, self->group[HOAP2_FMU_OUTPUT], out);
  for (int b = 0; b < HOAP2_CAN_BUSES; ++b) {
    for (int i = 0; i < out[b].count; ++i) hoap2_ls_send(self, b, &out[b].frame[i]);
  }
}

static int advance(hoap2_fmu_instance_t *self, void *side, int64_t number) {
  (void)self;
  (void)side;
  (void)number;
  return 0;
}

static int is_whole(const void *side) {
  const hoap2_can_controller_t *node = side;
  return node->tick >= 0 && node->request_board >= -1 && node->request_board < HOAP2_CAN_BOARDS;
}

const hoap2_ls_side_t HOAP2_LS_SIDE = {
    .name = "hoap2_controller_ls_bus",
    .token = HOAP2_LS_CONTROLLER_TOKEN,
    .terminals = HOAP2_CAN_BUSES,
    .size = sizeof(hoap2_can_controller_t),
    .start = start,
    .receive = receive,
    .tick = tick,
    .advance = advance,
    .is_whole = is_whole,
};
