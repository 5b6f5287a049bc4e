#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "hal/rtps/ip_packet.h"

namespace hal::files::recording {

/// The payload of a whole IP datagram.
struct WholeDatagram {
  std::int64_t at = 0;  ///< Of its first fragment that was captured [ns].
  rtps::IpAddress source{};
  rtps::Octets payload;  ///< Valid until the next call of add().
};

/// Puts the fragments of IP datagrams together (RFC 791, 3.2; RFC 8200, 4.5), in any order. The
/// last kMost unfinished datagrams are kept.
class Reassembly {
 public:
  static constexpr std::size_t kMost = 1024;

  /// @return the datagram that this packet completes.
  std::optional<WholeDatagram> add(std::int64_t at, const rtps::IpPacket& packet);

  /// Datagrams of which fragments were missing, so far and now.
  std::size_t unfinished() const { return given_up_ + unfinished_.size(); }

 private:
  struct Parts {
    std::int64_t at = 0;
    std::map<std::uint32_t, std::vector<std::byte>> pieces;  ///< By offset.
    std::optional<std::uint32_t> size;                       ///< Known from the last fragment.
  };
  bool complete(const Parts& parts);

  std::map<rtps::FragmentKey, Parts> unfinished_;
  std::deque<rtps::FragmentKey> order_;  ///< Some may be finished.
  std::vector<std::byte> whole_;
  std::size_t given_up_ = 0;
};

}  // namespace hal::files::recording
