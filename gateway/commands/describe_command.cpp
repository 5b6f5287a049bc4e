#include "gateway/commands/describe_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "gateway/commands/file_kinds.h"
#include "gateway/commands/key_words.h"
#include "gateway/exit_status.h"
#include "hal/config/suggest.h"
#include "hal/config/value.h"
#include "hal/runtime/parameter_form.h"
#include "hal/runtime/plugin.h"

namespace gateway {
namespace {

using hal::config::KeyDescription;

void print_kinds() {
  fmt::print("Kinds of files:\n");
  for (const FileKind& kind : file_kinds()) fmt::print("  {:<9} {}\n", kind.name, kind.about);
  fmt::print(
      "\nbaraka describe KIND        all keys of a kind of file\n"
      "baraka describe KEY         one key: `seed`, `radio.tx_power`\n"
      "baraka describe CONTROLLER  a controller's parameters\n"
      "baraka describe --markdown  everything as one page\n");
}

/// The lines below a key's path.
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
  for (const KeyDescription& key : keys_of(kind).keys) fmt::print("{}\n{}", key.path, body(key));
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

/// Whether a path ends like that; NAME stands for any name.
bool ends_like(const std::string& path, const std::vector<std::string>& end) {
  const std::vector<std::string> parts = parts_of(path);
  if (parts.size() < end.size()) return false;
  return std::equal(end.begin(), end.end(), parts.end() - static_cast<std::ptrdiff_t>(end.size()),
                    [](const std::string& wanted, const std::string& part) {
                      return wanted == part || part == "NAME";
                    });
}

/// Keys of that name, those with one description together.
bool print_key(const std::string& what) {
  const std::vector<std::string> end = parts_of(what);
  if (end.back().empty()) return false;
  std::vector<std::string> bodies;
  std::map<std::string, std::string> places;
  for (const FileKind& kind : file_kinds()) {
    for (const KeyDescription& key : keys_of(kind).keys) {
      if (!ends_like(key.path, end) || last_part(key.path) == "NAME") continue;
      const std::string text = body(key);
      if (!places.contains(text)) bodies.push_back(text);
      places[text] += fmt::format("{} ({} file)\n", key.path, kind.name);
    }
  }
  for (const std::string& text : bodies) fmt::print("{}{}", places[text], text);
  return !bodies.empty();
}

void print_controller(const hal::ControllerKind& kind) {
  fmt::print("Controller {}, for {}{}{}.\n", kind.name,
             kind.make_for_mote != nullptr ? "motes" : "",
             kind.make_for_mote != nullptr && kind.make_for_robot != nullptr ? " and " : "",
             kind.make_for_robot != nullptr ? "robots" : "");
  if (kind.parameters.empty()) fmt::print("It has no parameters.\n");
  for (const hal::ParameterSpec& parameter : kind.parameters) {
    const hal::config::Form form = hal::runtime::form_of(parameter);
    const std::string range = limits(form);
    fmt::print("{}\n    {}\n    value:   {}{}{}\n    default: {}\n", parameter.name,
               parameter.meaning, expected(form), range.empty() ? "" : ", ", range,
               hal::runtime::written(parameter, parameter.default_value));
  }
}

/// All that `what` could have meant.
std::vector<std::string> candidates() {
  std::vector<std::string> result;
  for (const FileKind& kind : file_kinds()) {
    result.push_back(kind.name);
    for (const KeyDescription& key : keys_of(kind).keys) result.push_back(last_part(key.path));
  }
  return result;
}

}  // namespace

int describe(const std::string& what) {
  if (what.empty()) {
    print_kinds();
    return kDone;
  }
  bool found = false;
  for (const FileKind& kind : file_kinds()) {
    if (kind.name != what) continue;
    print_kind(kind);
    return kDone;
  }
  found = print_key(what);
  const auto folders = hal::runtime::controller_folders();
  if (const auto kind = hal::runtime::load_plugin(what, folders)) {
    print_controller(**kind);
    found = true;
  }
  if (found) return kDone;
  throw UsageError(fmt::format(
      "no kind of file, key or controller is called '{}'{}; controllers were looked for in {}",
      what, hal::config::suggestion(what, candidates()), [&] {
        std::vector<std::string> names;
        names.reserve(folders.size());
        for (const auto& folder : folders) names.push_back(folder.string());
        return fmt::format("{}", fmt::join(names, ", "));
      }()));
}

}  // namespace gateway
