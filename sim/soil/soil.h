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
#include "soil/face_contact.h"
#include "soil/flow.h"
#include "soil/height_field.h"
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
  struct LinkFaces {
    int link;
    std::size_t first, end;
  };
  // Within one tick.
  struct TouchedFace {
    std::size_t face;
    bool presses;
    std::size_t first_pressed, end_pressed;
    Window under;
  };

  FacePose pose_of(const State &state, const Mat3 axes_W[HOAP2_LINKS], const Face &face,
                   FaceTwist *twist) const;
  bool is_near(const Face &face, const FacePose &pose, const FaceTwist &twist) const;
  bool is_link_near(const State &state, int link) const;
  bool is_inside(const Face &face, const FacePose &pose) const;
  std::string fault_of_sole(const Face &face, const FacePose &pose) const;
  std::string load_face(std::size_t i, const State &state, const Mat3 axes_W[HOAP2_LINKS], SoilLoad *load);
  void keep(const TouchedFace &touched);
  void leave(std::size_t i, const State &next, const Mat3 next_axes_W[HOAP2_LINKS]);
  void run_flow(const State &next, const Mat3 next_axes_W[HOAP2_LINKS]);
  void find_sheared();
  std::string fault_of_block(const void *from) const;

  hoap2_plant_params_t params_ = {};
  PoolFrame pool_;
  FaceContact contact_;
  double radius_m_[HOAP2_LINKS] = {};  // of the link's box about its CoM
  std::vector<Face> faces_;
  std::vector<LinkFaces> link_faces_;

  // The mutable block.
  HeightField field_;
  Flow flow_;
  std::vector<PatchShear> shear_;
  double sinkage_m_[2] = {};
  double compacted_m3_ = 0.0;
  std::int64_t tick_ = 0;

  std::vector<char> is_sheared_, presses_;  // faces that hold any patch in shear_
  std::vector<PatchTick> patch_;
  std::vector<TouchedFace> touched_;
  std::vector<PressedCell> pressed_;
  std::vector<PosedFace> posed_;
};

}  // namespace hoap2_sim
#endif
