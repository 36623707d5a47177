#include "robot_shape.h"

#include <algorithm>

#include "hoap2/generated/robot_model.h"

// Sizes follow the bounding boxes of the links (robot_model.h); within them the shapes are drawn by hand.
// Right limbs are described; left limbs are their mirror image in y.
namespace hoap2 {
namespace {

constexpr float kQuarter = 1.57079633F;

const Material kWhite = {{0.74F, 0.75F, 0.77F}, 0.45F};
const Material kGrey = {{0.36F, 0.38F, 0.41F}, 0.35F};
const Material kDark = {{0.045F, 0.048F, 0.055F}, 0.35F};
const Material kNavy = {{0.022F, 0.055F, 0.20F}, 0.55F};
const Material kGlass = {{0.010F, 0.012F, 0.016F}, 1.0F};
const Material kRubber = {{0.022F, 0.022F, 0.024F}, 0.05F};
const Material kLens = {{0.06F, 0.42F, 0.60F}, 0.9F};

enum class Axis { x, y, z };

class Builder {
 public:
  explicit Builder(Detail detail) : fine_(detail == Detail::picture) {}

  // Links that follow are drawn as they are (+1) or as the mirror image of the right ones (-1).
  void side(float mirror_y) { mirror_ = mirror_y; }

  struct Form {
    float taper_x = 0.0F, taper_y = 0.0F, shear_x = 0.0F, pitch_rad = 0.0F;
    int cells = 2;
  };

  void box(int link, const Material &material, Vec3 centre, Vec3 half, Vec3 radius, const Form &form) {
    Placement at = placement(link, material, centre);
    at.taper_x = form.taper_x;
    at.taper_y = form.taper_y;
    at.shear_x = form.shear_x;
    at.turn_rad = {0.0F, form.pitch_rad, 0.0F};
    add_rounded_box(mesh, at, half, radius, fine_ ? form.cells : 1);
  }
  void box(int link, const Material &material, Vec3 centre, Vec3 half, float radius) {
    box(link, material, centre, half, {radius, radius, radius}, Form{});
  }
  // Small parts cast no shadow of their own.
  void detail_box(int link, const Material &material, Vec3 centre, Vec3 half, float radius) {
    Form form;
    form.cells = 1;
    if (fine_) box(link, material, centre, half, {radius, radius, radius}, form);
  }
  void rod(int link, const Material &material, Axis axis, Vec3 centre, float radius, float half_length,
           int sides = 20) {
    Placement at = placement(link, material, centre);
    if (axis == Axis::x) at.turn_rad = {0.0F, kQuarter, 0.0F};
    if (axis == Axis::y) at.turn_rad = {kQuarter, 0.0F, 0.0F};
    add_cylinder(mesh, at, radius, half_length, 0.12F * radius, fine_ ? sides : 10);
  }
  void detail_rod(int link, const Material &material, Axis axis, Vec3 centre, float radius,
                  float half_length) {
    if (fine_) rod(link, material, axis, centre, radius, half_length, 16);
  }

  Mesh mesh;

 private:
  Placement placement(int link, const Material &material, Vec3 centre) const {
    Placement at;
    at.link = link;
    at.centre = {centre.x, centre.y * mirror_, centre.z};
    at.material = material;
    return at;
  }
  bool fine_;
  float mirror_ = 1.0F;
};

void add_trunk(Builder &b) {
  const int pelvis = HOAP2_L_PELVIS;
  Builder::Form belt;
  belt.cells = 4;
  belt.taper_x = 0.05F;
  b.box(pelvis, kWhite, {0.0145F, 0.0F, 0.052F}, {0.0365F, 0.0660F, 0.0205F}, {0.024F, 0.026F, 0.013F}, belt);
  b.box(pelvis, kDark, {0.0125F, 0.0F, 0.034F}, {0.027F, 0.054F, 0.013F}, 0.006F);
  b.detail_rod(pelvis, kNavy, Axis::y, {0.030F, 0.0F, 0.053F}, 0.0105F, 0.0675F);

  const int chest = HOAP2_L_CHEST;
  // waist, shell, breast plate, collar
  Builder::Form abdomen;
  abdomen.cells = 3;
  abdomen.taper_x = -0.08F;
  b.box(chest, kDark, {-0.016F, 0.0F, 0.016F}, {0.0345F, 0.044F, 0.026F}, {0.020F, 0.020F, 0.012F}, abdomen);
  Builder::Form shell;
  shell.taper_x = 0.10F;
  shell.taper_y = 0.13F;
  shell.cells = 4;
  b.box(chest, kWhite, {-0.029F, 0.0F, 0.085F}, {0.052F, 0.059F, 0.059F}, {0.034F, 0.030F, 0.030F}, shell);
  Builder::Form plate;
  plate.taper_y = 0.16F;
  plate.pitch_rad = 0.11F;
  plate.cells = 3;
  b.box(chest, kNavy, {0.0175F, 0.0F, 0.098F}, {0.0115F, 0.035F, 0.024F}, {0.008F, 0.018F, 0.013F}, plate);
  b.detail_rod(chest, kLens, Axis::x, {0.0285F, 0.0F, 0.104F}, 0.0055F, 0.0028F);
  b.detail_box(chest, kGrey, {0.0195F, 0.0F, 0.056F}, {0.004F, 0.022F, 0.0035F}, 0.002F);
  b.rod(chest, kDark, Axis::z, {-0.034F, 0.0F, 0.147F}, 0.023F, 0.0105F);
  // shoulder sockets
  for (const float y : {-0.061F, 0.061F}) b.rod(chest, kDark, Axis::y, {-0.034F, y, 0.09F}, 0.024F, 0.0065F);
  // backpack with its vents
  Builder::Form pack;
  pack.taper_y = 0.05F;
  pack.taper_x = -0.08F;
  pack.cells = 3;
  b.box(chest, kGrey, {-0.100F, 0.0F, 0.073F}, {0.0265F, 0.051F, 0.064F}, {0.016F, 0.016F, 0.016F}, pack);
  for (const float z : {0.056F, 0.070F, 0.084F}) {
    b.detail_box(chest, kDark, {-0.1255F, 0.0F, z}, {0.003F, 0.030F, 0.0035F}, 0.002F);
  }
  b.detail_box(chest, kNavy, {-0.1225F, 0.0F, 0.112F}, {0.004F, 0.020F, 0.007F}, 0.003F);
}

void add_head(Builder &b) {
  b.rod(HOAP2_L_HEAD_PAN_LINK, kDark, Axis::z, {-0.001F, 0.0F, 0.061F}, 0.0135F, 0.020F);
  const int head = HOAP2_L_HEAD;
  Builder::Form skull;
  skull.cells = 5;
  skull.taper_x = 0.05F;
  skull.taper_y = 0.07F;
  b.box(head, kWhite, {-0.002F, 0.0F, -0.003F}, {0.035F, 0.0345F, 0.0405F}, {0.034F, 0.0335F, 0.032F}, skull);
  // visor: stands out of the skull by a millimetre or two at the front only
  Builder::Form visor;
  visor.cells = 4;
  b.box(head, kGlass, {0.0105F, 0.0F, 0.002F}, {0.0275F, 0.0315F, 0.0165F}, {0.0275F, 0.0290F, 0.0120F},
        visor);
  for (const float y : {-0.0130F, 0.0130F}) {
    b.detail_box(head, kLens, {0.0350F, y, 0.002F}, {0.0032F, 0.0046F, 0.0046F}, 0.0046F);
  }
  for (const float y : {-0.0345F, 0.0345F}) {
    b.rod(head, kDark, Axis::y, {-0.003F, y, 0.000F}, 0.0125F, 0.0035F);
    b.detail_rod(head, kNavy, Axis::y, {-0.003F, y, 0.000F}, 0.0080F, 0.0048F);
  }
}

struct Arm {
  int shoulder_pitch, shoulder_roll, upper, fore, hand;
};

// In the zero posture the arm points forward (+x); +y of the right arm is towards the chest.
void add_arm(Builder &b, const Arm &arm) {
  b.rod(arm.shoulder_pitch, kDark, Axis::y, {0.0F, 0.016F, 0.0F}, 0.0180F, 0.0250F);
  b.box(arm.shoulder_pitch, kGrey, {0.0F, 0.008F, -0.037F}, {0.0165F, 0.020F, 0.0255F}, 0.008F);

  Builder::Form cap;
  cap.cells = 4;
  b.box(arm.shoulder_roll, kWhite, {0.002F, -0.001F, -0.003F}, {0.0295F, 0.0245F, 0.0330F},
        {0.024F, 0.0225F, 0.026F}, cap);
  b.box(arm.shoulder_roll, kGrey, {0.001F, 0.0F, -0.046F}, {0.0175F, 0.0165F, 0.0205F}, 0.008F);
  b.detail_rod(arm.shoulder_roll, kNavy, Axis::z, {0.0F, 0.0F, 0.0285F}, 0.0105F, 0.0042F);

  b.rod(arm.upper, kDark, Axis::x, {0.037F, 0.0F, 0.0F}, 0.0165F, 0.012F);
  b.box(arm.upper, kWhite, {0.066F, 0.002F, 0.0F}, {0.026F, 0.0215F, 0.0192F}, {0.012F, 0.014F, 0.014F}, {});
  b.rod(arm.upper, kDark, Axis::y, {0.101F, 0.003F, 0.0F}, 0.0155F, 0.0245F);
  b.detail_rod(arm.upper, kGrey, Axis::y, {0.101F, 0.003F, 0.0F}, 0.0085F, 0.0262F);

  Builder::Form sleeve;
  sleeve.cells = 3;
  sleeve.taper_x = -0.14F;
  sleeve.taper_y = -0.14F;
  sleeve.pitch_rad = kQuarter;  // the form's z runs along the forearm
  b.box(arm.fore, kWhite, {0.044F, 0.0F, -0.0035F}, {0.0175F, 0.0205F, 0.0400F}, {0.0150F, 0.0165F, 0.014F},
        sleeve);
  b.rod(arm.fore, kDark, Axis::y, {0.0F, 0.0F, 0.0F}, 0.0115F, 0.0200F);
  b.rod(arm.fore, kDark, Axis::x, {0.088F, 0.0F, -0.0035F}, 0.0115F, 0.0075F);

  b.box(arm.hand, kGrey, {0.006F, -0.003F, -0.0015F}, {0.0170F, 0.0150F, 0.0125F}, 0.008F);
  for (const float z : {-0.0085F, 0.0060F}) {
    b.box(arm.hand, kWhite, {0.032F, 0.006F, z}, {0.0160F, 0.0062F, 0.0058F}, 0.0050F);
  }
  b.box(arm.hand, kWhite, {0.026F, -0.017F, -0.0015F}, {0.0150F, 0.0062F, 0.0070F}, 0.0050F);
}

struct Leg {
  int hip_yaw, hip_roll, thigh, shank, ankle, foot;
};

// -y of the right leg is the outer side.
void add_leg(Builder &b, const Leg &leg) {
  b.rod(leg.hip_yaw, kDark, Axis::z, {0.0F, 0.0F, 0.021F}, 0.0215F, 0.0155F);
  b.box(leg.hip_yaw, kGrey, {-0.0015F, 0.0F, 0.001F}, {0.0295F, 0.0125F, 0.0160F}, 0.006F);
  b.rod(leg.hip_roll, kDark, Axis::x, {-0.002F, 0.0F, 0.0F}, 0.0170F, 0.0295F);
  b.box(leg.hip_roll, kGrey, {-0.002F, -0.002F, -0.003F}, {0.0215F, 0.0290F, 0.0150F}, 0.007F);

  Builder::Form thigh;
  thigh.cells = 3;
  thigh.taper_x = 0.14F;
  thigh.taper_y = 0.04F;
  b.rod(leg.thigh, kDark, Axis::y, {0.0F, -0.002F, 0.0F}, 0.0172F, 0.0330F);
  b.box(leg.thigh, kWhite, {0.0085F, -0.002F, -0.0465F}, {0.0225F, 0.0305F, 0.0400F},
        {0.0165F, 0.0175F, 0.0185F}, thigh);
  b.detail_box(leg.thigh, kNavy, {0.0310F, -0.002F, -0.046F}, {0.0022F, 0.0075F, 0.0200F}, 0.002F);
  b.rod(leg.thigh, kDark, Axis::y, {0.0F, -0.002F, -0.1F}, 0.0172F, 0.0335F);
  b.detail_rod(leg.thigh, kGrey, Axis::y, {0.0F, -0.002F, -0.1F}, 0.0090F, 0.0350F);

  Builder::Form shank;
  shank.cells = 3;
  shank.taper_x = 0.12F;
  shank.shear_x = 0.004F;
  shank.taper_y = 0.10F;
  Builder::Form knee;
  knee.cells = 3;
  b.box(leg.shank, kNavy, {0.0165F, -0.002F, -0.004F}, {0.0135F, 0.0220F, 0.0160F},
        {0.0125F, 0.0140F, 0.0130F}, knee);
  b.box(leg.shank, kWhite, {0.0105F, -0.002F, -0.0515F}, {0.0225F, 0.0275F, 0.0380F},
        {0.0165F, 0.0165F, 0.0170F}, shank);
  b.rod(leg.shank, kDark, Axis::y, {0.0F, -0.002F, -0.0985F}, 0.0155F, 0.0325F);

  b.rod(leg.ankle, kGrey, Axis::y, {0.0F, -0.002F, 0.0F}, 0.0095F, 0.0345F);
  b.box(leg.ankle, kGrey, {0.0045F, -0.002F, 0.0F}, {0.0220F, 0.0250F, 0.0150F}, 0.007F);
  b.rod(leg.ankle, kDark, Axis::x, {0.0055F, 0.0F, 0.0F}, 0.0120F, 0.0262F);

  const float sole_x = 0.5F * static_cast<float>(HOAP2_ANKLE_TO_TOE_M + HOAP2_ANKLE_TO_HEEL_M);
  const float sole_mid_x = 0.5F * static_cast<float>(HOAP2_ANKLE_TO_TOE_M - HOAP2_ANKLE_TO_HEEL_M);
  const auto sole_y = static_cast<float>(HOAP2_SOLE_HALF_WIDTH_M);
  const auto sole_z = static_cast<float>(HOAP2_SOLE_BELOW_ANKLE_M);
  Builder::Form flat;
  flat.cells = 3;
  b.box(leg.foot, kRubber, {sole_mid_x, 0.0F, -sole_z + 0.0030F}, {sole_x, sole_y, 0.0030F},
        {0.012F, 0.012F, 0.0008F}, flat);
  Builder::Form shoe;
  shoe.cells = 3;
  shoe.taper_x = -0.10F;
  shoe.taper_y = -0.07F;
  shoe.shear_x = -0.003F;
  b.box(leg.foot, kWhite, {sole_mid_x, 0.0F, -0.0255F}, {0.0440F, 0.0285F, 0.0078F},
        {0.016F, 0.015F, 0.0070F}, shoe);
  b.detail_box(leg.foot, kNavy, {0.0400F, 0.0F, -0.0200F}, {0.0075F, 0.0150F, 0.0030F}, 0.0025F);
  for (const float x : {-0.0245F, 0.0330F}) {
    b.box(leg.foot, kGrey, {x, 0.0F, -0.0085F}, {0.0045F, 0.0140F, 0.0185F}, {0.003F, 0.009F, 0.009F}, {});
  }
}

}  // namespace

Mesh robot_mesh(Detail detail) {
  Builder b(detail);
  add_trunk(b);
  add_head(b);
  const Arm right_arm = {HOAP2_L_R_SHOULDER_PITCH_LINK, HOAP2_L_R_SHOULDER_ROLL_LINK, HOAP2_L_R_UPPER_ARM,
                         HOAP2_L_R_FOREARM, HOAP2_L_R_HAND};
  const Arm left_arm = {HOAP2_L_L_SHOULDER_PITCH_LINK, HOAP2_L_L_SHOULDER_ROLL_LINK, HOAP2_L_L_UPPER_ARM,
                        HOAP2_L_L_FOREARM, HOAP2_L_L_HAND};
  const Leg right_leg = {HOAP2_L_R_HIP_YAW_LINK, HOAP2_L_R_HIP_ROLL_LINK, HOAP2_L_R_THIGH,
                         HOAP2_L_R_SHANK,        HOAP2_L_R_ANKLE_LINK,    HOAP2_L_R_FOOT};
  const Leg left_leg = {HOAP2_L_L_HIP_YAW_LINK, HOAP2_L_L_HIP_ROLL_LINK, HOAP2_L_L_THIGH,
                        HOAP2_L_L_SHANK,        HOAP2_L_L_ANKLE_LINK,    HOAP2_L_L_FOOT};
  add_arm(b, right_arm);
  add_leg(b, right_leg);
  b.side(-1.0F);
  add_arm(b, left_arm);
  add_leg(b, left_leg);
  return std::move(b.mesh);
}

}  // namespace hoap2
