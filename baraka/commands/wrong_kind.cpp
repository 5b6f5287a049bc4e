#include "baraka/commands/wrong_kind.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "baraka/commands/file_kinds.h"
#include "hal/files/config/document.h"
#include "hal/files/config/errors.h"
#include "hal/files/config/shared_folders.h"

namespace baraka::commands {
namespace {

using hal::files::config::ConfigErrors;
using hal::files::config::Included;

/// What is wrong with a file's kind; none: it may be of the wanted kind.
/// @throws ConfigErrors if the file cannot be read.
std::optional<std::string> other_kind(const std::string& file, const std::string& wanted) {
  if (hal::files::config::Document::load(file).root().keys().empty()) {
    return fmt::format("{}: is empty: it has no key of a {}; `baraka describe {}` shows one", file,
                       wanted, wanted);
  }
  const FileKind& kind = recognised(file, {});
  if (kind.name == wanted) return std::nullopt;
  return fmt::format("{}: is a {} file, not a {}; {}", file, kind.name, wanted, kind.use);
}

/// The kind of file that may be included in a mapping; empty: none, the mapping is part of a file.
/// @param path  path of the mapping, "agents.robots.robot".
std::string kind_at(const std::string& path, const std::string& kind) {
  if (path.empty()) return kind;
  if (path == "radio" && kind == "scenario") return path;
  const std::string key = path.substr(path.rfind('.') + 1);
  const bool has_bodies = kind == "hardware" ? path == key : path.starts_with("agents.");
  return has_bodies && (key == "robot" || key == "mote") ? key : "";
}

/// What is wrong with the kind of an included file; none: it may be of the kind that belongs there.
std::optional<std::string> other_kind_included(const Included& included, const std::string& kind) {
  const std::string wanted = kind_at(included.path, kind);
  if (wanted.empty()) return std::nullopt;
  const std::string path = included.path.empty() ? "include" : included.path + ".include";
  const bool is_set = included.place == "--set " + path;  // names the key itself
  const std::string at = is_set ? included.place : fmt::format("{}: {}", included.place, path);
  try {
    const FileKind& other = recognised(included.file, {});
    if (other.name == wanted) return std::nullopt;
    return fmt::format("{}: '{}' is a {} file, not a {}; {}", at, included.file, other.name, wanted,
                       other.use);
  } catch (const ConfigErrors&) {
    return std::nullopt;  // it may be of several kinds
  }
}

/// One line for each included file of the wrong kind.
std::vector<std::string> other_kinds_included(const std::string& file, const std::string& kind,
                                              const std::vector<std::string>& overrides) {
  std::vector<std::string> lines;
  try {
    const auto document = hal::files::config::Document::load(file, overrides);
    for (const Included& one : document.included()) {
      if (auto line = other_kind_included(one, kind)) lines.push_back(std::move(*line));
    }
  } catch (const ConfigErrors&) {
    return {};  // one of them cannot be read
  }
  return lines;
}

}  // namespace

int with_includes_of(const std::string& kind, const std::string& file,
                     const std::vector<std::string>& overrides, const std::function<int()>& act) {
  try {
    return act();
  } catch (const ConfigErrors&) {
    auto lines = other_kinds_included(file, kind, overrides);
    if (!lines.empty()) throw ConfigErrors(std::move(lines));
    throw;
  }
}

int with_file_of(const std::string& kind, const NamedFile& given, const std::function<int()>& act) {
  try {
    return act();
  } catch (const ConfigErrors& mistakes) {
    std::string file;
    std::optional<std::string> other;
    try {
      file = hal::files::config::named_file(given.name, given.folders).string();
      other = other_kind(file, kind);
    } catch (const ConfigErrors&) {
      if (file.empty()) throw mistakes;  // there is no such file
      // It cannot be read, or may be of several kinds.
    }
    if (other) throw ConfigErrors({*other});
    return with_includes_of(kind, file, given.overrides, [&]() -> int { throw mistakes; });
  }
}

}  // namespace baraka::commands
