#pragma once

#include <string_view>

namespace hal::files::description {

/// Letters, digits, '_' and '-'.
bool are_name_characters(std::string_view text);

/// Whether an agent may have that name: letters, digits, '_' and '-' after a letter. Names stand in
/// DDS topics, file names and patterns.
bool may_be_named(std::string_view name);

}  // namespace hal::files::description
