// The ways the robot touches the ground in the solver tests, each a start and how long to go on.
#ifndef HOAP2_TESTS_SIM_GROUND_SCENES_H
#define HOAP2_TESTS_SIM_GROUND_SCENES_H

#include <string>

#include "scenes.h"

namespace hoap2_sim {

struct GroundScene {
  const char *name;
  void (*start)(Rig *rig);  // with the solver and friction law that the rig has
  int ticks;
  int least_contacts, least_links;  // at once, at some time
};

inline void PrintTo(const GroundScene &scene, std::ostream *out) { *out << scene.name; }
inline std::string scene_name(const ::testing::TestParamInfo<GroundScene> &info) { return info.param.name; }

inline void stand(Rig *rig) { rig->start(); }

inline void land_hard(Rig *rig) {
  rig->params.floor_tilt_rad[0] = 0.1;
  rig->params.floor_tilt_rad[1] = -0.15;
  rig->params.start_height_m = 0.2;
  rig->start();
}

// Both soles reach over the edge of a tread by two thirds: the robot tips forward, sliding.
inline void stand_on_an_edge(Rig *rig) {
  add_block(&rig->params, -0.15, 0.0, 0.3, 0.4, 0.02, 0.05);
  rig->params.start_height_m = 0.0201;
  rig->params.friction_mu = 0.3;
  rig->start();
}

// The right sole's outer half on one tread, the left one's toes on another, askew.
inline void stand_on_two_treads(Rig *rig) {
  add_block(&rig->params, 0.0, -0.195, 0.4, 0.3, 0.02, 0.1);
  add_block(&rig->params, 0.06, 0.2, 0.08, 0.4, 0.015, 0.3);
  rig->params.start_height_m = 0.0201;
  rig->params.friction_mu = 0.3;
  rig->start();
}

// A foot with one corner over the corner of a block.
inline void stand_on_a_corner(Rig *rig) {
  add_block(&rig->params, 0.09, -0.06, 0.1, 0.05, 0.01, 0.6);
  rig->params.start_height_m = 0.0102;
  rig->start();
}

inline void fall_limp(Rig *rig, double about_x_rad_s, double about_y_rad_s) {
  rig->params.start_omega_W_rad_s[0] = about_x_rad_s;
  rig->params.start_omega_W_rad_s[1] = about_y_rad_s;
  rig->params.start_height_m = 0.01;
  rig->start();
  rig->mode_of_all(kDriveOff);
}
inline void fall_forward(Rig *rig) { fall_limp(rig, 0.0, 2.5); }
inline void fall_backward(Rig *rig) { fall_limp(rig, 0.0, -2.0); }
inline void fall_sideways(Rig *rig) { fall_limp(rig, 4.0, 0.0); }
inline void fall_askew(Rig *rig) { fall_limp(rig, 3.0, 2.0); }

// Face down, limp, almost without joint friction, so that every limb comes to lie.
inline void lie_down(Rig *rig) {
  rig->posture({{HOAP2_J_R_SHOULDER_PITCH, 90.0},
                {HOAP2_J_L_SHOULDER_PITCH, 90.0},
                {HOAP2_J_R_ANKLE_PITCH, 55.0},
                {HOAP2_J_L_ANKLE_PITCH, 55.0}});
  rig->params.joint_friction_scale = 0.05;
  rig->start();
  State s = rig->state();
  turn_robot(&s, about_axis(1, 0.5 * std::acos(-1.0)), vec(s.body[HOAP2_L_PELVIS].com_pos_W_m));
  shift_robot(&s, Vec3{0.0, 0.0, 0.005 - lowest_corner_m(s)});
  ASSERT_EQ(0, rig->restore(s));
  rig->mode_of_all(kDriveOff);
}
// The same on a plate flush with the floor: each corner touches both.
inline void lie_on_a_plate(Rig *rig) {
  add_block(&rig->params, 0.0, 0.0, 1.5, 1.5, 0.0);
  lie_down(rig);
}
// On a floor so soft that the robot sinks by millimetres.
inline void lie_on_soft_ground(Rig *rig) {
  rig->params.contact_stiffness_N_m = 1e3;
  lie_down(rig);
}

// Bent forward, both hands pressed on a block, the heels still loaded.
inline void lean_on_hands(Rig *rig) {
  rig->posture({{HOAP2_J_WAIST_PITCH, 50.0},
                {HOAP2_J_R_KNEE, 30.0},
                {HOAP2_J_L_KNEE, 30.0},
                {HOAP2_J_R_HIP_PITCH, -30.0},
                {HOAP2_J_L_HIP_PITCH, -30.0},
                {HOAP2_J_R_ANKLE_PITCH, -15.0},
                {HOAP2_J_L_ANKLE_PITCH, -15.0}});
  rig->start();
  const State s = rig->state();
  const Vec3 hand_W_m = point_W_m(s, HOAP2_L_R_HAND, Vec3{});
  add_block(&rig->params, hand_W_m.x + 0.05, 0.0, 0.14, 0.4, lowest_corner_m(s, HOAP2_L_R_HAND) - 0.001, 0.1);
  rig->start();
  rig->inputs.q_ref_rad[HOAP2_J_WAIST_PITCH] += 0.25;
}

inline void thrown_on_blocks(Rig *rig, std::uint64_t seed) {
  Dice dice(1000 + seed);
  for (int b = 0; b < 6; ++b) {
    add_block(&rig->params, dice.between(-0.3, 0.3), dice.between(-0.3, 0.3), dice.between(0.05, 0.3),
              dice.between(0.05, 0.3), dice.between(0.01, 0.08), dice.between(-3.0, 3.0));
  }
  thrown(rig, seed, 0.12);
}
inline void thrown_1(Rig *rig) { thrown_on_blocks(rig, 1); }
inline void thrown_2(Rig *rig) { thrown_on_blocks(rig, 2); }
inline void thrown_3(Rig *rig) { thrown_on_blocks(rig, 3); }

inline const GroundScene kGroundScenes[] = {
    {"Stand", stand, 300, 8, 2},
    {"LandHard", land_hard, 500, 6, 2},
    {"EdgeOfATread", stand_on_an_edge, 900, 4, 2},
    {"TwoTreads", stand_on_two_treads, 900, 4, 2},
    {"CornerOfABlock", stand_on_a_corner, 500, 4, 2},
    {"FallForward", fall_forward, 1200, 10, 4},
    {"FallBackward", fall_backward, 1200, 10, 4},
    {"FallSideways", fall_sideways, 1200, 4, 3},
    {"FallAskew", fall_askew, 1200, 4, 3},
    {"LeanOnHands", lean_on_hands, 800, 8, 4},
    {"Thrown1", thrown_1, 800, 3, 2},
    {"Thrown2", thrown_2, 800, 3, 2},
    {"Thrown3", thrown_3, 800, 2, 2},
};
inline const GroundScene kLyingScenes[] = {
    {"LieDown", lie_down, 2000, 14, 8},
    {"LieOnSoftGround", lie_on_soft_ground, 2000, 21, 10},
};
// dWorldStep's LCP gives up on some of these ticks: not for comparison with it.
inline const GroundScene kTwiceSupportedScenes[] = {
    {"LieOnAPlate", lie_on_a_plate, 1500, 28, 8},
};

}  // namespace hoap2_sim
#endif
