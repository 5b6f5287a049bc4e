#pragma once

#include <string>

namespace baraka::commands {

/// The command line of `baraka export`.
struct ExportOptions {
  std::string folder;  ///< Folder of a result or of a campaign.
  std::string table;   ///< Empty: list the tables.
  std::string file;    ///< Empty: standard output. For all tables: the folder to write to.
  std::string format;  ///< "csv": all tables; "mcap": one file of messages; "links":
                       ///< received powers for the law `measured`; empty: one table.
  bool describe = false;
};

/// Prints a table of a result or of a campaign as CSV, lists the tables, describes them, or exports
/// a whole result.
/// @return exit status. @throws UsageError  there is no such table. @throws std::runtime_error
int export_results(const ExportOptions& options);

}  // namespace baraka::commands
