#include "stage.h"

#include <cstddef>
#include <stdexcept>

#include "robot_shape.h"
#include "shaders.h"
#include "soil_tiles.h"

namespace hoap2 {
namespace {

const void *offset(size_t bytes) { return reinterpret_cast<const void *>(bytes); }

void attribute(const Gl &gl, GLuint index, GLint size, size_t stride, size_t at) {
  gl.EnableVertexAttribArray(index);
  gl.VertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride), offset(at));
}

template <class T>
void upload(const Gl &gl, GLenum target, GLuint buffer, const std::vector<T> &data) {
  gl.BindBuffer(target, buffer);
  gl.BufferData(target, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(), GL_DYNAMIC_DRAW);
}

}  // namespace

Stage::Stage(int width, int height, int samples_wanted)
    : width_px(width), height_px(height), samples(samples_wanted) {
  const Current current(context);
  try {
    make_programs();
    make_buffers();
  } catch (...) {
    destroy();
    throw;
  }
}

Stage::~Stage() {
  const Current current(context);
  destroy();
}

void Stage::make_programs() {
  using namespace shader;
  const Gl &gl = context.gl();
  const char *solid_inputs[] = {"a_pos", "a_normal", "a_albedo", "a_gloss_link"};
  const char *soil_inputs[] = {"a_pos", "a_normal", "a_change_open"};
  const char *mark_inputs[] = {"a_pos", "a_normal", "a_colour"};
  solid.id =
      build_program(gl, "solid", kHeader + kSolidVertex, kHeader + kLight + kSolidFragment, solid_inputs, 4);
  shadow.id = build_program(gl, "shadow", kHeader + kSolidVertex, kHeader + kShadowFragment, solid_inputs, 4);
  floor.id =
      build_program(gl, "floor", kHeader + kFloorVertex, kHeader + kLight + kFloorFragment, solid_inputs, 1);
  soil.id =
      build_program(gl, "soil", kHeader + kSoilVertex, kHeader + kLight + kSoilFragment, soil_inputs, 3);
  sky.id = build_program(gl, "sky", kHeader + kSkyVertex, kHeader + kLight + kSkyFragment, solid_inputs, 1);
  mark.id = build_program(gl, "mark", kHeader + kMarkVertex, kHeader + kMarkFragment, mark_inputs, 3);
}

void Stage::make_buffers() {
  for (Batch *batch : {&robot, &robot_shadow, &blocks, &walls, &sand}) make_batch(*batch, true);
  for (Batch *batch : {&floor_quad, &sky_quad, &footprints, &marks_ground, &marks_air})
    make_batch(*batch, false);
  fill(robot, robot_mesh(Detail::picture));
  fill(robot_shadow, robot_mesh(Detail::shadow));
  fill(sky_quad, std::vector<Vec3>{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
  picture_buffer = framebuffer(samples > 1 ? samples : 0);
  resolve_buffer = samples > 1 ? framebuffer(0) : 0;
  make_shadow_map();
}

GLuint Stage::framebuffer(int buffer_samples) {
  const Gl &gl = context.gl();
  GLuint id = 0;
  gl.GenFramebuffers(1, &id);
  gl.BindFramebuffer(GL_FRAMEBUFFER, id);
  const GLenum formats[] = {GL_RGBA8, GL_DEPTH_COMPONENT24};
  const GLenum points[] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT};
  for (int i = 0; i < 2; ++i) {
    GLuint buffer = 0;
    gl.GenRenderbuffers(1, &buffer);
    renderbuffers_.push_back(buffer);
    gl.BindRenderbuffer(GL_RENDERBUFFER, buffer);
    gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, buffer_samples, formats[i], width_px, height_px);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, points[i], GL_RENDERBUFFER, buffer);
  }
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    gl.DeleteFramebuffers(1, &id);
    throw std::runtime_error("OSMesa cannot make a picture of " + std::to_string(width_px) + "x" +
                             std::to_string(height_px) + " with " + std::to_string(samples) + " samples");
  }
  return id;
}

void Stage::make_shadow_map() {
  const Gl &gl = context.gl();
  gl.GenTextures(1, &shadow_map);
  gl.BindTexture(GL_TEXTURE_2D, shadow_map);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, kShadowSide_px, kShadowSide_px, 0, GL_DEPTH_COMPONENT,
                GL_UNSIGNED_INT, nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  gl.GenFramebuffers(1, &shadow_buffer);
  gl.BindFramebuffer(GL_FRAMEBUFFER, shadow_buffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, shadow_map, 0);
  gl.DrawBuffer(GL_NONE);
  gl.ReadBuffer(GL_NONE);
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error("OSMesa cannot make a shadow map");
  }
}

void Stage::make_batch(Batch &batch, bool indexed) const {
  const Gl &gl = context.gl();
  gl.GenVertexArrays(1, &batch.array);
  gl.GenBuffers(1, &batch.vertices);
  if (indexed) gl.GenBuffers(1, &batch.indices);
}

void Stage::fill(Batch &batch, const Mesh &mesh) const {
  const Gl &gl = context.gl();
  gl.BindVertexArray(batch.array);
  upload(gl, GL_ARRAY_BUFFER, batch.vertices, mesh.vertices);
  upload(gl, GL_ELEMENT_ARRAY_BUFFER, batch.indices, mesh.indices);
  attribute(gl, 0, 3, sizeof(Vertex), offsetof(Vertex, pos));
  attribute(gl, 1, 3, sizeof(Vertex), offsetof(Vertex, normal));
  attribute(gl, 2, 3, sizeof(Vertex), offsetof(Vertex, albedo));
  attribute(gl, 3, 2, sizeof(Vertex), offsetof(Vertex, gloss));
  batch.count = static_cast<GLsizei>(mesh.indices.size());
}

void Stage::fill(Batch &batch, const Marks &marks) const {
  const Gl &gl = context.gl();
  gl.BindVertexArray(batch.array);
  upload(gl, GL_ARRAY_BUFFER, batch.vertices, marks);
  attribute(gl, 0, 3, sizeof(MarkVertex), offsetof(MarkVertex, pos));
  attribute(gl, 1, 3, sizeof(MarkVertex), offsetof(MarkVertex, normal));
  attribute(gl, 2, 4, sizeof(MarkVertex), offsetof(MarkVertex, colour));
  batch.count = static_cast<GLsizei>(marks.size());
}

void Stage::fill(Batch &batch, const std::vector<Vec3> &points) const {
  const Gl &gl = context.gl();
  gl.BindVertexArray(batch.array);
  upload(gl, GL_ARRAY_BUFFER, batch.vertices, points);
  attribute(gl, 0, 3, sizeof(Vec3), 0);
  batch.count = static_cast<GLsizei>(points.size());
}

void Stage::fill_soil(SoilSurface &surface) {
  if (!surface.exists() || !surface.take_change()) return;
  const Gl &gl = context.gl();
  const SoilMesh mesh = soil_mesh(surface);
  gl.BindVertexArray(sand.array);
  upload(gl, GL_ARRAY_BUFFER, sand.vertices, mesh.vertices);
  upload(gl, GL_ELEMENT_ARRAY_BUFFER, sand.indices, mesh.indices);
  attribute(gl, 0, 3, sizeof(SoilVertex), offsetof(SoilVertex, pos));
  attribute(gl, 1, 3, sizeof(SoilVertex), offsetof(SoilVertex, normal));
  attribute(gl, 2, 2, sizeof(SoilVertex), offsetof(SoilVertex, change_m));
  sand.count = static_cast<GLsizei>(mesh.indices.size());
  fill(walls, wall_mesh(surface, kPoolPose));
}

void Stage::draw(const Batch &batch) const {
  if (batch.count == 0) return;
  const Gl &gl = context.gl();
  gl.BindVertexArray(batch.array);
  if (batch.indices != 0) {
    gl.DrawElements(GL_TRIANGLES, batch.count, GL_UNSIGNED_INT, nullptr);
  } else {
    gl.DrawArrays(GL_TRIANGLES, 0, batch.count);
  }
}

void Stage::destroy() {
  const Gl &gl = context.gl();
  for (const Program *program : {&solid, &shadow, &floor, &soil, &sky, &mark}) {
    if (program->id != 0) gl.DeleteProgram(program->id);
  }
  for (Batch *batch : {&robot, &robot_shadow, &blocks, &walls, &sand, &floor_quad, &sky_quad, &footprints,
                       &marks_ground, &marks_air}) {
    if (batch->array != 0) gl.DeleteVertexArrays(1, &batch->array);
    if (batch->vertices != 0) gl.DeleteBuffers(1, &batch->vertices);
    if (batch->indices != 0) gl.DeleteBuffers(1, &batch->indices);
  }
  for (const GLuint buffer : {picture_buffer, resolve_buffer, shadow_buffer}) {
    if (buffer != 0) gl.DeleteFramebuffers(1, &buffer);
  }
  if (!renderbuffers_.empty()) {
    gl.DeleteRenderbuffers(static_cast<GLsizei>(renderbuffers_.size()), renderbuffers_.data());
  }
  if (shadow_map != 0) gl.DeleteTextures(1, &shadow_map);
}

}  // namespace hoap2
