#include "hal/runtime/exit_watch.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <utility>

namespace hal::runtime {
namespace {

std::atomic<const ExitWatch::Handler*> current{nullptr};

void on_exit_called(int status, void* context) {
  (void)context;
  const auto* const handler = current.exchange(nullptr);
  if (handler == nullptr) return;
  ::_exit((*handler)({.status = status, .within = exchange::seize_call()}));
}

}  // namespace

std::string ExitCall::what() const {
  return fmt::format("called exit({}) {}", status,
                     within ? "in " + within->what : "outside any callback");
}

std::string ExitCall::text() const {
  if (!within) return "a controller " + what();
  return fmt::format("{} {} at {:.9f} s", within->who, what(), to_seconds(within->at));
}

ExitWatch::ExitWatch(Handler handler) : handler_(std::move(handler)) {
  // Handlers run in the opposite order of their registration: this one before the destructors of
  // everything that has been made by now.
  ::on_exit(on_exit_called, nullptr);
  current = &handler_;
}

ExitWatch::~ExitWatch() { current = nullptr; }

}  // namespace hal::runtime
