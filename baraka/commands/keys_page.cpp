#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <vector>

#include "baraka/commands/describe_command.h"
#include "baraka/commands/file_kinds.h"
#include "baraka/commands/key_words.h"

namespace baraka::commands {
namespace {

using hal::files::config::Form;
using hal::files::config::KeyDescription;

constexpr const char* kIntroduction = R"(# Every key of BARAKA's files

<!-- Written by `baraka describe --markdown`; the texts are where the keys are read. -->

Files are YAML. A value has its unit behind it (`250 ms`, `-45 deg`, `11 Mb/s`) unless it is a plain
number. `include: other.yaml` in a mapping inserts the keys of that file, which the mapping's own keys
override. The path is relative to the including file; a file that does not exist there is searched for
in the folders of `BARAKA_CONFIG_PATH` and in `share/baraka` of the installation. `--set a.b=value` on
the command line overrides a value. In the headings, `NAME` is a name that you choose, and `[]` stands
for each item of a list.

`baraka describe KEY` shows one key, `baraka describe CONTROLLER` the parameters of a controller.
`baraka check FILE` finds every mistake in a file of any kind.
)";

bool has_own_section(const KeyDescription& key) {
  return key.form.kind == Form::Kind::kMapping || key.form.kind == Form::Kind::kMappings;
}

std::string code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

/// @param further  sentence to add after the meaning.
std::string row(const KeyDescription& key, const std::string& further) {
  std::string meaning = key.meaning + further;
  if (std::string words = condition_words(key); !words.empty()) {
    words.front() = 'O';
    meaning += " " + words + ".";
  }
  return fmt::format("| {} | {} | {} | {} | {} |\n", code(last_part(key.path)), meaning,
                     value_words(key), default_words(key), code(key.example));
}

/// The part of a path below a mapping or an item; empty if the path is not below it.
std::string below(const std::string& path, const std::string& mapping) {
  return path.starts_with(mapping + ".") ? path.substr(mapping.size() + 1) : "";
}

/// The descriptions of the keys below a mapping, independent of the mapping's place.
std::vector<std::string> said_below(const std::vector<KeyDescription>& keys,
                                    const std::string& mapping) {
  std::vector<std::string> result;
  for (const KeyDescription& key : keys) {
    const std::string path = mapping.empty() ? key.path : below(key.path, mapping);
    if (path.empty()) continue;
    result.push_back(path + key.meaning + value_words(key) + default_words(key));
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// The kind of file that has the same keys as the mapping; null: none.
const FileKind* kind_of(const std::vector<KeyDescription>& keys, const std::string& mapping) {
  const auto said = said_below(keys, mapping);
  for (const FileKind& kind : file_kinds()) {
    if (!said.empty() && said_below(keys_of(kind), "") == said) return &kind;
  }
  return nullptr;
}

std::string heading(const FileKind& kind, const std::string& mapping) {
  return mapping.empty() ? fmt::format("\n### Top level of a {} file\n\n", kind.name)
                         : fmt::format("\n### `{}` of a {} file\n\n", mapping, kind.name);
}

constexpr const char* kHead =
    "| key | meaning | value | default | example |\n|---|---|---|---|---|\n";

/// One heading and table for each mapping; the keys of another kind of file are not repeated.
std::string sections(const FileKind& kind) {
  const auto& keys = keys_of(kind);
  std::string page, last = "?";
  std::vector<std::string> elsewhere;
  for (const KeyDescription& key : keys) {
    const std::string mapping = mapping_of(key.path);
    const auto said = [&](const std::string& other) { return !below(key.path, other).empty(); };
    if (std::any_of(elsewhere.begin(), elsewhere.end(), said)) continue;
    if (mapping != last) page += heading(kind, mapping) + kHead;
    last = mapping;
    std::string further;
    if (const FileKind* other = has_own_section(key) ? kind_of(keys, key.path) : nullptr) {
      elsewhere.push_back(key.path);
      further = fmt::format(" Its keys are those of a [{0} file](#{0}-files).", other->name);
    }
    page += row(key, further);
  }
  return page;
}

}  // namespace

std::string keys_page() {
  std::string page = kIntroduction;
  for (const FileKind& kind : file_kinds()) {
    std::string title = kind.name + " files";
    title.front() = static_cast<char>(title.front() - 'a' + 'A');
    page += fmt::format("\n## {}\n\n{} For example:\n\n```yaml\n{}```\n", title, kind.about,
                        kind.example);
    page += sections(kind);
  }
  return page;
}

}  // namespace baraka::commands
