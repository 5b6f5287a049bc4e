#include "sim/radio/channel/log_distance.h"

#include "hal/types/math.h"
#include "sim/radio/channel/power_law.h"

namespace sim::radio {

std::unique_ptr<const PathLoss> make(const LogDistanceConfig& config,
                                     const PropagationConfig& /*air*/, const Ground& /*ground*/) {
  return std::make_unique<LogDistance>(config);
}

LogDistance::LogDistance(const LogDistanceConfig& config)
    : at_reference_(hal::math::pow(10, -config.reference_loss.value / 10)),
      reference_(config.reference_distance.value),
      exponent_(config.exponent) {}

hal::Milliwatts LogDistance::after(hal::Milliwatts power, const Path& path) const {
  const double near = at_reference_ * power.value;
  double ratio = path.distance_squared;
  if (reference_ != 1) ratio /= reference_ * reference_;  // by 1 it would remain equal
  if (ratio <= 1) return hal::Milliwatts{near};
  return hal::Milliwatts{near / to_the(exponent_, ratio)};
}

double LogDistance::reach(hal::Milliwatts power, hal::Milliwatts least) const {
  const double ratio = at_reference_ * power.value / least.value;
  return ratio < 1 ? 0 : reference_ * hal::math::pow(ratio, 1 / exponent_);
}

}  // namespace sim::radio
