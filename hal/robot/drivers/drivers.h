#pragma once

#include <memory>

#include "hal/files/description/fields.h"
#include "hal/node/devices/robot_description.h"
#include "hal/robot/drivers/driver_choice.h"
#include "hal/robot/drivers/infrared.h"
#include "hal/robot/drivers/wheels.h"

namespace hal::robot::drivers {

/// `wheels:` and `infrared:` of a robot's file: `driver` and the keys of that driver.
/// @return  null: "none", or a mistake, which is recorded.
std::shared_ptr<const DriverChoice<WheelDriver>> wheels_keys(
    files::description::Fields& io, const node::devices::RobotDescription& robot);
std::shared_ptr<const DriverChoice<InfraredDriver>> infrared_keys(
    files::description::Fields& io, const node::devices::RobotDescription& robot);

}  // namespace hal::robot::drivers
