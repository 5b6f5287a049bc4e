#pragma once

#include <string>
#include <vector>

#include "hal/files/config/node.h"

namespace hal::files::config {

/// Something wrong at a place; `key` is the dotted path or empty.
struct Problem {
  Place place;
  std::string key;
  std::string what;
};

/// Reads one YAML document. Repeated keys stay in the tree, for the caller to judge. Tags, anchors,
/// aliases and further documents are problems: they hide where a value comes from.
/// @param origin  file, order and layer of all places.
/// @param values_left  of all files; those of this one are taken off. One too many is a problem.
/// @return the root; null if the text is not YAML, which is then the last problem.
Node parse_yaml(const std::string& text, const Place& origin, std::vector<Problem>& problems,
                std::size_t& values_left);

/// The node on one line, in flow style: parse_yaml() reads it back to the same values.
std::string flow_yaml(const Node& node);

}  // namespace hal::files::config
