#pragma once

#include <filesystem>

#include "sim/scenario/fields.h"

namespace sim::scenario {

/// A key that names a file, relative to the folder of the file in which it is written, to the
/// working folder, or to a shared folder (hal::files::config::find_shared()).
/// @param[in,out] path  absolute; empty: the key is absent.
void file_key(Fields& io, const Key& key, std::filesystem::path& path);

}  // namespace sim::scenario
