#include "soil/soil.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "robot/kinematics.h"

namespace hoap2_sim {
namespace {

// A link may touch with several faces.
void add_block(const Matrix3 &more, bool is_first, double to[3][3]) {
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) to[i][k] = more(i, k) + (is_first ? 0.0 : to[i][k]);
  }
}

void add_load(const SpatialVector &wrench_W, const SpatialInertia &slope_W, SoilLoad *load) {
  const bool is_first = !load->touches;
  load->touches = true;
  load->force_W_N = plain(wrench_W.linear) + (is_first ? Vec3{} : load->force_W_N);
  load->torque_com_W_Nm = plain(wrench_W.angular) + (is_first ? Vec3{} : load->torque_com_W_Nm);
  add_block(slope_W.angular, is_first, load->angular);
  add_block(slope_W.coupling, is_first, load->coupling);
  add_block(slope_W.linear, is_first, load->linear);
}

// Most cells that can be under a face at once.
std::size_t most_cells(const Face &face, double cell_m) {
  const double along = 2.0 * face.half_a_m / cell_m + 2.0, across = 2.0 * face.half_b_m / cell_m + 2.0;
  return static_cast<std::size_t>(along * across);
}

}  // namespace

std::string Soil::build(const hoap2_plant_params_t &params) {
  params_ = params;
  const std::string fault = field_.build(params);
  if (!fault.empty()) return fault;
  pool_ = pool_frame(params);
  pressure_.build(params);
  shear_law_.build(params.soil_shear_m, kTick_s);
  const bool is_rft = pressure_.depends_on_direction();  // knows neither cohesion nor edges
  cohesion_Pa_ = is_rft ? 0.0 : params.soil_cohesion_Pa;
  tan_friction_ = std::tan(params.soil_friction_rad);
  edge_loss_ = is_rft || params.soil_edge_m <= 0.0 ? 0.0 : params.soil_edge_loss;
  per_edge_m_ = edge_loss_ > 0.0 ? 1.0 / params.soil_edge_m : 0.0;
  faces_ = list_faces(params);
  std::size_t most = 0, patches = 0;
  for (const Face &face : faces_) {
    most += most_cells(face, field_.cell_m());
    patches += static_cast<std::size_t>(face.patches());
    const double corner_m = norm(face.arm_L_m + face.half_a_m * face.a_L) +
                            norm(face.half_b_m * face.b_L);  // not less than the corner's
    radius_m_[face.link] = std::max(radius_m_[face.link], corner_m);
  }
  flow_.build(params, field_, faces_.size());
  shear_.assign(patches, PatchShear{});
  patch_.assign(patches, PatchTick{});
  is_sheared_.assign(faces_.size(), false);
  face_tick_.assign(faces_.size(), FaceTick{});
  pressed_.reserve(most);
  posed_.reserve(faces_.size());
  start();
  return "";
}

void Soil::start() {
  field_.start(params_, pressure_.stiffness_Pa_m(0.0));
  flow_.start();
  std::fill(shear_.begin(), shear_.end(), PatchShear{});
  std::fill(face_tick_.begin(), face_tick_.end(), FaceTick{});
  pressed_.clear();
  find_sheared();
  sinkage_m_[0] = sinkage_m_[1] = 0.0;
  compacted_m3_ = 0.0;
  tick_ = 0;
}

void Soil::set_level(int ix, int iy, double level_m) {
  field_.cell(field_.index(ix, iy)) = {level_m, 0.0, 0.0, pressure_.stiffness_Pa_m(0.0)};
  field_.find_top();
  flow_.wake(0, {ix, iy, ix, iy});
}

FacePose Soil::pose_of(const State &state, const Mat3 axes_W[HOAP2_LINKS], const Face &face,
                       FaceTwist *twist) const {
  const BodyState &body = state.body[face.link];
  const Mat3 &axes = axes_W[face.link];
  const Vec3 a_W = axes * face.a_L, b_W = axes * face.b_L, m_W = axes * face.m_L;
  const Vec3 arm_W_m = axes * face.arm_L_m;
  const Vec3 omega_W = vec(body.omega_W_rad_s);
  const Vec3 vel_W = vec(body.com_vel_W_m_s) + cross(omega_W, arm_W_m);
  twist->omega_rad_s = {dot(a_W, omega_W), dot(b_W, omega_W), dot(m_W, omega_W)};
  twist->vel_m_s = {dot(a_W, vel_W), dot(b_W, vel_W), dot(m_W, vel_W)};
  const Vec3 centre_W_m = vec(body.com_pos_W_m) - pool_.origin_W_m + arm_W_m;
  return {turn_back(pool_.axes_W, centre_W_m), turn_back(pool_.axes_W, a_W), turn_back(pool_.axes_W, b_W),
          turn_back(pool_.axes_W, m_W)};
}

// Whether the face can touch within the tick.
bool Soil::is_near(const Face &face, const FacePose &pose, const FaceTwist &twist) const {
  if (pose.m.z <= kSteepest) return false;
  const double lowest_m =
      pose.centre_m.z - std::fabs(pose.a.z) * face.half_a_m - std::fabs(pose.b.z) * face.half_b_m;
  const double speed_m_s = norm(twist.vel_m_s) + norm(twist.omega_rad_s) * (face.half_a_m + face.half_b_m);
  return lowest_m - kTick_s * speed_m_s < field_.top_m();
}

// The same for all of a link, from less.
bool Soil::is_link_near(const State &state, int link) const {
  const BodyState &body = state.body[link];
  const double height_m = dot(pool_.axes_W.cz, vec(body.com_pos_W_m) - pool_.origin_W_m);
  const double speed_m_s = norm(vec(body.com_vel_W_m_s)) + norm(vec(body.omega_W_rad_s)) * radius_m_[link];
  return height_m - radius_m_[link] - kTick_s * speed_m_s < field_.top_m();
}

// A sole must find ground wherever it is below the surface.
std::string Soil::fault_of_sole(const Face &face, const FacePose &pose) const {
  const char *const name = face.foot == 0 ? "right" : "left";
  char text[256];
  for (int patch = 0; patch < face.patches(); ++patch) {
    const double u_m = face.patch_u_m(patch), v_m = face.patch_v_m(patch);
    const double height_m = pose.height_m(u_m, v_m);
    if (height_m >= 0.0) continue;
    const double x_m = pose.centre_m.x + u_m * pose.a.x + v_m * pose.b.x;
    const double y_m = pose.centre_m.y + u_m * pose.a.y + v_m * pose.b.y;
    if (!field_.is_within_walls(x_m, y_m)) {
      std::snprintf(text, sizeof text,
                    "the %s foot left the soil pool %g x %g m at x = %.2f m, y = %.2f m from the start; "
                    "see soil_size_m and soil_centre_m",
                    name, params_.soil_size_m[0], params_.soil_size_m[1], x_m, y_m);
      return text;
    }
    if (height_m < -field_.depth_m()) {
      std::snprintf(text, sizeof text, "the %s foot reached the bottom of the soil pool, %g m deep", name,
                    field_.depth_m());
      return text;
    }
  }
  return "";
}

void Soil::find_shares(const Face &face, const FacePose &pose, const FaceTwist &twist) {
  PatchTick *const patch = &patch_[static_cast<std::size_t>(face.first_patch)];
  for (int i = 0; i < face.patches(); ++i) {
    const double u_m = face.patch_u_m(i), v_m = face.patch_v_m(i);
    const Vec3 vel_m_s = twist.along_a_m_s(v_m) * pose.a + twist.along_b_m_s(u_m) * pose.b +
                         twist.normal_m_s(u_m, v_m) * pose.m;
    patch[i].share = rft_share(pose.m, vel_m_s);
  }
}

// Share of the pressure that a sole finds near its edge, where the ground gives way sideways.
inline double Soil::bearing(const Face &face, const CellPart &part) const {
  const double inside_m = std::min(face.half_a_m - std::fabs(part.u_m), face.half_b_m - std::fabs(part.v_m));
  return 1.0 - edge_loss_ * std::max(0.0, 1.0 - inside_m * per_edge_m_);
}

void Soil::press_face(const Face &face, const FacePose &pose, const FaceTwist &twist, FaceTick *tick,
                      FaceLoad *sum) {
  PatchTick *const patch = &patch_[static_cast<std::size_t>(face.first_patch)];
  for (int i = 0; i < face.patches(); ++i) patch[i] = PatchTick{};
  const bool is_rft = pressure_.depends_on_direction();
  if (is_rft) find_shares(face, pose, twist);
  const double per_m = 1.0 / pose.m.z;
  const double cell_area_m2 = field_.cell_m() * field_.cell_m() * per_m * slope_share(pose);
  const bool has_edge = edge_loss_ > 0.0 && face.foot >= 0;
  FaceLoad load;
  const CellsUnder cells(field_, face, pose);
  const double half_step_a_m = 0.5 * cells.step_a_m(), half_step_b_m = 0.5 * cells.step_b_m();
  cells.each([&](const CellPart &part) {
    const Cell *cell = &field_.cell(part.index);
    const double depth_m = cell->level_m - pose.height_m(part.u_m, part.v_m);
    const double down_m_s = -per_m * twist.normal_m_s(part.u_m, part.v_m);
    const double share = is_rft ? patch[face.patch_at(part.u_m, part.v_m)].share.normal : 1.0;
    if (depth_m > 0.0 && pressure_.yields(*cell, depth_m, share)) {
      pressed_.push_back({part.index, pressure_.pressed(*cell, depth_m, share)});
      cell = &pressed_.back().cell;
    }
    const Response answer = pressure_.respond(*cell, depth_m, down_m_s, share);
    if (answer.resistance_Pas_m <= 0.0 && answer.pressure_Pa <= 0.0) return;
    const double area_m2 = cell_area_m2 * part.cells();
    const double bearing_m2 = has_edge ? area_m2 * bearing(face, part) : area_m2;
    const double force_N = bearing_m2 * answer.pressure_Pa;
    load.press(part.u_m, part.v_m, force_N, bearing_m2 * per_m * answer.resistance_Pas_m);
    if (answer.pressure_Pa <= 0.0) return;
    face.share_out(part.u_m, part.v_m, half_step_a_m * part.wide_a, half_step_b_m * part.wide_b,
                   [&](int i, double of_it) {
                     patch[i].normal_N += of_it * force_N;
                     patch[i].area_m2 += of_it * area_m2;
                   });
  });
  tick->under = cells.window();
  *sum = load;
}

void Soil::shear_face(const Face &face, const FaceTwist &twist, FaceLoad *sum) {
  const auto first = static_cast<std::size_t>(face.first_patch);
  const bool is_rft = pressure_.depends_on_direction();
  for (int i = 0; i < face.patches(); ++i) {
    PatchTick &patch = patch_[first + static_cast<std::size_t>(i)];
    if (patch.normal_N <= 0.0) continue;
    const double limit_N = is_rft ? patch.share.shear_ratio * patch.normal_N
                                  : cohesion_Pa_ * patch.area_m2 + tan_friction_ * patch.normal_N;
    const double u_m = face.patch_u_m(i), v_m = face.patch_v_m(i);
    const double along_a_m_s = twist.along_a_m_s(v_m), along_b_m_s = twist.along_b_m_s(u_m);
    patch.shear = shear_[first + static_cast<std::size_t>(i)];
    if (patch.shear.peak_N > 0.0) {  // touched a tick ago: it has moved since
      shear_law_.move(&patch.shear, limit_N, kTick_s * along_a_m_s, kTick_s * along_b_m_s,
                      kTick_s * twist.omega_rad_s.z);
    } else {
      patch.shear.peak_N = limit_N;
    }
    sum->shear(u_m, v_m, shear_law_.respond(patch.shear, limit_N, along_a_m_s, along_b_m_s));
  }
}

std::string Soil::find_loads(const State &state, const Mat3 axes_W[HOAP2_LINKS], SoilLoad load[HOAP2_LINKS]) {
  for (int link = 0; link < HOAP2_LINKS; ++link) load[link].touches = false;
  pressed_.clear();
  int link_seen = -1;
  bool link_near = false;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const Face &face = faces_[i];
    FaceTick &tick = face_tick_[i];
    tick.presses = false;
    tick.first_pressed = tick.end_pressed = pressed_.size();
    if (face.link != link_seen) {
      link_seen = face.link;
      link_near = is_link_near(state, face.link);
    }
    if (!link_near) continue;
    FaceTwist twist;
    const FacePose pose = pose_of(state, axes_W, face, &twist);
    if (!is_near(face, pose, twist)) continue;
    if (face.foot >= 0) {
      const std::string fault = fault_of_sole(face, pose);
      if (!fault.empty()) return fault;
    }
    FaceLoad sum;
    press_face(face, pose, twist, &tick, &sum);
    tick.end_pressed = pressed_.size();
    if (!sum.any()) continue;
    tick.presses = sum.presses();
    shear_face(face, twist, &sum);
    SpatialVector wrench_W;
    SpatialInertia slope_W;
    sum.find(face, axes_W[face.link], &wrench_W, &slope_W);
    add_load(wrench_W, slope_W, &load[face.link]);
  }
  return "";
}

// What the tick's start did to the ground becomes its memory.
void Soil::keep_face(std::size_t i, const State &next, const Mat3 next_axes_W[HOAP2_LINKS]) {
  const Face &face = faces_[i];
  const FaceTick &tick = face_tick_[i];
  const double cell_m2 = field_.cell_m() * field_.cell_m();
  for (std::size_t k = tick.first_pressed; k < tick.end_pressed; ++k) {
    Cell &cell = field_.cell(pressed_[k].index);
    if (pressed_[k].cell.memory_m < cell.memory_m) continue;  // another face pressed deeper
    const double sunk_m3 = cell_m2 * (cell.surface_m() - pressed_[k].cell.surface_m());
    flow_.displace(i, params_.soil_heave * sunk_m3);
    compacted_m3_ += (1.0 - params_.soil_heave) * sunk_m3;
    cell = pressed_[k].cell;
  }
  if (tick.end_pressed > tick.first_pressed) flow_.wake(i, tick.under);
  if (!tick.presses && !is_sheared_[i]) return;
  const auto first = static_cast<std::size_t>(face.first_patch);
  for (std::size_t k = first; k < first + static_cast<std::size_t>(face.patches()); ++k) {
    shear_[k] = tick.presses ? patch_[k].shear : PatchShear{};
  }
  if (!tick.presses) {  // it has just left: what it held can slide now
    FaceTwist twist;
    const FacePose pose = pose_of(next, next_axes_W, face, &twist);
    if (pose.m.z > kSteepest) flow_.wake(i, CellsUnder(field_, face, pose).window());
  }
  is_sheared_[i] = tick.presses;
}

void Soil::run_flow(const State &next, const Mat3 next_axes_W[HOAP2_LINKS]) {
  posed_.clear();
  for (const Face &face : faces_) {
    FaceTwist twist;
    const FacePose pose = pose_of(next, next_axes_W, face, &twist);
    posed_.push_back({&face, pose, is_near(face, pose, twist)});
  }
  flow_.run(posed_, tick_ / Flow::kTicks % 2 != 0, pressure_, &field_);
}

void Soil::commit(const State &next, const Mat3 next_axes_W[HOAP2_LINKS]) {
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const Face &face = faces_[i];
    if (face.foot >= 0) {
      const bool presses = face_tick_[i].presses;
      FaceTwist twist;
      sinkage_m_[face.foot] = presses ? -pose_of(next, next_axes_W, face, &twist).centre_m.z : 0.0;
    }
    keep_face(i, next, next_axes_W);
  }
  ++tick_;
  if (tick_ % Flow::kTicks == 0 && !flow_.is_idle()) run_flow(next, next_axes_W);
}

}  // namespace hoap2_sim
