// The load on one face at the start of a tick: pressure of its cells, shear of its patches.
#ifndef HOAP2_SIM_SOIL_FACE_CONTACT_H
#define HOAP2_SIM_SOIL_FACE_CONTACT_H

#include <cstddef>
#include <vector>

#include "hoap2_plant/plant.h"
#include "soil/face.h"
#include "soil/face_load.h"
#include "soil/height_field.h"
#include "soil/pressure_law.h"
#include "soil/rft.h"
#include "soil/shear.h"

namespace hoap2_sim {

// A patch within one tick.
struct PatchTick {
  double cells_m2 = 0.0, loaded_m2 = 0.0;  // of the cells with their middle in it
  double cells_N = 0.0;                    // their normal force
  RftShare share;
  PatchShear shear;
};

// A column that gave way: what it becomes when the tick is kept.
struct PressedCell {
  std::size_t index;
  Cell cell;
};

class FaceContact {
 public:
  void build(const hoap2_plant_params_t &params);
  const PressureLaw &pressure() const { return pressure_; }

  // Sums the pressure under the face; fills its patches and appends the cells that gave way.
  void press(const HeightField &field, const Face &face, const FacePose &pose, const FaceTwist &twist,
             const CellsUnder &cells, PatchTick *patch, std::vector<PressedCell> *pressed,
             FaceLoad *load) const;
  // Adds the shear of its patches; `memory` of them before this tick.
  void shear(const Face &face, const FacePose &pose, const FaceTwist &twist, const PatchShear *memory,
             PatchTick *patch, FaceLoad *load) const;

 private:
  double patch_scale(const Face &face, const PatchTick *patch, double patch_m2) const;

  PressureLaw pressure_;
  ShearLaw shear_law_;
  double cohesion_Pa_ = 0.0, tan_friction_ = 0.0;
  double edge_loss_ = 0.0, edge_m_ = 0.0, per_edge_m_ = 0.0;
};

}  // namespace hoap2_sim
#endif
