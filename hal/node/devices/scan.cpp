#include "hal/node/devices/scan.h"

#include <string>

#include "hal/types/math.h"

namespace hal::node::devices {

std::vector<double> ScanSensor::headings() const {
  constexpr double kFullTurn = 2 * math::kPi - 1e-9;  // rad; a file says 360 deg
  const int steps = field >= kFullTurn ? rays : rays - 1;
  std::vector<double> headings;
  headings.reserve(static_cast<std::size_t>(rays));
  for (int i = 0; i < rays; ++i)
    headings.push_back(steps == 0 ? 0 : field * (static_cast<double>(i) / steps - 0.5));
  return headings;
}

Channel ScanSensor::describe() const {
  return {.id = 0,
          .name = mount.name,
          .kind = std::string(kKind),
          .unit = "m",
          .length = static_cast<std::uint32_t>(rays),
          .period = period,
          .frame = mount.name,
          .headings = headings(),
          .low = min_range,
          .high = max_range,
          .position = mount.position,
          .heading = mount.heading};
}

}  // namespace hal::node::devices
