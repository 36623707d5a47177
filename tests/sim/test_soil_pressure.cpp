// Pressure of the soil under a sole that is moved: sinkage curve, memory, edges, meshes.
#include "soil/power.h"
#include "soil_rig.h"

namespace hoap2_sim {
namespace {

constexpr Vec3 kPlace_m = {0.2031, 0.0317, 0.0};
constexpr double kPi = 3.14159265358979323846;

double modulus(const hoap2_plant_params_t &params) {
  return params.soil_kc_N_m_n1 / kSoleWidth_m + params.soil_kphi_N_m_n2;
}

// Vertical force at zero velocity with the sole at this depth; the soil does not change.
double force_at(SoilRig *rig, double depth_m, const Mat3 &axes = Mat3{}) {
  rig->put_sole({kPlace_m.x, kPlace_m.y, -depth_m}, axes);
  EXPECT_EQ("", rig->soil.find_loads(rig->state, rig->axes_W, rig->load));
  return rig->wrench(Vec3{}).force_W_N.z;
}

// Presses the sole slowly from the surface to this depth.
void press_to(SoilRig *rig, double depth_m, const Vec3 &place_m = kPlace_m) {
  constexpr int kTicks = 100;
  rig->put_sole(place_m);
  for (int i = 0; i < kTicks; ++i) rig->move({0.0, 0.0, -depth_m / (kTicks * kTick_s)});
  rig->move(Vec3{});  // the pose reached becomes memory
}

TEST(SoilPower, AgreesWithPow) {
  for (const double n : {0.3, 0.66, 0.79, 1.0, 1.1, 2.0}) {
    Power power;
    power.build(n);
    for (double z = 1e-12; z < 100.0; z *= 1.037)
      EXPECT_NEAR(1.0, power(z) / std::pow(z, n), 2e-14) << n << " " << z;
    EXPECT_DOUBLE_EQ(std::pow(1000.0, n), power(1000.0));
    EXPECT_EQ(0.0, n == 1.0 ? 0.0 : power(0.0));
    EXPECT_EQ(0.0, n == 1.0 ? 0.0 : power(-0.01));
  }
}

struct Ground {
  double kc, kphi, n;
};

TEST(SoilPressure, SinkageFollowsTheCurve) {
  for (const Ground &ground :
       {Ground{0.0, 6e6, 1.1}, Ground{990.0, 1.528e6, 1.1}, Ground{102e3, 5.301e6, 0.79}}) {
    SoilRig rig;
    rig.params.soil_kc_N_m_n1 = ground.kc;
    rig.params.soil_kphi_N_m_n2 = ground.kphi;
    rig.params.soil_n = ground.n;
    rig.params.soil_edge_loss = 0.0;
    rig.build();
    rig.put_sole({kPlace_m.x, kPlace_m.y, 0.00013});
    for (int i = 0; i < 2000; ++i) {
      rig.move({0.0, 0.0, -0.005});
      const double depth_m = -rig.sole_P_m().z;
      EXPECT_EQ("", rig.soil.find_loads(rig.state, rig.axes_W, rig.load));
      const double expected_N =
          depth_m > 0.0 ? kSole_m2 * modulus(rig.params) * std::pow(depth_m, ground.n) : 0.0;
      ASSERT_NEAR(expected_N, rig.wrench(Vec3{}).force_W_N.z, 1e-9 * expected_N + 1e-9) << depth_m;
    }
  }
}

// Rotated over the grid a sole's area is that of cells cut at its edges.
TEST(SoilPressure, AreaAndCentreAreRightAtAnyHeading) {
  SoilRig rig;
  rig.params.soil_edge_loss = 0.0;
  rig.build();
  for (int k = 0; k < 400; ++k) {
    const double yaw_rad = k * kPi / 799.0;
    rig.put_sole({0.2 + 0.00037 * (k % 27), 0.01 + 0.00021 * (k % 31), -0.004}, rotation(2, yaw_rad));
    ASSERT_EQ("", rig.soil.find_loads(rig.state, rig.axes_W, rig.load));
    const Wrench wrench = rig.wrench(Vec3{});
    EXPECT_NEAR(1.0, wrench.force_W_N.z / (kSole_m2 * 6e6 * std::pow(0.004, 1.1)), 0.008) << yaw_rad;
    const Vec3 arm = rig.axes_W[SoilRig::kRight] * SoilRig::sole_arm_L_m();
    const Vec3 moment_Nm = wrench.torque_W_Nm - cross(arm, wrench.force_W_N);
    EXPECT_LT(norm(moment_Nm) / wrench.force_W_N.z, 2e-4) << yaw_rad;
  }
}

TEST(SoilPressure, UnloadsStifflyAndReloadsToTheCurve) {
  SoilRig rig;
  rig.params.soil_edge_loss = 0.0;
  rig.params.soil_unload_Pa_m = 6e7;
  rig.params.soil_unload_Pa_m2 = 2e9;
  rig.params.soil_repose_rad = 1.4;  // the rut keeps its walls
  rig.build();
  const double depth_m = 0.006, held_Pa = 6e6 * std::pow(depth_m, 1.1), stiffness_Pa_m = 6e7 + 2e9 * depth_m;
  press_to(&rig, depth_m);
  EXPECT_NEAR(kSole_m2 * held_Pa, force_at(&rig, depth_m), 1e-6);
  for (const double up_m : {0.0, 1e-5, 8e-5, 2e-5}) {
    EXPECT_NEAR(kSole_m2 * (held_Pa - stiffness_Pa_m * up_m), force_at(&rig, depth_m - up_m), 1e-5) << up_m;
  }
  const double rebound_m = held_Pa / stiffness_Pa_m;
  EXPECT_EQ(0.0, force_at(&rig, depth_m - 1.0001 * rebound_m));
  EXPECT_GT(force_at(&rig, depth_m - 0.9999 * rebound_m), 0.0);
  // Lifted off and pressed again: nothing in the rut, then the old curve.
  EXPECT_EQ(0.0, force_at(&rig, -0.005));
  EXPECT_EQ(0.0, force_at(&rig, depth_m - 1.01 * rebound_m));
  press_to(&rig, 0.008);
  EXPECT_NEAR(kSole_m2 * 6e6 * std::pow(0.008, 1.1), force_at(&rig, 0.008), 1e-6);
}

// Soils whose table has no k_0 would unload softer than they load.
TEST(SoilPressure, UnloadingIsNeverSofterThanLoading) {
  for (const double n : {0.66, 0.79, 1.1}) {
    SoilRig rig;
    rig.params.soil_n = n;
    rig.params.soil_unload_Pa_m = 1e5;
    rig.params.soil_edge_loss = 0.0;
    rig.build();
    press_to(&rig, 0.004);
    const double held_N = force_at(&rig, 0.004);
    const double slope_N_m = (held_N - force_at(&rig, 0.00399)) / 1e-5;
    EXPECT_NEAR(std::max(1.0, n) * held_N / 0.004, slope_N_m, 1e-6 * slope_N_m) << n;
  }
}

TEST(SoilPressure, EdgeBearsLess) {
  SoilRig rig;
  rig.params.soil_cell_m = 0.0025;
  rig.params.soil_edge_loss = 0.3;
  rig.params.soil_edge_m = 0.01;
  rig.build();
  // Mean over the sole of 1 - d / edge in the strip.
  const double faded_m2 = (kSoleLength_m + kSoleWidth_m) * 0.01 - 8.0 * 0.01 * 0.01 / 6.0;
  const double expected_N = (kSole_m2 - 0.3 * faded_m2) * 6e6 * std::pow(0.005, 1.1);
  EXPECT_NEAR(1.0, force_at(&rig, 0.005) / expected_N, 0.002);
}

TEST(SoilPressure, GrowsWithDepthAndIsZeroAboveTheGround) {
  for (const int law : {HOAP2_SOIL_LAW_BEKKER, HOAP2_SOIL_LAW_RFT}) {
    SoilRig rig;
    rig.params.soil_law = law;
    rig.build();
    double last_N = 0.0;
    for (double depth_m = -0.01; depth_m < 0.02; depth_m += 0.00037) {
      const double force_N = force_at(&rig, depth_m);
      if (depth_m <= 0.0) {
        EXPECT_EQ(0.0, force_N);
        EXPECT_FALSE(rig.load[SoilRig::kRight].touches);
      } else {
        EXPECT_GT(force_N, last_N);
      }
      last_N = force_N;
    }
  }
}

// What the sole reaches within the tick resists already, as a damper: F0 stays 0.
TEST(SoilPressure, LandingIsFeltInItsFirstTick) {
  SoilRig rig;
  rig.build();
  rig.put_sole({kPlace_m.x, kPlace_m.y, 1e-5});
  BodyState &body = rig.state.body[SoilRig::kRight];
  body.com_vel_W_m_s[2] = -0.1;
  ASSERT_EQ("", rig.soil.find_loads(rig.state, rig.axes_W, rig.load));
  EXPECT_EQ(0.0, rig.wrench(Vec3{}).force_W_N.z);
  EXPECT_GT(rig.wrench({0.0, 0.0, -0.1}).force_W_N.z, 1.0);
  body.com_vel_W_m_s[2] = -0.005;  // does not get there
  ASSERT_EQ("", rig.soil.find_loads(rig.state, rig.axes_W, rig.load));
  EXPECT_FALSE(rig.load[SoilRig::kRight].touches);
}

// Force and pitching moment of a tilted sole, on flat ground or half over an old rut.
struct Tilted {
  double force_N, moment_Nm;
};
Tilted tilted_sole(double cell_m, bool over_rut, double shift_m) {
  SoilRig rig;
  rig.params.soil_cell_m = cell_m;
  rig.params.soil_repose_rad = 1.4;  // walls stand
  rig.params.soil_size_m[0] = 0.35;
  rig.params.soil_size_m[1] = 0.2;
  rig.build();
  const Vec3 place_m = {kPlace_m.x + 1.7 * shift_m, kPlace_m.y - 0.7 * shift_m, -0.004};
  if (over_rut) press_to(&rig, 0.003, {place_m.x - 0.0433, place_m.y + 0.0067, 0.0});
  rig.put_sole(place_m, rotation(1, 0.03) * rotation(0, 0.02) * rotation(2, 0.05));
  EXPECT_EQ("", rig.soil.find_loads(rig.state, rig.axes_W, rig.load));
  const Vec3 arm = rig.axes_W[SoilRig::kRight] * SoilRig::sole_arm_L_m();
  const Wrench wrench = rig.wrench(Vec3{});
  return {wrench.force_W_N.z, (wrench.torque_W_Nm - cross(arm, wrench.force_W_N)).y};
}

// Root mean square over places on the grid of the relative error of the force.
double mesh_error(double cell_m, bool over_rut) {
  constexpr int kPlaces = 8;
  double sum = 0.0;
  for (int k = 0; k < kPlaces; ++k) {
    const double exact_N = tilted_sole(0.000625, over_rut, 0.0021 * k).force_N;
    const double error = tilted_sole(cell_m, over_rut, 0.0021 * k).force_N / exact_N - 1.0;
    sum += error * error / kPlaces;
  }
  return std::sqrt(sum);
}

TEST(SoilPressure, ConvergesWithTheMesh) {
  const double smooth[3] = {mesh_error(0.01, false), mesh_error(0.005, false), mesh_error(0.0025, false)};
  EXPECT_LT(smooth[1], 0.003);
  EXPECT_GT(smooth[0] / smooth[1], 3.0);  // second order
  EXPECT_GT(smooth[1] / smooth[2], 3.0);
  const double rut[3] = {mesh_error(0.01, true), mesh_error(0.005, true), mesh_error(0.0025, true)};
  EXPECT_LT(rut[1], 0.01);
  EXPECT_GT(rut[0] / rut[1], 1.5);  // first order: the rut ends within a cell
  EXPECT_GT(rut[1] / rut[2], 1.5);
}

}  // namespace
}  // namespace hoap2_sim
