#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "sim/report/group.h"
#include "sim/report/plot_request.h"

namespace sim::report {
namespace {

constexpr const char* kVersion = "version of baraka";

Settings settings_of(const RunResult& run) {
  Settings settings = run.settings;
  std::erase_if(settings, [](const auto& setting) {
    return setting.first == "seed" || is_for_the_report_only(setting.first);
  });
  settings[kVersion] = run.value("version");
  return settings;
}

/// Whether runs may differ in it and still be of the paper's case study: what is varied to be
/// compared with it, and what does not change the course of a run or only cuts it short.
bool may_vary(const std::string& key) {
  static const std::set<std::string> keys = {"name",   "seed",          kVersion,   "--until",
                                             "--pace", "reply_timeout", "on_death", "wait"};
  return keys.contains(key) || is_for_the_report_only(key) || key.starts_with("radio.") ||
         key.starts_with("record.") || key.starts_with("expect.") ||
         key.ends_with(".controller.processes");
}

std::string value_in(const Settings& settings, const std::string& key) {
  const auto found = settings.find(key);
  return found == settings.end() ? "-" : found->second;
}

std::set<std::string> keys_of(const std::vector<const Settings*>& all) {
  std::set<std::string> keys;
  for (const Settings* settings : all) {
    for (const auto& [key, value] : *settings) keys.insert(key);
  }
  return keys;
}

/// What keeps runs of these settings from being of the paper's case study; empty: nothing.
std::string not_the_papers(const Settings& settings, const std::optional<Settings>& case_study) {
  if (!case_study) return "the paper's case study was not found, to compare with";
  std::size_t count = 0;
  std::string first;
  for (const std::string& key : keys_of({&settings, &*case_study})) {
    const std::string ours = value_in(settings, key);
    const std::string theirs = value_in(*case_study, key);
    if (may_vary(key) || ours == theirs) continue;
    if (count++ == 0) first = fmt::format("{} is {}, not {}", key, ours, theirs);
  }
  if (count == 0) return {};
  return count == 1 ? first : fmt::format("{}, and {} more settings differ", first, count - 1);
}

std::string last_part(const std::string& key) {
  const std::size_t dot = key.rfind('.');
  return dot == std::string::npos ? key : key.substr(dot + 1);
}

/// Tells groups apart that have the same name. @param same  at least two.
void tell_apart(const std::vector<Group*>& same) {
  std::vector<Group> groups;
  groups.reserve(same.size());
  for (const Group* group : same) groups.push_back(*group);
  const std::vector<Difference> found = differences(groups);
  for (std::size_t i = 0; i < same.size(); ++i) {
    same[i]->name += found.size() == 1 ? fmt::format(", {} {}", last_part(found.front().key),
                                                     found.front().values[i])
                                       : fmt::format(" ({})", i + 1);
  }
}

void name_apart(std::vector<Group>& groups) {
  std::map<std::string, std::vector<Group*>> by_name;
  for (Group& group : groups) by_name[group.name].push_back(&group);
  for (auto& [name, same] : by_name) {
    if (same.size() > 1) tell_apart(same);
  }
}

}  // namespace

std::vector<Difference> differences(const std::vector<Group>& groups) {
  std::vector<const Settings*> all;
  all.reserve(groups.size());
  for (const Group& group : groups) all.push_back(&group.settings);
  std::vector<Difference> found;
  for (const std::string& key : keys_of(all)) {
    Difference difference{key, {}};
    for (const Settings* settings : all) difference.values.push_back(value_in(*settings, key));
    const auto& values = difference.values;
    if (std::ranges::adjacent_find(values, std::not_equal_to<>()) != values.end()) {
      found.push_back(std::move(difference));
    }
  }
  return found;
}

bool has_the_papers(const std::vector<Group>& groups) {
  return std::ranges::any_of(groups, [](const Group& g) { return g.is_the_papers(); });
}

/// Whether the group has a run like this one, which so tells nothing new.
static bool is_copy(const RunResult& run, const Group& group) {
  const std::string fingerprint = run.value("fingerprint");
  if (fingerprint.empty()) return false;
  return std::ranges::any_of(group.runs, [&](const RunResult* other) {
    return other->value("seed") == run.value("seed") && other->value("fingerprint") == fingerprint;
  });
}

/// Whether the group is to be compared with the paper's figures, as its first run says.
static void compare_with_papers(const RunResult& run, const std::optional<Settings>& case_study,
                                Group& group) {
  const auto compare = run.settings.find("compare");
  group.asks_for_papers = compare != run.settings.end() && compare->second == "labella2009";
  if (group.asks_for_papers) group.not_the_papers = not_the_papers(group.settings, case_study);
}

std::vector<Group> group_runs(const std::vector<RunResult>& runs,
                              const std::optional<Settings>& case_study) {
  using Key = std::tuple<std::string, std::string, Settings>;
  std::set<std::string> scenarios;
  for (const RunResult& run : runs) scenarios.insert(run.value("scenario"));
  std::vector<std::pair<Key, Group>> keyed;
  for (const RunResult& run : runs) {
    const Key key{run.value("scenario"), run.value("profile"), settings_of(run)};
    const auto& [scenario, profile, settings] = key;
    auto place = std::ranges::find(keyed, key, &std::pair<Key, Group>::first);
    if (place == keyed.end()) {
      const std::string name =
          scenarios.size() > 1 ? fmt::format("{}/{}", scenario, profile) : profile;
      keyed.push_back({key, {name, settings, {}, 0, false, ""}});
      place = std::prev(keyed.end());
      compare_with_papers(run, case_study, place->second);
    }
    if (run.is_complete() && !is_copy(run, place->second)) {
      place->second.runs.push_back(&run);
    } else {
      ++place->second.left_out;
    }
  }
  std::vector<Group> groups;
  groups.reserve(keyed.size());
  for (auto& [key, group] : keyed) groups.push_back(std::move(group));
  name_apart(groups);
  return groups;
}

}  // namespace sim::report
