#include "sim/radio/channel/two_ray_ground.h"

#include "hal/types/math.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

std::unique_ptr<const PathLoss> make(const TwoRayGroundConfig& /*config*/,
                                     const PropagationConfig& air, const Ground& ground) {
  return std::make_unique<TwoRayGround>(air.wavelength, ground);
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
