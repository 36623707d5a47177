#include "gait_cp/tpcc.hpp"

namespace hoap2 {
namespace {

constexpr double kTick_s = 1e-6 * HOAP2_TICK_US;

double clip(double value, double limit) { return value < -limit ? -limit : (value > limit ? limit : value); }

}  // namespace

void tpcc_step(const hoap2_params_t& params, const double cop_est_m[2], bool feedback, hoap2_gait_t& gait) {
  for (int i = 0; i < 2; ++i) {
    const double raw_m = feedback ? clip(cop_est_m[i] - gait.cop_m[i], params.tpcc_error_limit_m) : 0.0;
    gait.cop_error_m[i] += kTick_s / (params.tpcc_filter_s + kTick_s) * (raw_m - gait.cop_error_m[i]);
    const double accel_m_s2 = params.tpcc_kp_1_s2 * gait.cop_error_m[i] -
                              params.tpcc_kv_1_s * gait.tpcc_rate_m_s[i] -
                              params.tpcc_kx_1_s2 * gait.tpcc_m[i];
    gait.tpcc_rate_m_s[i] += kTick_s * accel_m_s2;
    const double next_m = gait.tpcc_m[i] + kTick_s * gait.tpcc_rate_m_s[i];
    gait.tpcc_m[i] = clip(next_m, params.tpcc_shift_limit_m);
    if (gait.tpcc_m[i] != next_m) gait.tpcc_rate_m_s[i] = 0.0;
  }
}

}  // namespace hoap2
