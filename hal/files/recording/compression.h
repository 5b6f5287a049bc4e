#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "hal/files/recording/mapped_file.h"

namespace hal::files::recording {

/// Whether the octets begin as a frame of Zstandard does (RFC 8878, 3.1.1). No CDR encapsulation
/// does: its first octet is 0.
bool is_zstd(Octets octets);

/// Decompresses a chunk of MCAP; memory grows with what is found, not with what is announced.
/// @param compression  "" (none), "zstd" or "lz4" (the frame format).
/// @param size  announced size of the result, octets.
/// @throws std::runtime_error  unknown compression, damaged data or another size, without the
///   place.
std::vector<std::byte> decompressed(std::string_view compression, Octets octets,
                                    std::uint64_t size);

/// Size of what one frame of Zstandard holds, octets: told by the frame's header, else counted.
/// @throws std::runtime_error  the data are damaged, without the place.
std::uint64_t zstd_content_size(Octets frame);

/// A file that Zstandard compressed, as a temporary file, which is removed at the end.
class DecompressedFile {
 public:
  /// @throws std::runtime_error  with the path: damaged data, or no room for the result.
  explicit DecompressedFile(const std::filesystem::path& compressed);
  ~DecompressedFile();
  DecompressedFile(const DecompressedFile&) = delete;
  DecompressedFile& operator=(const DecompressedFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace hal::files::recording
