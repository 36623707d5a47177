// The soil's mutable block: saved and restored.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "soil/soil.h"

namespace hoap2_sim {
namespace {

constexpr std::uint64_t kSoilMagic = 0x314c494f5350414fULL;
constexpr double kForceLimit_N = 1e9;
constexpr double kLeastRut_m = 1e-9;  // rounding
constexpr double kHighest_m = 20.0;
constexpr std::int64_t kMostTicks = std::int64_t{1} << 53;
constexpr double kMostVolume_m3 = 1e4, kTinyVolume_m3 = 1e-9;

struct SoilHead {
  std::uint64_t magic;
  std::uint64_t size;
  std::int64_t tick;
  double sinkage_m[2];
  double compacted_m3;
};

struct SavedCell {
  double level_m, memory_m, rut_m;
};

template <class T>
void put(const T &value, unsigned char **to) {
  std::memcpy(*to, &value, sizeof value);
  *to += sizeof value;
}

template <class T>
T take(const unsigned char **from) {
  T value;
  std::memcpy(&value, *from, sizeof value);
  *from += sizeof value;
  return value;
}

// Written so that NaN fails.
bool is_within(double value, double low, double high) { return value >= low && value <= high; }

}  // namespace

std::size_t Soil::state_bytes() const {
  return sizeof(SoilHead) + field_.size() * sizeof(SavedCell) + shear_.size() * sizeof(PatchShear) +
         faces_.size() * sizeof(Flow::Memory);
}

void Soil::save(void *to) const {
  auto *bytes = static_cast<unsigned char *>(to);
  put(SoilHead{kSoilMagic, state_bytes(), tick_, {sinkage_m_[0], sinkage_m_[1]}, compacted_m3_}, &bytes);
  for (std::size_t i = 0; i < field_.size(); ++i) {
    const Cell &cell = field_.cell(i);
    put(SavedCell{cell.level_m, cell.memory_m, cell.rut_m}, &bytes);
  }
  for (const PatchShear &shear : shear_) put(shear, &bytes);
  for (const Flow::Memory &memory : flow_.memory()) put(memory, &bytes);
}

// Nothing of the block is believed before all of it was looked at: it may come from a file.
std::string Soil::fault_of_block(const void *from) const {
  const auto *bytes = static_cast<const unsigned char *>(from);
  const auto head = take<SoilHead>(&bytes);
  if (head.magic != kSoilMagic || head.size != state_bytes())
    return "the block is not the state of this soil";
  bool is_good = head.tick >= 0 && head.tick <= kMostTicks &&
                 is_within(head.compacted_m3, -kMostVolume_m3, kMostVolume_m3);
  const double deepest_m = field_.depth_m() + kHighest_m;
  for (const double sinkage_m : head.sinkage_m) is_good &= is_within(sinkage_m, -kHighest_m, deepest_m);
  for (std::size_t i = 0; i < field_.size(); ++i) {
    const auto cell = take<SavedCell>(&bytes);
    is_good &= is_within(cell.level_m, -field_.depth_m(), kHighest_m) &&
               is_within(cell.memory_m, 0.0, deepest_m) && is_within(cell.rut_m, -kLeastRut_m, cell.memory_m);
  }
  for (std::size_t i = 0; i < shear_.size(); ++i) {
    const auto shear = take<PatchShear>(&bytes);
    is_good &= is_within(shear.peak_N, 0.0, kForceLimit_N) &&
               is_within(shear.force_a_N, -kForceLimit_N, kForceLimit_N) &&
               is_within(shear.force_b_N, -kForceLimit_N, kForceLimit_N);
  }
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const auto memory = take<Flow::Memory>(&bytes);
    const Window &moving = memory.moving;
    is_good &= is_within(memory.pending_m3, -kTinyVolume_m3, kMostVolume_m3);
    const bool is_none = moving.x0 == 0 && moving.y0 == 0 && moving.x1 == -1 && moving.y1 == -1;
    is_good &= is_none || (!moving.empty() && moving.x0 >= 0 && moving.y0 >= 0 && moving.x1 < field_.nx() &&
                           moving.y1 < field_.ny());
  }
  return is_good ? "" : "the state of the soil is damaged: it holds values that cannot be";
}

std::string Soil::restore(const void *from) {
  const std::string fault = fault_of_block(from);
  if (!fault.empty()) return fault;
  const auto *bytes = static_cast<const unsigned char *>(from);
  const auto head = take<SoilHead>(&bytes);
  tick_ = head.tick;
  compacted_m3_ = head.compacted_m3;
  std::copy(head.sinkage_m, head.sinkage_m + 2, sinkage_m_);
  for (std::size_t i = 0; i < field_.size(); ++i) {
    const auto cell = take<SavedCell>(&bytes);
    field_.cell(i) = {cell.level_m, cell.memory_m, cell.rut_m,
                      contact_.pressure().stiffness_Pa_m(cell.memory_m)};
  }
  for (PatchShear &shear : shear_) shear = take<PatchShear>(&bytes);
  for (Flow::Memory &memory : flow_.memory()) memory = take<Flow::Memory>(&bytes);
  touched_.clear();
  pressed_.clear();
  field_.find_top();
  find_sheared();
  return "";
}

void Soil::find_sheared() {
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const auto first = shear_.begin() + faces_[i].first_patch;
    const auto is_held = [](const PatchShear &shear) { return shear.peak_N > 0.0; };
    is_sheared_[i] = std::any_of(first, first + faces_[i].patches(), is_held);
  }
}

}  // namespace hoap2_sim
