#pragma once

#include "hal/files/description/fields.h"
#include "hal/types/time.h"

namespace hal::robot::drivers {

/// Timing of a device: how often the driver queries it, how long it waits for an answer, and the
/// age at which a reading is too old and the channel is lost.
struct DeviceTimes {
  Duration period{};       ///< > 0
  Duration timeout{};      ///< > 0
  Duration stale_after{};  ///< > period
  bool operator==(const DeviceTimes&) const = default;
};

/// `period`, `timeout` and `stale_after` of a device.
/// @param longest_period  s
void times_keys(files::description::Fields& io, DeviceTimes& times, double longest_period);

}  // namespace hal::robot::drivers
