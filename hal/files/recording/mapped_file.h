#pragma once

#include <filesystem>
#include <string>

#include "hal/rtps/cursor.h"

namespace hal::files::recording {

using rtps::Octets;

/// The bytes of a file, as the kernel maps them: a bag of any size takes no memory of ours. The
/// file must not become shorter meanwhile.
class MappedFile {
 public:
  /// @throws std::runtime_error  it cannot be read, or is no regular file.
  explicit MappedFile(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  Octets octets() const { return octets_; }
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  Octets octets_;
};

}  // namespace hal::files::recording
