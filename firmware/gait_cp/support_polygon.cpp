#include "gait_cp/support_polygon.hpp"

#include "core/scalar_math.h"

namespace hoap2 {
namespace {

// Twice the area of a triangle that counts as none.
constexpr double kInLine_m2 = 1e-10;

double distance(const Point2& a, const Point2& b) { return hoap2_hypot(a.x - b.x, a.y - b.y); }

double cross(const Point2& origin, const Point2& a, const Point2& b) {
  return (a.x - origin.x) * (b.y - origin.y) - (a.y - origin.y) * (b.x - origin.x);
}

void add_sole(const double footprint[3], double margin_m, Point2* corners) {
  const double front_m = HOAP2_ANKLE_TO_TOE_M - margin_m;
  const double rear_m = -HOAP2_ANKLE_TO_HEEL_M + margin_m;
  const double half_m = HOAP2_SOLE_HALF_WIDTH_M - margin_m;
  const double local[4][2] = {{front_m, -half_m}, {front_m, half_m}, {rear_m, half_m}, {rear_m, -half_m}};
  const double c = hoap2_cos(footprint[2]);
  const double s = hoap2_sin(footprint[2]);
  for (int i = 0; i < 4; ++i) {
    corners[i].x = footprint[0] + c * local[i][0] - s * local[i][1];
    corners[i].y = footprint[1] + s * local[i][0] + c * local[i][1];
  }
}

Point2 nearest_on_segment(const Point2& a, const Point2& b, const Point2& p) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double length2 = dx * dx + dy * dy;
  double t = length2 > 0.0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / length2 : 0.0;
  t = t < 0.0 ? 0.0 : (t > 1.0 ? 1.0 : t);
  return {a.x + t * dx, a.y + t * dy};
}

Point2 nearest_on_boundary(const SupportPolygon& polygon, const Point2& p) {
  Point2 best = polygon.vertex_m[0];
  double best2 = 1e300;
  for (int i = 0; i < polygon.count; ++i) {
    const Point2 q = nearest_on_segment(polygon.vertex_m[i], polygon.vertex_m[(i + 1) % polygon.count], p);
    const double d2 = (q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y);
    if (d2 < best2) {
      best2 = d2;
      best = q;
    }
  }
  return best;
}

}  // namespace

SupportPolygon sole_polygon(const double footprint[3], double margin_m) {
  SupportPolygon polygon;
  polygon.count = 4;
  add_sole(footprint, margin_m, polygon.vertex_m);
  return polygon;
}

// Gift wrapping over eight points, begun at the corner farthest from the middle of the footprints: that one
// is a vertex. Soles side by side have corners in one line up to rounding; of those the farthest is taken.
SupportPolygon hull_of_soles(const double footprint_a[3], const double footprint_b[3], double margin_m) {
  Point2 points[8];
  add_sole(footprint_a, margin_m, points);
  add_sole(footprint_b, margin_m, points + 4);
  const Point2 middle = {0.5 * (footprint_a[0] + footprint_b[0]), 0.5 * (footprint_a[1] + footprint_b[1])};
  int start = 0;
  for (int i = 1; i < 8; ++i)
    if (distance(points[i], middle) > distance(points[start], middle)) start = i;
  SupportPolygon polygon;
  int current = start;
  for (int k = 0; k < 8; ++k) {
    polygon.vertex_m[polygon.count++] = points[current];
    int next = (current + 1) % 8;
    for (int i = 0; i < 8; ++i) {
      const double turn = cross(points[current], points[next], points[i]);
      const bool farther = distance(points[i], points[current]) > distance(points[next], points[current]);
      if (turn < -kInLine_m2 || (turn <= kInLine_m2 && farther)) next = i;
    }
    current = next;
    if (current == start) break;
  }
  return polygon;
}

double inside_distance(const SupportPolygon& polygon, const Point2& point_m) {
  double least = 1e300;
  for (int i = 0; i < polygon.count; ++i) {
    const Point2& a = polygon.vertex_m[i];
    const Point2& b = polygon.vertex_m[(i + 1) % polygon.count];
    const double length = hoap2_hypot(b.x - a.x, b.y - a.y);
    if (length <= 0.0) continue;
    const double distance = cross(a, b, point_m) / length;
    if (distance < least) least = distance;
  }
  return least;
}

Point2 clamp_cop(const SupportPolygon& polygon, const Point2& cop_m, const Point2& cp_start_m,
                 const Point2& cp_eos_m) {
  if (inside_distance(polygon, cop_m) >= 0.0) return cop_m;
  const double dx = cp_eos_m.x - cp_start_m.x;
  const double dy = cp_eos_m.y - cp_start_m.y;
  const double length = hoap2_hypot(dx, dy);
  if (length < 1e-9) return nearest_on_boundary(polygon, cop_m);  // no direction to keep

  // Clip the line cp_start + t d by each edge: what is left is [low, high].
  double low = -1e300;
  double high = 1e300;
  for (int i = 0; i < polygon.count; ++i) {
    const Point2& a = polygon.vertex_m[i];
    const Point2& b = polygon.vertex_m[(i + 1) % polygon.count];
    const double at_start = cross(a, b, cp_start_m);
    const double slope = (b.x - a.x) * dy - (b.y - a.y) * dx;
    if (slope == 0.0) {
      if (at_start < 0.0) high = -1e300;
    } else if (slope > 0.0) {
      const double t = -at_start / slope;
      if (t > low) low = t;
    } else {
      const double t = -at_start / slope;
      if (t < high) high = t;
    }
  }
  if (low > high) {  // the line misses: the vertex that asks for the least tilt about cp_start
    int best = 0;
    double best_tilt = 1e300;
    for (int i = 0; i < polygon.count; ++i) {
      const Point2& v = polygon.vertex_m[i];
      const double along = hoap2_hypot(v.x - cp_start_m.x, v.y - cp_start_m.y);
      const double off = (v.x - cp_start_m.x) * dy - (v.y - cp_start_m.y) * dx;
      const double tilt = (off < 0.0 ? -off : off) / (length * along + 1e-12);
      if (tilt < best_tilt) {
        best_tilt = tilt;
        best = i;
      }
    }
    return polygon.vertex_m[best];
  }
  double t = ((cop_m.x - cp_start_m.x) * dx + (cop_m.y - cp_start_m.y) * dy) / (length * length);
  t = t < low ? low : (t > high ? high : t);
  return {cp_start_m.x + t * dx, cp_start_m.y + t * dy};
}

}  // namespace hoap2
