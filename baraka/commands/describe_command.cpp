#include "baraka/commands/describe_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "baraka/commands/file_kinds.h"
#include "baraka/commands/key_words.h"
#include "baraka/commands/observables_page.h"
#include "baraka/run/controllers/controller_path.h"
#include "gateway/process/exit_status.h"
#include "gateway/runtime/parameter_form.h"
#include "gateway/runtime/plugin.h"
#include "hal/files/config/suggest.h"
#include "hal/files/config/value.h"

namespace baraka::commands {
namespace {

using hal::files::config::Condition;
using hal::files::config::Form;
using hal::files::config::KeyDescription;

constexpr std::string_view kObservables = "observables";

void print_kinds() {
  fmt::print("Kinds of files:\n");
  for (const FileKind& kind : file_kinds()) fmt::print("  {:<9} {}\n", kind.name, kind.about);
  fmt::print(
      "\nbaraka describe KIND        all keys of a kind of file\n"
      "baraka describe KEY         one key: `seed`, `radio.tx_power`\n"
      "baraka describe VALUE       a sensor, a driver, a profile with its keys: `imu`, `tmc200`\n"
      "baraka describe CONTROLLER  a controller's parameters\n"
      "baraka describe observables what can be followed in a run, and the numbers of each run\n"
      "baraka describe --markdown  all keys as one page\n");
}

/// The description of a key, printed below its path.
std::string body(const KeyDescription& key) {
  std::string text = fmt::format("    {}\n    value:   {}\n", key.meaning, value_words(key));
  if (const std::string words = default_words(key); !words.empty()) {
    text += fmt::format("    default: {}\n", words);
  }
  if (const std::string words = condition_words(key); !words.empty()) {
    text += fmt::format("    {}\n", words);
  }
  if (!key.example.empty()) {
    text += fmt::format("    example: {}: {}\n", last_part(key.path), key.example);
  }
  return text;
}

void print_kind(const FileKind& kind) {
  fmt::print("{}\n\n{}\n", kind.about, kind.example);
  for (const KeyDescription& key : keys_of(kind)) fmt::print("{}\n{}", key.path, body(key));
}

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.') {
      parts.emplace_back();
    } else if (c != '[' && c != ']') {
      parts.back() += c;
    }
  }
  return parts;
}

/// Whether a path has this end; NAME stands for any name.
bool ends_like(const std::string& path, const std::vector<std::string>& end) {
  const std::vector<std::string> parts = parts_of(path);
  if (parts.size() < end.size()) return false;
  return std::equal(end.begin(), end.end(), parts.end() - static_cast<std::ptrdiff_t>(end.size()),
                    [](const std::string& wanted, const std::string& part) {
                      return wanted == part || part == "NAME";
                    });
}

/// Prints descriptions, each once, below all paths that it applies to.
class Descriptions {
 public:
  void add(const std::string& place, const std::string& text) {
    if (!places_.contains(text)) texts_.push_back(text);
    places_[text] += place + "\n";
  }
  /// @return whether anything was printed.
  bool print() const {
    for (const std::string& text : texts_) fmt::print("{}{}", places_.at(text), text);
    return !texts_.empty();
  }

 private:
  std::vector<std::string> texts_;
  std::map<std::string, std::string> places_;
};

/// "    keys:    columns, rows" for a mapping or the items of a list; otherwise empty.
std::string inner_keys(const std::vector<KeyDescription>& keys, const KeyDescription& key) {
  std::vector<std::string> names;
  for (const KeyDescription& other : keys) {
    const std::string mapping = mapping_of(other.path);
    if (mapping == key.path || mapping == key.path + "[]") names.push_back(last_part(other.path));
  }
  return names.empty() ? "" : fmt::format("    keys:    {}\n", fmt::join(names, ", "));
}

/// Describes the keys with that name; keys with equal descriptions are printed together.
bool print_key(const std::string& what) {
  const std::vector<std::string> end = parts_of(what);
  if (end.back().empty()) return false;
  Descriptions descriptions;
  for (const FileKind& kind : file_kinds()) {
    const std::vector<KeyDescription>& keys = keys_of(kind);
    for (const KeyDescription& key : keys) {
      if (!ends_like(key.path, end) || last_part(key.path) == "NAME") continue;
      descriptions.add(fmt::format("{} ({} file)", key.path, kind.name),
                       body(key) + inner_keys(keys, key));
    }
  }
  return descriptions.print();
}

/// Whether the value of `choice` allows a key: alone or among others.
bool comes_with(const KeyDescription& key, const KeyDescription& choice, const std::string& value) {
  return std::ranges::any_of(key.conditions, [&](const Condition& condition) {
    return !condition.presence && condition.path == choice.path &&
           std::ranges::find(condition.values, value) != condition.values.end();
  });
}

/// Describes a value that may be chosen (a kind of sensor, a driver, a profile), with the keys that
/// it allows.
bool print_option(const std::string& what) {
  Descriptions descriptions;
  for (const FileKind& kind : file_kinds()) {
    const std::vector<KeyDescription>& keys = keys_of(kind);
    for (const KeyDescription& choice : keys) {
      if (std::ranges::find(choice.form.options, what) == choice.form.options.end()) continue;
      std::string text = fmt::format("    {}\n", choice.meaning);
      for (const KeyDescription& key : keys)
        if (comes_with(key, choice, what)) text += last_part(key.path) + "\n" + body(key);
      descriptions.add(fmt::format("{}: {} ({} file)", choice.path, what, kind.name), text);
    }
  }
  return descriptions.print();
}

void print_controller(const hal::ControllerKind& kind) {
  fmt::print("Controller {}, for {}{}{}.\n", kind.name,
             kind.make_for_mote != nullptr ? "motes" : "",
             kind.make_for_mote != nullptr && kind.make_for_robot != nullptr ? " and " : "",
             kind.make_for_robot != nullptr ? "robots" : "");
  if (kind.parameters.empty()) fmt::print("It has no parameters.\n");
  for (const hal::ParameterSpec& parameter : kind.parameters) {
    const hal::files::config::Form form = gateway::runtime::form_of(parameter);
    const std::string range = limits(form);
    fmt::print("{}\n    {}\n    value:   {}{}{}\n    default: {}\n", parameter.name,
               parameter.meaning, expected(form), range.empty() ? "" : ", ", range,
               gateway::runtime::written(parameter, parameter.default_value));
  }
  if (!kind.states.empty()) fmt::print("States: {}\n", fmt::join(kind.states, ", "));
  for (const hal::RecordSpec& record : kind.records) {
    fmt::print("controllers.AGENT.{}\n    {}\n    unit:    {}\n", record.name, record.meaning,
               record.unit);
  }
}

/// All names that `what` could have meant.
std::vector<std::string> candidates() {
  std::vector<std::string> result{std::string(kObservables)};
  for (const FileKind& kind : file_kinds()) {
    result.push_back(kind.name);
    for (const KeyDescription& key : keys_of(kind)) {
      result.push_back(last_part(key.path));
      result.insert(result.end(), key.form.options.begin(), key.form.options.end());
    }
  }
  return result;
}

}  // namespace

int describe(const std::string& what) {
  if (what.empty()) {
    print_kinds();
    return gateway::process::kDone;
  }
  bool found = false;
  for (const FileKind& kind : file_kinds()) {
    if (kind.name != what) continue;
    print_kind(kind);
    return gateway::process::kDone;
  }
  if (what == kObservables) {
    fmt::print("{}\n", observables_text());
    found = true;
  }
  found = print_key(what) || found;
  found = print_option(what) || found;
  const auto folders = gateway::runtime::controller_folders();
  if (const auto kind = gateway::runtime::load_plugin(what, folders)) {
    print_controller(**kind);
    found = true;
  }
  if (found) return gateway::process::kDone;
  run::controllers::warn_of_missing_controller_folders();
  throw gateway::process::UsageError(fmt::format(
      "no kind of file, key, value or controller is called '{}'{}; controllers were looked for in "
      "{}; `baraka check` judges a file",
      what, hal::files::config::suggestion(what, candidates()), [&] {
        std::vector<std::string> names;
        names.reserve(folders.size());
        for (const auto& folder : folders) names.push_back(folder.string());
        return fmt::format("{}", fmt::join(names, ", "));
      }()));
}

}  // namespace baraka::commands
