#include "hal/files/config/model_include.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <sstream>

#include "hal/files/config/document_limits.h"
#include "hal/files/config/model_reader.h"
#include "hal/files/config/yaml.h"

namespace hal::files::config {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kLine = "# line ";
constexpr std::string_view kLeftOut = "# left out: line ";

Node taken(Node& mapping, const std::string& key) {
  Entry* const entry = mapping.find(key);
  if (entry == nullptr) return {};
  Node value = std::move(entry->value);
  mapping.entries.erase(mapping.entries.begin() + (entry - mapping.entries.data()));
  return value;
}

/// The number at the start of a text; 0: none.
int number_at(std::string_view text) {
  int number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// For each line of the YAML, from 1, the line of the model it comes from: its own comment's, or
/// that of the line before.
std::vector<int> model_lines(const std::string& yaml) {
  std::vector<int> lines{1};
  std::istringstream stream(yaml);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t at = line.rfind(kLine);
    const int number =
        at == std::string::npos ? 0 : number_at(std::string_view(line).substr(at + kLine.size()));
    lines.push_back(number > 0 ? number : lines.back());
  }
  return lines;
}

void move_places(Node& node, const std::vector<int>& lines) {
  const auto move = [&lines](Place& place) {
    const auto line = static_cast<std::size_t>(place.line);
    if (line < lines.size()) place.line = lines[line];
    place.column = 1;
  };
  move(node.place);
  for (Node& item : node.items) move_places(item, lines);
  for (Entry& entry : node.entries) {
    move(entry.place);
    move_places(entry.value, lines);
  }
}

void warn_of_left_out(const std::string& yaml, const std::string& path, const Place& origin,
                      Problems& problems) {
  std::istringstream stream(yaml);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with(kLeftOut)) continue;
    const std::string rest = line.substr(kLeftOut.size());
    const std::size_t colon = rest.find(": ");
    if (colon == std::string::npos) continue;
    Place place = origin;
    place.line = number_at(rest);
    problems.warn(place, path, "is left out: " + rest.substr(colon + 2));
  }
}

/// A mistake of the reader at its place: "FILE:LINE:1: WHAT" or "drive.KEY: WHAT".
void note(const std::string& mistake, const ModelInclude& include, const std::string& path,
          const Place& origin, Problems& problems) {
  const std::string file = origin.file + ":";
  if (mistake.starts_with(file)) {
    Place place = origin;
    place.line = number_at(std::string_view(mistake).substr(file.size()));
    const std::size_t end = mistake.find(": ", file.size());
    return problems.add(place, path, end == std::string::npos ? mistake : mistake.substr(end + 2));
  }
  const std::size_t end = mistake.find(": ");
  if (!mistake.starts_with("drive") || end == std::string::npos)
    return problems.add(include.file.place, joined(path, include.is_urdf ? "urdf" : "sdf"),
                        mistake);
  const std::string key = mistake.substr(0, end);
  const Entry* const inner = key.size() > 6 ? include.drive.find(key.substr(6)) : nullptr;
  const bool is_there = include.drive.kind != Node::Kind::kNull;
  const Place& place = inner != nullptr ? inner->value.place
                       : is_there       ? include.drive.place
                                        : include.file.place;
  problems.add(place, joined(path, key), mistake.substr(end + 2));
}

/// Folders of `search_path`, relative to the folder of the file in which it is written.
std::optional<std::vector<std::string>> folders_of(const Node& list) {
  if (list.kind == Node::Kind::kNull) return std::vector<std::string>{};
  std::vector<Node> items = list.items;
  if (list.kind == Node::Kind::kScalar) items = {list};
  if (list.kind == Node::Kind::kMapping) return std::nullopt;
  std::vector<std::string> folders;
  for (const Node& item : items) {
    if (item.kind != Node::Kind::kScalar) return std::nullopt;
    const fs::path base =
        item.place.line > 0 ? fs::path(item.place.file).parent_path() : fs::path();
    folders.push_back((base / item.text).lexically_normal().string());
  }
  return folders;
}

bool is_called(const std::string& path, const std::string& name) {
  return path == name || path.ends_with("." + name);
}
bool is_world(const std::string& path) { return is_called(path, "world"); }

/// The reader's arguments; nullopt after a mistake.
std::optional<std::vector<std::string>> arguments_of(const ModelInclude& include,
                                                     const std::string& file,
                                                     const std::string& path, Problems& problems) {
  std::vector<std::string> words;
  const auto folders = folders_of(include.search_path);
  if (!folders) {
    problems.add(include.search_path.place, joined(path, "search_path"),
                 "must be a folder or a list of folders");
    return std::nullopt;
  }
  for (const std::string& folder : *folders) words.insert(words.end(), {"--robot-path", folder});
  if (include.drive.kind != Node::Kind::kNull)
    words.insert(words.end(), {"--drive", flow_yaml(include.drive)});
  if (include.model.kind != Node::Kind::kNull)
    words.insert(words.end(), {"--model", include.model.text});
  if (include.is_urdf) words.emplace_back("--urdf");
  if (is_world(path)) words.emplace_back("--world");
  words.push_back(file);
  return words;
}

}  // namespace

std::optional<ModelInclude> take_model(Node& mapping, const std::string& path) {
  if (!path.empty() && !is_called(path, "robot") && !is_world(path)) return std::nullopt;
  const bool is_urdf = mapping.find("urdf") != nullptr;
  if (!is_urdf && mapping.find("sdf") == nullptr) return std::nullopt;
  ModelInclude include;
  include.is_urdf = is_urdf;
  include.file = taken(mapping, is_urdf ? "urdf" : "sdf");
  include.drive = taken(mapping, "drive");
  include.search_path = taken(mapping, "search_path");
  include.model = taken(mapping, "sdf_model");
  return include;
}

Node read_model_file(const ModelInclude& include, const fs::path& file, const std::string& path,
                     const Place& origin, Problems& problems) {
  const auto arguments = arguments_of(include, file.string(), path, problems);
  if (!arguments) return {};
  const ModelReading reading = read_model(*arguments);
  for (const std::string& mistake : reading.mistakes)
    note(mistake, include, path, origin, problems);
  if (!reading.mistakes.empty()) return {};
  std::vector<Problem> found;
  std::size_t values = kMostValues;
  Node root = parse_yaml(reading.yaml, origin, found, values);
  if (!found.empty()) {
    problems.add(std::move(found), path);
    return {};
  }
  move_places(root, model_lines(reading.yaml));
  warn_of_left_out(reading.yaml, path, origin, problems);
  return root;
}

}  // namespace hal::files::config
