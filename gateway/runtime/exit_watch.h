#pragma once

#include <functional>
#include <optional>
#include <string>

#include "hal/node/exchange/foreign_call.h"

namespace gateway::runtime {

/// A call of exit(), or of one of those that end a process at once, by a controller.
struct ExitCall {
  const char* function = "exit";  ///< "_exit", "_Exit", "quick_exit"
  int status = 0;
  /// The callback; none: on a thread of its own.
  std::optional<hal::node::exchange::SeizedCall> within;

  std::string what() const;  ///< "called exit(0) in step()".
  std::string text() const;  ///< "controller of r0 called exit(0) in step() at 2.000000000 s".
};

/// While this object exists, exit(), _exit(), _Exit() and quick_exit() are treated as mistakes of a
/// controller, in a callback or on a thread of its own, plug-ins included. exit() would run the
/// destructors of a program whose threads are active, and end it with success. Instead the handler
/// is called, on the thread of exit(), and the process ends at once with the status it returns. One
/// at a time. Forked children are not watched. abort(), which ends the process with a signal, and
/// direct system calls are not detected.
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

/// Ends the process at once, as _exit() does, without the watch. Async-signal-safe.
[[noreturn]] void leave(int status) noexcept;

}  // namespace gateway::runtime
