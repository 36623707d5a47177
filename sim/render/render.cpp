#include "hoap2_render/render.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "kinematics.h"
#include "stage.h"
#include "view.h"

struct hoap2_render {
  std::unique_ptr<hoap2::Stage> stage;
  std::vector<uint8_t> rows_bottom_up;
  std::string error;
};

namespace {

using namespace hoap2;

thread_local std::string g_create_error;  // there is no renderer yet that could hold it

// 26 links and one pose at rest for what does not move (blocks).
std::vector<float> pose_table(const hoap2_scene_t &scene, const View &view) {
  std::vector<float> table;
  for (const Pose &pose : link_poses(scene)) {
    for (size_t row = 0; row < 3; ++row) {
      for (size_t k = 0; k < 3; ++k) table.push_back(static_cast<float>(pose.rot_W[3 * row + k]));
      table.push_back(static_cast<float>(pose.pos_W_m[row] - view.origin_W_m[row]));
    }
  }
  table.insert(table.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
  return table;
}

Mesh block_mesh(const hoap2_scene_t &scene, const View &view) {
  Mesh mesh;
  for (int i = 0; i < scene.block_count; ++i) {
    Placement at;
    at.link = HOAP2_LINKS;
    at.material = {{0.50F, 0.44F, 0.35F}, 0.1F};
    const double *c = scene.block_centre_W_m[i];
    at.centre = {static_cast<float>(c[0] - view.origin_W_m[0]), static_cast<float>(c[1] - view.origin_W_m[1]),
                 static_cast<float>(c[2] - view.origin_W_m[2])};
    at.turn_rad = {0.0F, 0.0F, static_cast<float>(scene.block_yaw_W_rad[i])};
    const double *s = scene.block_size_m[i];
    const Vec3 half =
        Vec3{static_cast<float>(s[0]), static_cast<float>(s[1]), static_cast<float>(s[2])} * 0.5F;
    add_rounded_box(mesh, at, half, {0.0012F, 0.0012F, 0.0012F}, 1);
  }
  return mesh;
}

std::vector<Vec3> floor_corners(const View &view, const Ground &ground) {
  const float r = 1.6F * view.fade_m;
  const float x = view.eye.x, y = view.eye.y;
  const Vec3 a = ground.floor_point(x - r, y - r), b = ground.floor_point(x + r, y - r);
  const Vec3 c = ground.floor_point(x + r, y + r), d = ground.floor_point(x - r, y + r);
  return {a, b, c, a, c, d};
}

void set(const Gl &gl, GLint location, Vec3 v) { gl.Uniform3f(location, v.x, v.y, v.z); }

void set_light(const Gl &gl, const Program &program, const View &view, bool shadow_on) {
  gl.UseProgram(program.id);
  gl.UniformMatrix4fv(program.at(gl, "u_camera"), 1, GL_FALSE, view.camera.m.data());
  gl.UniformMatrix4fv(program.at(gl, "u_shadow"), 1, GL_FALSE, view.shadow_map.m.data());
  set(gl, program.at(gl, "u_eye"), view.eye);
  set(gl, program.at(gl, "u_light"), view.light);
  gl.Uniform1i(program.at(gl, "u_shadow_map"), 0);
  gl.Uniform1f(program.at(gl, "u_shadow_on"), shadow_on ? 1.0F : 0.0F);
}

void set_poses(const Gl &gl, const Program &program, const std::vector<float> &poses) {
  gl.Uniform4fv(program.at(gl, "u_pose"), static_cast<GLsizei>(poses.size() / 4), poses.data());
}

void draw_shadow(const Stage &stage, const View &view, const std::vector<float> &poses) {
  const Gl &gl = stage.context.gl();
  gl.BindFramebuffer(GL_FRAMEBUFFER, stage.shadow_buffer);
  gl.Viewport(0, 0, kShadowSide_px, kShadowSide_px);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  gl.Enable(GL_DEPTH_CLAMP);
  gl.UseProgram(stage.shadow.id);
  gl.UniformMatrix4fv(stage.shadow.at(gl, "u_camera"), 1, GL_FALSE, view.shadow_clip.m.data());
  set_poses(gl, stage.shadow, poses);
  stage.draw(stage.robot_shadow);
  stage.draw(stage.blocks);
  gl.Disable(GL_DEPTH_CLAMP);
}

void draw_solids(const Stage &stage, const View &view, const Ground &ground, const std::vector<float> &poses,
                 bool shadow_on) {
  const Gl &gl = stage.context.gl();
  gl.BindTexture(GL_TEXTURE_2D, stage.shadow_map);
  set_light(gl, stage.solid, view, shadow_on);
  const Vec3 n = ground.normal();
  const float plane[4] = {n.x, n.y, n.z, -dot(n, ground.floor_point(0.0F, 0.0F))};
  gl.Uniform4fv(stage.solid.at(gl, "u_floor"), 1, plane);
  set_poses(gl, stage.solid, poses);
  stage.draw(stage.robot);
  stage.draw(stage.blocks);

  set_light(gl, stage.floor, view, shadow_on);
  set(gl, stage.floor.at(gl, "u_floor_normal"), n);
  gl.Uniform1f(stage.floor.at(gl, "u_fade_m"), view.fade_m);
  stage.draw(stage.floor_quad);
}

void draw_sky(const Stage &stage, const View &view) {
  const Gl &gl = stage.context.gl();
  const Vec3 forward = unit(view.target - view.eye);
  const float level = std::sqrt(std::max(0.0F, 1.0F - forward.z * forward.z));
  const float half = std::tan(0.5F * static_cast<float>(HOAP2_RENDER_FOV_Y_RAD));
  gl.UseProgram(stage.sky.id);
  set(gl, stage.sky.at(gl, "u_ray_z"), {0.0F, half * level, forward.z});
  gl.DepthMask(GL_FALSE);
  stage.draw(stage.sky_quad);
  gl.DepthMask(GL_TRUE);
}

void draw_marks(const Stage &stage, const View &view) {
  const Gl &gl = stage.context.gl();
  gl.UseProgram(stage.mark.id);
  gl.UniformMatrix4fv(stage.mark.at(gl, "u_camera"), 1, GL_FALSE, view.camera.m.data());
  set(gl, stage.mark.at(gl, "u_light"), view.light);
  const GLint alpha = stage.mark.at(gl, "u_alpha");
  gl.Enable(GL_BLEND);
  gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  // On the ground: drawn in order, without depth among themselves.
  gl.DepthMask(GL_FALSE);
  gl.Enable(GL_POLYGON_OFFSET_FILL);
  gl.PolygonOffset(-1.0F, -8.0F);
  gl.Uniform1f(alpha, 1.0F);
  stage.draw(stage.footprints);
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
  gl.Disable(GL_BLEND);
}

void read_picture(hoap2_render &render, uint8_t *rgb) {
  const Stage &stage = *render.stage;
  const Gl &gl = stage.context.gl();
  GLuint source = stage.picture_buffer;
  if (stage.samples > 1) {
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, stage.picture_buffer);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, stage.resolve_buffer);
    gl.BlitFramebuffer(0, 0, stage.width_px, stage.height_px, 0, 0, stage.width_px, stage.height_px,
                       GL_COLOR_BUFFER_BIT, GL_NEAREST);
    source = stage.resolve_buffer;
  }
  gl.BindFramebuffer(GL_FRAMEBUFFER, source);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  const auto width = static_cast<size_t>(stage.width_px), height = static_cast<size_t>(stage.height_px);
  render.rows_bottom_up.resize(4 * width * height);
  gl.ReadPixels(0, 0, stage.width_px, stage.height_px, GL_RGBA, GL_UNSIGNED_BYTE,
                render.rows_bottom_up.data());
  for (size_t row = 0; row < height; ++row) {
    const uint8_t *from = render.rows_bottom_up.data() + 4 * width * (height - 1 - row);
    uint8_t *to = rgb + 3 * width * row;
    for (size_t column = 0; column < width; ++column) std::copy_n(from + 4 * column, 3, to + 3 * column);
  }
}

void draw(hoap2_render &render, const hoap2_scene_t &scene, uint8_t *rgb) {
  Stage &stage = *render.stage;
  const float aspect = static_cast<float>(stage.width_px) / static_cast<float>(stage.height_px);
  const View view = make_view(scene, aspect);
  const Ground ground(scene, view.origin_W_m);
  const std::vector<float> poses = pose_table(scene, view);
  const bool shadow_on = (scene.show & HOAP2_SHOW_SHADOW) != 0;

  const Current current(stage.context);
  const Gl &gl = stage.context.gl();
  stage.fill(stage.blocks, block_mesh(scene, view));
  stage.fill(stage.floor_quad, floor_corners(view, ground));
  stage.fill(stage.footprints, footprint_marks(scene, ground, view.origin_W_m));
  stage.fill(stage.marks_ground, point_marks(scene, ground, view.origin_W_m));
  stage.fill(stage.marks_air, air_marks(scene, ground, view.origin_W_m));
  gl.Enable(GL_DEPTH_TEST);
  gl.Enable(GL_CULL_FACE);
  gl.DepthFunc(GL_LEQUAL);
  if (shadow_on) draw_shadow(stage, view, poses);
  gl.BindFramebuffer(GL_FRAMEBUFFER, stage.picture_buffer);
  gl.Viewport(0, 0, stage.width_px, stage.height_px);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  draw_solids(stage, view, ground, poses, shadow_on);
  draw_sky(stage, view);
  draw_marks(stage, view);
  read_picture(render, rgb);
  const GLenum problem = gl.GetError();
  if (problem != GL_NO_ERROR) throw std::runtime_error("OpenGL error " + std::to_string(problem));
}

}  // namespace

extern "C" {

hoap2_render_t *hoap2_render_create(int32_t width_px, int32_t height_px, int32_t samples) {
  g_create_error.clear();
  const auto fits = [](int32_t side) {
    return side >= HOAP2_RENDER_MIN_SIDE_PX && side <= HOAP2_RENDER_MAX_SIDE_PX;
  };
  try {
    if (!fits(width_px) || !fits(height_px)) {
      throw std::runtime_error("picture size " + std::to_string(width_px) + "x" + std::to_string(height_px) +
                               ": each side must be " + std::to_string(HOAP2_RENDER_MIN_SIDE_PX) + " to " +
                               std::to_string(HOAP2_RENDER_MAX_SIDE_PX) + " pixels");
    }
    if (samples != 1 && samples != 4) throw std::runtime_error("samples must be 1 or 4");
    auto render = std::make_unique<hoap2_render>();
    render->stage = std::make_unique<Stage>(width_px, height_px, samples);
    return render.release();
  } catch (const std::exception &problem) {
    g_create_error = problem.what();
    return nullptr;
  }
}

void hoap2_render_destroy(hoap2_render_t *render) { delete render; }

int hoap2_render_draw(hoap2_render_t *render, const hoap2_scene_t *scene, uint8_t *rgb) {
  try {
    render->error.clear();
    check(*scene);
    draw(*render, *scene, rgb);
    return 0;
  } catch (const std::exception &problem) {
    render->error = problem.what();
    return 1;
  }
}

int hoap2_render_project(const hoap2_render_t *render, const hoap2_scene_t *scene, const double point_W_m[3],
                         double column_row_depth[3]) {
  const double width = render->stage->width_px, height = render->stage->height_px;
  const View view = make_view(*scene, static_cast<float>(width / height));
  float p[4] = {0, 0, 0, 1};
  for (size_t i = 0; i < 3; ++i) p[i] = static_cast<float>(point_W_m[i] - view.origin_W_m[i]);
  double clip[4] = {0, 0, 0, 0};
  for (int row = 0; row < 4; ++row) {
    for (int k = 0; k < 4; ++k) clip[row] += static_cast<double>(view.camera.at(row, k) * p[k]);
  }
  if (!(clip[3] > 0.0)) return 1;
  column_row_depth[0] = 0.5 * width * (1.0 + clip[0] / clip[3]);
  column_row_depth[1] = 0.5 * height * (1.0 - clip[1] / clip[3]);
  column_row_depth[2] = clip[3];
  return 0;
}

int hoap2_render_link_pose(const hoap2_scene_t *scene, int32_t link, double pose_W[12]) {
  if (link < 0 || link >= HOAP2_LINKS) return 1;
  const LinkPoses poses = link_poses(*scene);
  const Pose &pose = poses[static_cast<size_t>(link)];
  for (size_t row = 0; row < 3; ++row) {
    for (size_t k = 0; k < 3; ++k) pose_W[4 * row + k] = pose.rot_W[3 * row + k];
    pose_W[4 * row + 3] = pose.pos_W_m[row];
  }
  return 0;
}

const char *hoap2_render_error(const hoap2_render_t *render) {
  return render != nullptr ? render->error.c_str() : g_create_error.c_str();
}

size_t hoap2_render_scene_size(void) { return sizeof(hoap2_scene_t); }

}  // extern "C"
