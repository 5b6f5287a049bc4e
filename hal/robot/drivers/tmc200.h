#pragma once

#include <memory>

#include "hal/robot/drivers/driver_choice.h"
#include "hal/robot/drivers/tmc200_protocol.h"
#include "hal/robot/drivers/wheels.h"

namespace hal::robot::drivers {

/// Wheels on a TMC200 (see tmc200_protocol.h). The controller stops its motors after
/// `settings.cut_off` without a command; the driver repeats the last one every period. Odometry is
/// integrated from the speeds that the controller measures. A single invalid line is ignored;
/// silence for the device's time-out means a lost connection.
/// @param robot  must have three wheels.
std::unique_ptr<WheelDriver> make_tmc200_wheels(const Tmc200Settings& settings,
                                                const DrivenRobot& robot);

/// Reads their keys in a robot's file; returns the choice that they describe.
std::shared_ptr<const DriverChoice<WheelDriver>> tmc200_wheels_keys(
    files::description::Fields& io, const node::devices::RobotDescription& robot);

}  // namespace hal::robot::drivers
