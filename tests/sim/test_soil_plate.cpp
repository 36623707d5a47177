// Energy: a free plate on the soil, and soles that are moved at random.
#include <random>

#include "soil_rig.h"

namespace hoap2_sim {
namespace {

constexpr double kMass_kg = 3.0;
constexpr Vec3 kInertia_kgm2 = {0.0014, 0.0028, 0.0034};  // 3 kg, 98 x 63 x 40 mm

double motion_J(const SoilRig &rig) {
  const BodyState &body = rig.state.body[SoilRig::kRight];
  const Vec3 vel = vec(body.com_vel_W_m_s);
  const Vec3 spin = turn_back(rig.axes_W[SoilRig::kRight], vec(body.omega_W_rad_s));
  double twice = kMass_kg * dot(vel, vel);
  for (int i = 0; i < 3; ++i) twice += kInertia_kgm2[i] * spin[i] * spin[i];
  return 0.5 * twice;
}
double energy_J(const SoilRig &rig) {
  const Vec3 com_W_m = vec(rig.state.body[SoilRig::kRight].com_pos_W_m);
  const double height_m = dot(rig.pool.axes_W.cz, com_W_m - rig.pool.origin_W_m);
  return motion_J(rig) + kMass_kg * kGravity_m_s2 * height_m;
}

TEST(SoilPlate, DroppedBlockComesToRestAndGainsNothing) {
  for (const int law : {HOAP2_SOIL_LAW_BEKKER, HOAP2_SOIL_LAW_RFT}) {
    for (const double tilt_rad : {0.0, 0.1, 0.25}) {
      SoilRig rig;
      rig.params.soil_law = law;
      rig.params.soil_links = HOAP2_SOIL_LINKS_ALL;
      rig.build();
      rig.put_sole({0.2031, 0.0117, 0.03 + 0.06 * std::sin(tilt_rad)},
                   rotation(0, -0.7 * tilt_rad) * rotation(1, tilt_rad));
      const double start_J = energy_J(rig);
      double after_J = start_J;
      for (int i = 0; i < 3000; ++i) {
        rig.fall(kMass_kg, kInertia_kgm2);
        ASSERT_LE(energy_J(rig), start_J + 1e-9);
        if (i == 150) after_J = energy_J(rig);
      }
      EXPECT_LT(motion_J(rig), 1e-5 * start_J) << law << " " << tilt_rad;
      EXPECT_LT(energy_J(rig), after_J + 1e-6);
      EXPECT_NEAR(kMass_kg * kGravity_m_s2, rig.wrench(Vec3{}).force_W_N.z, 0.02 * kMass_kg * kGravity_m_s2);
      EXPECT_LT(rig.sole_P_m().z, -0.001);
    }
  }
}

// Deepest and shallowest corner of a plate that is pressed at its toe.
struct Sunk {
  double toe_m, heel_m;
};
Sunk pressed_at_toe(double edge_loss, double ahead_m) {
  SoilRig rig;
  rig.params.soil_edge_loss = edge_loss;
  rig.build();
  rig.put_sole({0.2031, 0.0117, 0.0});
  for (int i = 0; i < 2000; ++i) {
    const double part = std::min(1.0, 1e-3 * i);
    const Vec3 middle = rig.axes_W[SoilRig::kRight] * SoilRig::sole_arm_L_m();
    const Vec3 arm = middle + ahead_m * rig.axes_W[SoilRig::kRight].cx;
    const Vec3 push_N = {0.0, 0.0, -part * 40.0};
    rig.fall(kMass_kg, kInertia_kgm2,
             {push_N, cross(arm, push_N) + cross(middle, Vec3{0.0, 0.0, -kMass_kg * kGravity_m_s2})});
  }
  const Mat3 axes = rig.axes_P();
  const double middle_m = -rig.sole_P_m().z, slope_m = 0.5 * kSoleLength_m * axes.cx.z;
  return {middle_m - slope_m, middle_m + slope_m};
}

TEST(SoilPlate, PressedAtItsToeItTiltsForward) {
  const Sunk ahead = pressed_at_toe(0.3, 0.02), behind = pressed_at_toe(0.3, -0.02),
             middle = pressed_at_toe(0.3, 0.0);
  EXPECT_GT(ahead.toe_m, ahead.heel_m + 0.002);
  EXPECT_GT(behind.heel_m, behind.toe_m + 0.002);
  EXPECT_NEAR(middle.toe_m, middle.heel_m, 1e-4);
  // Where the fringe bears less it sinks more.
  const Sunk without = pressed_at_toe(0.0, 0.02);
  EXPECT_GT(ahead.toe_m, without.toe_m + 2e-4);
  EXPECT_GT(ahead.toe_m - ahead.heel_m, without.toe_m - without.heel_m + 1e-4);
}

// Smooth random motion of the six velocities of a sole about a point near the surface.
class RandomMotion {
 public:
  RandomMotion(unsigned seed, double speed_m_s, double rate_rad_s)
      : speed_m_s_(speed_m_s), rate_rad_s_(rate_rad_s) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    for (auto &wave : wave_) {
      for (int k = 0; k < kWaves; ++k)
        wave[k] = {2.0 + 40.0 * any(random), 6.3 * any(random), any(random) / kWaves};
    }
  }
  void at(int tick, Vec3 *vel_m_s, Vec3 *omega_rad_s) const {
    double sum[6] = {};
    for (int i = 0; i < 6; ++i) {
      for (const Wave &wave : wave_[i]) {
        sum[i] += wave.size * std::sin(wave.omega_rad_s * kTick_s * tick + wave.phase_rad);
      }
    }
    *vel_m_s = {speed_m_s_ * sum[0], speed_m_s_ * sum[1], speed_m_s_ * sum[2]};
    *omega_rad_s = {rate_rad_s_ * sum[3], rate_rad_s_ * sum[4], rate_rad_s_ * sum[5]};
  }

 private:
  static constexpr int kWaves = 4;
  struct Wave {
    double omega_rad_s, phase_rad, size;
  };
  Wave wave_[6][kWaves];
  double speed_m_s_, rate_rad_s_;
};

double power_W(const Wrench &wrench, const Vec3 &vel_m_s, const Vec3 &omega_rad_s) {
  return dot(wrench.force_W_N, vel_m_s) + dot(wrench.torque_W_Nm, omega_rad_s);
}

// From fresh ground on, the soil never gives back more than was put into it.
TEST(SoilPlate, NeverGivesEnergy) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SoilRig rig;
    rig.params.soil_law = seed % 2 == 0 ? HOAP2_SOIL_LAW_RFT : HOAP2_SOIL_LAW_BEKKER;
    rig.params.soil_damping_Pas_m = seed % 3 == 0 ? 0.0 : 4e4;
    rig.params.soil_unload_Pa_m = seed % 5 == 0 ? 1e5 : 1e8;
    rig.params.soil_n = seed % 7 == 0 ? 0.66 : 1.1;
    rig.params.soil_shear_m = seed % 4 == 0 ? 5e-4 : 8e-3;
    rig.params.soil_roughness_m = 0.0005;
    rig.params.soil_seed = static_cast<std::int32_t>(seed);
    rig.build();
    rig.put_sole({0.2, 0.01, 0.004});
    const RandomMotion motion(seed, 0.05, 0.3);
    double work_J = 0.0, most_J = 0.0, sum_J = 0.0;
    for (int i = 0; i < 3000; ++i) {
      Vec3 vel, omega;
      motion.at(i, &vel, &omega);
      // Held near the surface, near level, by its own velocity.
      const Vec3 middle_m = rig.sole_P_m();
      const Mat3 axes = rig.axes_P();
      vel = vel + Vec3{0.0, 0.0, -2.0 * (middle_m.z + 0.003)};
      omega = omega - 3.0 * cross(Vec3{0.0, 0.0, 1.0}, axes.cz);
      const double step_J = kTick_s * power_W(rig.move(vel, omega), vel, omega);
      work_J += step_J;
      sum_J += std::fabs(step_J);
      most_J = std::max(most_J, work_J);
    }
    EXPECT_LT(most_J, 1e-6) << "seed " << seed;
    EXPECT_LT(work_J, -0.01 * sum_J) << "seed " << seed;
    EXPECT_GT(sum_J, 0.02) << "seed " << seed;
  }
}

// A slow cycle of pressing and letting go costs the area between the virgin curve and the way back.
TEST(SoilPlate, SlowCycleCostsItsArea) {
  SoilRig rig;
  rig.params.soil_edge_loss = 0.0;
  rig.params.soil_damping_Pas_m = 0.0;
  rig.build();
  rig.put_sole({0.2031, 0.0117, 0.0});
  double work_J = 0.0;
  constexpr int kTicks = 10000;
  const double depth_m = 0.005, speed_m_s = depth_m / (kTicks * kTick_s);
  for (int i = 0; i < 2 * kTicks; ++i) {
    const Vec3 vel = {0.0, 0.0, i < kTicks ? -speed_m_s : speed_m_s};
    work_J += kTick_s * power_W(rig.move(vel), vel, Vec3{});
  }
  const double held_Pa = 6e6 * std::pow(depth_m, 1.1);
  const double area_J = kSole_m2 * (held_Pa * depth_m / 2.1 - held_Pa * held_Pa / 2e8);
  EXPECT_NEAR(area_J, -work_J, 0.002 * area_J);
}

TEST(SoilPlate, SlopeIsSymmetricAndNeverNegative) {
  for (const int law : {HOAP2_SOIL_LAW_BEKKER, HOAP2_SOIL_LAW_RFT}) {
    SoilRig rig;
    rig.params.soil_law = law;
    rig.params.start_yaw_W_rad = 0.7;
    rig.build();
    rig.put_sole({0.2, 0.01, -0.001});
    const RandomMotion motion(11, 0.1, 0.5);
    for (int i = 0; i < 500; ++i) {
      Vec3 vel, omega;
      motion.at(i, &vel, &omega);
      rig.move(vel, omega);
      const SoilLoad &load = rig.load[SoilRig::kRight];
      if (!load.touches) continue;
      Eigen::Matrix<double, 6, 6> slope;
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
          slope(r, c) = load.angular[r][c];
          slope(r, 3 + c) = load.coupling[r][c];
          slope(3 + c, r) = load.coupling[r][c];
          slope(3 + r, 3 + c) = load.linear[r][c];
        }
      }
      ASSERT_LT((slope - slope.transpose()).norm(), 1e-12 * slope.norm());
      const double least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>(slope).eigenvalues()(0);
      ASSERT_GT(least, -1e-10 * slope.norm());
    }
  }
}

// With the velocity unchanged over the tick the ground pushes or lets go.
TEST(SoilPlate, DoesNotPull) {
  SoilRig rig;
  rig.build();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < 300; ++i) {
    rig.soil.start();
    rig.put_sole({0.2, 0.01, -0.003});
    rig.move(Vec3{});
    rig.move({0.0, 0.0, 0.02 * std::fabs(any(random))});
    const Vec3 vel = {0.0, 0.0, 0.6 * any(random)};
    put(vel, rig.state.body[SoilRig::kRight].com_vel_W_m_s);
    ASSERT_EQ("", rig.soil.find_loads(rig.state, rig.axes_W, rig.load));
    EXPECT_GE(rig.wrench(vel).force_W_N.z, -1e-9) << vel.z;
  }
}

}  // namespace
}  // namespace hoap2_sim
