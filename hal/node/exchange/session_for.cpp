#include <fmt/core.h>

#include <algorithm>

#include "hal/node/exchange/ports.h"

namespace hal::node::exchange {
namespace {

std::string names_of(const std::vector<Channel>& channels) {
  std::string names;
  for (const Channel& channel : channels) names += (names.empty() ? "" : ", ") + channel.name;
  return names.empty() ? "none" : names;
}

}  // namespace

Result<AgentSession> session_for(const AgentOffer& offer, const Wants& wants) {
  const std::vector<Channel>& offered = offer.session.channels;
  for (const std::string& name : wants.channels) {
    if (std::ranges::find(offered, name, &Channel::name) != offered.end()) continue;
    return fail(Errc::kNotAvailable, fmt::format("{} has no channel '{}'; it has: {}",
                                                 offer.session.name, name, names_of(offered)));
  }
  AgentSession session = offer.session;
  std::erase_if(session.channels, [&](const Channel& c) { return !wants.asks_for(c.name); });
  return session;
}

}  // namespace hal::node::exchange
