#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/dds/owned_descriptor.h"

namespace hal::dds {

/// The environment variable by which a process learns that it was handed sockets.
inline constexpr const char* kHandedVariable = "BARAKA_EXCHANGE";
/// Longest instance id that is announced, in bytes.
inline constexpr std::size_t kMostAnnounced = 1024;

/// The sockets of an Invitation, in the process that was invited: of another network namespace's
/// 127.0.0.1, which is all of that namespace that this process can reach.
struct HandedSockets {
  /// A UDP socket and the port that it is bound to.
  struct Bound {
    OwnedDescriptor descriptor;
    std::uint16_t port = 0;
  };
  Bound metatraffic;  ///< Where others discover this process.
  Bound data;         ///< Where Steps come, and from which everything is sent.
  OwnedDescriptor channel;
  std::vector<std::uint16_t> hosts;  ///< UDP ports of the process that invited this one.

  /// Tells the host as whom this process will say Hello. The kernel adds who it is.
  /// @throws std::runtime_error  the host is gone.
  void announce(const std::string& instance) const;
};

/// Takes what this process was handed; none: nothing, or it was taken before. No program that this
/// one starts gets any of it.
/// @throws std::runtime_error  the environment tells of sockets that are not there.
std::optional<HandedSockets> take_handed_sockets();

}  // namespace hal::dds
