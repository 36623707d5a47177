// Shear of the soil under a sole that is moved along the ground.
#include "soil_rig.h"

namespace hoap2_sim {
namespace {

// A sole held at a depth, its normal force and the largest shear it can bear. It stands
// so that it can move by 4 mm without meeting new ground.
class ShearedSole : public SoilRig {
 public:
  ShearedSole() {
    params.soil_edge_loss = 0.0;
    params.soil_shear_m = 2e-4;
  }
  void start() {
    build();
    put_sole({0.204, 0.002, -kDepth_m});
    move(Vec3{});
    move(Vec3{});
  }
  double normal_N() const { return kSole_m2 * params.soil_kphi_N_m_n2 * std::pow(kDepth_m, params.soil_n); }
  double limit_N() const {
    return kSole_m2 * params.soil_cohesion_Pa + normal_N() * std::tan(params.soil_friction_rad);
  }
  // Force at zero velocity, pool axes.
  Vec3 force_N() {
    EXPECT_EQ("", soil.find_loads(state, axes_W, load));
    return turn_back(pool.axes_W, wrench(Vec3{}).force_W_N);
  }
  static constexpr double kDepth_m = 0.004;
};

TEST(SoilShear, FollowsTheExponentialToMohrAndCoulomb) {
  ShearedSole rig;
  rig.start();
  for (int i = 1; i <= 1500; ++i) {
    rig.move({0.0012, 0.0016, 0.0});
    const double way_m = 2e-6 * i;
    const double expected_N = rig.limit_N() * (1.0 - std::exp(-way_m / rig.params.soil_shear_m));
    const Vec3 force_N = rig.force_N();
    ASSERT_NEAR(-0.6 * expected_N, force_N.x, 1e-6 * rig.limit_N()) << way_m;
    ASSERT_NEAR(-0.8 * expected_N, force_N.y, 1e-6 * rig.limit_N()) << way_m;
    ASSERT_NEAR(rig.normal_N(), force_N.z, 1e-6 * rig.normal_N());
  }
  EXPECT_NEAR(rig.limit_N(), norm(Vec3{rig.force_N().x, rig.force_N().y, 0.0}), 1e-6 * rig.limit_N());
}

TEST(SoilShear, CohesionAndFrictionEachCarryTheirPart) {
  for (const double cohesion_Pa : {0.0, 3000.0}) {
    ShearedSole rig;
    rig.params.soil_cohesion_Pa = cohesion_Pa;
    rig.params.soil_friction_rad = 0.4;
    rig.start();
    for (int i = 0; i < 1500; ++i) rig.move({0.002, 0.0, 0.0});
    const double expected_N = cohesion_Pa * kSole_m2 + rig.normal_N() * std::tan(0.4);
    EXPECT_NEAR(expected_N, -rig.force_N().x, 1e-5 * expected_N);
  }
}

// On the way back the force falls at once, twice as fast.
TEST(SoilShear, ReversalIsFeltAtOnce) {
  ShearedSole rig;
  rig.start();
  const double limit_N = rig.limit_N();
  for (int i = 0; i < 1500; ++i) rig.move({0.002, 0.0, 0.0});
  EXPECT_NEAR(limit_N, -rig.force_N().x, 1e-5 * limit_N);
  for (int i = 1; i <= 1500; ++i) {
    rig.move({-0.002, 0.0, 0.0});
    const double expected_N = -limit_N + 2.0 * limit_N * std::exp(-2e-6 * i / rig.params.soil_shear_m);
    ASSERT_NEAR(expected_N, -rig.force_N().x, 1e-5 * limit_N) << i;
  }
}

TEST(SoilShear, StepIsImplicit) {
  ShearedSole rig;
  rig.start();
  for (int i = 0; i < 30; ++i) rig.move({0.002, 0.001, 0.0});
  const Vec3 before_N = rig.force_N();
  const Vec3 step_N = rig.wrench({0.002, 0.001, 0.0}).force_W_N;
  rig.move({0.002, 0.001, 0.0});
  const Vec3 after_N = rig.force_N();
  EXPECT_GT(std::fabs(after_N.x - before_N.x), 0.05);
  EXPECT_NEAR(after_N.x, step_N.x, 0.01 * std::fabs(after_N.x - before_N.x));
  EXPECT_NEAR(after_N.y, step_N.y, 0.01 * std::fabs(after_N.y - before_N.y));
}

TEST(SoilShear, IsForgottenAboveTheGround) {
  ShearedSole rig;
  rig.start();
  for (int i = 0; i < 100; ++i) rig.move({0.002, 0.0, 0.0});
  EXPECT_LT(rig.force_N().x, -1.0);
  for (int i = 0; i < 10; ++i) rig.move({0.0, 0.0, 0.5});
  rig.put_sole({0.15, 0.1, -ShearedSole::kDepth_m});
  EXPECT_EQ(0.0, rig.force_N().x);
}

// A sole that carries less keeps the share of its shear that it can bear.
TEST(SoilShear, NeverExceedsWhatTheLoadBears) {
  ShearedSole rig;
  rig.start();
  for (int i = 0; i < 1500; ++i) rig.move({0.002, 0.0, 0.0});
  for (int i = 0; i < 200; ++i) {
    rig.move({0.0, 0.0, 0.0005});
    const Vec3 force_N = rig.force_N();
    const double limit_N =
        kSole_m2 * rig.params.soil_cohesion_Pa + force_N.z * std::tan(rig.params.soil_friction_rad);
    EXPECT_LE(-force_N.x, limit_N * (1.0 + 1e-9) + 1e-9);
  }
}

// A sole turned about its middle: torque by patches against the integral.
double turning_torque_Nm(int patches_a, int patches_b) {
  ShearedSole rig;
  rig.params.soil_cell_m = 0.00125;  // finer than the patches
  rig.params.soil_patches[0] = patches_a;
  rig.params.soil_patches[1] = patches_b;
  rig.start();
  const double rate_rad_s = 0.02;
  for (int i = 0; i < 500; ++i) {
    const Vec3 arm = rig.axes_W[SoilRig::kRight] * SoilRig::sole_arm_L_m();
    const Vec3 omega = {0.0, 0.0, rate_rad_s};
    rig.move(-1.0 * cross(omega, arm), omega);
  }
  EXPECT_EQ("", rig.soil.find_loads(rig.state, rig.axes_W, rig.load));
  const Wrench wrench = rig.wrench(Vec3{});
  const Vec3 arm = rig.axes_W[SoilRig::kRight] * SoilRig::sole_arm_L_m();
  return (wrench.torque_W_Nm - cross(arm, wrench.force_W_N)).z;
}

TEST(SoilShear, ConvergesWithThePatches) {
  const double exact_Nm = turning_torque_Nm(40, 24);
  EXPECT_LT(exact_Nm, -0.05);
  double last = 1.0;
  for (const int k : {1, 2, 4}) {
    const double error = std::fabs(turning_torque_Nm(5 * k, 3 * k) / exact_Nm - 1.0);
    EXPECT_LT(error, 0.5 * last);
    last = error;
  }
}

}  // namespace
}  // namespace hoap2_sim
