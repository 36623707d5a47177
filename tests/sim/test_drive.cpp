// The drives: motor rows against closed forms, limits, friction, modes, compliance.
#include <gtest/gtest.h>

#include "drive/drive.h"
#include "rig.h"

namespace hoap2_sim {
namespace {

constexpr int kHand = HOAP2_J_R_HAND;

// Inertia of rotor and hand about the hand's joint; the forearm behind it is heavy.
double hand_inertia_kgm2() {
  const hoap2_link_data_t &hand = HOAP2_LINK[HOAP2_L_R_HAND];
  const double r2 = hand.com_L_m[0] * hand.com_L_m[0] + hand.com_L_m[1] * hand.com_L_m[1];
  return HOAP2_JOINT[kHand].armature_kgm2 + hand.inertia_C_kgm2[2] + hand.mass_kg * r2;
}

class Drives : public WithEachSolver {};  // LongDrives: with the default solver alone

TEST_P(Drives, StepResponseIsTheImplicitSecondOrderRecursion) {
  Rig rig;
  rig.float_free();
  rig.start();
  const double r = rig.params.start_posture_rad[kHand] + 0.002;
  rig.inputs.q_ref_rad[kHand] = r;
  const double kp = rig.inputs.kp_Nm_rad[kHand], kd = rig.inputs.kd_Nms_rad[kHand], h = kTick_s;
  const double inertia = hand_inertia_kgm2();
  double q = rig.params.start_posture_rad[kHand], w = 0.0, largest = 0.0;
  for (int i = 0; i < 60; ++i) {
    w = (inertia / h * w + kp * (r - q)) / (inertia / h + kd + h * kp);
    q += h * w;
    rig.step();
    largest = std::fmax(largest, std::fabs(rig.out().true_q_rad[kHand] - q));
  }
  EXPECT_LT(largest, 1e-3 * 0.002);
  EXPECT_NEAR(r, rig.out().true_q_rad[kHand], 1e-5);
}

TEST_P(Drives, SoftServoFollowsTheAnalyticOscillator) {
  Rig rig;
  rig.float_free();
  rig.start();
  const double inertia = hand_inertia_kgm2(), wn = 20.0, zeta = 0.3, step = 0.01;
  rig.inputs.kp_Nm_rad[kHand] = inertia * wn * wn;
  rig.inputs.kd_Nms_rad[kHand] = 2.0 * zeta * wn * inertia;
  const double q0 = rig.params.start_posture_rad[kHand];
  rig.inputs.q_ref_rad[kHand] = q0 + step;
  const double wd = wn * std::sqrt(1.0 - zeta * zeta);
  for (int i = 1; i <= 400; ++i) {
    rig.step();
    const double t = kTick_s * i, decay = std::exp(-zeta * wn * t);
    const double q = q0 + step * (1.0 - decay * (std::cos(wd * t) + zeta * wn / wd * std::sin(wd * t)));
    EXPECT_NEAR(q, rig.out().true_q_rad[kHand], 0.02 * step) << "t " << t;
  }
}

TEST_P(Drives, TorqueModeAcceleratesRotorAndLink) {
  Rig rig;
  rig.float_free();
  rig.start();
  rig.inputs.drive_mode[kHand] = kDriveTorque;
  rig.inputs.tau_ff_Nm[kHand] = 0.01;
  rig.step(20);
  EXPECT_NEAR(0.01 / hand_inertia_kgm2() * 0.020, rig.out().true_qd_rad_s[kHand], 2e-3 * 0.4);
  EXPECT_NEAR(0.01, rig.out().true_tau_Nm[kHand], 1e-12);
}

TEST_P(Drives, DampedTorqueSettlesAtTorqueOverDamping) {
  Rig rig;
  rig.float_free();
  rig.start();
  rig.inputs.drive_mode[kHand] = kDriveDampedTorque;
  rig.inputs.tau_ff_Nm[kHand] = 0.02;
  rig.inputs.kd_Nms_rad[kHand] = 0.05;
  rig.step(200);
  EXPECT_NEAR(0.4, rig.out().true_qd_rad_s[kHand], 2e-3);
}

TEST_P(Drives, OffGivesNoTorque) {
  Rig rig;
  rig.start();
  rig.mode_of_all(kDriveOff);
  rig.step(50);
  for (const double tau : rig.out().true_tau_Nm) EXPECT_EQ(0.0, tau);
}

// Arms stretched forward: the elbow carries forearm and hand, weighed by hand.
TEST_P(Drives, HoldsTheArmWithTheTorqueOfStatics) {
  Rig rig;
  rig.posture({});
  rig.params.joint_friction_scale = 0.0;
  rig.start();
  rig.step(1500);
  const State s = rig.state();
  double moment_Nm = 0.0;
  for (const int link : {HOAP2_L_R_FOREARM, HOAP2_L_R_HAND}) {
    const double lever_m = s.body[link].com_pos_W_m[0] - point_W_m(s, HOAP2_L_R_FOREARM, Vec3{}).x;
    moment_Nm += HOAP2_LINK[link].mass_kg * 9.81 * lever_m;
  }
  EXPECT_GT(moment_Nm, 0.05);
  EXPECT_NEAR(-moment_Nm, rig.out().true_tau_Nm[HOAP2_J_R_ELBOW], 1e-3 * moment_Nm);
  const double error_rad = rig.inputs.q_ref_rad[HOAP2_J_R_ELBOW] - rig.out().true_q_rad[HOAP2_J_R_ELBOW];
  EXPECT_NEAR(-moment_Nm / rig.inputs.kp_Nm_rad[HOAP2_J_R_ELBOW], error_rad, 1e-3 * std::fabs(error_rad));
}

TEST_P(Drives, TorqueNeverExceedsThePeak) {
  Rig rig;
  rig.params.start_height_m = 0.15;  // a hard landing under saturating commands
  rig.start();
  bool reached = false;
  for (int i = 0; i < 800; ++i) {
    const double swing = (i / 60) % 2 == 0 ? 0.6 : -0.1;
    rig.inputs.q_ref_rad[HOAP2_J_R_KNEE] = rig.params.start_posture_rad[HOAP2_J_R_KNEE] + swing;
    rig.inputs.q_ref_rad[HOAP2_J_L_HIP_PITCH] = rig.params.start_posture_rad[HOAP2_J_L_HIP_PITCH] - swing;
    rig.step();
    const hoap2_plant_outputs_t out = rig.out();
    for (int j = 0; j < HOAP2_JOINTS; ++j) {
      const double peak_Nm = HOAP2_JOINT[j].torque_peak_Nm;
      ASSERT_LE(std::fabs(out.true_tau_Nm[j]), peak_Nm * (1.0 + 1e-9)) << "joint " << j << " tick " << i;
      reached = reached || std::fabs(out.true_tau_Nm[j]) > 0.999 * peak_Nm;
    }
  }
  EXPECT_TRUE(reached) << "the commands must reach the limit for this to mean anything";
}

TEST_P(Drives, AccelerationAtThePeakIsPeakOverInertia) {
  Rig rig;
  rig.float_free();
  rig.start();
  rig.inputs.q_ref_rad[kHand] += 0.8;
  rig.step(2);
  EXPECT_NEAR(HOAP2_JOINT[kHand].torque_peak_Nm / hand_inertia_kgm2() * 0.002, rig.out().true_qd_rad_s[kHand],
              0.01);
}

TEST_P(Drives, PositionLoopKeepsTheVelocityLimit) {
  Rig rig;
  rig.float_free();
  rig.start();
  const int j = HOAP2_J_R_SHOULDER_PITCH;
  rig.inputs.q_ref_rad[j] -= 1.8;
  double fastest = 0.0;
  for (int i = 0; i < 500; ++i) {
    rig.step();
    fastest = std::fmax(fastest, std::fabs(rig.out().true_qd_rad_s[j]));
  }
  EXPECT_LE(fastest, 1.01 * HOAP2_JOINT[j].velocity_limit_rad_s);
  EXPECT_GE(fastest, 0.95 * HOAP2_JOINT[j].velocity_limit_rad_s);
  EXPECT_NEAR(rig.inputs.q_ref_rad[j], rig.out().true_q_rad[j], 2e-3);
}

TEST_P(Drives, CoulombFrictionHoldsBelowAndDragsAbove) {
  Rig rig;
  rig.float_free();
  rig.params.joint_friction_scale = 1.0;
  rig.start();
  const int j = kHand;
  const double fc = HOAP2_JOINT[j].friction_coulomb_Nm, fv = HOAP2_JOINT[j].friction_viscous_Nms_rad;
  rig.inputs.drive_mode[j] = kDriveTorque;
  rig.inputs.tau_ff_Nm[j] = 0.8 * fc;
  rig.step(300);
  EXPECT_LT(rig.out().true_qd_rad_s[j], 0.02) << "creeps only";
  rig.inputs.tau_ff_Nm[j] = fc + 0.01;
  rig.step(40);
  const double before = rig.out().true_qd_rad_s[j];
  rig.step(10);
  const double after = rig.out().true_qd_rad_s[j];
  const double drag_Nm = 0.01 - fv * 0.5 * (before + after);
  EXPECT_NEAR(drag_Nm / hand_inertia_kgm2() * 0.010, after - before, 0.01 * (after - before));
}

TEST_P(Drives, QuantisedServoIgnoresLessThanHalfACount) {
  Rig rig;
  rig.float_free();
  rig.params.sensor_preset = 1;
  rig.posture({});
  rig.start();
  rig.inputs.q_ref_rad[kHand] = 0.4 * HOAP2_RAD_PER_COUNT;
  rig.step(100);
  EXPECT_NEAR(0.0, rig.out().true_q_rad[kHand], 1e-9);
  rig.inputs.q_ref_rad[kHand] = 5.4 * HOAP2_RAD_PER_COUNT;
  rig.step(200);
  EXPECT_NEAR(5.0 * HOAP2_RAD_PER_COUNT, rig.out().true_q_rad[kHand], 0.51 * HOAP2_RAD_PER_COUNT);
}

TEST(LongDrives, ComplianceDeflectsByTorqueOverStiffnessUnseenByTheEncoder) {
  Rig rig;
  rig.params.roll_stiffness_Nm_rad = 80.0;
  rig.params.joint_friction_scale = 0.0;
  rig.params.push_link[0] = HOAP2_L_CHEST;
  rig.params.push_force_W_N[0][1] = 4.0;
  rig.params.push_duration_s[0] = 1e3;
  rig.params.push_ramp_s[0] = 0.5;
  rig.start();
  rig.step(3000);
  const hoap2_plant_outputs_t out = rig.out();
  for (const int j : {HOAP2_J_R_HIP_ROLL, HOAP2_J_L_HIP_ROLL, HOAP2_J_R_ANKLE_ROLL, HOAP2_J_L_ANKLE_ROLL}) {
    EXPECT_NEAR(out.true_tau_Nm[j] / 80.0, out.q_enc_rad[j] - out.true_q_rad[j], 2e-6) << "joint " << j;
    EXPECT_NEAR(rig.inputs.q_ref_rad[j] - out.true_tau_Nm[j] / rig.inputs.kp_Nm_rad[j], out.q_enc_rad[j],
                2e-6);
  }
  EXPECT_GT(std::fabs(out.q_enc_rad[HOAP2_J_R_HIP_ROLL] - out.true_q_rad[HOAP2_J_R_HIP_ROLL]), 1e-4);
  EXPECT_EQ(out.q_enc_rad[HOAP2_J_R_KNEE], out.true_q_rad[HOAP2_J_R_KNEE])
      << "only roll joints are compliant";
  EXPECT_GT(out.true_chest_rpy_rad[0], -0.1);
  EXPECT_NEAR(kMg_N, out.true_foot_force_W_N[0][2] + out.true_foot_force_W_N[1][2], 1e-3 * kMg_N);
}

// The eliminated rotor against its two laws: the link's torque is the spring's, and the
// rotor turns by what the drive gives more than the spring takes.
TEST_P(Drives, CompliantRowObeysSpringAndRotor) {
  Rig rig;
  rig.float_free();
  rig.params.roll_stiffness_Nm_rad = 2000.0;
  rig.params.roll_damping_Nms_rad = 20.0;
  rig.start();
  const int j = HOAP2_J_L_HIP_ROLL;
  State s = rig.state();
  s.drive[j].rotor_q_rad += 4e-4;
  s.drive[j].rotor_qd_rad_s = 0.03;
  rig.inputs.q_ref_rad[j] += 1e-3;
  const double link_q = joint_angle_rad(s, j), inertia = HOAP2_JOINT[j].armature_kgm2;
  for (const double link_qd_next : {-0.2, 0.0, 0.05}) {
    Drive drive;
    drive.begin(s, rig.inputs, j);
    const MotorRow row = drive.row();
    const double torque_Nm = row.stiffness_Nms_rad * (row.target_rad_s - link_qd_next);
    const DriveState next = drive.finish(link_q + kTick_s * link_qd_next, link_qd_next, link_qd_next);
    const double spring_Nm = 2000.0 * (next.rotor_q_rad - link_q - kTick_s * link_qd_next) +
                             20.0 * (next.rotor_qd_rad_s - link_qd_next);
    EXPECT_NEAR(spring_Nm, torque_Nm, 1e-10);
    EXPECT_NEAR(inertia * (next.rotor_qd_rad_s - 0.03) / kTick_s, next.tau_Nm - torque_Nm, 1e-10);
    EXPECT_GT(std::fabs(torque_Nm), 0.1);
  }
}

// Rotor and link on a spring: the difference oscillates at sqrt(k / I_reduced).
TEST_P(Drives, CompliantJointRingsAtItsEigenfrequency) {
  Rig rig;
  rig.float_free();
  rig.params.roll_stiffness_Nm_rad = 20.0;
  rig.params.roll_damping_Nms_rad = 0.0;
  rig.start();
  const int j = HOAP2_J_R_ANKLE_ROLL;
  const hoap2_link_data_t &foot = HOAP2_LINK[HOAP2_L_R_FOOT];
  const double link_I = foot.inertia_C_kgm2[0] + foot.mass_kg * (foot.com_L_m[1] * foot.com_L_m[1] +
                                                                 foot.com_L_m[2] * foot.com_L_m[2]);
  State s = rig.state();
  s.drive[j].rotor_q_rad += 0.01;
  ASSERT_EQ(0, rig.restore(s));
  rig.mode_of_all(kDrivePosition);  // the servo holds the rotor: the foot swings against it
  rig.inputs.q_ref_rad[j] += 0.01;
  const double start_q = rig.out().true_q_rad[j];
  int crossings = 0, last_tick = 0, first_tick = 0;
  double before = -1.0;
  for (int i = 0; i < 120; ++i) {
    rig.step();
    const double off = rig.out().true_q_rad[j] - start_q - 0.01;
    if (off * before < 0.0) {
      if (crossings == 0) first_tick = i;
      last_tick = i;
      ++crossings;
    }
    before = off;
  }
  ASSERT_GT(crossings, 4);
  const double half_period_s = kTick_s * (last_tick - first_tick) / (crossings - 1);
  const double expected_s = std::acos(-1.0) / std::sqrt(20.0 / link_I);
  EXPECT_NEAR(expected_s, half_period_s, 0.1 * expected_s);
}

INSTANTIATE_WITH_EACH_SOLVER(Drives);

}  // namespace
}  // namespace hoap2_sim
