#include "gateway/runtime/readings.h"

#include <fmt/core.h>

#include <algorithm>

namespace gateway::runtime {

hal::Result<void> Readings::hold(const hal::node::exchange::Reading& reading) {
  const auto channel = std::ranges::find(channels_, reading.channel, &hal::Channel::id);
  if (channel == channels_.end()) {
    return hal::fail(
        hal::Errc::kProtocol,
        fmt::format("a reading of channel {}, which is not in the session", reading.channel));
  }
  if (reading.lost) {
    values_.erase(reading.channel);
    lost_.insert(reading.channel);
    return {};
  }
  if (channel->length != 0 && channel->length != reading.values.size()) {
    return hal::fail(hal::Errc::kProtocol,
                     fmt::format("a reading of channel '{}' with {} values instead of {}",
                                 channel->name, reading.values.size(), channel->length));
  }
  values_[reading.channel] = reading.values;
  lost_.erase(reading.channel);
  return {};
}

const hal::Channel* Readings::find(std::string_view channel) const {
  const auto found = std::ranges::find(channels_, channel, &hal::Channel::name);
  return found == channels_.end() ? nullptr : &*found;
}

hal::Result<std::span<const double>> Readings::values(std::string_view channel) const {
  const hal::Channel* const found = find(channel);
  if (found == nullptr) {
    return hal::fail(
        hal::Errc::kNotAvailable,
        fmt::format("no channel '{}': the agent has none or it was not asked for", channel));
  }
  const auto held = values_.find(found->id);
  if (held == values_.end()) {
    return hal::fail(
        hal::Errc::kNotAvailable,
        fmt::format("channel '{}' {}", channel,
                    lost_.contains(found->id) ? "is lost: its device gives no new reading"
                                              : "has not been sampled yet"));
  }
  return std::span<const double>(held->second);
}

}  // namespace gateway::runtime
