#include "hal/files/recording/message_size.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

#include "hal/files/recording/compression.h"

namespace hal::files::recording {

std::uint32_t message_size(Octets message) {
  const std::uint64_t size = is_zstd(message) ? zstd_content_size(message) : message.size();
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw std::runtime_error(fmt::format("a message of {} bytes is too large", size));
  return static_cast<std::uint32_t>(size);
}

}  // namespace hal::files::recording
