#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hal::files::config {

/// What a file is if its text is not YAML of BARAKA, and which command reads it: URDF, SDF, other
/// XML, an SQLite database, binary data. nullopt if it may be YAML. Judges by the text, not by the
/// name.
std::optional<std::string> foreign_format(std::string_view text);

/// The same for a folder: whether it contains results, and which command reads them. "is a
/// directory, …".
std::string folder_instead_of_file(const std::string& folder);

}  // namespace hal::files::config
