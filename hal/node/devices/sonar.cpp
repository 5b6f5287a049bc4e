#include "hal/node/devices/sonar.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace hal::node::devices {

Channel Sonar::describe() const {
  return {.id = 0,
          .name = mount.name,
          .kind = std::string(kKind),
          .unit = "m",
          .length = 1,
          .period = period,
          .frame = mount.name,
          .headings = {-half_angle, half_angle},
          .low = min_range,
          .high = max_range,
          .position = mount.position,
          .heading = mount.heading};
}

double Sonar::reading(double metres, double noise) const {
  if (metres > max_range) return std::numeric_limits<double>::quiet_NaN();
  if (metres < min_range) return -std::numeric_limits<double>::infinity();
  double told = metres + noise;
  if (resolution > 0) told = std::round(told / resolution) * resolution;
  return std::clamp(told, min_range, max_range);
}

}  // namespace hal::node::devices
