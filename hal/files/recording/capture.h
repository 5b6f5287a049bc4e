#pragma once

#include "hal/files/recording/collector.h"
#include "hal/files/recording/mapped_file.h"

namespace hal::files::recording {

/// Reads a pcap or pcapng: samples of DDS (rtps_traffic.h), and the other UDP datagrams as flows
/// by destination port. What is not UDP is left out.
/// @throws std::runtime_error  "path: byte N: …"
void read_capture(const MappedFile& file, Collector& into);

}  // namespace hal::files::recording
