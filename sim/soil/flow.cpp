#include "soil/flow.h"

#include <algorithm>
#include <cmath>

namespace hoap2_sim {
namespace {

constexpr double kRing_m = 0.0125;  // width of the rim
constexpr double kLeastRing_cells = 1.5;
// Sand stays where it is under a face that is closer than this.
constexpr double kClearance_m = 0.003;
// Excess of height that no longer slides.
constexpr double kRest_m = 1e-6;

}  // namespace

void Flow::build(const hoap2_plant_params_t &params, const HeightField &field, std::size_t faces) {
  tan_repose_ = std::tan(params.soil_repose_rad);
  ring_m_ = std::max(kRing_m, kLeastRing_cells * field.cell_m());
  nx_ = field.nx();
  ny_ = field.ny();
  memory_.assign(faces, Memory{});
  held_.assign(field.size(), 0);
  surface_m_.assign(field.size(), 0.0);
  run_ = 0;
}

void Flow::start() { std::fill(memory_.begin(), memory_.end(), Memory{}); }

double Flow::pending_m3() const {
  double sum_m3 = 0.0;
  for (const Memory &memory : memory_) sum_m3 += memory.pending_m3;
  return sum_m3;
}

bool Flow::is_idle() const {
  for (const Memory &memory : memory_) {
    if (memory.pending_m3 > 0.0 || !memory.moving.empty()) return false;
  }
  return true;
}

Window Flow::within(const Window &window) const {
  return {std::max(window.x0, 0), std::max(window.y0, 0), std::min(window.x1, nx_ - 1),
          std::min(window.y1, ny_ - 1)};
}

void Flow::wake(std::size_t face, const Window &window) {
  if (window.empty()) return;
  memory_[face].moving.cover(window.x0 - 1, window.y0 - 1, window.x1 + 1, window.y1 + 1);
  memory_[face].moving = within(memory_[face].moving);
}

void Flow::mark_under(const PosedFace &posed, const HeightField &field) {
  CellsUnder(field, *posed.face, posed.pose).each([&](const CellPart &part) {
    const double gap_m = posed.pose.height_m(part.u_m, part.v_m) - field.cell(part.index).surface_m();
    if (gap_m < kClearance_m) held_[part.index] = run_;
  });
}

void Flow::raise_rim(const PosedFace &posed, const PressureLaw &law, HeightField *field) {
  const std::size_t i = posed.number;
  if (memory_[i].pending_m3 <= 0.0 || posed.pose.m.z <= kSteepest) return;
  const CellsUnder ring(*field, *posed.face, posed.pose, ring_m_);
  const double half_a_m = posed.face->half_a_m, half_b_m = posed.face->half_b_m;
  const auto is_rim = [&](const CellPart &part) {
    const bool is_outside = std::fabs(part.u_m) > half_a_m || std::fabs(part.v_m) > half_b_m;
    return is_outside && held_[part.index] != run_;
  };
  int count = 0;
  ring.each([&](const CellPart &part) { count += is_rim(part) ? 1 : 0; });
  if (count == 0) return;  // stays pending
  const double height_m = memory_[i].pending_m3 / (count * field->cell_m() * field->cell_m());
  ring.each([&](const CellPart &part) {
    if (!is_rim(part)) return;
    law.lay(&field->cell(part.index), height_m);
    field->raise_top(field->cell(part.index).level_m);
  });
  memory_[i].pending_m3 = 0.0;
  wake(i, ring.window());
}

bool Flow::level_pair(int ix, int iy, int jx, int jy, double limit_m, const PressureLaw &law,
                      HeightField *field) {
  if (jx < 0 || jx >= nx_ || jy >= ny_) return false;
  std::size_t high = field->index(ix, iy), low = field->index(jx, jy);
  if (held_[low] == run_) return false;
  if (surface_m_[high] < surface_m_[low]) std::swap(high, low);
  const double excess_m = surface_m_[high] - surface_m_[low] - limit_m;
  if (excess_m <= kRest_m) return false;
  law.lay(&field->cell(high), -0.5 * excess_m);
  law.lay(&field->cell(low), 0.5 * excess_m);
  surface_m_[high] = field->cell(high).surface_m();
  surface_m_[low] = field->cell(low).surface_m();
  field->raise_top(field->cell(low).level_m);
  return true;
}

void Flow::sweep(Window *window, bool is_odd, const PressureLaw &law, HeightField *field) {
  const Window old = *window, around = within({old.x0 - 1, old.y0 - 1, old.x1 + 1, old.y1 + 1});
  for (int iy = around.y0; iy <= around.y1; ++iy) {
    for (int ix = around.x0; ix <= around.x1; ++ix) {
      const std::size_t k = field->index(ix, iy);
      surface_m_[k] = field->cell(k).surface_m();
    }
  }
  const double straight_m = tan_repose_ * field->cell_m(), diagonal_m = std::sqrt(2.0) * straight_m;
  *window = Window{};
  for (int j = 0; j <= old.y1 - old.y0; ++j) {
    const int iy = is_odd ? old.y1 - j : old.y0 + j;
    for (int i = 0; i <= old.x1 - old.x0; ++i) {
      const int ix = is_odd ? old.x1 - i : old.x0 + i;
      if (held_[field->index(ix, iy)] == run_) continue;
      bool moved = level_pair(ix, iy, ix + 1, iy, straight_m, law, field);
      moved |= level_pair(ix, iy, ix, iy + 1, straight_m, law, field);
      moved |= level_pair(ix, iy, ix + 1, iy + 1, diagonal_m, law, field);
      moved |= level_pair(ix, iy, ix - 1, iy + 1, diagonal_m, law, field);
      if (moved) window->cover(ix - 2, iy - 1, ix + 2, iy + 2);
    }
  }
  if (!window->empty()) *window = within(*window);
}

void Flow::run(const std::vector<PosedFace> &faces, bool is_odd, const PressureLaw &law, HeightField *field) {
  if (++run_ == 0) {  // the numbers start again
    std::fill(held_.begin(), held_.end(), 0U);
    run_ = 1;
  }
  for (const PosedFace &posed : faces) {
    if (posed.is_near) mark_under(posed, *field);
  }
  for (const PosedFace &posed : faces) raise_rim(posed, law, field);
  for (Memory &memory : memory_) {
    if (!memory.moving.empty()) sweep(&memory.moving, is_odd, law, field);
  }
}

}  // namespace hoap2_sim
