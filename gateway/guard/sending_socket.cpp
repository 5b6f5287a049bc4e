#include "gateway/guard/sending_socket.h"

#include <fmt/core.h>
#include <linux/filter.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "gateway/process/domains.h"

namespace gateway::guard {
namespace {

constexpr int kSendBuffer = 4 << 20;

/// Makes the kernel drop all datagrams that arrive at a socket, before they use memory (socket(7),
/// SO_ATTACH_FILTER). @return whether that succeeded; else errno is set.
bool hears_nothing(int descriptor) {
  sock_filter take_no_byte{BPF_RET | BPF_K, 0, 0, 0};
  const sock_fprog program{1, &take_no_byte};
  return setsockopt(descriptor, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof(program)) == 0;
}

/// @return its port; 0: it has none, and errno is set.
std::uint16_t bind_to_any(int descriptor) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  auto* const raw = reinterpret_cast<sockaddr*>(&address);
  socklen_t size = sizeof(address);
  const bool is_bound =
      bind(descriptor, raw, size) == 0 && getsockname(descriptor, raw, &size) == 0;
  return is_bound ? ntohs(address.sin_port) : 0;
}

}  // namespace

SendingSocket::SendingSocket() {
  // kept open, so that each attempt gets another port
  std::vector<process::OwnedDescriptor> refused;
  while (true) {
    process::OwnedDescriptor made(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    // Before it has a port: a socket bound to any address can be reached from other hosts.
    const bool is_made = made.number() >= 0 && hears_nothing(made.number());
    port_ = is_made ? bind_to_any(made.number()) : 0;
    if (port_ == 0) {
      throw std::runtime_error(fmt::format("a UDP port to send from: {}", std::strerror(errno)));
    }
    if (process::may_be_a_servers(port_)) {
      refused.push_back(std::move(made));
      continue;
    }
    // The system may limit the size.
    setsockopt(made.number(), SOL_SOCKET, SO_SNDBUF, &kSendBuffer, sizeof(kSendBuffer));
    descriptor_ = std::move(made);
    return;
  }
}

}  // namespace gateway::guard
