// How hard the contact problem is: sweeps of the tree, and the force that is left over, on all
// grounds, in walking, and in random throws over the whole range of the contact's parameters.
#include <gtest/gtest.h>

#include "ground_scenes.h"
#include "tick_rig.h"

namespace hoap2_sim {
namespace {

constexpr double kForceTolerance_N = 1e-8;
constexpr int kSweepLimit = 200;

struct Tally {
  int ticks = 0, unsolved = 0, most_sweeps = 0, most_updates = 0;
  long sweeps = 0;
  double worst_N = 0.0;

  // Ticks without contact are no work and do not count.
  void add(const TickRig &tick) {
    if (tick.contacts.count == 0) return;
    const ContactEffort &effort = tick.hardest;
    ++ticks;
    sweeps += effort.sweeps;
    most_sweeps = std::max(most_sweeps, effort.sweeps);
    most_updates = std::max(most_updates, effort.bound_updates);
    worst_N = std::fmax(worst_N, effort.force_error_N);
    // written so that NaN counts
    unsolved += effort.force_error_N <= kForceTolerance_N && effort.sweeps < kSweepLimit ? 0 : 1;
  }
  double mean_sweeps() const { return static_cast<double>(sweeps) / std::max(1, ticks); }
  void print(const std::string &what) const {
    std::printf(
        "%s: %d contact ticks, sweeps mean %.1f most %d, bound updates most %d, unsolved %d, left over %.1e "
        "N\n",
        what.c_str(), ticks, mean_sweeps(), most_sweeps, most_updates, unsolved, worst_N);
  }
};

// No contact pulls, and none acts that moves away faster than its spring follows.
void expect_complementary(const TickRig &tick, int at) {
  const ContactRow row = contact_row(tick.before.params);
  for (int i = 0; i < tick.contacts.count; ++i) {
    const Contact &contact = tick.contacts.at[i];
    const double normal_N = dot(tick.force_W_N(i), vec(contact.normal_W));
    ASSERT_GE(normal_N, -2.0 * kForceTolerance_N) << at;
    const double leaving_m_s = dot(tick.velocity_W_m_s(i), vec(contact.normal_W));
    const double target_m_s = row.erp * contact.depth_m / kTick_s;
    if (leaving_m_s > target_m_s + 1e-9) {
      ASSERT_LE(norm(tick.force_W_N(i)), 2.0 * kForceTolerance_N) << at;
    }
  }
}

class SolverEffort : public ::testing::TestWithParam<GroundScene> {};

TEST_P(SolverEffort, EveryTickConverges) {
  Rig rig;
  GetParam().start(&rig);
  TickRig tick(rig.state().params);
  tick.next = rig.state();
  Tally tally;
  for (int i = 0; i < GetParam().ticks; ++i) {
    tick.run_on(rig.inputs);
    tally.add(tick);
    expect_complementary(tick, i);
    if (HasFatalFailure()) return;
  }
  tally.print(GetParam().name);
  EXPECT_EQ(0, tally.unsolved);
  EXPECT_GT(tally.ticks, 30);
}

INSTANTIATE_TEST_SUITE_P(Ground, SolverEffort, ::testing::ValuesIn(kGroundScenes), scene_name);
INSTANTIATE_TEST_SUITE_P(Lying, SolverEffort, ::testing::ValuesIn(kLyingScenes), scene_name);
INSTANTIATE_TEST_SUITE_P(Twice, SolverEffort, ::testing::ValuesIn(kTwiceSupportedScenes), scene_name);

TEST(SolverEffortWalking, EveryTickConverges) {
  for (const int preset : {0, 1}) {
    Rig rig;
    rig.params.sensor_preset = preset;
    Walker walker(&rig);
    walker.start();
    TickRig tick(rig.state().params);
    Tally tally;
    for (int i = 0; walker.outputs.step_index < 6; ++i) {
      ASSERT_LT(i, 6000) << "it must walk";
      const State s = rig.state();
      walker.step();
      tick.run(s, rig.inputs);
      tally.add(tick);
    }
    tally.print(preset == 0 ? "walking, ideal" : "walking, hoap2");
    EXPECT_EQ(0, tally.unsolved);
    EXPECT_LT(tally.mean_sweeps(), 5.0);
  }
}

TEST(SolverEffortLanding, EveryTickConverges) {
  Tally tally;
  for (const double height_m : {0.05, 0.2}) {
    for (const double mu : {0.0, 0.1, 0.7, 1.5}) {
      for (int turn = 0; turn < 4; ++turn) {
        Rig rig;
        rig.params.start_height_m = height_m;
        rig.params.friction_mu = mu;
        rig.params.floor_tilt_rad[0] = turn % 2 == 0 ? 0.2 : -0.1;
        rig.params.floor_tilt_rad[1] = turn < 2 ? 0.05 : -0.3;
        rig.params.start_vel_W_m_s[0] = 0.5 * turn - 1.0;
        rig.start();
        TickRig tick(rig.state().params);
        tick.next = rig.state();
        for (int i = 0; i < 500; ++i) {
          tick.run_on(rig.inputs);
          tally.add(tick);
        }
      }
    }
  }
  tally.print("landing");
  EXPECT_EQ(0, tally.unsolved);
  EXPECT_GT(tally.ticks, 5000);
}

// Random postures thrown at random onto a floor with blocks, limp or held.
struct Ground {
  double mu, stiffness_N_m, damping_Ns_m;
  double solved_share;  // of the contact ticks, at least
};
void PrintTo(const Ground &ground, std::ostream *out) {
  *out << "mu " << ground.mu << ", " << ground.stiffness_N_m << " N/m, " << ground.damping_Ns_m << " Ns/m";
}

class SolverEffortThrown : public ::testing::TestWithParam<Ground> {};

TEST_P(SolverEffortThrown, NearlyEveryTickConvergesAndNoneGoesWild) {
  Tally tally;
  for (std::uint64_t seed = 501; seed <= 512; ++seed) {
    Rig rig;
    rig.params.friction_mu = GetParam().mu;
    rig.params.contact_stiffness_N_m = GetParam().stiffness_N_m;
    rig.params.contact_damping_Ns_m = GetParam().damping_Ns_m;
    thrown_on_blocks(&rig, seed);
    rig.mode_of_all(seed % 2 == 0 ? kDriveOff : kDrivePosition);
    TickRig tick(rig.state().params);
    tick.next = rig.state();
    for (int i = 0; i < 300; ++i) {
      tick.run_on(rig.inputs);
      tally.add(tick);
      if (tick.hardest.force_error_N <= kForceTolerance_N) expect_complementary(tick, i);
      if (HasFatalFailure()) return;
      for (const BodyState &body : tick.next.body) {  // thrown at up to 1.7 m/s and 9 rad/s, 0.4 m high
        ASSERT_LT(norm(vec(body.com_vel_W_m_s)), 20.0) << "seed " << seed << " tick " << i;
      }
    }
  }
  std::ostringstream what;
  PrintTo(GetParam(), &what);
  tally.print(what.str());
  EXPECT_GE(tally.ticks, 300);
  EXPECT_LE(tally.unsolved, (1.0 - GetParam().solved_share) * tally.ticks);
}

// Coulomb's law is hard where friction throws a limb back into the ground: at ten times the normal
// force, or with ground that is all damper.
double share_to_solve(double mu, double damping_Ns_m) {
  return mu > 1.5 || (mu > 1.0 && damping_Ns_m > 1e5) ? 0.97 : 0.999;
}

std::vector<Ground> grounds() {
  std::vector<Ground> all;
  for (const double mu : {0.0, 0.1, 0.7, 1.5, 10.0}) {
    for (const double stiffness_N_m : {1e3, 5e5, 1e8}) {
      all.push_back({mu, stiffness_N_m, 1500.0, share_to_solve(mu, 1500.0)});
    }
    for (const double damping_Ns_m : {0.0, 1e6}) {
      all.push_back({mu, 5e5, damping_Ns_m, share_to_solve(mu, damping_Ns_m)});
    }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Grounds, SolverEffortThrown, ::testing::ValuesIn(grounds()));

}  // namespace
}  // namespace hoap2_sim
