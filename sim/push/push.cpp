#include "push/push.h"

namespace hoap2_sim {
namespace {

double quintic(double s) { return s * s * s * (10.0 + s * (6.0 * s - 15.0)); }

}  // namespace

double push_profile(double after_start_s, double duration_s, double ramp_s) {
  if (after_start_s < 0.0 || after_start_s >= duration_s) return 0.0;
  const double ramp_used_s = ramp_s > 0.5 * duration_s ? 0.5 * duration_s : ramp_s;
  const double before_end_s = duration_s - after_start_s;
  if (after_start_s < ramp_used_s) return quintic(after_start_s / ramp_used_s);
  if (before_end_s < ramp_used_s) return quintic(before_end_s / ramp_used_s);
  return 1.0;
}

void push_force(const hoap2_plant_params_t &params, std::int64_t tick, int i, double force_W_N[3]) {
  // The middle of the tick stands for the tick.
  const double time_s = kTick_s * (static_cast<double>(tick) + 0.5);
  const double share =
      push_profile(time_s - params.push_start_s[i], params.push_duration_s[i], params.push_ramp_s[i]);
  for (int k = 0; k < 3; ++k) force_W_N[k] = share * params.push_force_W_N[i][k];
}

}  // namespace hoap2_sim
