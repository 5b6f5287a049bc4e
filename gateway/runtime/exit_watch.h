#pragma once

#include <functional>
#include <optional>
#include <string>

#include "hal/node/exchange/foreign_call.h"

namespace gateway::runtime {

/// A call of exit(), or of a function that ends a process at once, by a controller.
struct ExitCall {
  const char* function = "exit";  ///< "_exit", "_Exit", "quick_exit"
  int status = 0;
  /// The callback in which it was called; none: it was called on a thread of the controller's own.
  std::optional<hal::node::exchange::SeizedCall> within;

  std::string what() const;  ///< "called exit(0) in step()".
  std::string text() const;  ///< "controller of r0 called exit(0) in step() at 2.000000000 s".
};

/// While this object exists, calls of exit(), _exit(), _Exit() and quick_exit() are treated as
/// mistakes of a controller, in a callback or on a thread of its own, also in plug-ins. (exit()
/// would run the destructors of a program whose threads are active, and end it with success.) The
/// handler is called on the calling thread, and the process ends at once with the status that the
/// handler returns. One object at a time. Forked children are not watched. Not detected are
/// abort(), which ends the process with a signal, and direct system calls.
class ExitWatch {
 public:
  using Handler = std::function<int(const ExitCall&)>;

  explicit ExitWatch(Handler handler);
  ~ExitWatch();
  ExitWatch(const ExitWatch&) = delete;
  ExitWatch& operator=(const ExitWatch&) = delete;

 private:
  Handler handler_;
};

/// Ends the process at once, as _exit() does, bypassing the watch. Async-signal-safe.
[[noreturn]] void leave(int status) noexcept;

}  // namespace gateway::runtime
