#pragma once

#include "hal/files/recording/capture_file.h"

namespace hal::files::recording {

bool is_pcapng(Octets octets);

/// read_packets() of a pcapng: its sections can differ in their order of bytes, its interfaces in
/// their link types and in the resolution and offset of their time stamps.
std::size_t read_pcapng(Octets file, const OnPacket& on_packet);

}  // namespace hal::files::recording
