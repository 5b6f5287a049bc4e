#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "hal/node/exchange/session.h"

namespace hal::node::exchange {

/// Agents by address and by name, each found in logarithmic time. Thread-safe.
class Directory {
 public:
  /// @param agents  in any order. If several have the same address or name, one of them is found.
  explicit Directory(std::vector<AgentName> agents = {});

  std::optional<AgentId> address_of(std::string_view name) const;
  /// Valid for the life of the directory.
  std::optional<std::string_view> name_of(AgentId agent) const;

 private:
  std::vector<AgentName> agents_;       ///< By address.
  std::vector<std::uint32_t> by_name_;  ///< Indices in agents_, by name.
};

}  // namespace hal::node::exchange
