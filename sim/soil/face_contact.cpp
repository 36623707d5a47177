#include "soil/face_contact.h"

#include <algorithm>
#include <cmath>

#include "plant_state.h"

namespace hoap2_sim {

void FaceContact::build(const hoap2_plant_params_t &params) {
  pressure_.build(params);
  shear_law_.build(params.soil_shear_m, kTick_s);
  const bool is_rft = pressure_.depends_on_direction();  // knows neither cohesion nor edges
  cohesion_Pa_ = is_rft ? 0.0 : params.soil_cohesion_Pa;
  tan_friction_ = std::tan(params.soil_friction_rad);
  edge_loss_ = params.soil_edge_loss;
  edge_m_ = is_rft ? 0.0 : params.soil_edge_m;
  per_edge_m_ = edge_m_ > 0.0 ? 1.0 / edge_m_ : 0.0;
}

namespace {

// Share of the pressure that a sole finds near its edge, where the ground gives way sideways.
struct Edge {
  double half_a_m, half_b_m, wide_m, per_m, loss;

  double bearing(double u_m, double v_m) const {
    const double inside_m = std::min(half_a_m - std::fabs(u_m), half_b_m - std::fabs(v_m));
    return inside_m < wide_m ? 1.0 - loss * (1.0 - inside_m * per_m) : 1.0;
  }
};

}  // namespace

void FaceContact::press(const HeightField &field, const Face &face, const FacePose &pose,
                        const FaceTwist &twist, const CellsUnder &cells, PatchTick *patch,
                        std::vector<PressedCell> *pressed, FaceLoad *load) const {
  for (int i = 0; i < face.patches(); ++i) {
    patch[i] = PatchTick{};
    if (!pressure_.depends_on_direction()) continue;
    const double u_m = face.patch_u_m(i), v_m = face.patch_v_m(i);
    const Vec3 vel_m_s = twist.along_a_m_s(v_m) * pose.a + twist.along_b_m_s(u_m) * pose.b +
                         twist.normal_m_s(u_m, v_m) * pose.m;
    patch[i].share = rft_share(pose.m, vel_m_s);
  }
  // All that the cells need by value: the stores into the patches could otherwise be
  // to any of it, and the compiler would read it again for every cell.
  const double per_m = 1.0 / pose.m.z;
  const double cell_m2 = field.cell_m() * field.cell_m() * per_m * slope_share(pose);
  const double height_m = pose.centre_m.z, height_u = pose.a.z, height_v = pose.b.z;
  const double down_m_s = -per_m * twist.vel_m_s.z;
  const double down_u = per_m * twist.omega_rad_s.y, down_v = -per_m * twist.omega_rad_s.x;
  const Cell *const ground = field.cells();
  const PressureLaw *const law = &pressure_;
  const PatchGrid patches = face.patch_grid();
  // Answer of one cell with its area on the face: give(normal force, slope).
  const auto press_cell = [=](std::size_t index, double u_m, double v_m, double area_m2, double bearing_m2,
                              auto &&give) {
    const Cell *cell = &ground[index];
    PatchTick &under = patch[patches.at(u_m, v_m)];
    under.cells_m2 += area_m2;
    const double depth_m = cell->level_m - (height_m + u_m * height_u + v_m * height_v);
    const double down_here_m_s = down_m_s + u_m * down_u + v_m * down_v;
    if (depth_m > 0.0 && law->yields(*cell, depth_m, under.share.normal)) {
      pressed->push_back({index, law->pressed(*cell, depth_m, under.share.normal)});
      cell = &pressed->back().cell;
    }
    const Response answer = law->respond(*cell, depth_m, down_here_m_s, under.share.normal);
    if (answer.resistance_Pas_m <= 0.0 && answer.pressure_Pa <= 0.0) return;
    const double force_N = bearing_m2 * answer.pressure_Pa;
    give(force_N, bearing_m2 * per_m * answer.resistance_Pas_m);
    if (force_N <= 0.0) return;
    under.cells_N += force_N;
    under.loaded_m2 += area_m2;
  };
  const Edge edge = {face.half_a_m, face.half_b_m, face.foot < 0 ? 0.0 : edge_m_, per_edge_m_, edge_loss_};
  FaceLoad sum;
  cells.each(
      [&, edge](const CellPart &part) {
        const double area_m2 = cell_m2 * part.cells;
        press_cell(
            part.index, part.u_m, part.v_m, area_m2, area_m2 * edge.bearing(part.u_m, part.v_m),
            [&](double force_N, double slope_Ns_m) { sum.press(part.u_m, part.v_m, force_N, slope_Ns_m); });
      },
      [&, edge](const CellRun &run) {
        FaceLoad::Row row;
        for (int k = 0; k < run.count; ++k) {
          const double u_m = run.u_m + k * run.u_step_m, v_m = run.v_m + k * run.v_step_m;
          press_cell(run.index + static_cast<std::size_t>(k), u_m, v_m, cell_m2,
                     cell_m2 * edge.bearing(u_m, v_m),
                     [&](double force_N, double slope_Ns_m) { row.press(k, force_N, slope_Ns_m); });
        }
        sum.press(run.u_m, run.v_m, run.u_step_m, run.v_step_m, row);
      });
  *load = sum;
}

// Cells belong to the patch that their middle is in, so how many it has flickers while a
// sole slides. Their mean pressure on the patch's own area does not; the sum over the
// face is then brought back to its normal force.
double FaceContact::patch_scale(const Face &face, const PatchTick *patch, double patch_m2) const {
  double cells_N = 0.0, patches_N = 0.0;
  for (int i = 0; i < face.patches(); ++i) {
    if (patch[i].cells_N <= 0.0) continue;
    cells_N += patch[i].cells_N;
    patches_N += patch_m2 * patch[i].cells_N / patch[i].cells_m2;
  }
  return patches_N > 0.0 ? cells_N / patches_N : 0.0;
}

void FaceContact::shear(const Face &face, const FacePose &pose, const FaceTwist &twist,
                        const PatchShear *memory, PatchTick *patch, FaceLoad *load) const {
  const bool is_rft = pressure_.depends_on_direction();
  const double patch_m2 = slope_share(pose) * face.patch_m2();
  const double scaled_m2 = patch_m2 * patch_scale(face, patch, patch_m2);
  const double wide_a_m = 1.0 / face.per_patch_a_m, wide_b_m = 1.0 / face.per_patch_b_m;
  FaceLoad sum = *load;
  for (int i = 0, k = 0; i < face.patches_a; ++i) {
    const double u_m = (i + 0.5) * wide_a_m - face.half_a_m, along_b_m_s = twist.along_b_m_s(u_m);
    for (int j = 0; j < face.patches_b; ++j, ++k) {
      PatchTick &under = patch[k];
      if (under.cells_N <= 0.0) continue;
      const double bears_N = is_rft ? under.share.shear_ratio * under.cells_N
                                    : cohesion_Pa_ * under.loaded_m2 + tan_friction_ * under.cells_N;
      const double limit_N = scaled_m2 * bears_N / under.cells_m2;
      const double v_m = (j + 0.5) * wide_b_m - face.half_b_m;
      under.shear = memory[k];
      sum.shear(
          u_m, v_m,
          shear_law_.step(&under.shear, limit_N, twist.along_a_m_s(v_m), along_b_m_s, twist.omega_rad_s.z));
    }
  }
  *load = sum;
}

}  // namespace hoap2_sim
