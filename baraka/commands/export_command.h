#pragma once

#include <string>

namespace baraka::commands {

/// What the command line of `baraka export` says.
struct ExportOptions {
  std::string folder;  ///< Of a result or of a campaign.
  std::string table;   ///< Empty: list the tables.
  std::string file;    ///< Empty: standard output. Of all tables: their folder.
  std::string format;  ///< "csv": all tables; "mcap": one file of messages; empty: one table.
  bool describe = false;
};

/// Prints a table of a result or of a campaign as CSV, its tables, or what all of them are; or
/// writes all of a result.
/// @return exit status. @throws UsageError  there is no such table. @throws std::runtime_error
int export_results(const ExportOptions& options);

}  // namespace baraka::commands
