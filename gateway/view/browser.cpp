#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "gateway/view/view_server.h"

namespace gateway::view {

void open_browser(const std::string& address) {
  const bool has_desktop =
      std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
  if (!has_desktop || ::isatty(STDOUT_FILENO) == 0) return;
  const pid_t child = ::fork();
  if (child == 0) {
    // Once more: the browser is nobody's child, and what it says is not ours.
    if (::fork() != 0) ::_exit(0);
    ::setsid();
    if (::freopen("/dev/null", "r+", stdout) == nullptr) ::_exit(1);
    ::dup2(STDOUT_FILENO, STDERR_FILENO);
    ::execlp("xdg-open", "xdg-open", address.c_str(), nullptr);
    ::_exit(127);
  }
  if (child > 0) ::waitpid(child, nullptr, 0);
}

}  // namespace gateway::view
