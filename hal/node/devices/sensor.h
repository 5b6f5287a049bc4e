#pragma once

#include <optional>
#include <vector>

#include "hal/types/channel.h"
#include "hal/types/time.h"

namespace hal::node::devices {

/// One sensor of an agent, simulated or real: a channel, and its values when they are asked for.
/// One thread at a time.
class Sensor {
 public:
  Sensor() = default;
  Sensor(const Sensor&) = delete;
  Sensor& operator=(const Sensor&) = delete;
  virtual ~Sensor() = default;

  /// The channel; the `id` of one of `sensors:` is the agent's business and 0 here.
  virtual Channel describe() const = 0;

  /// The values of the channel that are new at a time, in its order; none: those of the last call
  /// still hold. @param at  not before that of the last call.
  virtual std::optional<std::vector<double>> sample(Time at) = 0;
};

}  // namespace hal::node::devices
