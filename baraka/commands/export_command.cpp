#include "baraka/commands/export_command.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <vector>

#include "baraka/commands/exported_scene_of.h"
#include "baraka/commands/output_file.h"
#include "baraka/commands/result_folder.h"
#include "gateway/process/exit_status.h"
#include "hal/files/config/suggest.h"
#include "hal/types/printable.h"
#include "hal/types/terminal_colours.h"
#include "results/campaign/description.h"
#include "results/campaign/schema.h"
#include "results/record/description.h"
#include "results/record/run_reader.h"
#include "results/report/csv.h"
#include "results/report/link_trace.h"
#include "results/report/mcap_export.h"

namespace baraka::commands {
namespace {

std::string list_of_tables(const std::vector<results::record::Table>& tables,
                           const std::map<std::string, std::int64_t>& rows) {
  std::string list = fmt::format("{:<14} {:>9}  {}\n", "table", "rows", "what it is");
  for (const results::record::Table& table : tables) {
    list += fmt::format("{:<14} {:>9}  {}\n", table.name, rows.at(std::string(table.name)),
                        table.meaning);
  }
  return list;
}

/// @param whole  "result" or "campaign", for the message.
/// @throws UsageError if there is no table of that name.
void require_table(const std::string& name, const std::vector<results::record::Table>& tables,
                   const char* whole) {
  if (name.empty() || results::record::find_table(tables, name) != nullptr) return;
  std::vector<std::string> names;
  names.reserve(tables.size());
  for (const results::record::Table& table : tables) names.emplace_back(table.name);
  throw gateway::process::UsageError(fmt::format(
      "export: '{}' is not a table of a {}{}; there are: {}", name, whole,
      hal::files::config::suggestion(name, names), results::record::table_names(tables)));
}

/// Writes every table as a file of a folder.
/// @param reader  the path of a result's folder, or the reader of a campaign.
template <class Reader>
int export_tables(const ExportOptions& options, const std::vector<results::record::Table>& tables,
                  Reader& reader) {
  const std::filesystem::path folder(options.file);
  std::filesystem::create_directories(folder);
  for (const results::record::Table& table : tables) {
    OutputFile output((folder / fmt::format("{}.csv", table.name)).string());
    results::report::write_csv(reader, table.name,
                               [&output](std::string_view text) { output.write(text); });
    output.finish();
  }
  return gateway::process::kDone;
}

int export_mcap(const ExportOptions& options) {
  // Everything that can be wrong with the result shows before a file is replaced.
  const results::report::ExportedScene scene = exported_scene_of(options.folder);
  OutputFile output(options.file);
  results::report::write_mcap(options.folder, scene,
                              [&output](std::string_view bytes) { output.write(bytes); });
  output.finish();
  return gateway::process::kDone;
}

int export_links(const ExportOptions& options) {
  std::string rows;
  results::report::write_link_trace(options.folder,
                                    [&rows](std::string_view text) { rows += text; });
  OutputFile output(options.file);
  output.write(rows);
  output.finish();
  return gateway::process::kDone;
}

/// Whether everything is exported (--format without a table).
bool is_whole(const ExportOptions& options) {
  return options.format == "mcap" || (options.format == "csv" && options.table.empty());
}

void check_format(const ExportOptions& options, bool is_campaign) {
  if (options.format.empty()) return;
  if (options.describe) throw gateway::process::UsageError("export: --describe has no --format");
  if (options.format == "mcap" && !options.table.empty()) {
    throw gateway::process::UsageError("export: an MCAP file has the whole run, so no TABLE");
  }
  if (options.format == "mcap" && is_campaign) {
    throw gateway::process::UsageError(
        "export: an MCAP file is of one run, and this is a campaign; its runs lie below");
  }
  if (options.format == "links" && (is_campaign || !options.table.empty())) {
    throw gateway::process::UsageError("export: --format links is of one run, and has no TABLE");
  }
  if (is_whole(options) && options.file.empty()) {
    throw gateway::process::UsageError(options.format == "csv"
                                           ? "export: -o is missing, the folder for the tables"
                                           : "export: -o is missing, the file");
  }
}

/// Exports from the folder of a campaign.
int export_campaign(const ExportOptions& options) {
  const auto& tables = results::campaign::tables();
  require_table(options.table, tables, "campaign");
  results::campaign::CampaignReader reader(options.folder);
  if (is_whole(options)) return export_tables(options, tables, reader);
  const std::string list = list_of_tables(tables, reader.count_rows());
  OutputFile output(options.file);
  const auto write = [&output](std::string_view text) { output.write(text); };
  if (options.describe) {
    write(results::campaign::describe_campaign());
  } else if (options.table.empty()) {
    write(list);
  } else {
    results::report::write_csv(reader, options.table, write);
  }
  output.finish();
  return gateway::process::kDone;
}

void check_arguments_of_result(const ExportOptions& options) {
  if (!options.describe && options.folder.empty()) {
    throw gateway::process::UsageError("export: DIR is missing, the folder of a result");
  }
  require_table(options.table, results::record::tables(), "result");
  if (options.describe && !(options.folder.empty() && options.table.empty())) {
    throw gateway::process::UsageError(
        "export: --describe is about every result, so no DIR but a campaign's");
  }
}

int describe_results(const ExportOptions& options) {
  OutputFile output(options.file);
  output.write(results::record::describe_results());
  output.finish();
  return gateway::process::kDone;
}

/// Prints a table of a result, or the list of tables.
int export_table(const ExportOptions& options) {
  // Everything that can be wrong with the result shows before a file is replaced.
  const std::string list =
      options.table.empty()
          ? list_of_tables(results::record::tables(),
                           results::record::RunReader(options.folder).count_rows())
          : "";
  OutputFile output(options.file);
  const auto write = [&output](std::string_view text) { output.write(text); };
  if (options.table.empty()) {
    write(list);
  } else {
    results::report::write_csv(options.folder, options.table, write);
  }
  output.finish();
  return gateway::process::kDone;
}

}  // namespace

int export_results(const ExportOptions& options) {
  const bool is_campaign =
      !options.folder.empty() && results::campaign::CampaignReader::has_database(options.folder);
  check_format(options, is_campaign);
  if (is_campaign) return export_campaign(options);
  check_arguments_of_result(options);
  if (options.describe) return describe_results(options);
  require_result(options.folder);
  if (results::record::RunReader(options.folder).is_unfinished()) {
    hal::print_line(
        hal::Tone::kWarning,
        fmt::format("warning: {}: this run is unfinished: broken off, or still under way",
                    hal::printable(options.folder)));
  }
  if (options.format == "mcap") return export_mcap(options);
  if (options.format == "links") return export_links(options);
  if (is_whole(options)) return export_tables(options, results::record::tables(), options.folder);
  return export_table(options);
}

}  // namespace baraka::commands
