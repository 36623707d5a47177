#include "terrain/contact.h"

#include <cmath>

#include "robot/kinematics.h"
#include "terrain/floor.h"

namespace hoap2_sim {
namespace {

constexpr int kBoxContacts = 8;

struct Box {
  Vec3 centre_L_m, half_m;
  double radius_m;
};

Box box_of(int link) {
  const hoap2_link_data_t &data = HOAP2_LINK[link];
  const Vec3 low = vec(data.box_min_L_m), high = vec(data.box_max_L_m);
  const Vec3 half_m = 0.5 * (high - low);
  return {0.5 * (low + high), half_m, norm(half_m)};
}

Vec3 box_centre_W_m(const State &state, const Mat3 &axes_W, int link, const Box &box) {
  return vec(state.body[link].com_pos_W_m) + axes_W * (box.centre_L_m - link_com_L_m(state.params, link));
}

void add(int link, const Vec3 &point_W_m, const Vec3 &normal_W, double depth_m, const Mat3 &link_axes,
         ContactList *contacts) {
  if (contacts->count >= kMaxContacts) return;
  Contact &contact = contacts->at[contacts->count++];
  Vec3 along_W = link_axes.cx - dot(link_axes.cx, normal_W) * normal_W;
  if (norm(along_W) < 0.1) along_W = link_axes.cy - dot(link_axes.cy, normal_W) * normal_W;
  contact.link = link;
  put(point_W_m, contact.point_W_m);
  put(normal_W, contact.normal_W);
  put((1.0 / norm(along_W)) * along_W, contact.along_W);
  contact.depth_m = depth_m;
}

}  // namespace

Ground::~Ground() { clear(); }

void Ground::clear() {
  for (dGeomID &geom : block_) {
    if (geom != nullptr) dGeomDestroy(geom);
    geom = nullptr;
  }
  for (dGeomID &geom : link_box_) {
    if (geom != nullptr) dGeomDestroy(geom);
    geom = nullptr;
  }
}

void Ground::build(const hoap2_plant_params_t &params) {
  clear();
  block_count_ = params.block_count;
  for (int b = 0; b < block_count_; ++b) {
    const double *const size_m = params.block_size_m[b];
    const double *const centre_W_m = params.block_centre_W_m[b];
    dMatrix3 axes;
    dRFromAxisAndAngle(axes, 0.0, 0.0, 1.0, params.block_yaw_W_rad[b]);
    block_[b] = dCreateBox(nullptr, size_m[0], size_m[1], size_m[2]);
    dGeomSetPosition(block_[b], centre_W_m[0], centre_W_m[1], centre_W_m[2]);
    dGeomSetRotation(block_[b], axes);
  }
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    const Vec3 half_m = box_of(link).half_m;
    link_box_[link] = dCreateBox(nullptr, 2.0 * half_m.x, 2.0 * half_m.y, 2.0 * half_m.z);
  }
}

// Corners of the link's box below the floor plane.
void Ground::touch_floor(const State &state, const Floor &floor, const Mat3 &axes, int link,
                         ContactList *contacts) const {
  const Box box = box_of(link);
  const Vec3 centre_W_m = box_centre_W_m(state, axes, link, box);
  const double centre_height_m = floor.height_m(centre_W_m);
  if (centre_height_m > box.radius_m) return;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 arm_L_m = {(corner & 1) != 0 ? box.half_m.x : -box.half_m.x,
                          (corner & 2) != 0 ? box.half_m.y : -box.half_m.y,
                          (corner & 4) != 0 ? box.half_m.z : -box.half_m.z};
    const Vec3 arm_W_m = axes * arm_L_m;
    const double height_m = centre_height_m + dot(floor.normal_W(), arm_W_m);
    if (height_m >= 0.0 || floor.is_over_pool(centre_W_m + arm_W_m)) continue;
    add(link, centre_W_m + arm_W_m, floor.normal_W(), -height_m, axes, contacts);
  }
}

void Ground::touch_block(const State &state, const Mat3 &axes, int link, int block,
                         ContactList *contacts) const {
  const hoap2_plant_params_t &params = state.params;
  const Box box = box_of(link);
  const Vec3 centre_W_m = box_centre_W_m(state, axes, link, box);
  const Vec3 away_W_m = centre_W_m - vec(params.block_centre_W_m[block]);
  const Vec3 away_B_m = turn_back(rotation(2, params.block_yaw_W_rad[block]), away_W_m);
  for (int i = 0; i < 3; ++i) {
    if (std::fabs(away_B_m[i]) > 0.5 * params.block_size_m[block][i] + box.radius_m) return;
  }
  const double *const q = state.body[link].quat_W;
  const dQuaternion quat_W = {q[0], q[1], q[2], q[3]};
  dGeomSetPosition(link_box_[link], centre_W_m.x, centre_W_m.y, centre_W_m.z);
  dGeomSetQuaternion(link_box_[link], quat_W);
  dContactGeom found[kBoxContacts];
  const int count = dCollide(link_box_[link], block_[block], kBoxContacts, found, sizeof(dContactGeom));
  for (int i = 0; i < count; ++i) {
    const Vec3 point = {found[i].pos[0], found[i].pos[1], found[i].pos[2]};
    const Vec3 normal = {found[i].normal[0], found[i].normal[1], found[i].normal[2]};
    add(link, point, normal, found[i].depth, axes, contacts);
  }
}

void Ground::find_contacts(const State &state, const Mat3 axes_W[HOAP2_LINKS], ContactList *contacts) const {
  contacts->count = 0;
  const Floor floor(state.params);
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    touch_floor(state, floor, axes_W[link], link, contacts);
    for (int block = 0; block < block_count_; ++block)
      touch_block(state, axes_W[link], link, block, contacts);
  }
}

}  // namespace hoap2_sim
