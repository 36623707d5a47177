/* Off-screen pictures of the robot (OSMesa). One scene in, one RGB picture out. */
#ifndef HOAP2_RENDER_RENDER_H
#define HOAP2_RENDER_RENDER_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hoap2_render hoap2_render_t;

enum { HOAP2_RENDER_MAX_FOOTPRINTS = 128, HOAP2_RENDER_MAX_BLOCKS = 16, HOAP2_RENDER_MAX_PUSHES = 8 };

typedef struct {
  double base_pos_W_m[3];
  double base_quat_W[4]; /* w x y z */
  double q_rad[25];
  double com_W_m[3];            /* CoM; a marker on the floor below it and a line */
  double cop_W_m[2];            /* net CoP */
  double cp_W_m[2];             /* capture point */
  int32_t show_overlays;        /* CoM, CoP, capture point, footprints */
  int32_t footprint_count;      /* planned or taken footprints, oldest first */
  double footprint_W_m_rad[HOAP2_RENDER_MAX_FOOTPRINTS][3]; /* sole point under the ankle x, y; yaw */
  int32_t footprint_left[HOAP2_RENDER_MAX_FOOTPRINTS];      /* 1 left foot, 0 right */
  double floor_tilt_rad[2];     /* as the plant's parameter, about floor_origin_W_m */
  double floor_origin_W_m[3];
  int32_t block_count;
  double block_centre_W_m[HOAP2_RENDER_MAX_BLOCKS][3];
  double block_size_m[HOAP2_RENDER_MAX_BLOCKS][3];
  double block_yaw_W_rad[HOAP2_RENDER_MAX_BLOCKS];
  double push_force_W_N[3];     /* arrow at push_point when not zero */
  double push_point_W_m[3];
  double camera_target_W_m[3];  /* the caller smooths it so that the camera follows */
  double camera_distance_m;
  double camera_azimuth_rad;    /* 0 looks along -x (from the front), pi/2 from the left side */
  double camera_elevation_rad;
} hoap2_scene_t;

/* NULL when OSMesa gives no context (hoap2_render_error(NULL) says why). */
hoap2_render_t *hoap2_render_create(int32_t width_px, int32_t height_px);
void hoap2_render_destroy(hoap2_render_t *render);

/* Draw into rgb (height x width x 3 bytes, top row first). Returns 0 on success. */
int hoap2_render_draw(hoap2_render_t *render, const hoap2_scene_t *scene, uint8_t *rgb);

const char *hoap2_render_error(const hoap2_render_t *render);

#ifdef __cplusplus
}
#endif
#endif
