#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/record/database.h"
#include "results/record/schema.h"

namespace results::record {

/// The result of one run, open for reading. Reports, exports and repetitions need to know no more
/// about how a result is stored.
///
///   RunReader reader(folder);
///   Statement links = reader.query("SELECT a, b FROM links");   // tables and columns of schema.h
///   while (links.next()) use(links.integer(0), links.integer(1));
///
/// What it returns is what a run can have written, whoever wrote the file: see
/// Database::read_only_sound(). Every member throws std::runtime_error, with table and row, if a
/// value is not, or if the file is damaged. One thread.
class RunReader {
 public:
  /// @param folder  holds `run.sqlite`.
  /// @throws std::runtime_error  the file is missing, damaged or of another version.
  explicit RunReader(const std::filesystem::path& folder);

  const std::filesystem::path& folder() const { return folder_; }

  /// @param sql  one SELECT. The statement must not outlive this object.
  Statement query(std::string_view sql) { return {database_, sql}; }

  /// Value in the table run; "" if the key is not there.
  std::string value(std::string_view key);

  /// Value of a key that is a number; none if the key is not there.
  std::optional<std::int64_t> integer(std::string_view key);
  std::optional<double> real(std::string_view key);

  /// Whether the run has not recorded how it ended: it was killed, or is still running.
  bool is_unfinished() { return value("result") == "running"; }

  /// Number of rows of each table.
  std::map<std::string, std::int64_t> count_rows();

 private:
  void check_keys();
  std::vector<std::int64_t> agents();

  std::filesystem::path folder_;
  Database database_;
};

}  // namespace results::record
