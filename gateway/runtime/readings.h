#pragma once

#include <map>
#include <set>
#include <span>
#include <string_view>
#include <vector>

#include "hal/node/exchange/step.h"
#include "hal/types/channel.h"
#include "hal/types/result.h"

namespace gateway::runtime {

/// The latest values of an agent's channels. They are kept until the next sample, or until the host
/// says that they are too old.
class Readings {
 public:
  explicit Readings(const std::vector<hal::Channel>& channels) : channels_(channels) {}

  /// Stores a reading. Errors: kProtocol (a channel that the session does not have; a wrong number
  /// of values). The old values are kept then.
  hal::Result<void> hold(const hal::node::exchange::Reading& reading);

  /// Null if the agent has no such channel, or the controller did not ask for it.
  const hal::Channel* find(std::string_view channel) const;

  /// Errors: kNotAvailable (no such channel, not asked for, not sampled yet, lost).
  hal::Result<std::span<const double>> values(std::string_view channel) const;

  const std::vector<hal::Channel>& channels() const { return channels_; }

 private:
  std::vector<hal::Channel> channels_;
  std::map<std::uint16_t, std::vector<double>> values_;
  std::set<std::uint16_t> lost_;
};

}  // namespace gateway::runtime
