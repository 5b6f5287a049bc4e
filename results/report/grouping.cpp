#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "results/report/group.h"
#include "sim/scenario/plot_request.h"

namespace results::report {
namespace {

constexpr const char* kVersion = "version of baraka";

Settings settings_of(const RunResult& run) {
  Settings settings = run.settings;
  std::erase_if(settings, [](const auto& setting) {
    return setting.first == "seed" || sim::scenario::is_for_the_report_only(setting.first);
  });
  settings[kVersion] = run.value("version");
  return settings;
}

/// Whether runs that differ in this setting still belong to the paper's case study: settings that
/// are varied for the comparison, and settings that do not change a run or only shorten it.
bool may_vary(const std::string& key) {
  static const std::set<std::string> keys = {"name",   "seed",          kVersion,   "--until",
                                             "--pace", "reply_timeout", "on_death", "wait"};
  return keys.contains(key) || sim::scenario::is_for_the_report_only(key) ||
         key.starts_with("radio.") || key.starts_with("record.") || key.starts_with("expect.") ||
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

/// Why runs with these settings do not belong to the paper's case study; empty: they do.
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

using Parts = std::vector<std::string>;

Parts parts_of(const std::string& folder) {
  Parts parts;
  for (const auto& part : std::filesystem::path(folder).lexically_normal()) {
    if (!part.empty() && part != ".") parts.push_back(part.string());
  }
  return parts;
}

/// Number of leading parts, counted from `begin`, that all paths share. At least one part of each
/// path is not counted.
template <class Begin>
std::size_t equal_parts(const std::vector<Parts>& paths, Begin begin) {
  std::size_t shortest = paths.front().size();
  for (const Parts& path : paths) shortest = std::min(shortest, path.size());
  std::size_t equal = 0;
  const auto is_equal = [&](const Parts& path) {
    return *(begin(path) + static_cast<std::ptrdiff_t>(equal)) ==
           *(begin(paths.front()) + static_cast<std::ptrdiff_t>(equal));
  };
  while (equal + 1 < shortest && std::ranges::all_of(paths, is_equal)) ++equal;
  return equal;
}

/// The folders' names without the parts that all of them share.
std::vector<std::string> short_folders(const std::vector<Group*>& same) {
  std::vector<Parts> paths;
  paths.reserve(same.size());
  for (const Group* group : same) paths.push_back(parts_of(group->folder));
  const std::size_t head = equal_parts(paths, [](const Parts& path) { return path.begin(); });
  for (Parts& path : paths) path.erase(path.begin(), path.begin() + std::ptrdiff_t(head));
  const std::size_t tail = equal_parts(paths, [](const Parts& path) { return path.rbegin(); });
  std::vector<std::string> folders;
  for (const Parts& path : paths) {
    std::string& folder = folders.emplace_back();
    for (std::size_t i = 0; i + tail < path.size(); ++i) folder += (i == 0 ? "" : "/") + path[i];
  }
  return folders;
}

/// Makes equal names of groups distinct. @param same  at least two groups with the same name.
void tell_apart(const std::vector<Group*>& same) {
  std::vector<Group> groups;
  groups.reserve(same.size());
  for (const Group* group : same) groups.push_back(*group);
  const std::vector<Difference> found = differences(groups);
  const std::vector<std::string> folders = short_folders(same);
  for (std::size_t i = 0; i < same.size(); ++i) {
    same[i]->name += ", " + (found.size() == 1
                                 ? fmt::format("{} {}", last_part(found[0].key), found[0].values[i])
                                 : folders[i]);
  }
}

/// The beginning and the end of a name with the number between them; never cuts a UTF-8 character.
std::string shortened(const std::string& name, std::size_t number) {
  const auto is_inside = [&name](std::size_t at) {
    return (static_cast<unsigned char>(name[at]) & 0xC0U) == 0x80U;
  };
  const std::string mark = fmt::format("...{}...", number);
  const std::size_t kept = kLongestName - mark.size();
  std::size_t head = kept / 2, tail = name.size() - (kept - kept / 2);
  while (head > 0 && is_inside(head)) --head;
  while (tail < name.size() && is_inside(tail)) ++tail;
  return name.substr(0, head) + mark + name.substr(tail);
}

void name_apart(std::vector<Group>& groups) {
  std::map<std::string, std::vector<Group*>> by_name;
  for (Group& group : groups) by_name[group.name].push_back(&group);
  for (auto& [name, same] : by_name) {
    if (same.size() > 1) tell_apart(same);
  }
  for (std::size_t i = 0; groups.size() > 1 && i < groups.size(); ++i) {
    if (groups[i].name.size() <= kLongestName) continue;
    groups[i].full_name = groups[i].name;
    groups[i].name = shortened(groups[i].full_name, i + 1);
  }
}

/// The name of a group before it is made distinct from others.
/// @param profiles  radio profiles by scenario.
std::string base_name(const RunResult& run,
                      const std::map<std::string, std::set<std::string>>& profiles) {
  std::string scenario = run.value("scenario"), profile = run.value("profile");
  const bool by_profile =
      profiles.at(scenario).size() > 1 || run.has_setting("compare", "labella2009");
  if (!by_profile && !scenario.empty()) return scenario;
  return profiles.size() > 1 ? fmt::format("{}/{}", scenario, profile) : profile;
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

/// Whether the group already has a run with this seed and fingerprint.
static bool is_copy(const RunResult& run, const Group& group) {
  const std::string fingerprint = run.value("fingerprint");
  if (fingerprint.empty()) return false;
  return std::ranges::any_of(group.runs, [&](const RunResult* other) {
    return other->value("seed") == run.value("seed") && other->value("fingerprint") == fingerprint;
  });
}

/// Notes whether the group's first run asks for a comparison with the paper's figures, and whether
/// that is possible.
static void compare_with_papers(const RunResult& run, const std::optional<Settings>& case_study,
                                Group& group) {
  const auto compare = run.settings.find("compare");
  group.asks_for_papers = compare != run.settings.end() && compare->second == "labella2009";
  if (group.asks_for_papers) group.not_the_papers = not_the_papers(group.settings, case_study);
}

std::vector<Group> group_runs(const std::vector<RunResult>& runs,
                              const std::optional<Settings>& case_study) {
  using Key = std::tuple<std::string, std::string, Settings>;
  std::map<std::string, std::set<std::string>> profiles;
  for (const RunResult& run : runs) profiles[run.value("scenario")].insert(run.value("profile"));
  std::vector<std::pair<Key, Group>> keyed;
  for (const RunResult& run : runs) {
    const Key key{run.value("scenario"), run.value("profile"), settings_of(run)};
    auto place = std::ranges::find(keyed, key, &std::pair<Key, Group>::first);
    if (place == keyed.end()) {
      Group group;
      group.name = base_name(run, profiles);
      group.folder = run.folder;
      group.settings = std::get<Settings>(key);
      keyed.emplace_back(key, std::move(group));
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

}  // namespace results::report
