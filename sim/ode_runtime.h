// Process-wide care of ODE: one initialisation, per-thread data, error handlers.
#ifndef HOAP2_SIM_ODE_RUNTIME_H
#define HOAP2_SIM_ODE_RUNTIME_H

#include <stdexcept>
#include <string>

namespace hoap2_sim {

// Thrown out of ODE when one of its checks fails (it would abort the process
// otherwise). The world it came from must not be used again.
struct OdeFailure : std::runtime_error {
  explicit OdeFailure(const std::string &text) : std::runtime_error(text) {}
};

// To be called on each thread before it calls ODE. Cheap after the first call.
// ODE is never closed: other instances of the process may still use it.
void use_ode_on_this_thread();

}  // namespace hoap2_sim
#endif
