#pragma once

#include <string_view>

namespace hal::files::description {

/// Whether the text has only letters, digits, '_' and '-'.
bool are_name_characters(std::string_view text);

/// Whether an agent may have this name: a letter, then letters, digits, '_' and '-'. Names are used
/// in DDS topics, file names and patterns.
bool may_be_named(std::string_view name);

}  // namespace hal::files::description
