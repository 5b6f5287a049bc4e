#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hal::files::recording {

/// What metadata.yaml of a rosbag2 tells that the files themselves do not.
struct BagMetadata {
  std::vector<std::filesystem::path> files;    ///< In order; all exist.
  std::optional<std::uint64_t> message_count;  ///< In all files.
};

/// @throws std::runtime_error  "path:line:column: …"
BagMetadata read_bag_metadata(const std::filesystem::path& path);

}  // namespace hal::files::recording
