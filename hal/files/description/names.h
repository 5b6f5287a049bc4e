#pragma once

#include <string_view>

#include "hal/files/description/fields.h"

namespace hal::files::description {

/// Whether the text has only letters, digits, '_' and '-'.
bool are_name_characters(std::string_view text);

/// Whether an agent may have this name: a letter, then letters, digits, '_' and '-'. Names are used
/// in DDS topics, file names and patterns.
bool may_be_named(std::string_view name);

/// Refuses a value of the key `name` that may not be the name of an agent, or of a folder of
/// results: letters, digits, '_' and '-'. An empty one has been refused before.
void check_name(Fields& io, std::string_view name);
void check_folder_name(Fields& io, std::string_view name);

}  // namespace hal::files::description
