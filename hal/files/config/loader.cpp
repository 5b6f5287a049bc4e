#include "hal/files/config/loader.h"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

#include "hal/files/config/document_limits.h"
#include "hal/files/config/foreign_format.h"
#include "hal/files/config/list_edit.h"
#include "hal/files/config/model_include.h"
#include "hal/files/config/shared_folders.h"
#include "hal/files/config/yaml.h"
#include "hal/types/result.h"

namespace hal::files::config {

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

/// Why a file cannot be read; nullopt if it can. @param absent  message if it does not exist.
std::optional<std::string> obstacle(const fs::path& file, std::string absent) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) {
    const bool unknown = error && error != std::errc::no_such_file_or_directory &&
                         error != std::errc::not_a_directory;
    return unknown ? "cannot be read: " + error.message() : std::move(absent);
  }
  if (fs::is_directory(status)) return folder_instead_of_file(file.string());
  if (!fs::is_regular_file(status)) return "is not a regular file";
  const std::uintmax_t bytes = fs::file_size(file, error);
  if (error || bytes <= kMostBytes) return std::nullopt;
  return fmt::format("has {} bytes; at most {} are read", bytes, kMostBytes);
}

/// The file's text, or why it cannot be read.
Result<std::string> content(const fs::path& file) {
  if (auto why = obstacle(file, "there is no such file" + similar_file(file))) {
    return fail(Errc::kInvalidArgument, std::move(*why));
  }
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.is_open() || stream.bad()) {
    return fail(Errc::kInvalidArgument,
                "cannot be read: " + std::generic_category().message(errno));
  }
  if (auto what = foreign_format(text)) return fail(Errc::kInvalidArgument, std::move(*what));
  return text;
}

/// The folder that contains a file, after symbolic links.
fs::path real_folder(const fs::path& file) {
  std::error_code error;
  const fs::path real = fs::canonical(file, error);
  const fs::path named = fs::absolute(file, error).lexically_normal();
  return error || real == named ? file.parent_path() : real.parent_path();
}

}  // namespace

Loader::Loader(const fs::path& first, Problems& problems)
    : folder_(real_folder(first)), problems_(problems) {}

Node Loader::load(const fs::path& file, Layer layer, const std::string& path) {
  const Place origin{files_++, file.string(), 1, 1, layer};
  const auto text = content(file);
  if (!text) {
    problems_.add({origin.order, origin.file, 0, 0, layer}, "", text.error().message);
    complete_ = false;
    return {};
  }
  std::vector<Problem> found;
  Node root = parse_yaml(*text, origin, found, values_left_);
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
    if (kept.size() == kMostKeys) {
      problems_.add(
          entry.place, path,
          fmt::format("has {} keys; at most {} are read", node.entries.size(), kMostKeys));
      complete_ = false;
      break;
    }
    if (is_new) {
      check_repeated(entry.value, key);
      kept.push_back(std::move(entry));
    } else {
      problems_.add(entry.place, key, fmt::format("already set on line {}", first->second));
    }
  }
  node.entries = std::move(kept);
}

void Loader::resolve(Node& node, const std::string& path, int depth) {
  for (auto at = node.find("include"); at != nullptr; at = node.find("include")) {
    const Node target = std::move(at->value);
    node.entries.erase(node.entries.begin() + (at - node.entries.data()));
    if (depth > kDeepestInclude) {
      return give_up(
          target, path,
          fmt::format("is nested in {} mappings; at most {} are allowed", depth, kDeepestInclude));
    }
    include(node, target, path);
    if (!complete_) return;
  }
  include_model(node, path);
  if (!complete_) return;
  if (node.kind == Node::Kind::kList) refuse_items(node, path);
  for (Node& item : node.items) resolve(item, path, depth + 1);
  for (Entry& entry : node.entries) resolve(entry.value, joined(path, entry.key), depth + 1);
}

void Loader::refuse_items(Node& list, const std::string& path) {
  for (const Entry& entry : std::exchange(list.entries, {})) {
    const bool is_edit = entry.key == "add" || entry.key.starts_with("remove");
    problems_.add(entry.place, is_edit ? path : "", list_mistake(list, entry));
  }
}

void Loader::give_up(const Node& target, const std::string& path, std::string why,
                     const std::string& key) {
  problems_.add(target.place, joined(path, key), std::move(why));
  complete_ = false;
}

std::optional<fs::path> Loader::included_file(const Node& target, const std::string& path,
                                              const std::string& key) {
  const auto give_up_on = [&](std::string why) {
    give_up(target, path, std::move(why), key);
    return std::nullopt;
  };
  if (target.kind != Node::Kind::kScalar)
    return give_up_on("must be the path of a file, not " + kind_name(target));
  if (files_ >= kMostFiles) {
    return give_up_on(
        fmt::format("is file {}; at most {} are read: do they include each other more than once?",
                    files_ + 1, kMostFiles));
  }
  const fs::path file = located(target);
  const std::string absent =
      fmt::format("there is no file '{}', nor in the shared folders ({}){}", file.string(),
                  listed_shared_folders(), similar_file(file, target.text));
  if (const auto why = obstacle(file, absent))
    return give_up_on(*why == absent ? absent : fmt::format("'{}' {}", file.string(), *why));
  return file;
}

void Loader::include_model(Node& mapping, const std::string& path) {
  const std::optional<ModelInclude> model = take_model(mapping, path);
  if (!model) return;
  const auto file = included_file(model->file, path, model->is_urdf ? "urdf" : "sdf");
  if (!file) return;
  included_.push_back({file->string(), path, model->file.place.text()});
  const bool by_file = model->file.place.layer == Layer::kFile;
  const Place origin{files_++, file->string(), 1, 1,
                     by_file ? Layer::kFile : Layer::kCommandLineInclude};
  problems_.note_include(origin.order, model->file.place);
  Node below = read_model_file(*model, *file, path, origin, problems_);
  complete_ = complete_ && below.kind == Node::Kind::kMapping;
  if (complete_) mapping = merged(std::move(below), std::move(mapping));
}

void Loader::include(Node& mapping, const Node& target, const std::string& path) {
  const auto file = included_file(target, path, "include");
  if (!file) return;
  const bool in_file = target.place.line > 0;
  const auto circle = in_file ? graph_.add(real_name(target.place.file), real_name(*file))
                              : std::vector<std::string>{};
  if (!circle.empty()) {
    return give_up(target, path,
                   fmt::format("includes itself: {}", fmt::join(names(circle), " -> ")));
  }
  const bool by_file = target.place.layer == Layer::kFile;
  included_.push_back({file->string(), path, target.place.text()});
  problems_.note_include(files_, target.place);  // the order that load() will assign
  Node below = load(*file, by_file ? Layer::kFile : Layer::kCommandLineInclude, path);
  mapping = merged(std::move(below), std::move(mapping));
}

fs::path Loader::located(const Node& target) const {
  const bool in_file = target.place.line > 0;
  const fs::path folder = in_file ? real_folder(target.place.file) : folder_;
  fs::path file = (folder / target.text).lexically_normal();
  std::error_code error;
  if (fs::exists(file, error)) return file;
  if (!in_file && fs::exists(target.text, error)) return target.text;
  if (const auto shared = find_shared(target.text)) return *shared;
  return in_file ? file : fs::path(target.text);
}

}  // namespace hal::files::config
