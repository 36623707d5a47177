#include "solver/gyroscopic.h"

namespace hoap2_sim {
namespace {

Vec3 inertia_times(int link, const Vec3 &v) {
  const double(&i)[6] = HOAP2_LINK[link].inertia_C_kgm2;
  return {i[0] * v.x + i[3] * v.y + i[4] * v.z, i[3] * v.x + i[1] * v.y + i[5] * v.z,
          i[4] * v.x + i[5] * v.y + i[2] * v.z};
}

}  // namespace

// A tick solves I(R) (w+ - w) = h tau with the axes R of the tick's start, while
// the angular momentum of its end is I(R+) w+, R+ = exp(h w+) R. The torque
//   tau = -(I(R+) - I(R)) w+ / h = -(exp(h w+) - 1) I(R) w+ / h
// makes up for it (in body axes, as exp(h w) leaves w alone). w+ is extrapolated from
// the last two ticks; the exponential is cut after its third term. ODE's own term,
// -w x I w at the tick's start, keeps a tumble's angular momentum ten times worse.
Vec3 gyroscopic_torque_W_Nm(const BodyState &body, int link, const Mat3 &axes_W) {
  const Vec3 omega_next = turn_back(axes_W, 2.0 * vec(body.omega_W_rad_s) - vec(body.omega_before_W_rad_s));
  const Vec3 first = cross(omega_next, inertia_times(link, omega_next));
  const Vec3 second = (kTick_s / 2.0) * cross(omega_next, first);
  const Vec3 third = (kTick_s / 3.0) * cross(omega_next, second);
  return axes_W * (-1.0 * (first + second + third));
}

}  // namespace hoap2_sim
