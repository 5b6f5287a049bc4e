#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <stdexcept>

#include "tests/unit/gateway/guard/udp_socket.h"

namespace gateway::guard {

/// A UDP socket of another user on the loopback interface, held by a child process. Needs root.
class ForeignSocket {
 public:
  static constexpr uid_t kUser = 65533;

  ForeignSocket() {
    std::array<int, 2> pipe_ends{};
    if (pipe(pipe_ends.data()) != 0) throw std::runtime_error("no pipe");
    child_ = fork();
    if (child_ == 0) hold(pipe_ends[1]);
    const bool is_told =
        read(pipe_ends[0], &sender_.port, sizeof(sender_.port)) == sizeof(sender_.port);
    for (const int end : pipe_ends) close(end);
    if (!is_told) throw std::runtime_error("no socket of another user");
  }
  ~ForeignSocket() { end(); }
  ForeignSocket(const ForeignSocket&) = delete;
  ForeignSocket& operator=(const ForeignSocket&) = delete;

  const guard::UdpSender& sender() const { return sender_; }
  pid_t pid() const { return child_; }
  /// Closes it.
  void end() {
    if (child_ <= 0) return;
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
    child_ = -1;
  }

 private:
  [[noreturn]] static void hold(int report) {
    if (setuid(kUser) != 0) _exit(1);
    const UdpSocket socket;
    const std::uint16_t port = socket.sender().port;
    if (write(report, &port, sizeof(port)) != sizeof(port)) _exit(1);
    while (true) pause();
  }

  guard::UdpSender sender_{INADDR_LOOPBACK, 0};
  pid_t child_ = -1;
};

}  // namespace gateway::guard
