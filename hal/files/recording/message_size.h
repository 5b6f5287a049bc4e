#pragma once

#include <cstdint>

#include "hal/files/recording/mapped_file.h"

namespace hal::files::recording {

/// Size of a recorded message before rosbag2 compressed it (compression mode `message`), octets;
/// of one that is not compressed, its own.
/// @throws std::runtime_error  damaged data, or a size that no message has, without the place.
std::uint32_t message_size(Octets message);

}  // namespace hal::files::recording
