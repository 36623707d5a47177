#include "soil/soil.h"

#include <cmath>
#include <cstdio>
#include <cstring>

#include "robot/kinematics.h"

namespace hoap2_sim {
namespace {

constexpr std::uint64_t kSoilMagic = 0x314c494f5350414fULL;

struct SoilHead {
  std::uint64_t magic;
  std::uint64_t size;
  std::int64_t tick;
  double sinkage_m[2];
};
struct SavedCell {
  double level_m, memory_m, pressure_Pa;
};

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
  const Face &last = faces_.back();
  shear_.assign(static_cast<std::size_t>(last.first_patch + last.patches()), PatchShear{});
  ground_.assign(shear_.size(), PatchGround{});
  start();
  return "";
}

void Soil::start() {
  field_.start(params_, pressure_.stiffness_Pa_m(0.0));
  std::fill(shear_.begin(), shear_.end(), PatchShear{});
  std::fill(ground_.begin(), ground_.end(), PatchGround{});
  sinkage_m_[0] = sinkage_m_[1] = 0.0;
  tick_ = 0;
}

void Soil::set_level(int ix, int iy, double level_m) {
  field_.cell(field_.index(ix, iy)) = {level_m, 0.0, 0.0, pressure_.stiffness_Pa_m(0.0)};
  field_.find_top();
}

// Pose and motion of a face that can touch within the tick.
bool Soil::is_near(const State &state, const Mat3 axes_W[HOAP2_LINKS], const Face &face, FacePose *pose,
                   FaceTwist *twist) const {
  const BodyState &body = state.body[face.link];
  const Mat3 &axes = axes_W[face.link];
  const Vec3 m_W = axes * face.m_L;
  pose->m.z = dot(pool_.axes_W.cz, m_W);
  if (pose->m.z <= kSteepest) return false;
  const Vec3 arm_W_m = axes * face.arm_L_m;
  const Vec3 centre_W_m = vec(body.com_pos_W_m) - pool_.origin_W_m + arm_W_m;
  const Vec3 a_W = axes * face.a_L, b_W = axes * face.b_L;
  pose->centre_m = turn_back(pool_.axes_W, centre_W_m);
  pose->a = turn_back(pool_.axes_W, a_W);
  pose->b = turn_back(pool_.axes_W, b_W);
  pose->m = turn_back(pool_.axes_W, m_W);
  const Vec3 omega_W = vec(body.omega_W_rad_s);
  const Vec3 vel_W = vec(body.com_vel_W_m_s) + cross(omega_W, arm_W_m);
  twist->omega_rad_s = {dot(a_W, omega_W), dot(b_W, omega_W), dot(m_W, omega_W)};
  twist->vel_m_s = {dot(a_W, vel_W), dot(b_W, vel_W), dot(m_W, vel_W)};
  const double lowest_m =
      pose->centre_m.z - std::fabs(pose->a.z) * face.half_a_m - std::fabs(pose->b.z) * face.half_b_m;
  const double speed_m_s = norm(vel_W) + norm(omega_W) * (face.half_a_m + face.half_b_m);
  return lowest_m - kTick_s * speed_m_s < field_.top_m();
}

// A sole must find ground wherever it is below the surface.
std::string Soil::fault_of_sole(const Face &face, const FacePose &pose) const {
  const char *const name = face.foot == 0 ? "right" : "left";
  char text[200];
  for (int patch = 0; patch < face.patches(); ++patch) {
    const double u_m = face.patch_u_m(patch), v_m = face.patch_v_m(patch);
    const double x_m = pose.centre_m.x + u_m * pose.a.x + v_m * pose.b.x;
    const double y_m = pose.centre_m.y + u_m * pose.a.y + v_m * pose.b.y;
    const double height_m = pose.height_m(u_m, v_m);
    if (height_m < 0.0 && !field_.is_within_walls(x_m, y_m)) {
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
  if (!pressure_.depends_on_direction()) return;
  for (int patch = 0; patch < face.patches(); ++patch) {
    const double u_m = face.patch_u_m(patch), v_m = face.patch_v_m(patch);
    const Vec3 vel_m_s = twist.along_a_m_s(v_m) * pose.a + twist.along_b_m_s(u_m) * pose.b +
                         twist.normal_m_s(u_m, v_m) * pose.m;
    ground_[static_cast<std::size_t>(face.first_patch + patch)].share = rft_share(pose.m, vel_m_s);
  }
}

// Share of the pressure that a sole finds near its edge, where the ground gives way sideways.
double Soil::bearing(const Face &face, const CellPart &part) const {
  if (edge_loss_ <= 0.0 || face.foot < 0) return 1.0;
  const double inside_m = std::min(face.half_a_m - std::fabs(part.u_m), face.half_b_m - std::fabs(part.v_m));
  return 1.0 - edge_loss_ * std::max(0.0, 1.0 - inside_m * per_edge_m_);
}

void Soil::load_face(const Face &face, const FacePose &pose, const FaceTwist &twist, FaceLoad *sum) {
  PatchGround *const ground = &ground_[static_cast<std::size_t>(face.first_patch)];
  for (int patch = 0; patch < face.patches(); ++patch) ground[patch] = PatchGround{};
  find_shares(face, pose, twist);
  const double per_m = 1.0 / pose.m.z;
  const double cell_area_m2 = field_.cell_m() * field_.cell_m() * per_m * slope_share(pose);
  CellsUnder(field_, face, pose).each([&](const CellPart &part) {
    const Cell &cell = field_.cell(part.index);
    PatchGround &under = ground[face.patch_at(part.u_m, part.v_m)];
    const double depth_m = cell.level_m - pose.height_m(part.u_m, part.v_m);
    const double down_m_s = -per_m * twist.normal_m_s(part.u_m, part.v_m);
    const Response answer = pressure_.respond(cell, depth_m, down_m_s, under.share.normal);
    if (answer.resistance_Pas_m <= 0.0 && answer.pressure_Pa <= 0.0) return;
    const double area_m2 = cell_area_m2 * part.cells, bearing_m2 = area_m2 * bearing(face, part);
    const double force_N = bearing_m2 * answer.pressure_Pa;
    sum->press(part.u_m, part.v_m, force_N, bearing_m2 * per_m * answer.resistance_Pas_m);
    under.normal_N += force_N;
    if (answer.pressure_Pa > 0.0) under.area_m2 += area_m2;
  });
  const PatchShear *const shear = &shear_[static_cast<std::size_t>(face.first_patch)];
  for (int patch = 0; patch < face.patches(); ++patch) {
    PatchGround &under = ground[patch];
    if (under.normal_N <= 0.0) continue;
    under.limit_N = pressure_.depends_on_direction()
                        ? under.share.shear_ratio * under.normal_N
                        : cohesion_Pa_ * under.area_m2 + tan_friction_ * under.normal_N;
    const double u_m = face.patch_u_m(patch), v_m = face.patch_v_m(patch);
    sum->shear(
        u_m, v_m,
        shear_law_.respond(shear[patch], under.limit_N, twist.along_a_m_s(v_m), twist.along_b_m_s(u_m)));
  }
}

std::string Soil::find_loads(const State &state, const Mat3 axes_W[HOAP2_LINKS], SoilLoad load[HOAP2_LINKS]) {
  for (int link = 0; link < HOAP2_LINKS; ++link) load[link].touches = false;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const Face &face = faces_[i];
    FacePose pose;
    FaceTwist twist;
    FaceLoad sum;
    if (is_near(state, axes_W, face, &pose, &twist)) {
      if (face.foot >= 0) {
        const std::string fault = fault_of_sole(face, pose);
        if (!fault.empty()) return fault;
      }
      load_face(face, pose, twist, &sum);
    } else {
      for (int patch = 0; patch < face.patches(); ++patch) {
        ground_[static_cast<std::size_t>(face.first_patch + patch)] = PatchGround{};
      }
    }
    if (!sum.any()) continue;
    SpatialVector wrench_W;
    SpatialInertia slope_W;
    sum.find(face, axes_W[face.link], &wrench_W, &slope_W);
    add_load(wrench_W, slope_W, &load[face.link]);
  }
  return "";
}

void Soil::press_face(std::size_t i, const FacePose &pose) {
  const Face &face = faces_[i];
  const PatchGround *const ground = &ground_[static_cast<std::size_t>(face.first_patch)];
  CellsUnder(field_, face, pose).each([&](const CellPart &part) {
    Cell &cell = field_.cell(part.index);
    const double depth_m = cell.level_m - pose.height_m(part.u_m, part.v_m);
    if (depth_m <= 0.0) return;
    const double share =
        pressure_.depends_on_direction() ? ground[face.patch_at(part.u_m, part.v_m)].share.normal : 1.0;
    pressure_.press(&cell, depth_m, share);
  });
}

void Soil::shear_face(const Face &face, const FaceTwist &twist) {
  for (int patch = 0; patch < face.patches(); ++patch) {
    const auto k = static_cast<std::size_t>(face.first_patch + patch);
    const double u_m = face.patch_u_m(patch), v_m = face.patch_v_m(patch);
    shear_law_.move(&shear_[k], ground_[k].limit_N, kTick_s * twist.along_a_m_s(v_m),
                    kTick_s * twist.along_b_m_s(u_m), kTick_s * twist.omega_rad_s.z);
  }
}

void Soil::commit(const State &next, const Mat3 next_axes_W[HOAP2_LINKS]) {
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const Face &face = faces_[i];
    FacePose pose;
    FaceTwist twist;
    const bool near = is_near(next, next_axes_W, face, &pose, &twist);
    shear_face(face, twist);
    if (near) {
      find_shares(face, pose, twist);
      press_face(i, pose);
    }
  }
  ++tick_;
}

std::size_t Soil::state_bytes() const {
  return sizeof(SoilHead) + field_.size() * sizeof(SavedCell) + shear_.size() * sizeof(PatchShear);
}

void Soil::save(void *to) const {
  auto *bytes = static_cast<unsigned char *>(to);
  const SoilHead head = {kSoilMagic, state_bytes(), tick_, {sinkage_m_[0], sinkage_m_[1]}};
  std::memcpy(bytes, &head, sizeof head);
  bytes += sizeof head;
  for (std::size_t i = 0; i < field_.size(); ++i, bytes += sizeof(SavedCell)) {
    const Cell &cell = field_.cell(i);
    const SavedCell saved = {cell.level_m, cell.memory_m, cell.pressure_Pa};
    std::memcpy(bytes, &saved, sizeof saved);
  }
  std::memcpy(bytes, shear_.data(), shear_.size() * sizeof(PatchShear));
}

std::string Soil::restore(const void *from) {
  const auto *bytes = static_cast<const unsigned char *>(from);
  SoilHead head;
  std::memcpy(&head, bytes, sizeof head);
  if (head.magic != kSoilMagic || head.size != state_bytes()) return "the block is not a soil of this size";
  bytes += sizeof head;
  for (std::size_t i = 0; i < field_.size(); ++i, bytes += sizeof(SavedCell)) {
    SavedCell saved;
    std::memcpy(&saved, bytes, sizeof saved);
    field_.cell(i) = {saved.level_m, saved.memory_m, saved.pressure_Pa,
                      pressure_.stiffness_Pa_m(saved.memory_m)};
  }
  std::memcpy(shear_.data(), bytes, shear_.size() * sizeof(PatchShear));
  tick_ = head.tick;
  sinkage_m_[0] = head.sinkage_m[0];
  sinkage_m_[1] = head.sinkage_m[1];
  field_.find_top();
  return "";
}

}  // namespace hoap2_sim
