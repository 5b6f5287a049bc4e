#include "sim/radio/mode_set.h"

#include <algorithm>

#include "hal/types/check.h"
#include "sim/radio/dsss_mode.h"

namespace sim::radio {

ModeSet::ModeSet(const RadioConfig& config) {
  if (config.profile == Profile::kDisk || config.profile == Profile::kIdeal) {
    modes_.push_back(
        std::make_unique<PlainMode>(config.data_rate, config.profile == Profile::kIdeal));
    return;
  }
  const DsssMode::Options options{config.preamble, config.rounding, config.error_model};
  for (const double rate : {1e6, 2e6, 5.5e6, 11e6}) {
    modes_.push_back(std::make_unique<DsssMode>(hal::BitsPerSecond{rate}, options));
  }
}

const PhyMode& ModeSet::at(hal::BitsPerSecond rate) const {
  const auto found =
      std::ranges::find_if(modes_, [rate](const auto& mode) { return mode->rate() == rate; });
  BARAKA_CHECK(found != modes_.end());
  return **found;
}

}  // namespace sim::radio
