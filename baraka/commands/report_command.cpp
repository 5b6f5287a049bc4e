#include "baraka/commands/report_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>

#include "baraka/commands/output_file.h"
#include "baraka/commands/result_folder.h"
#include "gateway/process/exit_status.h"
#include "hal/files/config/document.h"
#include "hal/files/config/shared_folders.h"
#include "hal/types/pattern.h"
#include "hal/types/printable.h"
#include "hal/types/terminal_colours.h"
#include "results/report/csv.h"
#include "results/report/experiment_section.h"
#include "results/report/paired_differences.h"
#include "results/report/plot.h"
#include "results/report/plot_json.h"
#include "results/report/report.h"
#include "results/report/report_page.h"
#include "results/report/svg.h"
#include "sim/scenario/report_section.h"
#include "sim/scenario/resolved.h"
#include "sim/scenario/scenario.h"
#include "view/server/bundled_page.h"

namespace baraka::commands {
namespace {

using results::report::Experiment;
using results::report::RunResult;
using sim::scenario::PlotRequest;

/// The page without figures.
std::string empty_page() {
  return view::server::bundled_page(
      "report_page.html",
      "the report page is bundled with npm when that is installed; ./setup report_page installs it "
      "and builds the page. Without -o, report prints its tables");
}

/// Settings of the shipped case study of the paper; none if it is missing or no run asks for a
/// comparison.
std::optional<results::report::Settings> case_study(const std::vector<RunResult>& runs) {
  const auto asks = [](const RunResult& run) { return run.settings.contains("compare"); };
  if (!std::ranges::any_of(runs, asks)) return std::nullopt;
  const auto file = hal::files::config::find_shared("scenarios/case_study.yaml");
  if (!file) return std::nullopt;
  try {
    const auto values = sim::scenario::resolved_values(sim::scenario::load_scenario(*file, {}));
    return results::report::Settings(values.begin(), values.end());
  } catch (const std::exception& e) {
    hal::print_line(hal::Tone::kWarning,
                    fmt::format("warning: the paper's figures are left out: {}", e.what()));
    return std::nullopt;
  }
}

/// Reads `report:` from a scenario file.
std::vector<PlotRequest> requests_in(const std::filesystem::path& scenario) {
  auto document = hal::files::config::Document::load(scenario);
  auto root = document.root();
  sim::scenario::FieldReader reader(root);
  std::vector<PlotRequest> requests;
  sim::scenario::report_keys(reader, requests);
  document.finish();
  return requests;
}

/// A temporary file with a unique name; removed by the destructor.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text)
      : path_((std::filesystem::temp_directory_path() / "baraka-XXXXXX.yaml").string()) {
    const int file = ::mkstemps(path_.data(), 5);
    if (file < 0) throw std::runtime_error(path_ + ": cannot be written");
    ::close(file);
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~TemporaryFile() { ::unlink(path_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Reads `report:` from the text of a scenario.
/// @throws std::runtime_error  it cannot be read; the message has its place in the campaign
std::vector<PlotRequest> requests_of_campaign(const Experiment& experiment) {
  const TemporaryFile file(experiment.scenario);
  try {
    return requests_in(file.path());
  } catch (const std::exception& e) {
    std::string what = e.what();
    for (std::size_t at = 0; (at = what.find(file.path(), at)) != std::string::npos;) {
      what.replace(at, file.path().size(), "scenario");
    }
    throw std::runtime_error(fmt::format("{}: {}", experiment.scenario_place, what));
  }
}

results::report::Sources read_all(const ReportOptions& options) {
  require_results(options.folders);
  auto sources = results::report::read_sources({options.folders.begin(), options.folders.end()});
  for (Experiment& one : sources.experiments) {
    if (!options.scenario.empty()) {
      one.requests = requests_in(options.scenario);
    } else if (one.requests.empty() && !one.scenario.empty()) {
      one.requests = requests_of_campaign(one);
    }
  }
  return sources;
}

std::string csv_of(const results::report::Plot& plot) {
  std::string text;
  for (const auto& row : plot_rows(plot, results::report::Digits::kExact)) {
    for (std::size_t i = 0; i < row.size(); ++i)
      text += (i == 0 ? "" : ",") + (row[i].empty() ? "" : results::report::csv_text(row[i]));
    text += "\r\n";
  }
  return text;
}

/// The requested figure: the one of that name in `report:`, otherwise a new one. Options of the
/// command line override its keys.
PlotRequest request_of(const Experiment& experiment, const ReportOptions& options) {
  const std::vector<PlotRequest> requests = results::report::requests_of(experiment);
  PlotRequest request;
  request.plot = options.figure;
  for (const PlotRequest& one : requests) {
    if (one.plot != options.figure && !(options.figure.empty() && requests.size() == 1)) continue;
    request = one;
    break;
  }
  if (request.plot.empty()) {
    std::string names;
    for (const PlotRequest& one : requests) names += "\n  " + one.plot;
    throw std::runtime_error(
        "which figure? --figure NAME takes any quantity that `baraka describe "
        "observables` lists" +
        (names.empty() ? names : "; the report has" + names));
  }
  const auto replace = [](std::string& value, const std::string& by) {
    if (!by.empty()) value = by;
  };
  replace(request.versus, options.versus);
  replace(request.by, options.by);
  replace(request.agent, options.agent);
  // Over time there is no axis of settings.
  if (!options.versus.empty() && request.as == sim::scenario::PlotKind::kTime) {
    request.as = sim::scenario::PlotKind::kAutomatic;
  }
  if (options.as) request.as = *options.as;
  if (options.interval) request.interval = *options.interval;
  return request;
}

const Experiment& only_one(const std::vector<Experiment>& experiments) {
  if (experiments.size() == 1) return experiments.front();
  throw std::runtime_error(
      "a figure is of one experiment: name one campaign, or folders of results");
}

/// The quantities that a pattern stands for; the name itself, if it is none or matches none.
std::vector<std::string> figures_of(const Experiment& experiment, const std::string& figure) {
  const bool is_pattern = figure.find_first_of("*?") != std::string::npos;
  if (!is_pattern || experiment.units.contains(figure)) return {figure};
  std::vector<std::string> names;
  for (const auto& [name, unit] : experiment.units) {
    if (hal::matches(figure, name)) names.push_back(name);
  }
  if (names.empty()) names.push_back(figure);
  return names;
}

void print_figure(const Experiment& experiment, const PlotRequest& request) {
  fmt::print("{}{}", hal::printable_lines(plot_text(make_plot(experiment, request))),
             hal::printable_lines(pairs_text(experiment, request)));
}

/// Prints the figure as a table, those of a pattern one below the other, or writes it to a file in
/// the format given by the file's extension.
int report_figure(const results::report::Sources& sources, ReportOptions options) {
  const Experiment& experiment = only_one(sources.experiments);
  const std::vector<std::string> names = figures_of(experiment, options.figure);
  if (names.size() > 1 && !options.file.empty()) {
    throw std::runtime_error(fmt::format("-o {}: a file has one figure, and {} stands for {}: {}",
                                         options.file, options.figure, names.size(),
                                         fmt::join(names, ", ")));
  }
  if (options.file.empty()) {
    for (const std::string& name : names) {
      options.figure = name;
      if (name != names.front()) fmt::print("\n");
      print_figure(experiment, request_of(experiment, options));
    }
    return gateway::process::kDone;
  }
  options.figure = names.front();
  const PlotRequest request = request_of(experiment, options);
  const results::report::Plot plot = make_plot(experiment, request);
  if (options.file.ends_with(".json")) {
    write_output(options.file, plot_json(plot, experiment.points.empty() ? "" : experiment.label(0),
                                         results::report::paired_differences(experiment, request)));
  } else {
    write_output(options.file, options.file.ends_with(".csv") ? csv_of(plot) : svg(plot));
  }
  for (const std::string& note : plot.notes) fmt::print("note: {}\n", hal::printable(note));
  fmt::print("figure: {}\n", options.file);
  return gateway::process::kDone;
}

/// Refuses an extension whose format cannot be written. A file without extension (/dev/stdout) is a
/// page or a drawing.
void check_ending(const ReportOptions& options) {
  const std::string ending = std::filesystem::path(options.file).extension().string();
  if (ending.empty() || ending == ".svg" || ending == ".csv" || ending == ".json") return;
  const bool is_page = options.figure.empty();
  if (is_page && (ending == ".html" || ending == ".htm")) return;
  throw std::runtime_error(
      fmt::format("-o {}: a figure is written as .svg, .csv or .json{}", options.file,
                  is_page ? ", the whole report as .html" : "; the page .html has all of them"));
}

}  // namespace

std::string page_of(const std::string& folder) {
  const std::string page = empty_page();
  ReportOptions options;
  options.folders = {folder};
  const results::report::Sources sources = read_all(options);
  return results::report::report_page(sources, case_study(sources.runs), page);
}

int report(const ReportOptions& options) {
  check_ending(options);
  const bool is_drawing = options.file.ends_with(".svg") || options.file.ends_with(".csv") ||
                          options.file.ends_with(".json");
  const bool is_page = !is_drawing && options.figure.empty() && !options.file.empty();
  const std::string page = is_page ? empty_page() : "";
  const results::report::Sources sources = read_all(options);
  if (!options.resamples.empty()) {
    write_output(options.resamples, results::report::resamples_csv(only_one(sources.experiments)));
  }
  if (is_drawing || !options.figure.empty()) return report_figure(sources, options);
  if (options.file.empty()) {
    // Made printable because titles and notes, like cells, contain names from the record.
    fmt::print("{}",
               hal::printable_lines(results::report::report(sources, case_study(sources.runs))));
    return gateway::process::kDone;
  }
  write_output(options.file, results::report::report_page(sources, case_study(sources.runs), page));
  fmt::print("page: {}\n", options.file);
  return gateway::process::kDone;
}

}  // namespace baraka::commands
