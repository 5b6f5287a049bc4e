#pragma once

#include <filesystem>

#include "hal/types/result.h"

namespace hal::robot::drivers {

/// The number in an attribute of a device in sysfs, obtained by one read as sysfs requires. Errors:
/// kNotConnected (it cannot be read), kProtocol (it contains no number).
Result<double> read_attribute(const std::filesystem::path& file);

bool has_attribute(const std::filesystem::path& file);

}  // namespace hal::robot::drivers
