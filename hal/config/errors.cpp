#include "hal/config/errors.h"

#include <fmt/format.h>

#include <utility>

namespace hal::config {

ConfigErrors::ConfigErrors(std::vector<std::string> messages)
    : std::runtime_error(fmt::format("{}", fmt::join(messages, "\n"))),
      messages_(std::move(messages)) {}

}  // namespace hal::config
