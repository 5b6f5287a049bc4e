#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <set>
#include <tuple>

#include "hal/files/recording/mapped_file.h"

namespace hal::files::recording {

/// A packet of the network layer.
struct NetworkPacket {
  std::uint16_t ethertype = 0;
  Octets packet;
};

using OnNetworkPacket = std::function<void(const NetworkPacket&)>;

/// Finds the MSDUs in captured frames of IEEE 802.11 (IEEE Std 802.11-2020, 9.2, 9.3.2), each
/// once: repetitions (Retry is set and the sequence number is known, 10.3.2.14) and what an access
/// point passes on from a station whose own frames are in the capture are left out. Fragments of
/// MSDUs and encrypted frames are counted only.
class WirelessFrames {
 public:
  /// @param at  ns  @param frame  without FCS, or with it.
  void read(std::int64_t at, Octets frame, const OnNetworkPacket& on_packet);
  /// A frame behind a radiotap header (radiotap.org), which tells of FCS and padding.
  void read_radiotap(std::int64_t at, Octets octets, const OnNetworkPacket& on_packet);

  std::size_t encrypted() const { return encrypted_; }
  std::size_t fragments() const { return fragments_; }

 private:
  using MacAddress = std::array<std::byte, 6>;
  /// Transmitter, TID (16: none), sequence control.
  using FrameKey = std::tuple<MacAddress, std::uint8_t, std::uint16_t>;

  void read_frame(std::int64_t at, Octets frame, std::size_t padding, const OnNetworkPacket& on);
  bool is_repetition(std::int64_t at, const FrameKey& key, bool is_retry);
  /// @param ds  To DS and From DS.
  bool is_relayed(Octets frame, unsigned ds);

  std::map<FrameKey, std::int64_t> seen_;
  std::deque<FrameKey> order_;
  std::set<MacAddress> stations_;  ///< Those that send to an access point.
  std::size_t encrypted_ = 0, fragments_ = 0;
};

}  // namespace hal::files::recording
