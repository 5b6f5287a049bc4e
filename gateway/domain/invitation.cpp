#include "gateway/domain/invitation.h"

#include <fmt/core.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "gateway/guard/handed_sockets.h"
#include "gateway/process/domains.h"

namespace gateway::domain {
namespace {

constexpr int kHandedBuffer = 4 << 20;

[[noreturn]] void fail_inviting(const char* what) {
  throw std::runtime_error(fmt::format("{}: {}", what, std::strerror(errno)));
}

std::optional<sockaddr_in> name_of_socket(int descriptor) {
  sockaddr_in name{};
  socklen_t size = sizeof(name);
  if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&name), &size) != 0 ||
      name.sin_family != AF_INET) {
    return std::nullopt;
  }
  return name;
}

/// A UDP socket on 127.0.0.1 whose port is not the discovery port of a server.
process::OwnedDescriptor loopback_socket(std::uint16_t& port) {
  // kept open, so that each attempt gets another port
  std::vector<process::OwnedDescriptor> refused;
  while (true) {
    process::OwnedDescriptor udp(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (udp.number() < 0 ||
        bind(udp.number(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
      fail_inviting("a UDP port of 127.0.0.1");
    }
    port = ntohs(name_of_socket(udp.number()).value().sin_port);
    // The system may limit the size.
    setsockopt(udp.number(), SOL_SOCKET, SO_RCVBUF, &kHandedBuffer, sizeof(kHandedBuffer));
    setsockopt(udp.number(), SOL_SOCKET, SO_SNDBUF, &kHandedBuffer, sizeof(kHandedBuffer));
    if (!process::may_be_a_servers(port)) return udp;
    refused.push_back(std::move(udp));
  }
}

std::uint64_t inode_of(const process::OwnedDescriptor& descriptor) {
  struct stat status {};
  fstat(descriptor.number(), &status);
  return status.st_ino;
}

}  // namespace

std::pair<std::string, std::string> Invitation::variable() const {
  return {guard::kHandedVariable, variable_};
}

Invited invite(std::uint16_t host) {
  std::uint16_t metatraffic_port = 0, data_port = 0;
  process::OwnedDescriptor metatraffic = loopback_socket(metatraffic_port);
  process::OwnedDescriptor data = loopback_socket(data_port);
  std::array<int, 2> ends{-1, -1};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    fail_inviting("a Unix socket");
  }
  process::OwnedDescriptor own(ends[0]), guests(ends[1]);
  const int on = 1;
  setsockopt(own.number(), SOL_SOCKET, SO_PASSCRED, &on, sizeof(on));
  // Whoever starts the process may renumber the descriptors, so they are identified by inodes.
  std::string variable =
      fmt::format("{} {} {} {}", inode_of(metatraffic), inode_of(data), inode_of(guests), host);
  return {
      Invitation(std::move(metatraffic), std::move(data), std::move(guests), std::move(variable)),
      Guest(std::move(own), data_port)};
}

void Guest::hear() {
  std::array<char, guard::kMostAnnounced> text{};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(ucred))> control{};
  iovec part{text.data(), text.size()};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const ssize_t size = recvmsg(channel_.number(), &message, MSG_DONTWAIT | MSG_CMSG_CLOEXEC);
  if (size <= 0) return;
  for (const cmsghdr* one = CMSG_FIRSTHDR(&message); one != nullptr;
       one = CMSG_NXTHDR(&message, const_cast<cmsghdr*>(one))) {
    if (one->cmsg_level != SOL_SOCKET || one->cmsg_type != SCM_CREDENTIALS) continue;
    ucred sender{};
    std::memcpy(&sender, CMSG_DATA(one), sizeof(sender));
    instance_ = std::string(text.data(), static_cast<std::size_t>(size));
    identity_ = {process::this_process().host, sender.pid,
                 process::start_time_of(sender.pid).value_or(0)};
  }
}

std::optional<process::ProcessIdentity> Guest::identity_of(const std::string& instance,
                                                           const guard::UdpSender& sender) {
  if (sender != guard::UdpSender{INADDR_LOOPBACK, port_}) return std::nullopt;
  if (instance_.empty()) hear();
  if (instance_.empty() || instance != instance_) return std::nullopt;
  return identity_;
}

}  // namespace gateway::domain
