#include "sim/radio/channel/two_ray_interference.h"

#include <algorithm>
#include <cmath>

#include "hal/types/math.h"
#include "sim/radio/channel/antenna.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {
namespace {

/// Amplitude of the ray to the other antenna's image over that of the direct one, by the gains of
/// the antenna here. @param below  m, of the image's height to that of the antenna here; <= 0.
double share_towards_image(const Site& here, const Site& there, double below) {
  if (here.directed == nullptr) return 1;
  hal::Vec3 way = there.antenna() - here.antenna();
  const double direct = here.directed->towards(way);
  way.z = below;
  return std::sqrt(here.directed->towards(way) / direct);
}

}  // namespace

std::unique_ptr<const PathLoss> make(const TwoRayInterferenceConfig& config,
                                     const PropagationConfig& air, const Ground& ground) {
  return std::make_unique<TwoRayInterference>(air.wavelength, config.reflection, ground);
}

/// m, of the antenna above the ground.
double TwoRayInterference::height(const Site& site) const {
  return std::max(site.antenna().z - ground_.height({site.position.x, site.position.y}), 0.0);
}

hal::Milliwatts TwoRayInterference::after(hal::Milliwatts power, const Path& path) const {
  const double here = height(path.from), there = height(path.to);
  const double longer = 4 * here * there;  // d2^2 - d1^2, m^2
  const double direct = std::sqrt(path.distance_squared);
  const double reflected = std::sqrt(path.distance_squared + longer);
  if (direct <= 0) return power;
  // d2 - d1, without the cancellation far away.
  const double waves = longer / (direct + reflected) / wavelength_;
  const double phase = 2 * hal::math::kPi * (waves - std::floor(waves));
  const double patterns = share_towards_image(path.from, path.to, -here - there) *
                          share_towards_image(path.to, path.from, -here - there);
  const double share = reflection_ * patterns * direct / reflected;  // of the direct amplitude
  const double in_phase = 1 + share * hal::math::cos(phase);
  const double in_quadrature = share * hal::math::sin(phase);
  const double gain = in_phase * in_phase + in_quadrature * in_quadrature;
  const double per_wavelength = wavelength_ / (4 * hal::math::kPi);
  const double left = gain * per_wavelength * per_wavelength / path.distance_squared;
  return hal::Milliwatts{power.value * std::min(left, 1.0)};
}

double TwoRayInterference::reach(hal::Milliwatts power, hal::Milliwatts least) const {
  const double most = 1 + std::abs(reflection_);
  return free_space_.reach(most * most * power, least);
}

}  // namespace sim::radio
