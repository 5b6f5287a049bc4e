#pragma once

#include <optional>
#include <vector>

#include "hal/types/channel.h"
#include "hal/types/time.h"

namespace hal::node::devices {

/// One sensor of an agent, simulated or real: a channel and its values on request. One thread at a
/// time.
class Sensor {
 public:
  Sensor() = default;
  Sensor(const Sensor&) = delete;
  Sensor& operator=(const Sensor&) = delete;
  virtual ~Sensor() = default;

  /// The channel. The agent assigns the `id` of channels of `sensors:`; here it is 0.
  virtual Channel describe() const = 0;

  /// The values of the channel, in its order, if they are new at this time; nullopt: those of the
  /// previous call still hold. @param at  not before that of the previous call.
  virtual std::optional<std::vector<double>> sample(Time at) = 0;
};

}  // namespace hal::node::devices
