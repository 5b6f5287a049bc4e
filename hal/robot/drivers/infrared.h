#pragma once

#include <string>
#include <vector>

#include "hal/robot/platform/boot_time.h"
#include "hal/robot/platform/device_counts.h"
#include "hal/types/result.h"

namespace hal::robot::drivers {

/// One measurement of all sensors, in the order of the robot's `mounts`.
struct InfraredReadings {
  std::vector<double> metres;  ///< NaN: nothing within range.
  std::vector<double> volts;   ///< As measured, or computed from the metres by the curve.
  platform::BootTime stamp;
};

/// The infrared sensors of a real robot, measured repeatedly by a thread of the driver, which
/// reconnects as a WheelDriver does. Any thread.
class InfraredDriver {
 public:
  virtual ~InfraredDriver() = default;
  InfraredDriver(const InfraredDriver&) = delete;
  InfraredDriver& operator=(const InfraredDriver&) = delete;

  /// Does not block. Errors: kNotConnected, kNotAvailable (none yet), kTimeout (the last
  /// measurement is older than `stale_after` of the file).
  virtual Result<InfraredReadings> latest() const = 0;

  virtual bool connected() const = 0;
  virtual std::string trouble() const = 0;  ///< Why the device is not connected; empty while it is.
  virtual platform::DeviceCounts counts() const = 0;

 protected:
  InfraredDriver() = default;
};

}  // namespace hal::robot::drivers
