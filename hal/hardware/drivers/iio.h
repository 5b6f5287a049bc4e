#pragma once

#include <memory>

#include "hal/devices/robot_description.h"
#include "hal/hardware/drivers/infrared.h"
#include "hal/hardware/drivers/settings.h"

namespace hal::hardware {

/// Infrared sensors on an analog-to-digital converter of Linux's Industrial I/O subsystem (Linux
/// kernel, Documentation/ABI/testing/sysfs-bus-iio): millivolts = (raw + offset) * scale, read from
/// in_<channel>_raw, and in_<channel>_scale and _offset or, for all channels of a type alike,
/// in_<type>_scale and _offset. The offset may be missing.
/// @param robot  with as many infrared sensors as there are channels; their curves give the metres.
std::unique_ptr<InfraredDriver> make_iio_infrared(const IioSettings& settings,
                                                  const devices::RobotDescription& robot);

}  // namespace hal::hardware
