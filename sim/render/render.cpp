#include "hoap2_render/render.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "kinematics.h"
#include "passes.h"
#include "soil_surface.h"
#include "stage.h"
#include "view.h"

struct hoap2_render {
  std::unique_ptr<hoap2::Stage> stage;
  hoap2::SoilSurface soil;
  std::vector<uint8_t> rows_bottom_up;
  std::string error;
};

namespace {

using namespace hoap2;

thread_local std::string g_create_error;  // there is no renderer yet that could hold it

// 26 links, one pose at rest for what does not move (blocks), the pool of soil.
std::vector<float> pose_table(const hoap2_scene_t &scene, const View &view, const SoilSurface &soil) {
  std::vector<float> table;
  for (const Pose &pose : link_poses(scene)) {
    for (size_t row = 0; row < 3; ++row) {
      for (size_t k = 0; k < 3; ++k) table.push_back(static_cast<float>(pose.rot_W[3 * row + k]));
      table.push_back(static_cast<float>(pose.pos_W_m[row] - view.origin_W_m[row]));
    }
  }
  table.insert(table.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
  const std::array<float, 12> pool = soil.pose(view.origin_W_m);
  table.insert(table.end(), pool.begin(), pool.end());
  return table;
}

Mesh block_mesh(const hoap2_scene_t &scene, const View &view) {
  Mesh mesh;
  for (int i = 0; i < scene.block_count; ++i) {
    Placement at;
    at.link = kRestPose;
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

void add_rectangle(std::vector<Vec3> &points, Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  points.insert(points.end(), {a, b, c, a, c, d});
}

std::vector<Vec3> floor_corners(const View &view, const Ground &ground) {
  const float r = 1.6F * view.fade_m;
  const float x = view.eye.x, y = view.eye.y;
  std::vector<Vec3> points;
  add_rectangle(points, ground.floor_point(x - r, y - r), ground.floor_point(x + r, y - r),
                ground.floor_point(x + r, y + r), ground.floor_point(x - r, y + r));
  return points;
}

// The floor around the pool: 3 x 3 rectangles along the pool's axes without the middle one. Its edge
// lies under the walls.
std::vector<Vec3> floor_around_pool(const View &view, const Ground &ground, const SoilSurface &soil) {
  const float r = 1.6F * view.fade_m, wall = 0.5F * kWall_m;
  const Vec3 eye = ground.pool_place(view.eye);
  const auto lines = [&](float middle, float low, float high) {
    return std::array<float, 4>{middle - r, std::clamp(low - wall, middle - r, middle + r),
                                std::clamp(high + wall, middle - r, middle + r), middle + r};
  };
  const std::array<float, 4> x = lines(eye.x, soil.low_x(), soil.high_x());
  const std::array<float, 4> y = lines(eye.y, soil.low_y(), soil.high_y());
  std::vector<Vec3> points;
  for (size_t row = 0; row < 3; ++row) {
    for (size_t column = 0; column < 3; ++column) {
      if (row == 1 && column == 1) continue;
      add_rectangle(points, ground.pool_point({x[column], y[row], 0.0F}),
                    ground.pool_point({x[column + 1], y[row], 0.0F}),
                    ground.pool_point({x[column + 1], y[row + 1], 0.0F}),
                    ground.pool_point({x[column], y[row + 1], 0.0F}));
    }
  }
  return points;
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
  const Ground ground(scene, view.origin_W_m, render.soil);
  const std::vector<float> poses = pose_table(scene, view, render.soil);
  const Shot shot = {stage, view, ground, render.soil, poses, scene.show};

  const Current current(stage.context);
  const Gl &gl = stage.context.gl();
  const bool soil = render.soil.exists();
  stage.fill(stage.blocks, block_mesh(scene, view));
  stage.fill_soil(render.soil);
  stage.fill(stage.floor_quad,
             soil ? floor_around_pool(view, ground, render.soil) : floor_corners(view, ground));
  stage.fill(stage.footprints, footprint_marks(scene, ground, view.origin_W_m));
  stage.fill(stage.marks_ground, point_marks(scene, ground, view.origin_W_m));
  stage.fill(stage.marks_air, air_marks(scene, ground, view.origin_W_m));
  gl.Enable(GL_DEPTH_TEST);
  gl.Enable(GL_CULL_FACE);
  gl.DepthFunc(GL_LEQUAL);
  if ((scene.show & HOAP2_SHOW_SHADOW) != 0) draw_shadow(shot);
  gl.BindFramebuffer(GL_FRAMEBUFFER, stage.picture_buffer);
  gl.Viewport(0, 0, stage.width_px, stage.height_px);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  // What hides most comes first; but footprints on soil must be under the robot.
  if (soil) draw_ground(shot);
  draw_solids(shot);
  if (!soil) draw_ground(shot);
  draw_sky(shot);
  draw_marks(shot);
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

int hoap2_render_set_soil(hoap2_render_t *render, const hoap2_soil_grid_t *grid, const float *height_m,
                          const float *change_m, double full_scale_m) {
  try {
    render->error.clear();
    if (grid == nullptr) {
      render->soil.clear();
    } else {
      render->soil.set(*grid, height_m, change_m, full_scale_m);
    }
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
