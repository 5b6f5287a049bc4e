#pragma once

#include <cstdint>

#include "hal/dds/owned_descriptor.h"

namespace hal::dds {

/// A UDP socket to send from whose port is its own: bound to any address, so that Linux lets nobody
/// else bind that port to an address of this host. From a port that is bound to 127.0.0.1, others
/// may speak, too, whoever they are: they bind it to 127.0.0.2 and name 127.0.0.1 as the source
/// (ip(7), IP_PKTINFO). What is sent to it, the kernel drops.
class SendingSocket {
 public:
  /// @throws std::runtime_error  no port or no descriptor is left.
  SendingSocket();
  int number() const { return descriptor_.number(); }
  std::uint16_t port() const { return port_; }

 private:
  OwnedDescriptor descriptor_;
  std::uint16_t port_ = 0;
};

}  // namespace hal::dds
