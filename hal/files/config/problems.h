#pragma once

#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/files/config/node.h"
#include "hal/files/config/yaml.h"

namespace hal::files::config {

/// The mistakes found so far in one document.
class Problems {
 public:
  void add(const Place& place, std::string key, std::string what) {
    found_.push_back({place, std::move(key), std::move(what)});
  }
  void add(std::vector<Problem> problems, const std::string& path);

  /// Records where the file of this order (Place) is included, for messages about its contents.
  void note_include(int order, const Place& by) { included_by_.insert_or_assign(order, by); }

  /// Records something permitted but probably unintended; not a mistake.
  void warn(const Place& place, std::string key, std::string what) {
    warnings_.push_back({place, std::move(key), std::move(what)});
  }

  bool none() const { return found_.empty(); }

  /// One line each, sorted by position: "file:line:column: key: what (included by
  /// file:line:column)"; warnings likewise as "file:line:column: warning: …".
  std::vector<std::string> messages() const;
  std::vector<std::string> warnings() const;

  /// An empty mapping that lives as long as this object.
  const Node& empty_mapping(const Place& place);

 private:
  std::vector<std::string> lines(std::vector<Problem> problems, std::string_view mark) const;
  std::string includers(const Place& place) const;

  std::vector<Problem> found_;
  std::vector<Problem> warnings_;
  std::map<int, Place> included_by_;
  std::deque<Node> empty_;
};

/// "path.key", or the non-empty one of the two.
std::string joined(const std::string& path, const std::string& key);

}  // namespace hal::files::config
