#include "gateway/runtime/exit_watch.h"

#include <fmt/format.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <utility>

namespace gateway::runtime {
namespace {

std::atomic<const ExitWatch::Handler*> current{nullptr};
std::atomic<pid_t> watched{0};  ///< The watched process: a forked child has a copy of this memory.

/// Returns if there is no watch.
void on_call(const char* function, int status) {
  if (::getpid() != watched) return;
  const auto* const handler = current.exchange(nullptr);
  if (handler == nullptr) return;
  leave((*handler)(
      {.function = function, .status = status, .within = hal::node::exchange::seize_call()}));
}

void on_exit_called(int status, void* context) {
  (void)context;
  on_call("exit", status);
}

}  // namespace

void leave(int status) noexcept {
  while (true) ::syscall(SYS_exit_group, status);
}

std::string ExitCall::what() const {
  return fmt::format("called {}({}) {}", function, status,
                     within ? fmt::format("in {}", within->what) : "outside any callback");
}

std::string ExitCall::text() const {
  if (!within) return "a controller " + what();
  return fmt::format("{} {} at {:.9f} s", within->who, what(), hal::to_seconds(within->at));
}

ExitWatch::ExitWatch(Handler handler) : handler_(std::move(handler)) {
  // Handlers run in the reverse order of their registration: this one before the destructors of all
  // objects that exist now.
  ::on_exit(on_exit_called, nullptr);
  watched = ::getpid();
  current = &handler_;
}

ExitWatch::~ExitWatch() { current = nullptr; }

}  // namespace gateway::runtime

// A function of the program replaces the C library's function of the same name, for the program and
// for all plug-ins, if the program exports it (CMakeLists.txt).
// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp,readability-identifier-naming)
extern "C" {
void _exit(int status) {
  gateway::runtime::on_call("_exit", status);
  gateway::runtime::leave(status);
}
void _Exit(int status) noexcept {
  gateway::runtime::on_call("_Exit", status);
  gateway::runtime::leave(status);
}
void quick_exit(int status) noexcept {
  gateway::runtime::on_call("quick_exit", status);
  gateway::runtime::leave(status);
}
}
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp,readability-identifier-naming)
