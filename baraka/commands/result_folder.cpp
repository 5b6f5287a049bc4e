#include "baraka/commands/result_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "gateway/process/exit_status.h"
#include "hal/files/config/suggest.h"
#include "results/campaign/campaign_reader.h"
#include "results/report/run_result.h"

namespace baraka::commands {
namespace {

namespace fs = std::filesystem;

void require_folder(const fs::path& given) {
  std::error_code error;
  const fs::file_status status = fs::status(given, error);
  if (fs::is_directory(status)) return;
  if (!fs::exists(status)) {
    throw gateway::process::UsageError(
        fmt::format("{}: there is no such folder{}; name the folder of a result, where a run "
                    "wrote run.sqlite",
                    given.string(), similar_folder(given)));
  }
  const bool is_database = given.extension() == ".sqlite" && given.has_parent_path();
  throw gateway::process::UsageError(
      fmt::format("{}: is a file, and the folder of a result is wanted{}", given.string(),
                  is_database ? fmt::format(": {}", given.parent_path().string()) : ""));
}

std::vector<fs::path> results_in(const fs::path& folder) {
  try {
    return results::report::find_results({folder});
  } catch (const fs::filesystem_error&) {
    throw;
  } catch (const std::runtime_error& e) {
    throw gateway::process::UsageError(e.what());
  }
}

}  // namespace

std::string similar_folder(const fs::path& given) {
  const fs::path named = given.has_filename() ? given : given.parent_path();  // "results/a/"
  const fs::path around = named.parent_path();
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(around.empty() ? "." : around, error), end; !error && at != end;
       at.increment(error)) {
    std::error_code unknown;
    if (at->is_directory(unknown)) names.push_back(at->path().filename().string());
  }
  std::ranges::sort(names);
  const auto best = hal::files::config::nearest(named.filename().string(), names);
  return best ? fmt::format("; did you mean '{}'?", (around / names[*best]).string()) : "";
}

void require_results(const std::vector<std::string>& folders) {
  for (const std::string& folder : folders) {
    require_folder(folder);
    if (!results::campaign::CampaignReader::has_database(folder)) results_in(folder);
  }
}

void require_result(const std::string& folder) {
  require_folder(folder);
  if (results::campaign::CampaignReader::has_database(folder)) return;
  const std::vector<fs::path> found = results_in(folder);
  if (found.front() == fs::path(folder)) return;
  throw gateway::process::UsageError(
      fmt::format("{}: has results in folders of its own; name one, such as {}", folder,
                  found.front().string()));
}

}  // namespace baraka::commands
