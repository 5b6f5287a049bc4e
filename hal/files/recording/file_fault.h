#pragma once

#include <cstdint>
#include <string>

namespace hal::files::recording {

/// What is wrong with a file, and at which byte.
struct FileFault {
  std::uint64_t at = 0;
  std::string what;
  bool is_cut = false;  ///< The file ends there.
};

}  // namespace hal::files::recording
