#pragma once

#include <cstdint>

#include "gateway/process/owned_descriptor.h"

namespace gateway::guard {

/// A UDP socket for sending with an exclusive port: it is bound to any address, so Linux does not
/// let other users bind that port to an address of this host. A port bound to 127.0.0.1 is not
/// exclusive: any user can bind it to 127.0.0.2 and give 127.0.0.1 as the source (ip(7),
/// IP_PKTINFO). The kernel drops datagrams that are sent to this socket.
class SendingSocket {
 public:
  /// @throws std::runtime_error  no port or no descriptor is left.
  SendingSocket();
  int number() const { return descriptor_.number(); }
  std::uint16_t port() const { return port_; }

 private:
  process::OwnedDescriptor descriptor_;
  std::uint16_t port_ = 0;
};

}  // namespace gateway::guard
