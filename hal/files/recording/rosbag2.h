#pragma once

#include <filesystem>

#include "hal/files/recording/collector.h"

namespace hal::files::recording {

/// Reads a rosbag2: its folder, or its metadata.yaml. The files that metadata.yaml names are read
/// in its order; without one, all .db3 and .mcap files of the folder (also compressed, .zstd) in
/// the order of their numbers, and a note says so.
/// @throws std::runtime_error  with the path: metadata.yaml is not one, names a file that is
///   missing, or a storage or compression that is not known; and as the readers of the files do.
void read_rosbag2(const std::filesystem::path& folder_or_metadata, Collector& into);

/// Reads one file of a rosbag2: SQLite or MCAP, also compressed by Zstandard.
void read_bag_file(const std::filesystem::path& path, Collector& into);

}  // namespace hal::files::recording
