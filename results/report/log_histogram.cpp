#include "results/report/log_histogram.h"

#include <algorithm>
#include <cmath>

#include "hal/types/math.h"

namespace results::report {
namespace {

int bin_of(double time) {
  const double low = hal::math::log10(LogHistogram::kLow);
  const double high = hal::math::log10(LogHistogram::kHigh);
  const double place = (hal::math::log10(time) - low) / (high - low) * LogHistogram::kBins;
  return std::clamp(static_cast<int>(std::floor(place)), 0, LogHistogram::kBins - 1);
}

}  // namespace

LogHistogram log_histogram(const std::vector<double>& times) {
  LogHistogram histogram;
  for (const double time : times) {
    if (time <= 0) {
      ++histogram.zeros;
    } else if (time < LogHistogram::kLow) {
      ++histogram.below;
    } else if (time > LogHistogram::kHigh) {
      ++histogram.above;
    } else {
      ++histogram.bins.at(static_cast<std::size_t>(bin_of(time)));
    }
  }
  return histogram;
}

}  // namespace results::report
