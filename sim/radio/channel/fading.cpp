#include "sim/radio/channel/fading.h"

#include <cmath>
#include <limits>

#include "hal/types/math.h"
#include "hal/types/random.h"

namespace sim::radio {
namespace {

constexpr double kTurn = 2 * hal::math::kPi;

}  // namespace

double Fading::reach(hal::Milliwatts, hal::Milliwatts) const {
  return std::numeric_limits<double>::infinity();
}

Fading::Wave Fading::scattered(const Path& path) const {
  hal::RandomStream random(path.link(), "fading");
  const hal::Vec3 way = path.second().position - path.first().position;
  const double turns_here_x = way.x / wavelength_, turns_here_y = way.y / wavelength_;
  const double turns_in_time = speed_ * hal::to_seconds(path.at - hal::Time{}) / wavelength_;
  Wave sum{0, 0};
  for (int i = 0; i < kWaves; ++i) {
    const double direction = kTurn * random.uniform();
    const double scatterer = kTurn * random.uniform();
    double turns = random.uniform() + turns_here_x * hal::math::cos(direction) +
                   turns_here_y * hal::math::sin(direction);
    if (speed_ > 0) turns += turns_in_time * hal::math::cos(scatterer);
    const double phase = kTurn * (turns - std::floor(turns));
    sum.in_phase += hal::math::cos(phase);
    sum.quadrature += hal::math::sin(phase);
  }
  const double scale = 1 / std::sqrt(static_cast<double>(kWaves));
  return {scale * sum.in_phase, scale * sum.quadrature};
}

Fading::Wave Fading::direct(const Path& path) const {
  const double turns = std::sqrt(path.distance_squared) / wavelength_;
  const double phase = kTurn * (turns - std::floor(turns));
  return {hal::math::cos(phase), hal::math::sin(phase)};
}

}  // namespace sim::radio
