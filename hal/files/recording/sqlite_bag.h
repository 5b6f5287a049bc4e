#pragma once

#include <filesystem>

#include "hal/files/recording/collector.h"
#include "hal/files/recording/mapped_file.h"

namespace hal::files::recording {

/// Whether the octets begin as a SQLite database does (sqlite.org/fileformat, 1.3).
bool is_sqlite(Octets octets);

/// Reads one file of rosbag2's storage `sqlite3`: its tables topics and messages. The instant of a
/// message is when the recorder received it.
/// @param name  of the file, for messages: the path can be that of a temporary one.
/// @throws std::runtime_error  "name: table messages, row N: …", or "name: byte N: …" for a file
///   that is cut off.
void read_sqlite_bag(const std::filesystem::path& path, const std::string& name, Collector& into);

}  // namespace hal::files::recording
