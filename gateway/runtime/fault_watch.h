#pragma once

#include <signal.h>  // NOLINT(modernize-deprecated-headers): stack_t

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gateway::runtime {

/// An alternate stack for signal handlers of its thread, so that a stack overflow can be reported.
/// Destroy it on the thread that made it. If a thread has several, only the first one is used;
/// their lifetimes need not be nested.
class SignalStack {
 public:
  SignalStack();
  ~SignalStack();
  SignalStack(const SignalStack&) = delete;
  SignalStack& operator=(const SignalStack&) = delete;

 private:
  std::vector<char> bytes_;  ///< Empty: the thread had one already.
  stack_t before_{};
};

/// While this object exists, a signal that ends the process, and an uncaught exception, are
/// reported on standard error with the call in which they occurred:
///   error: controller of r0: SIGSEGV (Segmentation fault) at address 0x0 in step() at 2.000000000
///   s
/// The process then ends by that signal as usual, with a core dump where enabled. Signals that have
/// another handler or are ignored are not affected, nor are those of forked children. SIGPIPE is
/// reported only if it occurs in a call: otherwise a reader has closed its end.
///
/// Stack overflows are reported on the thread that made this, and on those with a SignalStack.
/// SIGKILL, and memory corruption by which the handler itself fails, are not detected. One at a
/// time.
class FaultWatch {
 public:
  /// @param prefix  of the message: "error", or the name of a process.
  /// @param held  a fault during a call holds its thread until end(), for up to 5 s, so that
  /// another thread can write results. The call is seized (hal/node/exchange).
  explicit FaultWatch(std::string_view prefix, bool held = false);
  ~FaultWatch();
  FaultWatch(const FaultWatch&) = delete;
  FaultWatch& operator=(const FaultWatch&) = delete;

  /// Text of the fault that holds its thread; none: there was no fault. Any thread.
  static std::optional<std::string> held_fault();

  /// Call when the results are written: the process ends by the signal of the held fault. Any
  /// thread.
  [[noreturn]] static void end();

 private:
  struct Handlers;
  SignalStack stack_;
  std::unique_ptr<Handlers> handlers_;
};

}  // namespace gateway::runtime
