#pragma once

#include <memory>
#include <string_view>
#include <utility>

#include "hal/files/description/fields.h"
#include "hal/node/devices/robot_description.h"
#include "hal/robot/drivers/driven_robot.h"
#include "hal/types/time.h"

namespace hal::robot::drivers {

/// A driver as selected by a robot's file. Any thread; immutable.
/// @tparam Driver  WheelDriver or InfraredDriver.
template <class Driver>
class DriverChoice {
 public:
  DriverChoice() = default;
  DriverChoice(const DriverChoice&) = delete;
  DriverChoice& operator=(const DriverChoice&) = delete;
  virtual ~DriverChoice() = default;

  /// Creates the driver and starts its threads. A device that does not answer is not an error: the
  /// driver keeps trying.
  virtual std::unique_ptr<Driver> make(const DrivenRobot& robot) const = 0;
  virtual Duration period() const = 0;  ///< Time between two queries of the device, > 0.
};

/// A choice described by settings, which have a member `times`.
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
  std::string_view name;  ///< As in the file: `driver: <name>`.
  /// Describes its keys and returns the choice that they describe. @param robot  of the file.
  std::shared_ptr<const DriverChoice<Driver>> (*keys)(files::description::Fields& io,
                                                      const node::devices::RobotDescription& robot);
};

}  // namespace hal::robot::drivers
