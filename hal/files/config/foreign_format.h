#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hal::files::config {

/// What a file is whose text is no YAML of BARAKA, and what reads it: URDF, SDF, other XML, a
/// database of SQLite, binary data. Nothing if it may be YAML. Looks at the text, not at its name.
std::optional<std::string> foreign_format(std::string_view text);

/// The same for a folder: whether it holds results, and what reads those. "is a directory, …".
std::string folder_instead_of_file(const std::string& folder);

}  // namespace hal::files::config
