#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "hal/files/config/document_limits.h"
#include "hal/files/config/node.h"
#include "hal/files/config/problems.h"

namespace hal::files::config {

/// Records which file includes which, to detect circles.
class IncludeGraph {
 public:
  /// Records that `from` includes `to`.
  /// @return if that closes a circle, the files from `to` back to `to`, and it is not recorded;
  ///   otherwise empty.
  std::vector<std::string> add(const std::string& from, const std::string& to) {
    std::vector<std::string> circle = way(to, from);
    if (circle.empty()) {
      edges_[from].insert(to);
    } else {
      circle.push_back(to);
    }
    return circle;
  }

 private:
  std::vector<std::string> way(const std::string& from, const std::string& to) const {
    if (from == to) return {to};
    const auto targets = edges_.find(from);
    if (targets == edges_.end()) return {};
    for (const std::string& next : targets->second) {
      std::vector<std::string> rest = way(next, to);
      if (rest.empty()) continue;
      rest.insert(rest.begin(), from);
      return rest;
    }
    return {};
  }

  std::map<std::string, std::set<std::string>> edges_;
};

/// A file that another one, or the command line, includes.
struct Included {
  std::string file;
  /// Path of the mapping into which it is included, "agents.robots.robot"; "": the top level.
  std::string path;
  std::string place;  ///< Place of the value of `include`: "file:line:column", or "--set a.b".
};

/// Reads files and replaces `include` keys by the contents of the files, and `urdf` and `sdf` by
/// what model_include.h makes of those.
class Loader {
 public:
  /// @param first  includes on the command line are relative to its folder.
  Loader(const std::filesystem::path& first, Problems& problems);

  /// False if a file could not be read: all of its keys would seem to be missing.
  bool complete() const { return complete_; }

  /// The included files, in the order of reading.
  const std::vector<Included>& included() const { return included_; }

  /// The file's mapping, with includes not yet resolved.
  /// @param path  its destination, for messages.
  Node load(const std::filesystem::path& file, Layer layer, const std::string& path);

  /// Replaces each `include` in and below the node, outermost first, so that an outer mapping can
  /// change an inner one's `include`.
  /// @param depth  number of mappings and lists around the node.
  void resolve(Node& node, const std::string& path, int depth = 0);

 private:
  void check_repeated(Node& node, const std::string& path);
  void include(Node& mapping, const Node& target, const std::string& path);
  /// Replaces `urdf` or `sdf`, if it is there.
  void include_model(Node& mapping, const std::string& path);
  /// The file that a mapping includes; nullopt: there is none, and why is noted.
  /// @param key  that names it, for messages.
  std::optional<std::filesystem::path> included_file(const Node& target, const std::string& path,
                                                     const std::string& key);
  void refuse_items(Node& list, const std::string& path);
  void give_up(const Node& target, const std::string& path, std::string why,
               const std::string& key = "include");
  std::filesystem::path located(const Node& target) const;

  std::filesystem::path folder_;  ///< Folder of the first file.
  Problems& problems_;
  IncludeGraph graph_;
  std::vector<Included> included_;
  int files_ = 0;
  std::size_t values_left_ = kMostValues;
  bool complete_ = true;
};

}  // namespace hal::files::config
