/* The soil of a finished run, from its motion alone.
 *
 * What the links leave in the soil follows from where they were: the replay moves them through a
 * fresh pool again, tick by tick, with the plant's own soil. So a log of poses is enough, and no
 * height field has to be logged.
 */
#ifndef HOAP2_RENDER_SOIL_REPLAY_H
#define HOAP2_RENDER_SOIL_REPLAY_H

#include <stddef.h>
#include <stdint.h>

#include "hoap2_plant/generated/plant_signals.h"
#include "hoap2_render/render.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hoap2_soil_replay hoap2_soil_replay_t;

/* A fresh pool. NULL when there is none of these parameters; hoap2_soil_replay_error(NULL) says why. */
HOAP2_RENDER_API hoap2_soil_replay_t *hoap2_soil_replay_create(const hoap2_plant_params_t *params);
HOAP2_RENDER_API void hoap2_soil_replay_destroy(hoap2_soil_replay_t *replay);

/* Back to the fresh pool. */
HOAP2_RENDER_API void hoap2_soil_replay_restart(hoap2_soil_replay_t *replay);

/* The next `count` rows of the log, one a tick of 1 ms: true_base_pos_W_m (3 a row), true_base_quat_W
 * (4), true_q_rad (25). The first row ever is the start and changes nothing. Returns 0, or non-zero when
 * the run could not have gone on there (a foot outside the pool); the soil then stays as it is. */
HOAP2_RENDER_API int hoap2_soil_replay_advance(hoap2_soil_replay_t *replay, int64_t count,
                                               const double *base_pos_W_m, const double *base_quat_W,
                                               const double *q_rad);

/* Size and place of the pool: constant. */
HOAP2_RENDER_API void hoap2_soil_replay_grid(const hoap2_soil_replay_t *replay, hoap2_soil_grid_t *grid);

/* The surface without load, as hoap2_render_set_soil() takes it: ny rows of nx cells each. */
HOAP2_RENDER_API void hoap2_soil_replay_surface(const hoap2_soil_replay_t *replay, float *height_m,
                                                float *change_m);

/* Error text of the replay, or with NULL of the last failed create of this thread; "" if none. */
HOAP2_RENDER_API const char *hoap2_soil_replay_error(const hoap2_soil_replay_t *replay);

/* sizeof the structs of the library, for bindings to check their layout. */
HOAP2_RENDER_API size_t hoap2_soil_replay_params_size(void);
HOAP2_RENDER_API size_t hoap2_soil_replay_grid_size(void);

#ifdef __cplusplus
}
#endif
#endif
