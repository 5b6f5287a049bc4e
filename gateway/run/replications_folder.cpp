#include "gateway/run/replications_folder.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "gateway/run/result_marker.h"
#include "gateway/run/results_folder.h"
#include "hal/config/errors.h"
#include "sim/record/database.h"

namespace gateway {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNewIdentityFile = "replications.yaml.new";
constexpr const char* kIdentityStart = "# version: ";

std::string identity_of(const std::string& scenario, std::optional<double> until) {
  return fmt::format("{}{}\n# until: {}\n{}", kIdentityStart, BARAKA_VERSION,
                     until ? fmt::format("{} s", *until) : "its end", scenario);
}

std::string read(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The first lines that differ, for a message.
std::string difference(const std::string& old_text, const std::string& new_text) {
  std::istringstream old_lines(old_text), new_lines(new_text);
  std::string before, after;
  do {
    if (!std::getline(old_lines, before)) before.clear();
    if (!std::getline(new_lines, after)) after.clear();
  } while (before == after && (old_lines || new_lines));
  return fmt::format("there '{}', now '{}'", before, after);
}

std::map<std::string, std::string> values_of(const fs::path& file) {
  sim::record::Database database(file, sim::record::Database::Mode::kRead);
  sim::record::Statement query(database, "SELECT key, value FROM run");
  std::map<std::string, std::string> values;
  while (query.next()) values[query.text(0)] = query.text(1);
  return values;
}

}  // namespace

std::string Replication::name() const { return fmt::format("replication-{:02}", number); }

ReplicationsFolder::ReplicationsFolder(const fs::path& path, const Settings& settings)
    : path_(folder_named(path)) {
  if (path_.has_parent_path()) make_folder(path_.parent_path());
  lock_.emplace(path_);
  finish_set_aside(path_);
  const auto old = fs::exists(scenario()) ? std::nullopt : make(settings.overwrite);
  claim(identity_of(settings.scenario, settings.until));
  if (old && settings.overwrite) remove_result(*old);
}

/// A folder with nothing in it. @return where an earlier result is now.
std::optional<fs::path> ReplicationsFolder::make(bool overwrite) {
  const fs::path half = path_ / kNewIdentityFile;
  // Half written by one that was killed.
  const std::string begun = read(half);
  const std::string_view start = kIdentityStart;
  if (fs::is_regular_file(fs::symlink_status(half)) &&
      begun.starts_with(start.substr(0, begun.size()))) {
    fs::remove(half);
  }
  require_result_or_nothing(path_);
  std::optional<fs::path> old = set_aside(path_, overwrite);
  make_folder(path_);
  if (old && !overwrite) fmt::print(stderr, "the earlier result is kept: {}\n", old->string());
  return old;
}

void ReplicationsFolder::claim(const std::string& identity) {
  if (fs::exists(scenario())) {
    const std::string old = read(scenario());
    if (old == identity) return;
    throw hal::config::ConfigErrors(
        {fmt::format("{}: holds replications of another scenario: {}; give another --out, or "
                     "remove the folder",
                     path_.string(), difference(old, identity))});
  }
  const fs::path half = path_ / kNewIdentityFile;
  std::ofstream out(half);
  out << identity;
  out.close();
  if (!out) throw std::runtime_error(fmt::format("{}: cannot be written", half.string()));
  fs::rename(half, scenario());
}

fs::path ReplicationsFolder::scenario() const { return path_ / kReplicationsFile; }

std::optional<ReplicationEnd> ReplicationsFolder::end_of(const Replication& replication) const {
  const fs::path file = path_ / replication.name() / "run.sqlite";
  if (!fs::exists(file)) return std::nullopt;
  try {
    std::map<std::string, std::string> values = values_of(file);
    const auto status = values.find("exit_status");
    if (status == values.end() || values["seed"] != std::to_string(replication.seed)) {
      return std::nullopt;
    }
    return ReplicationEnd{std::stoi(status->second), values["result"], values["error"]};
  } catch (const std::exception&) {
    return std::nullopt;  // cut short before its tables were complete
  }
}

std::string ReplicationsFolder::last_words(const Replication& replication) const {
  constexpr std::string_view kError = "error: ";
  std::ifstream log(path_ / (replication.name() + ".log"));
  std::string last;
  for (std::string line; std::getline(log, line);) {
    if (line.starts_with(kError)) return line.substr(kError.size());
    if (!line.empty()) last = line;
  }
  return last;
}

}  // namespace gateway
