#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gateway/process/owned_descriptor.h"

namespace gateway::guard {

/// The environment variable that describes the sockets passed to a process.
inline constexpr const char* kHandedVariable = "BARAKA_EXCHANGE";
/// Longest instance id that can be announced [byte].
inline constexpr std::size_t kMostAnnounced = 1024;

/// The sockets of an Invitation, in the invited process. They belong to 127.0.0.1 of another
/// network namespace; this process can reach nothing else there.
struct HandedSockets {
  /// A UDP socket and the port that it is bound to.
  struct Bound {
    process::OwnedDescriptor descriptor;
    std::uint16_t port = 0;
  };
  Bound metatraffic;  ///< For discovery of this process.
  Bound data;         ///< Receives Steps; also used for all sending.
  process::OwnedDescriptor channel;
  std::vector<std::uint16_t> hosts;  ///< UDP ports of the process that invited this one.

  /// Tells the host the instance id of this process's Hello. The kernel adds the credentials.
  /// @throws std::runtime_error  the host is gone.
  void announce(const std::string& instance) const;
};

/// Takes the sockets that were passed to this process. None: there are none, or they were taken
/// before. Child processes do not inherit them.
/// @throws std::runtime_error  the environment describes sockets that do not exist.
std::optional<HandedSockets> take_handed_sockets();

}  // namespace gateway::guard
