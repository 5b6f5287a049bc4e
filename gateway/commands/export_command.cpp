#include "gateway/commands/export_command.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

#include "gateway/exit_status.h"
#include "sim/campaign/description.h"
#include "sim/campaign/schema.h"
#include "sim/record/description.h"
#include "sim/record/run_reader.h"
#include "sim/report/csv.h"

namespace gateway {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

[[noreturn]] void fail_writing(const std::string& name) {
  throw std::runtime_error(fmt::format("{}: {}", name, std::strerror(errno)));
}

/// Standard output or a file, with every error told.
class Output {
 public:
  explicit Output(const std::string& file)
      : name_(file.empty() ? "standard output" : file),
        file_(file.empty() ? nullptr : std::fopen(file.c_str(), "wb"), &std::fclose) {
    if (!file.empty() && !file_) fail_writing(name_);
  }

  void write(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), stream()) != text.size()) fail_writing(name_);
  }

  void finish() {
    if (std::fflush(stream()) != 0) fail_writing(name_);
  }

 private:
  std::FILE* stream() { return file_ ? file_.get() : stdout; }

  std::string name_;
  File file_;
};

std::string list_of_tables(const std::vector<sim::record::Table>& tables,
                           const std::map<std::string, std::int64_t>& rows) {
  std::string list = fmt::format("{:<14} {:>9}  {}\n", "table", "rows", "what it is");
  for (const sim::record::Table& table : tables) {
    list += fmt::format("{:<14} {:>9}  {}\n", table.name, rows.at(std::string(table.name)),
                        table.meaning);
  }
  return list;
}

/// Of the folder of a campaign.
int export_campaign(const ExportOptions& options) {
  const auto& tables = sim::campaign::tables();
  if (!options.table.empty() && sim::record::find_table(tables, options.table) == nullptr) {
    throw UsageError(fmt::format("export: '{}' is no table of a campaign; there are: {}",
                                 options.table, sim::record::table_names(tables)));
  }
  sim::campaign::CampaignReader reader(options.folder);
  const std::string list = list_of_tables(tables, reader.count_rows());
  Output output(options.file);
  const auto write = [&output](std::string_view text) { output.write(text); };
  if (options.describe) {
    write(sim::campaign::describe_campaign());
  } else if (options.table.empty()) {
    write(list);
  } else {
    sim::report::write_csv(reader, options.table, write);
  }
  output.finish();
  return kDone;
}

}  // namespace

int export_results(const ExportOptions& options) {
  if (!options.folder.empty() && sim::campaign::CampaignReader::has_database(options.folder)) {
    return export_campaign(options);
  }
  if (!options.describe && options.folder.empty()) {
    throw UsageError("export: DIR is missing, the folder of a result");
  }
  if (!options.table.empty() && sim::record::find_table(options.table) == nullptr) {
    throw UsageError(fmt::format("export: '{}' is no table of a result; there are: {}",
                                 options.table, sim::record::table_names()));
  }
  if (options.describe && !(options.folder.empty() && options.table.empty())) {
    throw UsageError("export: --describe is about every result, so no DIR but a campaign's");
  }
  if (!options.describe && sim::record::RunReader(options.folder).is_unfinished()) {
    fmt::print(stderr, "warning: {}: this run is unfinished: broken off, or still under way\n",
               options.folder);
  }
  // Everything that can be wrong with the result shows before a file is replaced.
  const std::string list = !options.describe && options.table.empty()
                               ? list_of_tables(sim::record::tables(),
                                                sim::record::RunReader(options.folder).count_rows())
                               : "";
  Output output(options.file);
  const auto write = [&output](std::string_view text) { output.write(text); };
  if (options.describe) {
    write(sim::record::describe_results());
  } else if (options.table.empty()) {
    write(list);
  } else {
    sim::report::write_csv(options.folder, options.table, write);
  }
  output.finish();
  return kDone;
}

}  // namespace gateway
