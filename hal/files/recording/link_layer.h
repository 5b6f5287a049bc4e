#pragma once

#include <functional>
#include <optional>

#include "hal/files/recording/capture_file.h"
#include "hal/files/recording/wireless_frames.h"

namespace hal::files::recording {

/// Finds the IP packets in captured frames: of Ethernet with VLANs, Linux's cooked captures (SLL,
/// SLL2), raw IP, BSD's loopback, and IEEE 802.11 with and without radiotap.
class LinkLayer {
 public:
  /// @throws FileFault  the link type is another one; without the byte.
  void read(const CapturedPacket& packet, const OnNetworkPacket& on_packet);

  const WirelessFrames& wireless() const { return wireless_; }

 private:
  WirelessFrames wireless_;
};

}  // namespace hal::files::recording
