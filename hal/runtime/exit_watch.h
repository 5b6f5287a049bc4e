#pragma once

#include <functional>
#include <optional>
#include <string>

#include "hal/exchange/foreign_call.h"

namespace hal::runtime {

/// A call of exit() by a controller.
struct ExitCall {
  int status = 0;
  std::optional<exchange::SeizedCall> within;  ///< The callback; none: on a thread of its own.

  std::string what() const;  ///< "called exit(0) in step()".
  std::string text() const;  ///< "controller of r0 called exit(0) in step() at 2.000000000 s".
};

/// While this lives, exit() is a mistake: of a controller, in a callback or on a thread of its own.
/// It would run the destructors of a program whose threads are at work, and end it as if all were
/// well. Instead the handler is called, on the thread of exit(), and the process ends at once with
/// the status it returns. One at a time. _exit() and abort() are not seen.
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

}  // namespace hal::runtime
