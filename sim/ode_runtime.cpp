#include "ode_runtime.h"

#include <ode/ode.h>

#include <cstdarg>
#include <cstdio>
#include <mutex>

namespace hoap2_sim {
namespace {

[[noreturn]] void raise(const char *kind, int number, const char *format, va_list arguments) {
  char text[256], whole[320];
  std::vsnprintf(text, sizeof text, format, arguments);
  std::snprintf(whole, sizeof whole, "ODE %s %d: %s", kind, number, text);
  throw OdeFailure(whole);
}

void on_error(int number, const char *format, va_list arguments) {
  raise("error", number, format, arguments);
}

void on_debug(int number, const char *format, va_list arguments) {
  raise("check", number, format, arguments);
}

// Remarks of the contact solver. The state is checked after each tick; nothing to print.
void on_message(int, const char *, va_list) {}

}  // namespace

void use_ode_on_this_thread() {
  static std::once_flag once;
  std::call_once(once, [] {
    dInitODE2(0);
    dSetErrorHandler(&on_error);
    dSetDebugHandler(&on_debug);
    dSetMessageHandler(&on_message);
  });
  thread_local bool ready = false;
  if (!ready) {
    dAllocateODEDataForThread(dAllocateMaskAll);
    ready = true;
  }
}

}  // namespace hoap2_sim
