#pragma once

#include <memory>
#include <string_view>
#include <utility>

#include "hal/files/description/fields.h"
#include "hal/node/devices/robot_description.h"
#include "hal/robot/drivers/driven_robot.h"
#include "hal/types/time.h"

namespace hal::robot::drivers {

/// A driver as a robot's file asks for it. Any thread; immutable.
/// @tparam Driver  WheelDriver or InfraredDriver.
template <class Driver>
class DriverChoice {
 public:
  DriverChoice() = default;
  DriverChoice(const DriverChoice&) = delete;
  DriverChoice& operator=(const DriverChoice&) = delete;
  virtual ~DriverChoice() = default;

  /// The driver, its threads started. A device that does not answer is no error: the driver goes on
  /// trying.
  virtual std::unique_ptr<Driver> make(const DrivenRobot& robot) const = 0;
  virtual Duration period() const = 0;  ///< Between two questions of the device, > 0.
};

/// One that its settings describe, which have `times`.
template <class Driver, class Settings>
class ChosenDriver final : public DriverChoice<Driver> {
 public:
  using Make = std::unique_ptr<Driver> (*)(const Settings& settings, const DrivenRobot& robot);

  ChosenDriver(Settings settings, Make maker) : settings_(std::move(settings)), make_(maker) {}

  std::unique_ptr<Driver> make(const DrivenRobot& robot) const override {
    return make_(settings_, robot);
  }
  Duration period() const override { return settings_.times.period; }
  const Settings& settings() const { return settings_; }

 private:
  Settings settings_;
  Make make_;
};

/// A driver that a file may name.
template <class Driver>
struct DriverKind {
  std::string_view name;  ///< In the file: `driver: <name>`.
  /// Describes its keys, and what they ask for. @param robot  of the file.
  std::shared_ptr<const DriverChoice<Driver>> (*keys)(files::description::Fields& io,
                                                      const node::devices::RobotDescription& robot);
};

}  // namespace hal::robot::drivers
