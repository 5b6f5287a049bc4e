#pragma once

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stdexcept>

#include "gateway/guard/datagram_filter.h"

namespace gateway::guard {

/// A UDP socket of this process on the loopback interface.
class UdpSocket {
 public:
  UdpSocket() : descriptor_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address);
    auto* const raw = reinterpret_cast<sockaddr*>(&address);
    if (bind(descriptor_, raw, size) != 0 || getsockname(descriptor_, raw, &size) != 0) {
      throw std::runtime_error("no socket");
    }
    sender_ = {INADDR_LOOPBACK, ntohs(address.sin_port)};
  }
  ~UdpSocket() { close(descriptor_); }
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;
  const guard::UdpSender& sender() const { return sender_; }
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
  guard::UdpSender sender_;
};

}  // namespace gateway::guard
