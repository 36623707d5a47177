// What lives on the GL side: framebuffers, shader programs, vertex buffers.
#ifndef HOAP2_RENDER_STAGE_H
#define HOAP2_RENDER_STAGE_H

#include <vector>

#include "gl.h"
#include "hoap2/generated/robot_model.h"
#include "marks.h"
#include "mesh.h"
#include "soil_surface.h"

namespace hoap2 {

constexpr int kShadowSide_px = 1024;

// Rows of the table of poses after those of the links: at rest, and the pool of soil.
constexpr int kRestPose = HOAP2_LINKS, kPoolPose = HOAP2_LINKS + 1;

// Vertices with their layout; refilled every frame or once.
struct Batch {
  GLuint array = 0, vertices = 0, indices = 0;
  GLsizei count = 0;
};

struct Program {
  GLuint id = 0;
  GLint at(const Gl &gl, const char *uniform) const { return gl.GetUniformLocation(id, uniform); }
};

class Stage {
 public:
  Stage(int width_px, int height_px, int samples);
  ~Stage();
  Stage(const Stage &) = delete;
  Stage &operator=(const Stage &) = delete;

  Context context;
  int width_px, height_px, samples;

  Program solid, shadow, floor, soil, sky, mark;
  Batch robot, robot_shadow, blocks, walls, sand, floor_quad, sky_quad, footprints, marks_ground, marks_air;
  GLuint picture_buffer = 0, resolve_buffer = 0, shadow_buffer = 0, shadow_map = 0;

  void fill(Batch &batch, const Mesh &mesh) const;
  void fill(Batch &batch, const Marks &marks) const;
  void fill(Batch &batch, const std::vector<Vec3> &points) const;
  // The soil and its walls, when they changed.
  void fill_soil(SoilSurface &surface);
  void draw(const Batch &batch) const;

 private:
  void make_programs();
  void make_buffers();
  GLuint framebuffer(int buffer_samples);
  void make_shadow_map();
  void make_batch(Batch &batch, bool indexed) const;
  void destroy();

  std::vector<GLuint> renderbuffers_;
};

}  // namespace hoap2
#endif
