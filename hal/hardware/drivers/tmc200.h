#pragma once

#include <memory>

#include "hal/hardware/drivers/driver_choice.h"
#include "hal/hardware/drivers/tmc200_protocol.h"
#include "hal/hardware/drivers/wheels.h"

namespace hal::hardware {

/// Wheels on a TMC200 (see tmc200_protocol.h). The controller stops its motors after
/// `settings.cut_off` without a command; the driver repeats the last one every period. Odometry is
/// integrated from the speeds the controller measures. A single garbled line is passed over;
/// silence for the device's time-out is a lost connection.
/// @param robot  with three wheels.
std::unique_ptr<WheelDriver> make_tmc200_wheels(const Tmc200Settings& settings,
                                                const DrivenRobot& robot);

/// Their keys in a robot's file.
std::shared_ptr<const DriverChoice<WheelDriver>> read_tmc200_wheels(
    config::Mapping& in, const devices::RobotDescription& robot);

}  // namespace hal::hardware
