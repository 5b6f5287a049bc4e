#pragma once

#include <signal.h>  // NOLINT(modernize-deprecated-headers): stack_t

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hal::runtime {

/// A stack for the handlers of its thread's signals, so that one that overflows can be told of. To
/// be destroyed on the thread that made it. Of several on a thread, only the first that is made
/// counts: they need not end in turn.
class SignalStack {
 public:
  SignalStack();
  ~SignalStack();
  SignalStack(const SignalStack&) = delete;
  SignalStack& operator=(const SignalStack&) = delete;

 private:
  std::vector<char> bytes_;  ///< Empty: the thread had one.
  stack_t before_{};
};

/// While this lives, a signal that ends the process, and an exception that nobody catches, tell on
/// standard error whose call they came out of:
///   error: controller of r0: SIGSEGV (Segmentation fault) at address 0x0 in step() at 2.000000000
///   s
/// The process then ends by that signal as it would have, with a core dump where there are any.
/// Signals that somebody else handles or ignores stay theirs, and so do those of a child that was
/// forked off. SIGPIPE is told only if it comes out of a call: else it is a reader's that left.
///
/// A stack that overflows is told of on the thread that made this, and on those with a SignalStack.
/// Not seen are SIGKILL, and what corrupts memory so that the handler itself fails. One at a time.
class FaultWatch {
 public:
  /// @param prefix  of the message: "error", the name of a process.
  /// @param held    a fault during a call holds its thread for up to 5 s, until end(): time to
  ///                write results on another thread. The call is seized (hal/exchange).
  explicit FaultWatch(std::string_view prefix, bool held = false);
  ~FaultWatch();
  FaultWatch(const FaultWatch&) = delete;
  FaultWatch& operator=(const FaultWatch&) = delete;

  /// The fault that holds its thread, for people; none so far. Any thread.
  static std::optional<std::string> held_fault();

  /// Results are written: the process ends by the signal of the fault that was held. Any thread.
  [[noreturn]] static void end();

 private:
  struct Handlers;
  SignalStack stack_;
  std::unique_ptr<Handlers> handlers_;
};

}  // namespace hal::runtime
