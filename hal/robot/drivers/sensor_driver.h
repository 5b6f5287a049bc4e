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

/// One of the `sensors:` of a real robot, measured again and again by a thread of the driver, which
/// reconnects as a WheelDriver does. Any thread.
class SensorDriver {
 public:
  virtual ~SensorDriver() = default;
  SensorDriver(const SensorDriver&) = delete;
  SensorDriver& operator=(const SensorDriver&) = delete;

  /// Returns at once. Errors: kNotConnected, kNotAvailable (none yet), kTimeout (the last
  /// measurement is too old to be used; which age that is, the file says).
  virtual Result<SensorReading> latest() const = 0;

  virtual bool connected() const = 0;
  virtual std::string trouble() const = 0;  ///< Empty while connected.
  virtual platform::DeviceCounts counts() const = 0;

 protected:
  SensorDriver() = default;
};

}  // namespace hal::robot::drivers
