#include "view/server/view_api.h"

#include <utility>

#include "results/report/run_result.h"
#include "view/server/json_text.h"
#include "view/server/plain_integer.h"

namespace view::server {
namespace {

/// Version of the format of the answers: a page that knows another version reports it.
constexpr int kVersion = 1;

std::string_view name_of(ViewApi::Mode mode) {
  switch (mode) {
    case ViewApi::Mode::kReplay:
      return "replay";
    case ViewApi::Mode::kLive:
      return "live";
    case ViewApi::Mode::kScenario:
      return "scenario";
  }
  return {};
}

/// Removes a prefix. @return whether it was there.
bool take(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

}  // namespace

ViewApi::ViewApi(std::vector<std::unique_ptr<Run>> runs, Mode mode, bool can_command)
    : runs_(std::move(runs)), mode_(mode), can_command_(can_command) {}

std::string ViewApi::view() const {
  JsonArray runs;
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    runs.add(JsonObject()
                 .add("index", i)
                 .add("name", runs_[i]->name())
                 .add("folder", runs_[i]->folder().string())
                 .json());
  }
  return JsonObject()
      .add("version", kVersion)
      .add("mode", name_of(mode_))
      .add("can_command", can_command_)
      .add("runs", runs.json())
      .json()
      .text;
}

std::optional<std::string> ViewApi::get(std::string_view path) const {
  if (path == "/api/view") return view();
  if (!take(path, "/api/runs/")) return std::nullopt;
  const std::size_t slash = path.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto run = plain_integer(path.substr(0, slash));
  if (!run || *run >= static_cast<std::int64_t>(runs_.size())) return std::nullopt;
  return runs_[static_cast<std::size_t>(*run)]->answer(path.substr(slash + 1));
}

std::vector<std::unique_ptr<Run>> open_results(const std::vector<std::filesystem::path>& folders) {
  std::vector<std::unique_ptr<Run>> runs;
  for (const auto& folder : results::report::find_results(folders)) {
    runs.push_back(std::make_unique<Run>(folder));
  }
  return runs;
}

}  // namespace view::server
