// The base of support as a convex polygon, and the shift of a CoP into it.
#ifndef HOAP2_GAIT_CP_SUPPORT_POLYGON_HPP
#define HOAP2_GAIT_CP_SUPPORT_POLYGON_HPP

#include "hoap2/generated/robot_model.h"

namespace hoap2 {

struct Point2 {
  double x;
  double y;
};

// Counter-clockwise vertices; two soles have at most eight.
struct SupportPolygon {
  int count = 0;
  Point2 vertex_m[8];
};

// The sole of a footprint (x, y, yaw; left and right soles are alike), shrunk on all sides by margin_m.
SupportPolygon sole_polygon(const double footprint[3], double margin_m);

// Convex hull of two soles.
SupportPolygon hull_of_soles(const double footprint_a[3], const double footprint_b[3], double margin_m);

// Signed distance to the boundary, positive inside: the least over the edges.
double inside_distance(const SupportPolygon& polygon, const Point2& point_m);

// Section 7.2.2 d: a CoP outside is shifted to the boundary along the line through cp_start and cp_eos, on
// which (7.9) puts it. Where the line misses the polygon it is tilted about cp_start just so far that it
// meets the nearest vertex.
Point2 clamp_cop(const SupportPolygon& polygon, const Point2& cop_m, const Point2& cp_start_m,
                 const Point2& cp_eos_m);

}  // namespace hoap2
#endif
