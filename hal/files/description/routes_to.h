#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hal/files/config/mapping.h"

namespace hal::files::description {

/// The next hop of an agent on the way to a destination.
struct RouteHop {
  std::size_t via = 0;  ///< Index of an agent, not that of the agent itself.
  std::size_t row = 0;  ///< Of the file, which gives it.
};

/// Something doubtful, or wrong, in a row of a file.
struct RouteFinding {
  std::size_t row = 0;
  bool is_mistake = false;
  std::string what;
};

/// The routes of all agents to one destination, and where they lead.
class RoutesTo {
 public:
  /// @param destination  index of an agent, which has no hop.
  /// @param hops  by agent; none: it has no route.
  /// @param names  of the agents; outlives this object.
  RoutesTo(std::size_t destination, std::vector<std::optional<RouteHop>> hops,
           const std::vector<std::string>& names);

  const std::optional<RouteHop>& hop(std::size_t agent) const { return hops_[agent]; }
  /// Links from the agent up to the destination; 0: the routes lead only part of the way.
  std::uint16_t length(std::size_t agent) const { return lengths_[agent].value_or(0); }
  /// Loops, which are mistakes, and routes that end before the destination.
  const std::vector<RouteFinding>& findings() const { return findings_; }

 private:
  void measure(std::size_t agent);
  void note_loop(const std::vector<std::size_t>& way, std::size_t again);
  void note_end(std::size_t agent);

  std::size_t destination_;
  std::vector<std::optional<RouteHop>> hops_;
  const std::vector<std::string>& names_;
  std::vector<std::optional<std::uint16_t>> lengths_;  ///< None: not known yet.
  std::vector<RouteFinding> findings_;
};

/// Notes findings in the rows of a file, at most one mistake and one warning in each.
class RouteFindings {
 public:
  /// @param rows  outlive this object.
  explicit RouteFindings(std::vector<config::Mapping>& rows) : rows_(rows) {}
  void add(const std::vector<RouteFinding>& found);
  bool has_mistake() const { return has_mistake_; }

 private:
  std::vector<config::Mapping>& rows_;
  std::set<std::pair<std::size_t, bool>> noted_;
  bool has_mistake_ = false;
};

}  // namespace hal::files::description
