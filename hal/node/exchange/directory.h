#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "hal/node/exchange/session.h"

namespace hal::node::exchange {

/// Who is who: agents by address and by name, each in logarithmic time. Thread-safe.
class Directory {
 public:
  /// @param agents  in any order. Of several with the same address, or name, one is found.
  explicit Directory(std::vector<AgentName> agents = {});

  std::optional<AgentId> address_of(std::string_view name) const;
  /// Valid as long as the directory lives.
  std::optional<std::string_view> name_of(AgentId agent) const;

 private:
  std::vector<AgentName> agents_;       ///< By address.
  std::vector<std::uint32_t> by_name_;  ///< Indices in agents_, by name.
};

}  // namespace hal::node::exchange
