#pragma once

#include "hal/files/recording/collector.h"
#include "hal/files/recording/mapped_file.h"

namespace hal::files::recording {

/// Whether the octets begin with MCAP's magic bytes.
bool is_mcap(Octets octets);

/// Reads an MCAP file (MCAP format specification, mcap.dev/spec) from its first byte to its last:
/// the index is not needed, so a file without a summary is read as well. CRCs that are present are
/// checked. The instant of a message is its publish_time, or its log_time if that is 0.
/// @throws std::runtime_error  "path: byte N: …". A file that ends before its Footer is refused,
///   with the number of messages that are whole.
void read_mcap(const MappedFile& file, Collector& into);

}  // namespace hal::files::recording
