#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "hal/files/description/fields.h"
#include "hal/node/devices/sensors.h"
#include "hal/robot/drivers/device_times.h"
#include "hal/robot/drivers/sensor_driver.h"

namespace hal::robot::drivers {

/// A driver of a sensor as selected by a robot's file. Any thread; immutable.
class SensorChoice {
 public:
  SensorChoice() = default;
  SensorChoice(const SensorChoice&) = delete;
  SensorChoice& operator=(const SensorChoice&) = delete;
  virtual ~SensorChoice() = default;
  /// Creates the driver and starts its thread.
  virtual std::unique_ptr<SensorDriver> make() const = 0;
  virtual Duration period() const = 0;  ///< Time between two measurements, > 0.
};

/// A choice described by settings, which have a member `times`.
template <class Settings>
class ChosenSensor final : public SensorChoice {
 public:
  using Make = std::unique_ptr<SensorDriver> (*)(const Settings& settings);

  ChosenSensor(Settings settings, Make maker) : settings_(std::move(settings)), make_(maker) {}
  std::unique_ptr<SensorDriver> make() const override { return make_(settings_); }
  Duration period() const override { return settings_.times.period; }
  const Settings& settings() const { return settings_; }

 private:
  Settings settings_;
  Make make_;
};

/// A sensor of a real robot with its driver.
struct DrivenSensor {
  std::size_t sensor = 0;  ///< Index into the robot's `sensors`.
  std::shared_ptr<const SensorChoice> driver;
};

/// `sensors:` of a robot's file, in addition to `robot:`: which driver feeds which of the robot's
/// sensors. Sensors without a driver are not offered.
/// @param sensors  of the robot.
std::vector<DrivenSensor> driven_sensors_key(
    files::description::Fields& io, const std::vector<node::devices::SensorDescription>& sensors);

}  // namespace hal::robot::drivers
