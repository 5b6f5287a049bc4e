#include "view/server/run.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "view/server/coverage.h"
#include "view/server/movables.h"
#include "view/server/plain_integer.h"
#include "view/server/tiles.h"
#include "view/server/world.h"

namespace view::server {
namespace {

/// Keeps the record open while an answer is made.
class Opened {
 public:
  explicit Opened(Record& record) : record_(record), is_same_(record_.open()) {}
  ~Opened() { record_.close_if_growing(); }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

  bool is_same() const { return is_same_; }

 private:
  Record& record_;
  bool is_same_;
};

/// The scenario as stored with the results; none if it is of another version, or was removed.
std::optional<sim::scenario::Scenario> stored_scenario(const std::filesystem::path& folder) {
  try {
    return sim::scenario::load_scenario(folder / "scenario.resolved.yaml");
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace

Run::Run(const std::filesystem::path& folder)
    : folder_(std::filesystem::absolute(folder)),
      record_(folder_),
      scenario_(stored_scenario(folder_)) {
  const Opened opened(*record_);
  name_ = record_->value("scenario");
  if (name_.empty()) name_ = folder_.filename().string();
}

Run::Run(const std::filesystem::path& file, sim::scenario::Scenario scenario,
         std::vector<std::string> said)
    : folder_(file), name_(scenario.name), scenario_(std::move(scenario)), said_(std::move(said)) {}

Run::~Run() = default;

std::optional<std::string> Run::answer(std::string_view path) {
  const std::lock_guard lock(mutex_);
  if (path == "coverage") return coverage();
  if (!record_) {
    if (path != "world") return std::nullopt;
    return world_json(nullptr, &*scenario_, name_, said_);
  }
  const Opened opened(*record_);
  if (!opened.is_same()) known_ = {};
  return answer_open(path);
}

Run::Contents Run::contents() {
  const std::lock_guard lock(mutex_);
  Contents contents;
  if (!record_) return contents;
  const Opened opened(*record_);
  contents.kinds.assign(kKinds.begin(), kKinds.end());
  for (const std::int64_t index : SeriesStore::indices(*record_)) {
    contents.kinds.push_back("series:" + std::to_string(index));
  }
  contents.agents = record_->agents();
  contents.until = record_->until();
  return contents;
}

std::optional<std::string> Run::answer_open(std::string_view path) {
  if (path == "world") return world();
  const std::size_t first = path.find('/');
  if (first == std::string_view::npos) return std::nullopt;
  const std::string_view kind = path.substr(0, first), rest = path.substr(first + 1);
  const std::size_t second = rest.find('/');
  if (second == std::string_view::npos) {
    const auto agent = plain_integer(rest);
    return agent ? of_agent(kind, *agent) : std::nullopt;
  }
  const auto level = plain_integer(rest.substr(0, second));
  const auto index = plain_integer(rest.substr(second + 1));
  const auto span = level && index ? Span::of(*level, *index) : std::nullopt;
  return span ? tile(kind, *span) : std::nullopt;
}

std::string Run::coverage() {
  if (!scenario_) return R"({"error": "the scenario can no longer be read"})";
  if (known_.coverage.empty()) known_.coverage = coverage_json(*scenario_);
  return known_.coverage;
}

std::string Run::world() {
  if (!known_.world.empty()) return known_.world;
  std::string text = world_json(&*record_, scenario_ ? &*scenario_ : nullptr, name_, said_);
  if (!record_->is_growing()) known_.world = text;
  return text;
}

std::optional<std::string> Run::of_agent(std::string_view kind, std::int64_t agent) {
  if (!std::ranges::binary_search(record_->agents(), agent)) return std::nullopt;
  if (kind == "routes") return routes_json(*record_, agent);
  if (kind == "totals") return totals_json(*record_, agent);
  return std::nullopt;
}

std::optional<std::string> Run::tile(std::string_view kind, const Span& span) {
  constexpr std::string_view kSeries = "series:";
  if (kind == "poses") return poses_tile(*record_, span);
  if (kind == "movables") return movables_tile(*record_, span);
  if (kind == "frames") return frames_tile(*record_, known_.frames, span);
  if (kind == "messages") return messages_tile(*record_, known_.messages, span);
  if (kind == "states") return states_tile(*record_, known_.states, span);
  if (kind == "events") return events_tile(*record_, span);
  if (kind == "readings") return readings_tile(*record_, known_.readings, span);
  if (kind == "queues") return queues_tile(*record_, known_.queues, span);
  if (kind == "log") return known_.log.tile(*record_, span);
  if (!kind.starts_with(kSeries)) return std::nullopt;
  const auto number = plain_integer(kind.substr(kSeries.size()));
  if (!number) return std::nullopt;
  std::string text = known_.series.tile(*record_, *number, span);
  if (text.empty()) return std::nullopt;
  return text;
}

}  // namespace view::server
