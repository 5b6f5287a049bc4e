#include "hal/node/exchange/directory.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace hal::node::exchange {

Directory::Directory(std::vector<AgentName> agents)
    : agents_(std::move(agents)), by_name_(agents_.size()) {
  std::ranges::stable_sort(agents_, {}, &AgentName::agent);
  std::iota(by_name_.begin(), by_name_.end(), 0U);
  std::ranges::stable_sort(
      by_name_, {}, [this](std::uint32_t i) -> const std::string& { return agents_[i].name; });
}

std::optional<AgentId> Directory::address_of(std::string_view name) const {
  const auto name_at = [this](std::uint32_t i) { return std::string_view(agents_[i].name); };
  const auto found = std::ranges::lower_bound(by_name_, name, {}, name_at);
  if (found == by_name_.end() || name_at(*found) != name) return std::nullopt;
  return agents_[*found].agent;
}

std::optional<std::string_view> Directory::name_of(AgentId agent) const {
  const auto found = std::ranges::lower_bound(agents_, agent, {}, &AgentName::agent);
  if (found == agents_.end() || found->agent != agent) return std::nullopt;
  return found->name;
}

}  // namespace hal::node::exchange
