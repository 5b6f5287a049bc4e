#pragma once

#include <string>
#include <vector>

#include "hal/robot/platform/boot_time.h"
#include "hal/robot/platform/device_counts.h"
#include "hal/types/result.h"

namespace hal::robot::drivers {

/// One measurement of all sensors, in the order of the robot's `mounts`.
struct InfraredReadings {
  std::vector<double> metres;  ///< NaN: nothing within reach.
  std::vector<double> volts;   ///< As measured, or as the curve gives them for the metres.
  platform::BootTime stamp;
};

/// The infrared sensors of a real robot, measured again and again by a thread of the driver, which
/// reconnects as a WheelDriver does. Any thread.
class InfraredDriver {
 public:
  virtual ~InfraredDriver() = default;
  InfraredDriver(const InfraredDriver&) = delete;
  InfraredDriver& operator=(const InfraredDriver&) = delete;

  /// Returns at once. Errors: kNotConnected, kNotAvailable (none yet), kTimeout (the last
  /// measurement is too old to be used; which age that is, the file says).
  virtual Result<InfraredReadings> latest() const = 0;

  virtual bool connected() const = 0;
  virtual std::string trouble() const = 0;  ///< Empty while connected.
  virtual platform::DeviceCounts counts() const = 0;

 protected:
  InfraredDriver() = default;
};

}  // namespace hal::robot::drivers
