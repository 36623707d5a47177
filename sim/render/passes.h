// The passes of one picture: shadow map, floor and soil, solids, sky, marks.
#ifndef HOAP2_RENDER_PASSES_H
#define HOAP2_RENDER_PASSES_H

#include <vector>

#include "marks.h"
#include "stage.h"
#include "view.h"

namespace hoap2 {

// What all passes need.
struct Shot {
  const Stage &stage;
  const View &view;
  const Ground &ground;
  const SoilSurface &soil;
  const std::vector<float> &poses;  // rows of [R | p]: links, at rest, the pool
  int show;                         // bits of HOAP2_SHOW_*
};

void draw_shadow(const Shot &shot);
// Into the bound framebuffer, in this order. Footprints on soil lie under the robot.
void draw_ground(const Shot &shot);
void draw_solids(const Shot &shot);
void draw_sky(const Shot &shot);
void draw_marks(const Shot &shot);

}  // namespace hoap2
#endif
