#include "sim/radio/channel/multi_wall.h"

#include <algorithm>

#include "hal/types/math.h"
#include "sim/radio/channel/power_law.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

std::unique_ptr<const PathLoss> make(const MultiWallConfig& config, const PropagationConfig& air,
                                     const Ground& /*ground*/) {
  return std::make_unique<MultiWall>(config, air.wavelength);
}

MultiWall::MultiWall(const MultiWallConfig& config, hal::Metres wavelength)
    : exponent_(config.exponent) {
  const double free_space = wavelength.value / (4 * hal::math::kPi);
  at_reference_ = free_space * free_space * hal::math::pow(10, -config.constant_loss.value / 10);
}

hal::Milliwatts MultiWall::after(hal::Milliwatts power, const Path& path) const {
  const double near = at_reference_ * power.value;
  const double loss = to_the(exponent_, path.distance_squared);
  return hal::Milliwatts{near < power.value * loss ? near / loss : power.value};
}

double MultiWall::reach(hal::Milliwatts power, hal::Milliwatts least) const {
  if (least > power) return 0;
  return hal::math::pow(at_reference_ * power.value / least.value, 1 / exponent_);
}

}  // namespace sim::radio
