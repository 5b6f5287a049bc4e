#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace results::capsule {

/// Writes a copy of a database in which tables with more rows than `most_rows` are empty; the file
/// of a run under way is copied as it was at one instant.
/// @param to  does not exist.
/// @return rows of each table that was emptied.
/// @throws std::runtime_error  with the file and SQLite's reason.
std::map<std::string, std::int64_t> copy_without_bulk(const std::filesystem::path& from,
                                                      const std::filesystem::path& to,
                                                      std::int64_t most_rows);

}  // namespace results::capsule
