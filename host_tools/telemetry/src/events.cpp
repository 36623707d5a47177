// What the rows show: steps, faults, modes, pushes.
#include <cstdio>

#include "publisher.hpp"

namespace hoap2::telemetry {
namespace {

constexpr const char *kStance[] = {"right", "left", "both"};

std::string named(const char *const *names, std::size_t count, std::int32_t index) {
  const auto i = static_cast<std::size_t>(index);
  return index >= 0 && i < count ? names[i] : std::to_string(index);
}

template <std::size_t N>
std::string named(const char *const (&names)[N], std::int32_t index) {
  return named(names, N, index);
}

std::string faults_in(std::int32_t word) {
  std::string text;
  for (const fault_name_t &fault : FAULT_NAMES) {
    if ((word & fault.bit) != 0) text += (text.empty() ? "" : ", ") + std::string(fault.name);
  }
  return text;
}

}  // namespace

void Publisher::event(std::int64_t tick, const char *kind, const std::string &text) {
  hoap2_lcm::event_t message{};
  message.kind = kind;
  message.text = text;
  put(event_channel_, message, tick, live_.open());
}

void Publisher::events(std::int64_t tick, const double *real) {
  if (gait_.mode != mode_) event(tick, "note", "mode " + named(MODE_NAMES, mode_ = gait_.mode));
  if (gait_.step_index != step_) {
    step_ = gait_.step_index;
    if (step_ > 0)
      event(tick, "step", "step " + std::to_string(step_) + ", stance " + named(kStance, gait_.stance_foot));
  }
  if (gait_.fault != fault_) {
    const std::int32_t added = gait_.fault & ~fault_;
    event(tick, "fault", added != 0 ? faults_in(added) : "cleared: " + faults_in(fault_ & ~gait_.fault));
    fault_ = gait_.fault;
  }
  if (config_.push_column >= 0) {
    const double *force = real + config_.push_column;
    const bool pushed = force[0] != 0.0 || force[1] != 0.0 || force[2] != 0.0;
    if (pushed != pushed_) event(tick, "push", pushed ? "push begins" : "push ends");
    pushed_ = pushed;
  }
}

}  // namespace hoap2::telemetry
