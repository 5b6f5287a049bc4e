#pragma once

#include <memory>

#include "hal/robot/drivers/driver_choice.h"
#include "hal/robot/drivers/tmc200_protocol.h"
#include "hal/robot/drivers/wheels.h"

namespace hal::robot::drivers {

/// Wheels on a TMC200 (see tmc200_protocol.h). The controller stops its motors after
/// `settings.cut_off` without a command; the driver repeats the last one every period. Odometry is
/// integrated from the speeds the controller measures. A single garbled line is passed over;
/// silence for the device's time-out is a lost connection.
/// @param robot  with three wheels.
std::unique_ptr<WheelDriver> make_tmc200_wheels(const Tmc200Settings& settings,
                                                const DrivenRobot& robot);

/// Their keys in a robot's file, and what it asks for.
std::shared_ptr<const DriverChoice<WheelDriver>> tmc200_wheels_keys(
    files::description::Fields& io, const node::devices::RobotDescription& robot);

}  // namespace hal::robot::drivers
