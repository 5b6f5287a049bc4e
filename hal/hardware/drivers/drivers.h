#pragma once

#include <memory>

#include "hal/config/mapping.h"
#include "hal/devices/robot_description.h"
#include "hal/hardware/drivers/driver_choice.h"
#include "hal/hardware/drivers/infrared.h"
#include "hal/hardware/drivers/wheels.h"

namespace hal::hardware {

/// `wheels:` and `infrared:` of a robot's file: `driver` and the keys of that driver. Null: "none",
/// or a mistake, which is noted.
std::shared_ptr<const DriverChoice<WheelDriver>> read_wheels(
    config::Mapping in, const devices::RobotDescription& robot);
std::shared_ptr<const DriverChoice<InfraredDriver>> read_infrared(
    config::Mapping in, const devices::RobotDescription& robot);

}  // namespace hal::hardware
