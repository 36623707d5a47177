// The pool of soil: what it does to the links within a tick, and what they leave in it.
// The laws, their sources and their limits are in docs/soil.md.
//
// All of it is computed in the pool's frame: origin at the start point, x ahead, y left,
// z up along the floor's normal. So a run far away or turned is the same to rounding.
#ifndef HOAP2_SIM_SOIL_SOIL_H
#define HOAP2_SIM_SOIL_SOIL_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry.h"
#include "hoap2_plant/plant.h"
#include "plant_state.h"
#include "soil/face.h"
#include "soil/face_load.h"
#include "soil/flow.h"
#include "soil/height_field.h"
#include "soil/pressure_law.h"
#include "soil/rft.h"
#include "soil/shear.h"

namespace hoap2_sim {

// On one link, linearised about the tick's start: about its CoM, world axes.
//   wrench = F0 - Z (omega, v_com), velocities after the tick; Z is symmetric and positive semidefinite.
struct SoilLoad {
  bool touches = false;
  Vec3 force_W_N, torque_com_W_Nm;                     // F0
  double angular[3][3], coupling[3][3], linear[3][3];  // Z = [angular, coupling; coupling^T, linear]
};

class Soil {
 public:
  // Allocates everything. An error text when the grid does not fit, else "".
  std::string build(const hoap2_plant_params_t &params);
  // Fresh surface (roughness by soil_seed), no plastic memory, no shear.
  void start();

  // The mutable block: plain bytes, size fixed by build(). restore() refuses what cannot
  // be and then leaves the soil as it was.
  std::size_t state_bytes() const;
  void save(void *to) const;
  std::string restore(const void *from);

  // Loads on all links at the start of a tick; the soil does not change. An error when a
  // sole presses outside the walls or reached the pool's bottom. axes_W: of all links.
  std::string find_loads(const State &state, const Mat3 axes_W[HOAP2_LINKS], SoilLoad load[HOAP2_LINKS]);
  // After the tick that find_loads() began has succeeded: what its start pressed and
  // sheared becomes memory; rim and flow.
  void commit(const State &next, const Mat3 next_axes_W[HOAP2_LINKS]);

  // Of the sole's middle below the untouched surface; 0 while the sole does not touch.
  double mean_sinkage_m(int foot) const { return sinkage_m_[foot]; }
  // Under the unloaded surface, with what was compacted: constant.
  double volume_m3() const { return field_.volume_m3() + flow_.pending_m3() + compacted_m3_; }
  const HeightField &field() const { return field_; }
  // Another initial surface than the flat one: call after start().
  void set_level(int ix, int iy, double level_m);

 private:
  // A patch and a face within one tick.
  struct PatchTick {
    double normal_N = 0.0, area_m2 = 0.0;
    RftShare share;
    PatchShear shear;
  };
  struct FaceTick {
    bool presses = false;
    std::size_t first_pressed = 0, end_pressed = 0;
    Window under;
  };
  struct Pressed {
    std::size_t index;
    Cell cell;
  };

  FacePose pose_of(const State &state, const Mat3 axes_W[HOAP2_LINKS], const Face &face,
                   FaceTwist *twist) const;
  bool is_near(const Face &face, const FacePose &pose, const FaceTwist &twist) const;
  bool is_link_near(const State &state, int link) const;
  std::string fault_of_sole(const Face &face, const FacePose &pose) const;
  double bearing(const Face &face, const CellPart &part) const;
  void find_shares(const Face &face, const FacePose &pose, const FaceTwist &twist);
  void press_face(const Face &face, const FacePose &pose, const FaceTwist &twist, FaceTick *tick,
                  FaceLoad *sum);
  void shear_face(const Face &face, const FaceTwist &twist, FaceLoad *sum);
  void keep_face(std::size_t i, const State &next, const Mat3 next_axes_W[HOAP2_LINKS]);
  void run_flow(const State &next, const Mat3 next_axes_W[HOAP2_LINKS]);
  void find_sheared();
  std::string fault_of_block(const void *from) const;

  hoap2_plant_params_t params_ = {};
  PoolFrame pool_;
  PressureLaw pressure_;
  ShearLaw shear_law_;
  double cohesion_Pa_ = 0.0, tan_friction_ = 0.0;
  double edge_loss_ = 0.0, per_edge_m_ = 0.0;
  double radius_m_[HOAP2_LINKS] = {};  // of the link's box about its CoM
  std::vector<Face> faces_;

  // The mutable block.
  HeightField field_;
  Flow flow_;
  std::vector<PatchShear> shear_;
  double sinkage_m_[2] = {};
  double compacted_m3_ = 0.0;
  std::int64_t tick_ = 0;

  std::vector<bool> is_sheared_;  // faces with any patch in shear_
  std::vector<PatchTick> patch_;
  std::vector<FaceTick> face_tick_;
  std::vector<Pressed> pressed_;
  std::vector<PosedFace> posed_;
};

}  // namespace hoap2_sim
#endif
