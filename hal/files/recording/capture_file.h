#pragma once

#include <cstdint>
#include <functional>

#include "hal/files/recording/mapped_file.h"

namespace hal::files::recording {

/// A packet of a capture file.
struct CapturedPacket {
  std::int64_t at = 0;          ///< Nanoseconds since 1970.
  std::uint16_t link_type = 0;  ///< LINKTYPE_ value (tcpdump.org/linktypes.html).
  Octets octets;
  bool is_cut = false;  ///< It was longer: the capture had a snap length.
};

using OnPacket = std::function<void(const CapturedPacket&)>;

/// Whether the octets begin as a pcap or a pcapng does, in either order of bytes.
bool is_capture(Octets octets);

/// Passes on the packets of a pcap (draft-ietf-opsawg-pcap; microseconds and nanoseconds) or of a
/// pcapng (draft-ietf-opsawg-pcapng), in the order of the file.
/// @return packets without a time stamp, which are left out (Simple Packet Blocks).
/// @throws FileFault
std::size_t read_packets(Octets file, const OnPacket& on_packet);

}  // namespace hal::files::recording
