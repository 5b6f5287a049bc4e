#include "hal/robot/platform/interface_watch.h"

#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace hal::robot::platform {
namespace {

int open_rtnetlink() {
  const int socket = ::socket(AF_NETLINK, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, NETLINK_ROUTE);
  sockaddr_nl groups{};
  groups.nl_family = AF_NETLINK;
  groups.nl_groups = RTMGRP_LINK | RTMGRP_IPV4_IFADDR;
  if (socket < 0 || bind(socket, reinterpret_cast<sockaddr*>(&groups), sizeof groups) != 0) {
    const int error = errno;
    if (socket >= 0) ::close(socket);
    throw std::system_error(error, std::generic_category(), "cannot watch network interfaces");
  }
  return socket;
}

}  // namespace

InterfaceWatch::InterfaceWatch(EventLoop& loop, std::function<void()> on_change)
    : loop_(loop),
      socket_(open_rtnetlink()),
      watch_(loop.watch(socket_, [this, on_change = std::move(on_change)] {
        drain();
        on_change();
      })) {}

InterfaceWatch::~InterfaceWatch() {
  loop_.unwatch(watch_);
  ::close(socket_);
}

/// Discards the notifications, whether or not some were lost: interfaces are queried again anyway.
void InterfaceWatch::drain() const {
  std::array<char, 8192> said;
  ssize_t size = 0;
  do {
    size = recv(socket_, said.data(), said.size(), MSG_DONTWAIT);
  } while (size > 0 || (size < 0 && errno == ENOBUFS));
}

}  // namespace hal::robot::platform
