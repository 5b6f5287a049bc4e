#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "results/record/run_reader.h"
#include "results/report/run_result.h"

namespace results::report {
namespace {

namespace fs = std::filesystem;
using record::kResultsFile;

/// Whether a folder holds an earlier result beside its successor ("name.2" beside "name"), or an
/// attempt that did not start.
bool is_put_aside(const fs::path& folder) {
  const std::string end = folder.extension().string();
  if (end == ".not-started") return true;
  const bool is_number =
      end.size() > 1 && end.find_first_not_of("0123456789", 1) == std::string::npos;
  return is_number && fs::exists(folder.parent_path() / folder.stem() / kResultsFile);
}

std::vector<fs::path> results_inside(const fs::path& folder) {
  std::vector<fs::path> inside;
  if (!fs::is_directory(folder)) return inside;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!fs::exists(entry.path() / kResultsFile)) continue;
    if (!is_put_aside(entry.path())) inside.push_back(entry.path());
  }
  std::sort(inside.begin(), inside.end(), [](const fs::path& a, const fs::path& b) {
    const std::string x = a.string();
    const std::string y = b.string();
    return x.size() != y.size() ? x.size() < y.size() : x < y;  // puts seed_2 before seed_10
  });
  return inside;
}

}  // namespace

std::vector<fs::path> find_results(const std::vector<fs::path>& folders) {
  std::vector<fs::path> results;
  std::set<fs::path> seen;
  for (const fs::path& folder : folders) {
    const std::vector<fs::path> found =
        fs::exists(folder / kResultsFile) ? std::vector{folder} : results_inside(folder);
    if (found.empty()) {
      throw std::runtime_error(
          fmt::format("{}: holds no result (no {})", folder.string(), kResultsFile));
    }
    for (const fs::path& one : found) {
      if (seen.insert(fs::canonical(one)).second) results.push_back(one);
    }
  }
  return results;
}

}  // namespace results::report
