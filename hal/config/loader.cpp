#include "hal/config/loader.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <optional>
#include <utility>

#include "hal/config/shared_folders.h"
#include "hal/config/yaml.h"

namespace hal::config {

namespace fs = std::filesystem;

namespace {

std::string real_name(const fs::path& file) {
  std::error_code error;
  return fs::weakly_canonical(file, error).string();
}

std::vector<std::string> names(const std::vector<std::string>& files) {
  std::vector<std::string> result;
  result.reserve(files.size());
  for (const std::string& file : files) result.push_back(fs::path(file).filename().string());
  return result;
}

std::optional<std::string> content(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return std::nullopt;
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.good() && !stream.eof()) return std::nullopt;
  return text;
}

}  // namespace

Node Loader::load(const fs::path& file, Layer layer, const std::string& path) {
  const Place origin{files_++, file.string(), 1, 1, layer};
  const auto text = content(file);
  if (!text) {
    problems_.add({origin.order, origin.file, 0, 0, layer}, "", "there is no such file");
    complete_ = false;
    return {};
  }
  std::vector<Problem> found;
  Node root = parse_yaml(*text, origin, found);
  if (!found.empty()) complete_ = false;
  problems_.add(std::move(found), "");
  if (root.kind == Node::Kind::kNull) {
    root.kind = Node::Kind::kMapping;
    root.place = origin;
  }
  if (root.kind != Node::Kind::kMapping) {
    problems_.add(root.place, path, "must be a mapping, not " + kind_name(root));
    complete_ = false;
    return {};
  }
  check_repeated(root, path);
  return root;
}

void Loader::check_repeated(Node& node, const std::string& path) {
  for (Node& item : node.items) check_repeated(item, path);
  std::map<std::string, int> lines;
  std::vector<Entry> kept;
  for (Entry& entry : node.entries) {
    const std::string key = joined(path, entry.key);
    const auto [first, is_new] = lines.emplace(entry.key, entry.place.line);
    if (is_new) {
      check_repeated(entry.value, key);
      kept.push_back(std::move(entry));
    } else {
      problems_.add(entry.place, key, fmt::format("already set on line {}", first->second));
    }
  }
  node.entries = std::move(kept);
}

void Loader::resolve(Node& node, const std::string& path) {
  for (auto at = node.find("include"); at != nullptr; at = node.find("include")) {
    const Node target = std::move(at->value);
    node.entries.erase(node.entries.begin() + (at - node.entries.data()));
    include(node, target, path);
  }
  if (node.kind == Node::Kind::kList) refuse_items(node);
  for (Node& item : node.items) resolve(item, path);
  for (Entry& entry : node.entries) resolve(entry.value, joined(path, entry.key));
}

void Loader::refuse_items(Node& list) {
  const std::size_t size = list.items.size();
  for (const Entry& entry : std::exchange(list.entries, {})) {
    problems_.add(entry.place, "",
                  fmt::format("'{}' is no item: the list has {}{}", entry.key, size,
                              size > 0 ? fmt::format(", 0 to {}", size - 1) : ""));
  }
}

void Loader::give_up(const Node& target, const std::string& path, std::string why) {
  problems_.add(target.place, joined(path, "include"), std::move(why));
  complete_ = false;
}

void Loader::include(Node& mapping, const Node& target, const std::string& path) {
  if (target.kind != Node::Kind::kScalar) {
    return give_up(target, path, "must be the path of a file, not " + kind_name(target));
  }
  const fs::path file = located(target);
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    return give_up(target, path, fmt::format("there is no file '{}'", file.string()));
  }
  const bool in_file = target.place.line > 0;
  const auto circle = in_file ? graph_.add(real_name(target.place.file), real_name(file))
                              : std::vector<std::string>{};
  if (!circle.empty()) {
    return give_up(target, path,
                   fmt::format("goes in a circle: {}", fmt::join(names(circle), " -> ")));
  }
  const bool by_file = target.place.layer == Layer::kFile;
  Node below = load(file, by_file ? Layer::kFile : Layer::kCommandLineInclude, path);
  mapping = merged(std::move(below), std::move(mapping));
}

fs::path Loader::located(const Node& target) const {
  const bool in_file = target.place.line > 0;
  const fs::path folder = in_file ? fs::path(target.place.file).parent_path() : folder_;
  fs::path file = (folder / target.text).lexically_normal();
  std::error_code error;
  if (fs::exists(file, error)) return file;
  if (!in_file && fs::exists(target.text, error)) return target.text;
  if (const auto shared = find_shared(target.text)) return *shared;
  return in_file ? file : fs::path(target.text);
}

}  // namespace hal::config
