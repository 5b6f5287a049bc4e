#include "gateway/view/run.h"

#include <exception>
#include <utility>

#include "gateway/view/world.h"

namespace gateway::view {
namespace {

/// The record, open while an answer is made.
class Opened {
 public:
  explicit Opened(Record& record) : record_(record) { record_.open(); }
  ~Opened() { record_.close_if_growing(); }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

 private:
  Record& record_;
};

/// As it was stored with the results; none: by another version, or removed.
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
  if (!record_) {
    if (path != "world") return std::nullopt;
    return world_json(nullptr, &*scenario_, name_, said_);
  }
  const Opened opened(*record_);
  return answer_open(path);
}

std::optional<std::string> Run::answer_open(std::string_view path) {
  if (path == "world") {
    return world_json(&*record_, scenario_ ? &*scenario_ : nullptr, name_, said_);
  }
  return std::nullopt;
}

}  // namespace gateway::view
