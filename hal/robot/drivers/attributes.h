#pragma once

#include <filesystem>

#include "hal/types/result.h"

namespace hal::robot::drivers {

/// The number that an attribute of a device in sysfs holds: one read, as sysfs wants it. Errors:
/// kNotConnected (it cannot be read), kProtocol (it holds no number).
Result<double> read_attribute(const std::filesystem::path& file);

bool has_attribute(const std::filesystem::path& file);

}  // namespace hal::robot::drivers
