#include "gateway/guard/handed_sockets.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <stdexcept>

namespace gateway::guard {
namespace {

/// Highest descriptor that is searched: after exec, inherited descriptors have low numbers.
constexpr int kHighestInherited = 1023;

[[noreturn]] void fail_taking(const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", kHandedVariable, what));
}

/// The socket with an inode. It is set to be closed in programs that this process starts.
process::OwnedDescriptor inherited(std::uint64_t inode) {
  for (int number = 3; number <= kHighestInherited; ++number) {
    struct stat status {};
    if (fstat(number, &status) != 0 || !S_ISSOCK(status.st_mode) || status.st_ino != inode) {
      continue;
    }
    fcntl(number, F_SETFD, FD_CLOEXEC);
    return process::OwnedDescriptor(number);
  }
  fail_taking(fmt::format("the socket {} was not inherited", inode));
}

HandedSockets::Bound inherited_udp(std::uint64_t inode) {
  process::OwnedDescriptor descriptor = inherited(inode);
  sockaddr_in name{};
  socklen_t size = sizeof(name);
  if (getsockname(descriptor.number(), reinterpret_cast<sockaddr*>(&name), &size) != 0 ||
      name.sin_family != AF_INET) {
    fail_taking(fmt::format("the socket {} is none of UDP", inode));
  }
  return {std::move(descriptor), ntohs(name.sin_port)};
}

}  // namespace

void HandedSockets::announce(const std::string& instance) const {
  if (send(channel.number(), instance.data(), instance.size(), MSG_NOSIGNAL) >= 0) return;
  fail_taking(fmt::format("the process that handed the sockets over: {}", std::strerror(errno)));
}

std::optional<HandedSockets> take_handed_sockets() {
  const char* variable = std::getenv(kHandedVariable);
  if (variable == nullptr) return std::nullopt;
  std::istringstream words{std::string(variable)};
  unsetenv(kHandedVariable);
  std::uint64_t metatraffic = 0, data = 0, channel = 0;
  if (!(words >> metatraffic >> data >> channel)) fail_taking("names no three sockets");
  HandedSockets handed{inherited_udp(metatraffic), inherited_udp(data), inherited(channel), {}};
  for (std::uint16_t port = 0; words >> port;) handed.hosts.push_back(port);
  if (handed.hosts.empty()) fail_taking("names no port of a server");
  return handed;
}

}  // namespace gateway::guard
