// What happens to displaced soil: a rim around what pressed it out, and slopes that slide
// down to the angle of repose (docs/soil.md, "Flow"). Keeps the volume.
#ifndef HOAP2_SIM_SOIL_FLOW_H
#define HOAP2_SIM_SOIL_FLOW_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "soil/face.h"
#include "soil/height_field.h"
#include "soil/pressure_law.h"

namespace hoap2_sim {

// A face and where it is now.
struct PosedFace {
  const Face *face;
  std::size_t number;
  FacePose pose;
  bool is_near;
};

class Flow {
 public:
  static constexpr int kTicks = 10;  // between two runs

  // What it remembers, for each face: volume that found no place yet, and the cells
  // around it that may still move.
  struct Memory {
    double pending_m3 = 0.0;
    Window moving;
  };

  void build(const hoap2_plant_params_t &params, const HeightField &field, std::size_t faces);
  void start();
  double pending_m3() const;
  bool is_idle() const;
  std::vector<Memory> &memory() { return memory_; }
  const std::vector<Memory> &memory() const { return memory_; }

  void displace(std::size_t face, double volume_m3) { memory_[face].pending_m3 += volume_m3; }
  // Cells of this window, and their neighbours, may be too steep now.
  void wake(std::size_t face, const Window &window);

  // Rims, then one sweep over all that moves. `faces`: those that are near the ground or
  // have volume pending. `is_odd` alternates the sense of the sweep.
  void run(const std::vector<PosedFace> &faces, bool is_odd, const PressureLaw &law, HeightField *field);

 private:
  void mark_under(const PosedFace &posed, const HeightField &field);
  void raise_rim(const PosedFace &posed, const PressureLaw &law, HeightField *field);
  void sweep(Window *window, bool is_odd, const PressureLaw &law, HeightField *field);
  bool level_pair(int ix, int iy, int jx, int jy, double limit_m, const PressureLaw &law, HeightField *field);
  Window within(const Window &window) const;

  double tan_repose_ = 0.0, ring_m_ = 0.0;
  int nx_ = 0, ny_ = 0;
  std::vector<Memory> memory_;
  // Of one run only: cells that a face holds, and the unloaded surface.
  std::vector<std::uint32_t> held_;
  std::uint32_t run_ = 0;
  std::vector<double> surface_m_;
};

}  // namespace hoap2_sim
#endif
