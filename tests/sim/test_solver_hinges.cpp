// Hinges stay closed: the two halves of a joint, measured on the bodies, in walking, in the air and in
// falls, with either solver.
#include <gtest/gtest.h>

#include "ground_scenes.h"

namespace hoap2_sim {
namespace {

// A tick moves a body's CoM straight and turns its axes, so an anchor at r from the CoM leaves its
// circle by (h w)^2 r / 2; the rows take a fifth of what is there back each tick, and five times a
// tick's error stays. Both halves of a hinge err, with r up to 0.12 m (chest 0.15 m). Axes: the same
// without r.
constexpr double kArms_m = 0.25;

struct Worst {
  double anchors_m = 0.0, axes_rad = 0.0, omega_rad_s = 0.0;

  void note(const Rig &rig) {
    const State s = rig.state();
    const HingeError now = hinge_error(s);
    anchors_m = std::fmax(anchors_m, now.anchors_m);
    axes_rad = std::fmax(axes_rad, now.axes_rad);
    for (const BodyState &body : s.body) omega_rad_s = std::fmax(omega_rad_s, norm(vec(body.omega_W_rad_s)));
  }
  void expect_closed() const {
    const double turned_rad = 0.5 / 0.2 * std::pow(kTick_s * omega_rad_s, 2);
    EXPECT_LE(anchors_m, turned_rad * kArms_m);
    EXPECT_LE(axes_rad, turned_rad);
    EXPECT_GT(anchors_m, 1e-9) << "it must move";
    ::testing::Test::RecordProperty("anchors_um", std::to_string(anchors_m * 1e6));
  }
};

class Hinges : public WithEachSolver {};

TEST_P(Hinges, StayClosedInWalking) {
  Rig rig;
  Walker walker(&rig);
  walker.start();
  Worst worst;
  for (int tick = 0; walker.outputs.step_index < 5; ++tick) {
    ASSERT_LT(tick, 6000) << "it must walk";
    walker.step();
    worst.note(rig);
  }
  worst.expect_closed();
  EXPECT_LE(worst.anchors_m, 2e-6);
  EXPECT_LE(worst.axes_rad, 1e-5);
}

TEST_P(Hinges, StayClosedInTheAir) {
  Rig rig;
  rig.float_free();
  rig.params.joint_friction_scale = 1.0;
  rig.start();
  const Swing swing(3, 4.0);
  Worst worst;
  for (int tick = 0; tick < 1000; ++tick) {
    swing.set(&rig, tick);
    rig.step();
    worst.note(rig);
  }
  worst.expect_closed();
  EXPECT_LE(worst.anchors_m, 5e-5);
}

TEST_P(Hinges, StayClosedInFalls) {
  for (void (*const fall)(Rig *) : {fall_forward, fall_askew, thrown_1}) {
    Rig rig;
    fall(&rig);
    Worst worst;
    for (int tick = 0; tick < 600; ++tick) {
      rig.step();
      worst.note(rig);
    }
    worst.expect_closed();
    EXPECT_LE(worst.anchors_m, 5e-5);
  }
}

// An open hinge closes: a fifth a tick, whatever the drives do.
TEST_P(Hinges, CloseByAFifthATick) {
  Rig rig;
  rig.float_free();
  rig.start();
  State s = rig.state();
  s.body[HOAP2_L_R_SHANK].com_pos_W_m[1] += 1e-4;
  ASSERT_EQ(0, rig.restore(s));
  double before_m = hinge_error(rig.state()).anchors_m;
  for (int tick = 0; tick < 20; ++tick) {
    rig.step();
    const double now_m = hinge_error(rig.state()).anchors_m;
    EXPECT_NEAR(0.8, now_m / before_m, 0.01) << tick;
    before_m = now_m;
  }
}

INSTANTIATE_WITH_EACH_SOLVER(Hinges);

}  // namespace
}  // namespace hoap2_sim
