#include "hal/runtime/readings.h"

#include <fmt/core.h>

#include <algorithm>

namespace hal::runtime {

Result<void> Readings::hold(const exchange::Reading& reading) {
  const auto channel = std::ranges::find(channels_, reading.channel, &Channel::id);
  if (channel == channels_.end()) {
    return fail(Errc::kProtocol, fmt::format("a reading of channel {}, which is not in the session",
                                             reading.channel));
  }
  if (reading.lost) {
    values_.erase(reading.channel);
    lost_.insert(reading.channel);
    return {};
  }
  if (channel->length != 0 && channel->length != reading.values.size()) {
    return fail(Errc::kProtocol,
                fmt::format("a reading of channel '{}' with {} values instead of {}", channel->name,
                            reading.values.size(), channel->length));
  }
  values_[reading.channel] = reading.values;
  lost_.erase(reading.channel);
  return {};
}

const Channel* Readings::find(std::string_view channel) const {
  const auto found = std::ranges::find(channels_, channel, &Channel::name);
  return found == channels_.end() ? nullptr : &*found;
}

Result<std::span<const double>> Readings::values(std::string_view channel) const {
  const Channel* const found = find(channel);
  if (found == nullptr) {
    return fail(
        Errc::kNotAvailable,
        fmt::format("no channel '{}': the agent has none or it was not asked for", channel));
  }
  const auto held = values_.find(found->id);
  if (held == values_.end()) {
    return fail(Errc::kNotAvailable,
                fmt::format("channel '{}' {}", channel,
                            lost_.contains(found->id) ? "is lost: its device gives no new reading"
                                                      : "has not been sampled yet"));
  }
  return std::span<const double>(held->second);
}

}  // namespace hal::runtime
