#include "sim/radio/channel/shadowing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/types/math.h"
#include "hal/types/random.h"

namespace sim::radio {
namespace {

/// More: nearer to a normal distribution (kurtosis 3 - 3 / (2 n)).
constexpr int kCosines = 32;
constexpr double kCut = 3;  ///< Standard deviations.
constexpr double kFullTurn = 2 * hal::math::kPi;

/// Wave vector times place [m], the vector drawn with the spectrum of exp(-r / distance).
double random_phase(hal::RandomStream& random, const hal::Vec3& place, double distance) {
  // Share of the spectrum beyond k: 1 / sqrt(1 + k^2 d^2).
  const double beyond = 1 - random.uniform();  // above 0
  const double k = std::sqrt(1 / (beyond * beyond) - 1) / distance;
  const double direction = kFullTurn * random.uniform();
  return k * (place.x * hal::math::cos(direction) + place.y * hal::math::sin(direction));
}

/// Standard deviations by which a link differs from the mean.
double deviation(const Path& path, double distance) {
  hal::RandomStream random(path.link(), "shadowing");
  double sum = 0;
  for (int i = 0; i < kCosines; ++i) {
    const double here = random_phase(random, path.first().position, distance);
    const double there = random_phase(random, path.second().position, distance);
    const double turns = (here + there) / kFullTurn + random.uniform();
    sum += hal::math::cos(kFullTurn * (turns - std::floor(turns)));
  }
  return std::clamp(std::sqrt(2.0 / kCosines) * sum, -kCut, kCut);
}

double gain(double decibels) { return hal::math::pow(10, decibels / 10); }

}  // namespace

std::unique_ptr<const PathLoss> make(const ShadowingConfig& config,
                                     const PropagationConfig& /*air*/, const Ground& /*ground*/) {
  return std::make_unique<Shadowing>(config);
}

hal::Milliwatts Shadowing::after(hal::Milliwatts power, const Path& path) const {
  return gain(sigma_ * deviation(path, distance_)) * power;
}

double Shadowing::reach(hal::Milliwatts, hal::Milliwatts) const {
  return std::numeric_limits<double>::infinity();
}

double Shadowing::most_gain() const { return gain(kCut * sigma_); }

}  // namespace sim::radio
