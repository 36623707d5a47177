#include "passes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hoap2 {
namespace {

// Screen colours of level soil in the light: full sinkage, half, untouched, half raised, fully raised.
// From dark blue to cream, so that they also differ in brightness. The same stand in the legend of
// host_tools/hoap2/picture_labels.py.
constexpr std::array<Vec3, 5> kTint = {
    {{24, 50, 100}, {92, 122, 152}, {205, 180, 138}, {232, 214, 176}, {255, 246, 222}}};
// What of the scale of the sinkage is the scale of the rise: rims are lower than ruts are deep.
constexpr float kRiseShare = 0.2F;

void set(const Gl &gl, GLint location, Vec3 v) { gl.Uniform3f(location, v.x, v.y, v.z); }

// Light on level ground in the lamp (shaders.h), which the tints are meant for.
constexpr float kLevelLight = 1.18F;

// Inverse of `display` in shaders.h.
float linear(float screen) {
  const float y = std::pow(screen / 255.0F, 2.2F);
  const float b = 1.0F - 0.42F * y;
  return (std::sqrt(b * b + 0.4F * y) - b) / 0.2F;
}

void set_light(const Shot &shot, const Program &program) {
  const Gl &gl = shot.stage.context.gl();
  const View &view = shot.view;
  gl.UseProgram(program.id);
  gl.UniformMatrix4fv(program.at(gl, "u_camera"), 1, GL_FALSE, view.camera.m.data());
  gl.UniformMatrix4fv(program.at(gl, "u_shadow"), 1, GL_FALSE, view.shadow_map.m.data());
  set(gl, program.at(gl, "u_eye"), view.eye);
  set(gl, program.at(gl, "u_light"), view.light);
  gl.Uniform1i(program.at(gl, "u_shadow_map"), 0);
  gl.Uniform1f(program.at(gl, "u_shadow_on"), (shot.show & HOAP2_SHOW_SHADOW) != 0 ? 1.0F : 0.0F);
}

void set_poses(const Gl &gl, const Program &program, const std::vector<float> &poses) {
  gl.Uniform4fv(program.at(gl, "u_pose"), static_cast<GLsizei>(poses.size() / 4), poses.data());
}

void draw_floor(const Shot &shot) {
  const Stage &stage = shot.stage;
  const Gl &gl = stage.context.gl();
  set_light(shot, stage.floor);
  set(gl, stage.floor.at(gl, "u_floor_normal"), shot.ground.normal());
  gl.Uniform1f(stage.floor.at(gl, "u_fade_m"), shot.view.fade_m);
  stage.draw(stage.floor_quad);
}

void draw_sand(const Shot &shot) {
  const Stage &stage = shot.stage;
  const Gl &gl = stage.context.gl();
  set_light(shot, stage.soil);
  const size_t pool = 12 * static_cast<size_t>(kPoolPose);
  gl.Uniform4fv(stage.soil.at(gl, "u_pool"), 3, shot.poses.data() + pool);
  std::array<float, 15> tint{};
  for (size_t k = 0; k < 5; ++k) {
    const Vec3 c = (shot.show & HOAP2_SHOW_SINKAGE) != 0 ? kTint[k] : kTint[2];
    tint[3 * k] = linear(c.x) / kLevelLight;
    tint[3 * k + 1] = linear(c.y) / kLevelLight;
    tint[3 * k + 2] = linear(c.z) / kLevelLight;
  }
  gl.Uniform3fv(stage.soil.at(gl, "u_tint"), 5, tint.data());
  const float steps_per_m = 2.0F * shot.soil.per_full_scale();
  gl.Uniform2f(stage.soil.at(gl, "u_per_m"), steps_per_m, steps_per_m / kRiseShare);
  stage.draw(stage.sand);
}

void begin_marks(const Shot &shot) {
  const Gl &gl = shot.stage.context.gl();
  const Program &mark = shot.stage.mark;
  gl.UseProgram(mark.id);
  gl.UniformMatrix4fv(mark.at(gl, "u_camera"), 1, GL_FALSE, shot.view.camera.m.data());
  set(gl, mark.at(gl, "u_light"), shot.view.light);
  gl.Uniform1f(mark.at(gl, "u_alpha"), 1.0F);
  gl.Enable(GL_BLEND);
  gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl.DepthMask(GL_FALSE);
}

void end_marks(const Gl &gl) {
  gl.DepthMask(GL_TRUE);
  gl.Disable(GL_BLEND);
}

}  // namespace

void draw_shadow(const Shot &shot) {
  const Stage &stage = shot.stage;
  const Gl &gl = stage.context.gl();
  gl.BindFramebuffer(GL_FRAMEBUFFER, stage.shadow_buffer);
  gl.Viewport(0, 0, kShadowSide_px, kShadowSide_px);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  gl.Enable(GL_DEPTH_CLAMP);
  gl.UseProgram(stage.shadow.id);
  gl.UniformMatrix4fv(stage.shadow.at(gl, "u_camera"), 1, GL_FALSE, shot.view.shadow_clip.m.data());
  set_poses(gl, stage.shadow, shot.poses);
  stage.draw(stage.robot_shadow);
  stage.draw(stage.blocks);
  gl.Disable(GL_DEPTH_CLAMP);
}

void draw_ground(const Shot &shot) {
  const Gl &gl = shot.stage.context.gl();
  gl.BindTexture(GL_TEXTURE_2D, shot.stage.shadow_map);
  draw_floor(shot);
  if (!shot.soil.exists()) return;
  draw_sand(shot);
  // They lie where the untouched surface was: rims would hide parts of them.
  begin_marks(shot);
  gl.DepthFunc(GL_ALWAYS);
  shot.stage.draw(shot.stage.footprints);
  gl.DepthFunc(GL_LEQUAL);
  end_marks(gl);
}

void draw_solids(const Shot &shot) {
  const Stage &stage = shot.stage;
  const Gl &gl = stage.context.gl();
  gl.BindTexture(GL_TEXTURE_2D, stage.shadow_map);
  set_light(shot, stage.solid);
  const Vec3 n = shot.ground.normal();
  const float plane[4] = {n.x, n.y, n.z, -dot(n, shot.ground.floor_point(0.0F, 0.0F))};
  gl.Uniform4fv(stage.solid.at(gl, "u_floor"), 1, plane);
  set_poses(gl, stage.solid, shot.poses);
  stage.draw(stage.robot);
  stage.draw(stage.blocks);
  if (shot.soil.exists()) stage.draw(stage.walls);
}

void draw_sky(const Shot &shot) {
  const Stage &stage = shot.stage;
  const Gl &gl = stage.context.gl();
  const Vec3 forward = unit(shot.view.target - shot.view.eye);
  const float level = std::sqrt(std::max(0.0F, 1.0F - forward.z * forward.z));
  const float half = std::tan(0.5F * static_cast<float>(HOAP2_RENDER_FOV_Y_RAD));
  gl.UseProgram(stage.sky.id);
  set(gl, stage.sky.at(gl, "u_ray_z"), {0.0F, half * level, forward.z});
  gl.DepthMask(GL_FALSE);
  stage.draw(stage.sky_quad);
  gl.DepthMask(GL_TRUE);
}

void draw_marks(const Shot &shot) {
  const Stage &stage = shot.stage;
  const Gl &gl = stage.context.gl();
  begin_marks(shot);
  const GLint alpha = stage.mark.at(gl, "u_alpha");
  // On the ground: drawn in order, without depth among themselves.
  gl.Enable(GL_POLYGON_OFFSET_FILL);
  gl.PolygonOffset(-1.0F, -8.0F);
  if (!shot.soil.exists()) stage.draw(stage.footprints);
  // What the robot hides of the rest shines through, then the visible part comes in full.
  gl.DepthFunc(GL_GREATER);
  gl.Uniform1f(alpha, 0.62F);
  stage.draw(stage.marks_ground);
  stage.draw(stage.marks_air);
  gl.DepthFunc(GL_LEQUAL);
  gl.Uniform1f(alpha, 1.0F);
  stage.draw(stage.marks_ground);
  gl.Disable(GL_POLYGON_OFFSET_FILL);
  gl.DepthMask(GL_TRUE);
  stage.draw(stage.marks_air);
  end_marks(gl);
}

}  // namespace hoap2
