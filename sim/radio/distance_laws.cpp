#include "sim/radio/distance_laws.h"

#include <cmath>

#include "hal/types/math.h"

namespace sim::radio {

LogDistance::LogDistance(const LogDistanceConfig& config)
    : at_reference_(hal::math::pow(10, -config.reference_loss.value / 10)),
      reference_(config.reference_distance.value),
      exponent_(config.exponent) {}

hal::Milliwatts LogDistance::after(hal::Milliwatts power, const Path& path) const {
  const double near = at_reference_ * power.value;
  const double ratio = path.distance_squared / (reference_ * reference_);
  if (ratio <= 1) return hal::Milliwatts{near};
  return hal::Milliwatts{near / to_the(exponent_, ratio)};
}

double LogDistance::reach(hal::Milliwatts power, hal::Milliwatts least) const {
  const double ratio = at_reference_ * power.value / least.value;
  return ratio < 1 ? 0 : reference_ * hal::math::pow(ratio, 1 / exponent_);
}

/// m, of the antenna above the ground.
double TwoRayGround::height(const Site& site) const {
  return site.antenna().z - ground_.height({site.position.x, site.position.y});
}

hal::Milliwatts TwoRayGround::after(hal::Milliwatts power, const Path& path) const {
  const double heights = height(path.from) * height(path.to);  // m^2
  const double crossover = 4 * hal::math::kPi * heights / wavelength_;
  if (heights <= 0) return {};  // on the ground the two rays extinguish each other
  if (path.distance_squared <= crossover * crossover) return free_space_.after(power, path);
  const double d2 = path.distance_squared;
  return hal::Milliwatts{power.value * (heights * heights) / (d2 * d2)};
}

}  // namespace sim::radio
