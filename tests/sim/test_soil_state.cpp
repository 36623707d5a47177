// The soil as a part of the plant: saved blocks, any place and heading, errors, other links.
#include <cstring>
#include <limits>

#include "soil_rig.h"

namespace hoap2_sim {
namespace {

// A sole that treads, slides and turns.
void tread(int tick, Vec3 *vel_m_s, Vec3 *omega_rad_s) {
  const double t = 1e-3 * tick;
  *vel_m_s = {0.05 * std::sin(3.0 * t), 0.03 * std::cos(5.0 * t), -0.05 * std::sin(8.0 * t)};
  *omega_rad_s = {0.3 * std::sin(11.0 * t), 0.2 * std::cos(7.0 * t), 0.4 * std::sin(2.0 * t)};
}

void run(SoilRig *rig, int from, int to) {
  for (int i = from; i < to; ++i) {
    Vec3 vel, omega;
    tread(i, &vel, &omega);
    rig->move(vel, omega);
  }
}

bool same_load(const SoilLoad &a, const SoilLoad &b) {
  if (a.touches != b.touches) return false;
  if (!a.touches) return true;
  return std::memcmp(&a.force_W_N, &b.force_W_N, sizeof a.force_W_N) == 0 &&
         std::memcmp(&a.torque_com_W_Nm, &b.torque_com_W_Nm, sizeof a.torque_com_W_Nm) == 0 &&
         std::memcmp(a.angular, b.angular, sizeof a.angular) == 0 &&
         std::memcmp(a.coupling, b.coupling, sizeof a.coupling) == 0 &&
         std::memcmp(a.linear, b.linear, sizeof a.linear) == 0;
}

double deepest_m(const HeightField &field) {
  double deepest = 0.0;
  for (std::size_t i = 0; i < field.size(); ++i) deepest = std::max(deepest, field.cell(i).memory_m);
  return deepest;
}

class SoilStateLaws : public testing::TestWithParam<int> {};

TEST_P(SoilStateLaws, RestoredBlockContinuesBitForBit) {
  SoilRig rig, other;
  for (SoilRig *const one : {&rig, &other}) {
    one->params.soil_law = GetParam();
    one->params.soil_roughness_m = 0.001;
    one->build();
    one->put_sole({0.2, 0.01, 0.003});
  }
  run(&other, 0, 313);  // another past
  run(&rig, 0, 587);
  const std::vector<unsigned char> block = rig.saved();
  const State state = rig.state;
  run(&rig, 587, 900);
  const std::vector<unsigned char> end = rig.saved();
  for (SoilRig *const one : {&rig, &other}) {
    ASSERT_EQ("", one->soil.restore(block.data()));
    ASSERT_EQ(block, one->saved());
    one->state = state;
    all_link_axes_W(one->state, one->axes_W);
    run(one, 587, 900);
    EXPECT_EQ(end, one->saved());
  }
  EXPECT_TRUE(same_load(rig.load[SoilRig::kRight], other.load[SoilRig::kRight]));
  EXPECT_TRUE(rig.load[SoilRig::kRight].touches);
  EXPECT_NE(block, end);
  EXPECT_GT(deepest_m(rig.soil.field()), 0.002);
}

// One thousand metres away and turned: the same to rounding.
TEST_P(SoilStateLaws, IsTheSameAnywhereAndAtAnyHeading) {
  SoilRig here, there;
  for (SoilRig *const one : {&here, &there}) {
    one->params.soil_law = GetParam();
    one->params.soil_roughness_m = 0.001;
  }
  there.params.start_pos_W_m[0] = 1000.0;
  there.params.start_pos_W_m[1] = -700.0;
  there.params.start_yaw_W_rad = 2.2689280275926285;
  there.params.floor_tilt_rad[0] = 0.01;
  double loads_N = 0.0;
  here.build();
  there.build();
  here.put_sole({0.2013, 0.0107, 0.003});
  there.put_sole({0.2013, 0.0107, 0.003});
  for (int i = 0; i < 900; ++i) {
    Vec3 vel, omega;
    tread(i, &vel, &omega);
    const Wrench a = here.move(vel, omega), b = there.move(vel, omega);
    ASSERT_LT(norm(a.force_W_N - b.force_W_N), 1e-5) << i;
    ASSERT_LT(norm(a.torque_W_Nm - b.torque_W_Nm), 1e-6) << i;
    loads_N += a.force_W_N.z;
  }
  EXPECT_GT(loads_N, 1000.0);
}

TEST_P(SoilStateLaws, FindingLoadsChangesNothing) {
  SoilRig rig;
  rig.params.soil_law = GetParam();
  rig.build();
  rig.put_sole({0.2, 0.01, 0.003});
  run(&rig, 0, 400);
  const std::vector<unsigned char> before = rig.saved();
  ASSERT_EQ("", rig.soil.find_loads(rig.state, rig.axes_W, rig.load));
  const SoilLoad first = rig.load[SoilRig::kRight];
  for (int i = 0; i < 3; ++i) ASSERT_EQ("", rig.soil.find_loads(rig.state, rig.axes_W, rig.load));
  EXPECT_TRUE(same_load(first, rig.load[SoilRig::kRight]));
  EXPECT_EQ(before, rig.saved());
}

INSTANTIATE_TEST_SUITE_P(Laws, SoilStateLaws, testing::Values(HOAP2_SOIL_LAW_BEKKER, HOAP2_SOIL_LAW_RFT));

TEST(SoilState, DamagedBlocksAreRefused) {
  SoilRig rig;
  rig.build();
  rig.put_sole({0.2, 0.01, 0.003});
  run(&rig, 0, 500);
  const std::vector<unsigned char> good = rig.saved();
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                        -1e300};
  int refused = 0, tried = 0;
  for (std::size_t at = 0; at + 8 <= good.size(); at += at < 512 || at + 4096 > good.size() ? 8 : 71 * 8) {
    for (const double value : bad) {
      std::vector<unsigned char> block = good;
      std::memcpy(&block[at], &value, sizeof value);
      ++tried;
      refused += rig.soil.restore(block.data()).empty() ? 0 : 1;
    }
    ASSERT_EQ(good, rig.saved()) << at;
  }
  EXPECT_EQ(tried, refused);
  EXPECT_EQ("", rig.soil.restore(good.data()));
}

TEST(SoilState, GridsThatDoNotFitAreRefused) {
  SoilRig rig;
  rig.params.soil_size_m[0] = rig.params.soil_size_m[1] = 20.0;
  rig.params.soil_cell_m = 0.001;
  EXPECT_NE(std::string::npos, rig.soil.build(rig.params).find("soil_cell_m"));
  rig.params.soil_cell_m = 0.05;
  EXPECT_NE(std::string::npos, rig.soil.build(rig.params).find("too coarse"));
}

TEST(SoilState, LeavingThePoolIsAnError) {
  SoilRig rig;
  rig.build();  // x from -0.215 to 0.635
  rig.put_sole({0.62, 0.1, -0.002});
  const std::string text = rig.soil.find_loads(rig.state, rig.axes_W, rig.load);
  EXPECT_NE(std::string::npos, text.find("right foot left the soil pool 0.85 x 0.56 m at x = 0.6")) << text;
  rig.put_sole({0.62, 0.1, 0.001});  // above the ground
  EXPECT_EQ("", rig.soil.find_loads(rig.state, rig.axes_W, rig.load));
  rig.put_sole({0.58, 0.1, -0.002});
  EXPECT_EQ("", rig.soil.find_loads(rig.state, rig.axes_W, rig.load));
  rig.put_sole({0.3, 0.26, -0.002}, Mat3{}, SoilRig::kLeft);
  EXPECT_NE(std::string::npos, rig.soil.find_loads(rig.state, rig.axes_W, rig.load).find("left foot left"));
  rig.put_sole({0.3, 0.0, -0.151}, Mat3{}, SoilRig::kLeft);
  EXPECT_NE(std::string::npos, rig.soil.find_loads(rig.state, rig.axes_W, rig.load).find("bottom"));
  // Another link outside the walls finds no ground.
  rig.build();
  rig.put_link(HOAP2_L_CHEST, {3.0, 0.0, 0.0}, Mat3{});
  EXPECT_EQ("", rig.soil.find_loads(rig.state, rig.axes_W, rig.load));
  EXPECT_FALSE(rig.load[HOAP2_L_CHEST].touches);
}

// The chest lying on its back: its whole face bears, and the force is normal to the ground.
TEST(SoilState, OtherLinksAreCarried) {
  SoilRig rig;
  rig.build();
  const hoap2_link_data_t &chest = HOAP2_LINK[HOAP2_L_CHEST];
  const Mat3 on_back = rotation(1, -1.57079632679489661923);  // x up, z backward
  const double below_m = chest.com_L_m[0] - chest.box_min_L_m[0];
  const double wide_m2 =
      (chest.box_max_L_m[1] - chest.box_min_L_m[1]) * (chest.box_max_L_m[2] - chest.box_min_L_m[2]);
  const auto lie = [&](double depth_m) {
    rig.put_link(HOAP2_L_CHEST, {0.2, 0.0, below_m - depth_m}, on_back);
    EXPECT_EQ("", rig.soil.find_loads(rig.state, rig.axes_W, rig.load));
    return rig.wrench(Vec3{}, Vec3{}, HOAP2_L_CHEST).force_W_N;
  };
  const double expected_N = wide_m2 * 6e6 * std::pow(0.002, 1.1);
  EXPECT_NEAR(expected_N, lie(0.002).z, 1e-6 * expected_N);
  EXPECT_NEAR(0.0, lie(0.002).x, 1e-6 * expected_N);
  EXPECT_EQ(0.0, lie(-0.001).z);
  // On an edge two faces share the load.
  const Mat3 on_edge = rotation(1, -0.8);
  const double corner_m = dot(transpose(on_edge).cz, vec(chest.box_min_L_m) - vec(chest.com_L_m));
  rig.put_link(HOAP2_L_CHEST, {0.2, 0.0, -corner_m - 0.008}, on_edge);
  EXPECT_EQ("", rig.soil.find_loads(rig.state, rig.axes_W, rig.load));
  const Vec3 force_N = rig.wrench(Vec3{}, Vec3{}, HOAP2_L_CHEST).force_W_N;
  EXPECT_GT(force_N.z, 10.0);
  EXPECT_LT(std::fabs(force_N.x), force_N.z);
  rig.params.soil_links = HOAP2_SOIL_LINKS_SOLES;
  rig.build();
  EXPECT_EQ(0.0, lie(0.002).z);
}

}  // namespace
}  // namespace hoap2_sim
