#pragma once

#include <string>
#include <vector>

#include "hal/robot/platform/boot_time.h"
#include "hal/robot/platform/device_counts.h"
#include "hal/types/result.h"

namespace hal::robot::drivers {

/// One measurement of a sensor, in the order of its channel.
struct SensorReading {
  std::vector<double> values;
  platform::BootTime stamp;
};

/// One of the `sensors:` of a real robot, measured repeatedly by a thread of the driver, which
/// reconnects as a WheelDriver does. Any thread.
class SensorDriver {
 public:
  virtual ~SensorDriver() = default;
  SensorDriver(const SensorDriver&) = delete;
  SensorDriver& operator=(const SensorDriver&) = delete;

  /// Does not block. Errors: kNotConnected, kNotAvailable (none yet), kTimeout (the last
  /// measurement is older than `stale_after` of the file).
  virtual Result<SensorReading> latest() const = 0;

  virtual bool connected() const = 0;
  virtual std::string trouble() const = 0;  ///< Why the device is not connected; empty while it is.
  virtual platform::DeviceCounts counts() const = 0;

 protected:
  SensorDriver() = default;
};

}  // namespace hal::robot::drivers
