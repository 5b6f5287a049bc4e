#pragma once

#include <string>
#include <vector>

#include "hal/files/config/node.h"

namespace hal::files::config {

/// A problem at a place; `key` is the dotted path or empty.
struct Problem {
  Place place;
  std::string key;
  std::string what;
};

/// Reads one YAML document. Repeated keys are kept in the tree, for the caller to check. Tags,
/// anchors, aliases and further documents are problems, because they hide the origin of a value.
/// @param origin  file, order and layer of all places.
/// @param values_left  number of values still permitted in all files; reduced by those of this one.
///   One too many is a problem.
/// @return the root; null if the text is not YAML, which is then the last problem.
Node parse_yaml(const std::string& text, const Place& origin, std::vector<Problem>& problems,
                std::size_t& values_left);

/// The node on one line, in flow style; parse_yaml() reads it back to the same values.
std::string flow_yaml(const Node& node);

}  // namespace hal::files::config
