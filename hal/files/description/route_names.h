#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/files/config/mapping.h"
#include "hal/types/agent_id.h"

namespace hal::files::description {

/// An agent that routes may name.
struct NamedAgent {
  std::string name;
  AgentId id;
};

/// Whether a name has `*` or `?`.
bool is_pattern(const std::string& name);

/// Finds the agents that the names in a row of routes mean, by their index. Notes mistakes in the
/// row.
class RouteNames {
 public:
  /// @param row,agents  outlive this object.
  RouteNames(config::Mapping& row, std::span<const NamedAgent> agents)
      : row_(row), agents_(agents) {}

  /// The agents that have this name or match this pattern, in their order; empty after a mistake.
  std::vector<std::size_t> meant(const std::string& key, const std::string& name);
  /// The agent `via` of the row, which cannot be a pattern; nullopt after a mistake.
  std::optional<std::size_t> via(const std::string& name);
  /// The agents of a path, each once; others and paths of one agent are mistakes.
  std::vector<std::size_t> path(const std::vector<std::string>& names);

  void mistake(const std::string& key, std::string what);
  bool is_good() const { return is_good_; }

 private:
  config::Mapping& row_;
  std::span<const NamedAgent> agents_;
  bool is_good_ = true;
};

}  // namespace hal::files::description
