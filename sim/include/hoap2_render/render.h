/* Off-screen pictures of the robot (OSMesa). One scene in, one RGB picture out.
 *
 * Renderers are independent. A renderer may be used from any thread, one thread at
 * a time. World frame: x forward, y left, z up.
 */
#ifndef HOAP2_RENDER_RENDER_H
#define HOAP2_RENDER_RENDER_H

#include <stddef.h>
#include <stdint.h>

#ifndef HOAP2_RENDER_API
#define HOAP2_RENDER_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hoap2_render hoap2_render_t;

enum {
  HOAP2_RENDER_MAX_FOOTPRINTS = 128,
  HOAP2_RENDER_MAX_BLOCKS = 16,
  HOAP2_RENDER_MIN_SIDE_PX = 16,
  HOAP2_RENDER_MAX_SIDE_PX = 4096
};

/* Vertical field of view of the camera. */
#define HOAP2_RENDER_FOV_Y_RAD 0.5

/* Bits of show. */
enum {
  HOAP2_SHOW_COM = 1,        /* ball, plumb line, dot on the ground */
  HOAP2_SHOW_COP = 2,        /* dot on the ground */
  HOAP2_SHOW_CP = 4,         /* ring with a dot on the ground */
  HOAP2_SHOW_FOOTPRINTS = 8, /* outlined soles */
  HOAP2_SHOW_PUSH = 16,      /* arrow that ends at the point of application */
  HOAP2_SHOW_SHADOW = 32,
  HOAP2_SHOW_SINKAGE = 64, /* soil coloured by its depth below the untouched surface */
  HOAP2_SHOW_ALL = 127
};

typedef struct {
  double base_pos_W_m[3];
  double base_quat_W[4]; /* w x y z */
  double q_rad[25];      /* in the joint order of hoap2.json */
  double com_W_m[3];     /* markers with a value that is not finite are left out */
  double cop_W_m[2];
  double cp_W_m[2];
  double footprint_W_m_rad[HOAP2_RENDER_MAX_FOOTPRINTS]
                          [3]; /* sole point under the ankle x, y; yaw; oldest first */
  double floor_tilt_rad[2];    /* about x, then about y of the tilted floor, through floor_origin_W_m */
  double floor_origin_W_m[3];
  double block_centre_W_m[HOAP2_RENDER_MAX_BLOCKS][3];
  double block_size_m[HOAP2_RENDER_MAX_BLOCKS][3];
  double block_yaw_W_rad[HOAP2_RENDER_MAX_BLOCKS];
  double push_force_W_N[3];
  double push_point_W_m[3];
  double camera_target_W_m[3]; /* the caller smooths it so that the camera follows */
  double camera_distance_m;
  double camera_azimuth_rad;   /* 0: from the front, looking along -x; pi/2: from the left side */
  double camera_elevation_rad; /* height of the camera over the target */
  int32_t footprint_left[HOAP2_RENDER_MAX_FOOTPRINTS]; /* 1 left foot, 0 right */
  int32_t footprint_count;
  int32_t block_count;
  int32_t show;
} hoap2_scene_t;

/* A pool of soil in the floor: a grid of square cells in a frame of its own, whose z = 0 is the
 * floor. The pool's walls stand at the border of the grid. */
typedef struct {
  double origin_W_m[3];
  double axes_W[9]; /* rows of the rotation from the pool's frame to the world */
  double low_x_m;   /* corner of cell (0, 0) */
  double low_y_m;
  double cell_m;
  double depth_m;
  int32_t nx, ny;
} hoap2_soil_grid_t;

/* samples: 1 (fast) or 4 (smooth edges). NULL when the size is out of range or OSMesa
 * gives no context; hoap2_render_error(NULL) then says why. */
HOAP2_RENDER_API hoap2_render_t *hoap2_render_create(int32_t width_px, int32_t height_px, int32_t samples);
HOAP2_RENDER_API void hoap2_render_destroy(hoap2_render_t *render);

/* Draw into rgb (height x width x 3 bytes, top row first). Returns 0 on success. */
HOAP2_RENDER_API int hoap2_render_draw(hoap2_render_t *render, const hoap2_scene_t *scene, uint8_t *rgb);

/* The soil of the pictures from now on; grid NULL: none. Both fields are ny rows of nx cells and are
 * copied: the surface in the pool's frame, and the same against the untouched surface. The colour
 * scale ends at a sinkage of full_scale_m. Returns 0 on success. */
HOAP2_RENDER_API int hoap2_render_set_soil(hoap2_render_t *render, const hoap2_soil_grid_t *grid,
                                           const float *height_m, const float *change_m, double full_scale_m);

/* Where a point appears: column, row from the top left corner (in pixels), distance along
 * the line of sight (m). Returns 0, or non-zero when it is behind the camera. */
HOAP2_RENDER_API int hoap2_render_project(const hoap2_render_t *render, const hoap2_scene_t *scene,
                                          const double point_W_m[3], double column_row_depth[3]);

/* Pose of a link (index in hoap2.json) as it is drawn: rows of [R | p], world frame. */
HOAP2_RENDER_API int hoap2_render_link_pose(const hoap2_scene_t *scene, int32_t link, double pose_W[12]);

/* Error text of the renderer, or with NULL of the last failed create of this thread; "" if none. */
HOAP2_RENDER_API const char *hoap2_render_error(const hoap2_render_t *render);

/* sizeof(hoap2_scene_t) of the library, for bindings to check their layout. */
HOAP2_RENDER_API size_t hoap2_render_scene_size(void);

#ifdef __cplusplus
}
#endif
#endif
