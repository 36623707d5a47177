#include "marks.h"

#include <algorithm>

#include "hoap2/generated/robot_model.h"

namespace hoap2 {
namespace {

// A mark on the soil lies as high as the highest soil this near.
constexpr float kMarkReach_m = 0.008F;

constexpr float kPi = 3.14159265358979F;

// The same colours stand in the legend of host_tools/hoap2/pictures.py.
constexpr Colour kCom = {0.98F, 0.78F, 0.08F, 1.0F};
constexpr Colour kComDark = {0.10F, 0.10F, 0.12F, 1.0F};
constexpr Colour kCop = {0.86F, 0.12F, 0.14F, 1.0F};
constexpr Colour kCp = {0.02F, 0.62F, 0.36F, 1.0F};
constexpr Colour kRight = {0.91F, 0.42F, 0.10F, 1.0F};
constexpr Colour kLeft = {0.10F, 0.40F, 0.86F, 1.0F};
constexpr Colour kPush = {0.72F, 0.10F, 0.58F, 1.0F};
constexpr Colour kRim = {1.0F, 1.0F, 1.0F, 0.95F};

Colour faded(Colour c, float alpha) { return {c.r, c.g, c.b, c.a * alpha}; }

void triangle(Marks &marks, Vec3 a, Vec3 b, Vec3 c, Vec3 normal, Colour colour) {
  for (const Vec3 p : {a, b, c}) marks.push_back({p, normal, colour});
}

// Frame of the ground: x and y in the plane, heading along yaw.
struct Plane {
  Vec3 centre, x, y, n;
  Vec3 at(float u, float v) const { return centre + x * u + y * v; }
};

Plane plane_at(Vec3 centre, Vec3 normal, float yaw, float lift_m) {
  const Vec3 y = unit(cross(normal, {std::cos(yaw), std::sin(yaw), 0.0F}));
  return {centre + normal * lift_m, cross(y, normal), y, normal};
}

void disc(Marks &marks, const Plane &plane, float inner_m, float outer_m, Colour colour) {
  constexpr int kSides = 28;
  for (int i = 0; i < kSides; ++i) {
    const float a = 2.0F * kPi * static_cast<float>(i) / kSides;
    const float b = 2.0F * kPi * static_cast<float>(i + 1) / kSides;
    const Vec3 oa = plane.at(outer_m * std::cos(a), outer_m * std::sin(a));
    const Vec3 ob = plane.at(outer_m * std::cos(b), outer_m * std::sin(b));
    const Vec3 ia = plane.at(inner_m * std::cos(a), inner_m * std::sin(a));
    const Vec3 ib = plane.at(inner_m * std::cos(b), inner_m * std::sin(b));
    triangle(marks, ia, oa, ob, plane.n, colour);
    if (inner_m > 0.0F) triangle(marks, ia, ob, ib, plane.n, colour);
  }
}

// Sole with rounded corners: a thin fill and an outline that runs just inside the edge.
void footprint(Marks &marks, const Plane &plane, Colour colour, float alpha, float fill) {
  constexpr int kArc = 4;
  constexpr float kCorner = 0.012F;
  constexpr float kOutline = 0.0024F;
  const auto toe = static_cast<float>(HOAP2_ANKLE_TO_TOE_M),
             heel = static_cast<float>(-HOAP2_ANKLE_TO_HEEL_M);
  const auto side = static_cast<float>(HOAP2_SOLE_HALF_WIDTH_M);
  struct Corner {
    float u, v, start;
  };
  const Corner corners[] = {{toe - kCorner, side - kCorner, 0.0F},
                            {heel + kCorner, side - kCorner, 0.5F * kPi},
                            {heel + kCorner, kCorner - side, kPi},
                            {toe - kCorner, kCorner - side, 1.5F * kPi}};
  std::vector<Vec3> outer, inner;
  for (const Corner &corner : corners) {
    for (int i = 0; i <= kArc; ++i) {
      const float angle = corner.start + 0.5F * kPi * static_cast<float>(i) / kArc;
      const float c = std::cos(angle), s = std::sin(angle);
      outer.push_back(plane.at(corner.u + kCorner * c, corner.v + kCorner * s));
      inner.push_back(plane.at(corner.u + (kCorner - kOutline) * c, corner.v + (kCorner - kOutline) * s));
    }
  }
  const Vec3 middle = plane.at(0.5F * (toe + heel), 0.0F);
  for (size_t i = 0; i < outer.size(); ++i) {
    const size_t k = (i + 1) % outer.size();
    triangle(marks, middle, inner[i], inner[k], plane.n, faded(colour, fill * alpha));
    triangle(marks, inner[i], outer[i], outer[k], plane.n, faded(colour, alpha));
    triangle(marks, inner[i], outer[k], inner[k], plane.n, faded(colour, alpha));
  }
}

// The engineer's sign of a centre of mass: a ball with octants of two colours.
void com_ball(Marks &marks, Vec3 centre, float radius_m) {
  constexpr int kAround = 20;
  constexpr int kRows = 10;
  const auto point = [](int row, int column) {
    const float polar = kPi * static_cast<float>(row) / kRows;
    const float angle = 2.0F * kPi * static_cast<float>(column) / kAround;
    return Vec3{std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar)};
  };
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kAround; ++column) {
      const bool bright = ((column * 4 / kAround) + (row * 2 / kRows)) % 2 == 0;
      const Colour colour = bright ? kCom : kComDark;
      const Vec3 p[] = {point(row, column), point(row + 1, column), point(row + 1, column + 1),
                        point(row, column + 1)};
      for (const auto &corner : {std::array<int, 3>{0, 1, 2}, std::array<int, 3>{0, 2, 3}}) {
        for (const int i : corner) marks.push_back({centre + p[i] * radius_m, p[i], colour});
      }
    }
  }
}

// Rod or cone from `from` to `to`.
void tube(Marks &marks, Vec3 from, Vec3 to, float radius_from_m, float radius_to_m, Colour colour) {
  constexpr int kSides = 10;
  const Vec3 along = unit(to - from);
  const Vec3 any = std::abs(along.z) < 0.9F ? Vec3{0.0F, 0.0F, 1.0F} : Vec3{1.0F, 0.0F, 0.0F};
  const Vec3 u = unit(cross(along, any));
  const Vec3 v = cross(along, u);
  for (int i = 0; i < kSides; ++i) {
    const float a = 2.0F * kPi * static_cast<float>(i) / kSides;
    const float b = 2.0F * kPi * static_cast<float>(i + 1) / kSides;
    const Vec3 da = u * std::cos(a) + v * std::sin(a);
    const Vec3 db = u * std::cos(b) + v * std::sin(b);
    triangle(marks, from + da * radius_from_m, from + db * radius_from_m, to + db * radius_to_m, da, colour);
    triangle(marks, from + da * radius_from_m, to + db * radius_to_m, to + da * radius_to_m, da, colour);
    triangle(marks, from, from + db * radius_from_m, from + da * radius_from_m, along * -1.0F, colour);
  }
}

Vec3 local(const double *p_W_m, const std::array<double, 3> &origin, int count) {
  const double z = count > 2 ? p_W_m[2] - origin[2] : 0.0;
  return {static_cast<float>(p_W_m[0] - origin[0]), static_cast<float>(p_W_m[1] - origin[1]),
          static_cast<float>(z)};
}

bool finite(const double *values, int count) {
  return std::all_of(values, values + count, [](double v) { return std::isfinite(v); });
}

// Plane of the ground at x, y: the floor's, or level on top of a block.
Plane plane_on(const Ground &ground, Vec3 p, float yaw, float lift_m) {
  const Vec3 top = ground.point(p.x, p.y);
  const bool on_floor = ground.is_soil() || top.z <= ground.floor_point(p.x, p.y).z;
  return plane_at(top, on_floor ? ground.normal() : Vec3{0.0F, 0.0F, 1.0F}, yaw, lift_m);
}

}  // namespace

Ground::Ground(const hoap2_scene_t &scene, const std::array<double, 3> &origin_W_m, const SoilSurface &soil)
    : soil_(soil), pool_(soil.pose(origin_W_m)) {
  through_ = local(scene.floor_origin_W_m, origin_W_m, 3);
  const auto about_x = static_cast<float>(scene.floor_tilt_rad[0]);
  const auto about_y = static_cast<float>(scene.floor_tilt_rad[1]);
  // R_x(a) R_y(b) e_z
  normal_ = {std::sin(about_y), -std::sin(about_x) * std::cos(about_y),
             std::cos(about_x) * std::cos(about_y)};
  for (int i = 0; i < scene.block_count; ++i) {
    const double *size = scene.block_size_m[i];
    blocks_.push_back(
        {local(scene.block_centre_W_m[i], origin_W_m, 3),
         Vec3{static_cast<float>(size[0]), static_cast<float>(size[1]), static_cast<float>(size[2])} * 0.5F,
         static_cast<float>(scene.block_yaw_W_rad[i])});
  }
}

Vec3 Ground::floor_point(float x, float y) const {
  const float slope = normal_.x * (x - through_.x) + normal_.y * (y - through_.y);
  return {x, y, through_.z - slope / normal_.z};
}

Vec3 Ground::point(float x, float y) const {
  Vec3 p = floor_point(x, y);
  for (const Block &block : blocks_) {
    const float dx = x - block.centre.x, dy = y - block.centre.y;
    const float c = std::cos(block.yaw), s = std::sin(block.yaw);
    const bool above = std::abs(c * dx + s * dy) <= block.half.x && std::abs(c * dy - s * dx) <= block.half.y;
    if (above) p.z = std::max(p.z, block.centre.z + block.half.z);
  }
  const Vec3 place = soil_.exists() ? pool_place(p) : Vec3{};
  if (soil_.is_inside(place.x, place.y)) p.z += soil_.height_m(place.x, place.y, kMarkReach_m) / normal_.z;
  return p;
}

Vec3 Ground::pool_point(Vec3 p_P_m) const {
  Vec3 p;
  for (size_t k = 0; k < 3; ++k) {
    const float *const row = pool_.data() + 4 * k;
    (k == 0 ? p.x : (k == 1 ? p.y : p.z)) = dot({row[0], row[1], row[2]}, p_P_m) + row[3];
  }
  return p;
}

Vec3 Ground::pool_place(Vec3 p) const {
  const Vec3 arm = p - Vec3{pool_[3], pool_[7], pool_[11]};
  return {dot({pool_[0], pool_[4], pool_[8]}, arm), dot({pool_[1], pool_[5], pool_[9]}, arm),
          dot({pool_[2], pool_[6], pool_[10]}, arm)};
}

Marks footprint_marks(const hoap2_scene_t &scene, const Ground &ground,
                      const std::array<double, 3> &origin_W_m) {
  Marks marks;
  if ((scene.show & HOAP2_SHOW_FOOTPRINTS) == 0) return marks;
  for (int i = 0; i < scene.footprint_count; ++i) {
    const double *print_W = scene.footprint_W_m_rad[i];
    if (!finite(print_W, 3)) continue;
    const Vec3 place = local(print_W, origin_W_m, 2);
    const auto yaw = static_cast<float>(print_W[2]);
    const Plane plane = ground.is_soil()
                            ? plane_at(ground.floor_point(place.x, place.y), ground.normal(), yaw, 0.0F)
                            : plane_on(ground, place, yaw, 0.0003F);
    const int age = scene.footprint_count - 1 - i;
    const float alpha = std::max(0.45F, 1.0F - 0.06F * static_cast<float>(age));
    // On soil without a fill: it would blend with the colours of the sinkage.
    footprint(marks, plane, scene.footprint_left[i] != 0 ? kLeft : kRight, alpha,
              ground.is_soil() ? 0.0F : 0.20F);
  }
  return marks;
}

Marks point_marks(const hoap2_scene_t &scene, const Ground &ground, const std::array<double, 3> &origin_W_m) {
  Marks marks;
  const auto plane = [&](const double *p_W_m, float lift_m) {
    return plane_on(ground, local(p_W_m, origin_W_m, 2), 0.0F, lift_m);
  };
  if ((scene.show & HOAP2_SHOW_COM) != 0 && finite(scene.com_W_m, 3)) {
    disc(marks, plane(scene.com_W_m, 0.0006F), 0.0F, 0.0065F, kRim);
    disc(marks, plane(scene.com_W_m, 0.0006F), 0.0F, 0.0052F, kCom);
  }
  if ((scene.show & HOAP2_SHOW_COP) != 0 && finite(scene.cop_W_m, 2)) {
    disc(marks, plane(scene.cop_W_m, 0.0007F), 0.0F, 0.0085F, kRim);
    disc(marks, plane(scene.cop_W_m, 0.0007F), 0.0F, 0.0070F, kCop);
  }
  if ((scene.show & HOAP2_SHOW_CP) != 0 && finite(scene.cp_W_m, 2)) {
    const Plane p = plane(scene.cp_W_m, 0.0008F);
    disc(marks, p, 0.0072F, 0.0122F, kRim);
    disc(marks, p, 0.0082F, 0.0112F, kCp);
    disc(marks, p, 0.0F, 0.0034F, kCp);
  }
  return marks;
}

Marks air_marks(const hoap2_scene_t &scene, const Ground &ground, const std::array<double, 3> &origin_W_m) {
  Marks marks;
  if ((scene.show & HOAP2_SHOW_COM) != 0 && finite(scene.com_W_m, 3)) {
    const Vec3 com = local(scene.com_W_m, origin_W_m, 3);
    tube(marks, ground.point(com.x, com.y), com, 0.0011F, 0.0011F, kCom);
    com_ball(marks, com, 0.0125F);
  }
  const double *f = scene.push_force_W_N;
  const double force_N = std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
  if ((scene.show & HOAP2_SHOW_PUSH) != 0 && std::isfinite(force_N) && force_N > 0.05 &&
      finite(scene.push_point_W_m, 3)) {
    const Vec3 along = unit({static_cast<float>(f[0]), static_cast<float>(f[1]), static_cast<float>(f[2])});
    // 6 mm a newton, between 60 and 250 mm
    const float length_m = std::clamp(0.006F * static_cast<float>(force_N), 0.06F, 0.25F);
    const Vec3 tip = local(scene.push_point_W_m, origin_W_m, 3);
    const Vec3 neck = tip - along * 0.032F;
    tube(marks, tip - along * length_m, neck, 0.0050F, 0.0050F, kPush);
    tube(marks, neck, tip, 0.0125F, 0.0F, kPush);
  }
  return marks;
}

}  // namespace hoap2
