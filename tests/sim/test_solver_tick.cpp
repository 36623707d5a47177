// One tick by both solvers from the same state: the articulated solver against dWorldStep,
// on the way through every kind of contact.
#include <gtest/gtest.h>

#include "ground_scenes.h"
#include "tick_rig.h"

namespace hoap2_sim {
namespace {

// dWorldStep's hinges give way by their CFM, 1e-10 m/s per newton of their reaction, which the
// articulated solver does not copy; a chain of up to ten hinges lies between two contacts. So what
// may differ goes with the forces of the tick: the largest on a link, and the weight.
constexpr double kVelocityPerForce_m_Ns = 1e-9;
constexpr double kOmegaPerForce_rad_Ns = 1e-8;
constexpr double kArm_m = 0.1;
// Where sticking limbs strain against each other, their friction (1e-6 m/s per newton) shares out by
// compliances: the hinges' are 1e-4 of it.
constexpr double kForceShare = 3e-6, kForceShareStrained = 5e-5;

struct Difference {
  double velocity_m_s = 0.0, omega_rad_s = 0.0, force_N = 0.0, moment_Nm = 0.0, scale_N = 0.0;
};

Difference difference(const TickRig &a, const TickRig &b) {
  Difference d;
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    const BodyState &x = a.next.body[link], &y = b.next.body[link];
    d.velocity_m_s = std::fmax(d.velocity_m_s, norm(vec(x.com_vel_W_m_s) - vec(y.com_vel_W_m_s)));
    d.omega_rad_s = std::fmax(d.omega_rad_s, norm(vec(x.omega_W_rad_s) - vec(y.omega_W_rad_s)));
    Vec3 force_a, moment_a, force_b, moment_b;
    a.link_load(link, &force_a, &moment_a);
    b.link_load(link, &force_b, &moment_b);
    d.force_N = std::fmax(d.force_N, norm(force_a - force_b));
    d.moment_Nm = std::fmax(d.moment_Nm, norm(moment_a - moment_b));
    d.scale_N = std::fmax(d.scale_N, norm(force_b) + kMg_N);
  }
  return d;
}

int links_pressed(const TickRig &tick) {
  int count = 0;
  for (int link = 0; link < HOAP2_LINKS; ++link) {
    Vec3 force, moment;
    tick.link_load(link, &force, &moment);
    count += norm(force) > 0.0 ? 1 : 0;
  }
  return count;
}

void compare_both_solvers(const GroundScene &scene, double force_share) {
  Rig rig;
  rig.params.friction_law = HOAP2_FRICTION_LAW_PYRAMID;
  scene.start(&rig);
  TickRig articulated(with(rig.state(), HOAP2_SOLVER_ARTICULATED, HOAP2_FRICTION_LAW_PYRAMID).params);
  TickRig ode(with(rig.state(), HOAP2_SOLVER_ODE, HOAP2_FRICTION_LAW_OF_SOLVER).params);
  int contacts_most = 0, links_most = 0, compared = 0;
  double worst_share = 0.0;
  for (int tick = 0; tick < scene.ticks; ++tick, rig.step()) {
    if (tick % 8 != 0 && tick != scene.ticks - 1) continue;
    const State s = rig.state();
    articulated.run(with(s, HOAP2_SOLVER_ARTICULATED, HOAP2_FRICTION_LAW_PYRAMID), rig.inputs);
    if (articulated.contacts.count == 0) continue;
    ode.run(with(s, HOAP2_SOLVER_ODE, HOAP2_FRICTION_LAW_OF_SOLVER), rig.inputs);
    const Difference d = difference(articulated, ode);
    ASSERT_LE(d.velocity_m_s, kVelocityPerForce_m_Ns * d.scale_N) << tick;
    ASSERT_LE(d.omega_rad_s, kOmegaPerForce_rad_Ns * d.scale_N) << tick;
    ASSERT_LE(d.force_N, force_share * d.scale_N) << tick;
    ASSERT_LE(d.moment_Nm, kArm_m * force_share * d.scale_N) << tick;
    worst_share = std::fmax(worst_share, d.force_N / d.scale_N);
    contacts_most = std::max(contacts_most, articulated.contacts.count);
    links_most = std::max(links_most, links_pressed(articulated));
    ++compared;
  }
  ::testing::Test::RecordProperty("force_difference_share", std::to_string(worst_share * 1e6) + "e-6");
  EXPECT_GE(contacts_most, scene.least_contacts);
  EXPECT_GE(links_most, scene.least_links);
  EXPECT_GE(compared, 30);
}

class SolverTick : public ::testing::TestWithParam<GroundScene> {};
TEST_P(SolverTick, BothSolversGiveTheSame) { compare_both_solvers(GetParam(), kForceShare); }
INSTANTIATE_TEST_SUITE_P(Ground, SolverTick, ::testing::ValuesIn(kGroundScenes), scene_name);

class SolverTickLying : public ::testing::TestWithParam<GroundScene> {};
TEST_P(SolverTickLying, BothSolversGiveTheSame) { compare_both_solvers(GetParam(), kForceShareStrained); }
INSTANTIATE_TEST_SUITE_P(Ground, SolverTickLying, ::testing::ValuesIn(kLyingScenes), scene_name);

// The rig of these tests is the plant's tick to the last bit, with either solver. As the rig sees
// only every fifth tick, this also says that a tick knows nothing but its state.
TEST_P(SolverTick, TheRigIsThePlant) {
  for (const int solver : {HOAP2_SOLVER_ARTICULATED, HOAP2_SOLVER_ODE}) {
    Rig plant;
    plant.params.solver = solver;
    GetParam().start(&plant);
    TickRig tick_rig(plant.state().params);
    const int ticks = solver == HOAP2_SOLVER_ARTICULATED ? GetParam().ticks : 300;
    for (int i = 0; i < ticks; i += 5) {
      tick_rig.run(plant.state(), plant.inputs);
      plant.step();
      const State next = plant.state();
      ASSERT_EQ(0, std::memcmp(tick_rig.next.body, next.body, sizeof next.body)) << i;
      ASSERT_EQ(0, std::memcmp(tick_rig.next.drive, next.drive, sizeof next.drive)) << i;
      plant.step(4);
    }
  }
}

// A walking tick: feet that land, roll off and are lifted under the firmware's commands.
TEST(SolverTickWalking, BothSolversGiveTheSame) {
  Rig rig;
  rig.params.friction_law = HOAP2_FRICTION_LAW_PYRAMID;
  Walker walker(&rig);
  walker.start();
  TickRig articulated(with(rig.state(), HOAP2_SOLVER_ARTICULATED, HOAP2_FRICTION_LAW_PYRAMID).params);
  TickRig ode(with(rig.state(), HOAP2_SOLVER_ODE, HOAP2_FRICTION_LAW_OF_SOLVER).params);
  int landings = 0;
  bool in_air[2] = {false, false};
  for (int tick = 0; walker.outputs.step_index < 5; ++tick) {
    ASSERT_LT(tick, 6000) << "it must walk";
    const State s = rig.state();
    walker.step();
    const hoap2_plant_outputs_t out = rig.out();
    bool landed = false;
    for (int foot = 0; foot < 2; ++foot) {
      const bool loaded = norm(vec(out.true_foot_force_W_N[foot])) > 0.0;
      landed = landed || (loaded && in_air[foot]);
      in_air[foot] = !loaded;
    }
    landings += landed ? 1 : 0;
    if (!landed && tick % 10 != 0) continue;
    articulated.run(with(s, HOAP2_SOLVER_ARTICULATED, HOAP2_FRICTION_LAW_PYRAMID), rig.inputs);
    ode.run(with(s, HOAP2_SOLVER_ODE, HOAP2_FRICTION_LAW_OF_SOLVER), rig.inputs);
    const Difference d = difference(articulated, ode);
    ASSERT_LE(d.velocity_m_s, kVelocityPerForce_m_Ns * d.scale_N) << tick;
    ASSERT_LE(d.force_N, kForceShare * d.scale_N) << tick;
  }
  EXPECT_GE(landings, 4);
}

}  // namespace
}  // namespace hoap2_sim
