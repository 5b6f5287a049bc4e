#pragma once

#include <filesystem>
#include <string>

namespace hal::files::config {

/// The value of an override that was written in a file: paths in it that are relative to the
/// file's folder are made absolute. Those are the texts of the keys `file`, `from`, `include` and
/// `profile`, at any depth, where such a file is there, for `from` also a folder; texts of which
/// there is none are left for the folders where overrides are searched for.
/// @param key  dotted path of the value.  @param yaml  in flow style.
std::string with_paths_beside(const std::string& key, const std::string& yaml,
                              const std::filesystem::path& folder);

}  // namespace hal::files::config
