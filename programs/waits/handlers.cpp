#include "programs/waits/handlers.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace programs::waits {
namespace {

struct Handler {
  std::atomic<SignalHandler> function = nullptr;
  std::atomic<bool> restarts = false;
};

constexpr std::size_t kSignals = 65;
std::array<Handler, kSignals> all;
__attribute__((tls_model("initial-exec"))) thread_local unsigned run = 0, interrupted = 0;

bool is_signal(int signal) { return signal > 0 && static_cast<std::size_t>(signal) < kSignals; }

Handler& of(int signal) { return all[static_cast<std::size_t>(signal)]; }

void run_handler(int signal, siginfo_t* info, void* context) {
  const Handler& handler = of(signal);
  ++run;
  if (!handler.restarts.load()) ++interrupted;
  handler.function.load()(signal, info, context);
}

/// SIG_DFL and SIG_IGN, 0 and 1, are none.
bool is_function(SignalHandler handler) { return reinterpret_cast<std::uintptr_t>(handler) > 1; }

}  // namespace

SignalHandler put_handler(int signal, SignalHandler handler, unsigned long flags) {
  if (!is_signal(signal) || !is_function(handler)) return handler;
  of(signal).function = handler;
  of(signal).restarts = (flags & SA_RESTART) != 0;
  return run_handler;
}

SignalHandler given_handler(int signal, SignalHandler handler) {
  return handler == run_handler ? of(signal).function.load() : handler;
}

unsigned handlers_run() { return run; }

unsigned interruptions() { return interrupted; }

}  // namespace programs::waits
