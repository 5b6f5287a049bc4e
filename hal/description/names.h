#pragma once

#include <string_view>

namespace hal::description {

/// Whether an agent may have that name: letters, digits, '_' and '-' after a letter. Names stand in
/// DDS topics, file names and patterns.
bool may_be_named(std::string_view name);

}  // namespace hal::description
