#include "baraka/commands/diff_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <vector>

#include "baraka/commands/output_file.h"
#include "baraka/commands/result_folder.h"
#include "gateway/process/exit_status.h"
#include "hal/types/printable.h"
#include "hal/types/terminal_colours.h"
#include "results/record/run_difference.h"
#include "results/record/run_reader.h"

namespace baraka::commands {
namespace {

using results::record::RunDifference;
using results::record::RunReader;
using Key = RunDifference::Key;

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

/// @throws UsageError  it is not the folder of one run.
void require_run(const std::string& folder) {
  require_result(folder);
  if (std::filesystem::exists(std::filesystem::path(folder) / results::record::kResultsFile))
    return;
  throw gateway::process::UsageError(
      fmt::format("{}: is a campaign, and diff compares two runs; its runs lie below", folder));
}

void warn_if_unfinished(RunReader& run) {
  if (!run.is_unfinished()) return;
  hal::print_line(hal::Tone::kWarning,
                  fmt::format("warning: {}: this run is unfinished: broken off, or still under way",
                              hal::printable(run.folder().string())));
}

std::string shown(const std::string& value) { return value.empty() ? "-" : value; }

std::string line_of(const Key& key) {
  if (key.is_equal()) return fmt::format("{}: {}", key.name, shown(key.first));
  return fmt::format("{}: {} | {}", key.name, shown(key.first), shown(key.second));
}

void add_settings(std::vector<std::string>& lines, const std::vector<Key>& settings) {
  constexpr std::size_t kMostLines = 10;
  lines.push_back(settings.empty() ? "settings: equal"
                                   : fmt::format("settings: {} differ", settings.size()));
  for (std::size_t i = 0; i < std::min(kMostLines, settings.size()); ++i)
    lines.push_back("  " + line_of(settings[i]));
  if (settings.size() > kMostLines)
    lines.push_back(fmt::format("  and {} more", settings.size() - kMostLines));
}

void add(std::vector<std::string>& lines, const RunDifference::Happening& happening,
         const DiffOptions& options) {
  std::string what = happening.what;
  if (what.empty())
    what = fmt::format("only in {}", happening.first.empty() ? options.other : options.folder);
  lines.push_back(fmt::format("difference: {}.{:09} s, {}, {}, {}: {}",
                              happening.at_ns / kNanosecondsPerSecond,
                              happening.at_ns % kNanosecondsPerSecond, happening.table,
                              happening.stations, happening.protocol, what));
  const auto add_row = [&lines](const std::string& name, const std::string& row) {
    lines.push_back(fmt::format("  {}: {}", name, row.empty() ? "no more" : row));
  };
  if (!happening.before.empty()) add_row("before", happening.before);
  add_row(options.folder, happening.first);
  add_row(options.other, happening.second);
}

std::vector<std::string> lines_of(const RunDifference& difference, const DiffOptions& options) {
  std::vector<std::string> lines;
  for (const Key& key : difference.causes) lines.push_back(line_of(key));
  add_settings(lines, difference.settings);
  for (const Key& key : difference.outcomes) lines.push_back(line_of(key));
  if (difference.hash) {
    lines.push_back(fmt::format("fingerprints: differ from second {} on, first in {} of {}",
                                difference.hash->second, difference.hash->part,
                                difference.hash->agent));
  }
  if (difference.happening) add(lines, *difference.happening, options);
  for (const std::string& note : difference.notes) lines.push_back("note: " + note);
  lines.push_back(fmt::format("runs: {}", difference.is_equal() ? "equal" : "different"));
  return lines;
}

RunDifference compare(const DiffOptions& options) {
  for (const std::string& folder : {options.folder, options.other}) require_run(folder);
  RunReader one(options.folder), other(options.other);
  for (RunReader* const run : {&one, &other}) warn_if_unfinished(*run);
  return results::record::compare_runs(one, other);
}

}  // namespace

int diff(const DiffOptions& options) {
  try {
    const RunDifference difference = compare(options);
    OutputFile output("");
    // Names and settings may contain line feeds.
    for (const std::string& line : lines_of(difference, options))
      output.write(hal::printable(line) + "\n");
    output.finish();
    return difference.is_equal() ? gateway::process::kDone : kDifferent;
  } catch (const std::exception& e) {
    // 1, the status of other failures, says that the runs differ.
    throw gateway::process::UsageError(e.what());
  }
}

}  // namespace baraka::commands
