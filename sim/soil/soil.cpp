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
  contact_.build(params);
  faces_ = list_faces(params);
  std::size_t most = 0, patches = 0, first = 0;
  link_faces_.clear();
  for (const Face &face : faces_) {
    most += most_cells(face, field_.cell_m());
    patches += static_cast<std::size_t>(face.patches());
    const double corner_m = norm(face.arm_L_m + face.half_a_m * face.a_L) +
                            norm(face.half_b_m * face.b_L);  // not less than the corner's
    if (link_faces_.empty() || link_faces_.back().link != face.link) {
      link_faces_.push_back({face.link, first, first});
    }
    link_faces_.back().end = ++first;
    radius_m_[face.link] = std::max(radius_m_[face.link], corner_m);
  }
  flow_.build(params, field_, faces_.size());
  shear_.assign(patches, PatchShear{});
  patch_.assign(patches, PatchTick{});
  is_sheared_.assign(faces_.size(), false);
  presses_.assign(faces_.size(), false);
  touched_.reserve(faces_.size());
  pressed_.reserve(most);
  posed_.reserve(faces_.size());
  start();
  return "";
}

void Soil::start() {
  field_.start(params_, contact_.pressure().stiffness_Pa_m(0.0));
  flow_.start();
  std::fill(shear_.begin(), shear_.end(), PatchShear{});
  touched_.clear();
  pressed_.clear();
  find_sheared();
  sinkage_m_[0] = sinkage_m_[1] = 0.0;
  compacted_m3_ = 0.0;
  tick_ = 0;
}

void Soil::set_level(int ix, int iy, double level_m) {
  field_.cell(field_.index(ix, iy)) = {level_m, 0.0, 0.0, contact_.pressure().stiffness_Pa_m(0.0)};
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

// Whether all of the face is within the walls and above the bottom.
bool Soil::is_inside(const Face &face, const FacePose &pose) const {
  const auto reach_m = [&](double a, double b) {
    return std::fabs(a) * face.half_a_m + std::fabs(b) * face.half_b_m;
  };
  const double x_m = reach_m(pose.a.x, pose.b.x), y_m = reach_m(pose.a.y, pose.b.y);
  return field_.is_within_walls(pose.centre_m.x - x_m, pose.centre_m.y - y_m) &&
         field_.is_within_walls(pose.centre_m.x + x_m, pose.centre_m.y + y_m) &&
         pose.centre_m.z - reach_m(pose.a.z, pose.b.z) > -field_.depth_m();
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

std::string Soil::load_face(std::size_t i, const State &state, const Mat3 axes_W[HOAP2_LINKS],
                            SoilLoad *load) {
  const Face &face = faces_[i];
  const Mat3 &axes = axes_W[face.link];
  if (dot(pool_.axes_W.cz, axes * face.m_L) <= kSteepest) return "";
  FaceTwist twist;
  const FacePose pose = pose_of(state, axes_W, face, &twist);
  if (!is_near(face, pose, twist)) return "";
  if (face.foot >= 0 && !is_inside(face, pose)) {
    const std::string fault = fault_of_sole(face, pose);
    if (!fault.empty()) return fault;
  }
  FaceLoad sum;
  const CellsUnder cells(field_, face, pose);
  PatchTick *const patch = &patch_[static_cast<std::size_t>(face.first_patch)];
  const std::size_t first_pressed = pressed_.size();
  contact_.press(field_, face, pose, twist, cells, patch, &pressed_, &sum);
  if (!sum.any()) return "";
  touched_.push_back({i, sum.presses(), first_pressed, pressed_.size(), cells.window()});
  contact_.shear(face, pose, twist, &shear_[static_cast<std::size_t>(face.first_patch)], patch, &sum);
  SpatialVector wrench_W;
  SpatialInertia slope_W;
  sum.find(face, axes, &wrench_W, &slope_W);
  add_load(wrench_W, slope_W, load);
  return "";
}

std::string Soil::find_loads(const State &state, const Mat3 axes_W[HOAP2_LINKS], SoilLoad load[HOAP2_LINKS]) {
  for (int link = 0; link < HOAP2_LINKS; ++link) load[link].touches = false;
  pressed_.clear();
  touched_.clear();
  for (const LinkFaces &faces : link_faces_) {
    if (!is_link_near(state, faces.link)) continue;
    for (std::size_t i = faces.first; i < faces.end; ++i) {
      const std::string fault = load_face(i, state, axes_W, &load[faces.link]);
      if (!fault.empty()) return fault;
    }
  }
  return "";
}

// What the tick's start did to the ground becomes its memory.
void Soil::keep(const TouchedFace &touched) {
  const std::size_t i = touched.face;
  const double cell_m2 = field_.cell_m() * field_.cell_m();
  double sunk_m3 = 0.0;
  for (std::size_t k = touched.first_pressed; k < touched.end_pressed; ++k) {
    Cell &cell = field_.cell(pressed_[k].index);
    if (pressed_[k].cell.memory_m < cell.memory_m) continue;  // another face pressed deeper
    sunk_m3 += cell_m2 * (cell.surface_m() - pressed_[k].cell.surface_m());
    cell = pressed_[k].cell;
  }
  if (touched.end_pressed > touched.first_pressed) {
    flow_.displace(i, params_.soil_heave * sunk_m3);
    compacted_m3_ += (1.0 - params_.soil_heave) * sunk_m3;
    flow_.wake(i, touched.under);
  }
  if (!touched.presses) return;
  const auto first = static_cast<std::size_t>(faces_[i].first_patch);
  const auto end = first + static_cast<std::size_t>(faces_[i].patches());
  for (std::size_t k = first; k < end; ++k) shear_[k] = patch_[k].shear;
}

// The face has just left the ground: what it held can slide now.
void Soil::leave(std::size_t i, const State &next, const Mat3 next_axes_W[HOAP2_LINKS]) {
  const Face &face = faces_[i];
  std::fill_n(shear_.begin() + face.first_patch, face.patches(), PatchShear{});
  FaceTwist twist;
  const FacePose pose = pose_of(next, next_axes_W, face, &twist);
  if (pose.m.z > kSteepest) flow_.wake(i, CellsUnder(field_, face, pose).window());
}

void Soil::run_flow(const State &next, const Mat3 next_axes_W[HOAP2_LINKS]) {
  posed_.clear();
  for (const LinkFaces &faces : link_faces_) {
    const bool link_near = is_link_near(next, faces.link);
    for (std::size_t i = faces.first; i < faces.end; ++i) {
      if (!link_near && flow_.memory()[i].pending_m3 <= 0.0) continue;
      FaceTwist twist;
      const FacePose pose = pose_of(next, next_axes_W, faces_[i], &twist);
      posed_.push_back({&faces_[i], i, pose, is_near(faces_[i], pose, twist)});
    }
  }
  flow_.run(posed_, tick_ / Flow::kTicks % 2 != 0, contact_.pressure(), &field_);
}

void Soil::commit(const State &next, const Mat3 next_axes_W[HOAP2_LINKS]) {
  std::fill(presses_.begin(), presses_.end(), false);
  for (const TouchedFace &touched : touched_) {
    presses_[touched.face] = touched.presses;
    keep(touched);
  }
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    if (is_sheared_[i] && !presses_[i]) leave(i, next, next_axes_W);
  }
  is_sheared_.swap(presses_);
  for (std::size_t foot = 0; foot < 2; ++foot) {  // the soles are the first faces
    FaceTwist twist;
    sinkage_m_[foot] = is_sheared_[foot] ? -pose_of(next, next_axes_W, faces_[foot], &twist).centre_m.z : 0.0;
  }
  touched_.clear();
  pressed_.clear();
  ++tick_;
  if (tick_ % Flow::kTicks == 0 && !flow_.is_idle()) run_flow(next, next_axes_W);
}

}  // namespace hoap2_sim
