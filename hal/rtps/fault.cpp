#include "hal/rtps/fault.h"

#include <fmt/core.h>

namespace hal::rtps {

std::string Fault::text() const { return fmt::format("octet {}: {}: {}", at, part, what); }

}  // namespace hal::rtps
