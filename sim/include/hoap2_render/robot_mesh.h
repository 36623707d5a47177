/* The robot's surface as the pictures draw it, for viewers that draw it themselves. */
#ifndef HOAP2_RENDER_ROBOT_MESH_H
#define HOAP2_RENDER_ROBOT_MESH_H

#include <stdint.h>

#include "hoap2_render/render.h"

#ifdef __cplusplus
extern "C" {
#endif

/* In the frame of its link (index in hoap2.json). */
typedef struct {
  float pos_L_m[3];
  float normal_L[3];
  float albedo[3]; /* linear */
  float gloss;     /* 0 matt .. 1 lacquer */
  float link;
} hoap2_mesh_vertex_t;

/* coarse: 0 as in the pictures; otherwise fewer triangles and no small parts, as in their shadows. */

/* Number of vertices and of indices (three a triangle, counter-clockwise from outside). Returns 0 on success. */
HOAP2_RENDER_API int hoap2_render_robot_mesh_size(int32_t coarse, int32_t *vertices, int32_t *indices);

/* Fill both arrays, which have the sizes above. Returns 0 on success. */
HOAP2_RENDER_API int hoap2_render_robot_mesh(int32_t coarse, hoap2_mesh_vertex_t *vertex, uint32_t *index);

#ifdef __cplusplus
}
#endif
#endif
