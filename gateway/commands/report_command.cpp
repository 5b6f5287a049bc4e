#include "gateway/commands/report_command.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>

#include "gateway/exit_status.h"
#include "hal/config/shared_folders.h"
#include "sim/report/report.h"
#include "sim/report/report_page.h"
#include "sim/scenario/resolved.h"
#include "sim/scenario/scenario.h"

namespace gateway {
namespace {

/// The page without figures. It lies beside this program, if it was built, or where it was
/// installed.
std::string empty_page() {
  const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const auto installed = hal::config::find_shared("report_page.html");
  const std::filesystem::path path = installed.value_or(folder / "report_page.html");
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw std::runtime_error(fmt::format(
        "{} is missing, and no report_page.html is in {}: the report page is bundled with npm when "
        "that is installed; "
        "./setup report_page installs it and builds the page. Without -o, report prints "
        "its tables",
        path.string(), hal::config::listed_shared_folders()));
  }
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Settings of the paper's case study, as it is shipped; none if it is not there.
std::optional<sim::report::Settings> case_study() {
  const auto file = hal::config::find_shared("scenarios/case_study.yaml");
  if (!file) return std::nullopt;
  try {
    const auto values = sim::scenario::resolved_values(sim::scenario::load_scenario(*file, {}));
    return sim::report::Settings(values.begin(), values.end());
  } catch (const std::exception& e) {
    fmt::print(stderr, "warning: the paper's figures are left out: {}\n", e.what());
    return std::nullopt;
  }
}

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace

int report(const std::vector<std::string>& folders, const std::string& page) {
  const std::vector<std::filesystem::path> results(folders.begin(), folders.end());
  if (page.empty()) {
    fmt::print("{}", sim::report::report(results, case_study()));
    return kDone;
  }
  write(page, sim::report::report_page(results, case_study(), empty_page()));
  fmt::print("page: {}\n", page);
  return kDone;
}

}  // namespace gateway
