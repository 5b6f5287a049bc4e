#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gateway/process/owned_descriptor.h"

namespace gateway::guard {

/// The environment variable that tells a process of the sockets passed to it.
inline constexpr const char* kHandedVariable = "BARAKA_EXCHANGE";
/// Longest instance id that is announced, in bytes.
inline constexpr std::size_t kMostAnnounced = 1024;

/// The sockets of an Invitation, in the invited process. They belong to 127.0.0.1 of another
/// network namespace, of which this process can reach nothing else.
struct HandedSockets {
  /// A UDP socket and the port that it is bound to.
  struct Bound {
    process::OwnedDescriptor descriptor;
    std::uint16_t port = 0;
  };
  Bound metatraffic;  ///< For discovery of this process.
  Bound data;         ///< Receives Steps, and sends everything.
  process::OwnedDescriptor channel;
  std::vector<std::uint16_t> hosts;  ///< UDP ports of the process that invited this one.

  /// Tells the host the instance id of this process's Hello. The kernel adds the credentials.
  /// @throws std::runtime_error  the host is gone.
  void announce(const std::string& instance) const;
};

/// Takes what this process was handed; none: nothing, or it was taken before. No program that this
/// one starts gets any of it.
/// @throws std::runtime_error  the environment tells of sockets that are not there.
std::optional<HandedSockets> take_handed_sockets();

}  // namespace gateway::guard
