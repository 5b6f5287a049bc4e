#include "sim/radio/mode_set.h"

#include <algorithm>

#include "hal/types/check.h"
#include "sim/radio/dsss_mode.h"

namespace sim::radio {
namespace {

/// Written into instant frames.
constexpr hal::BitsPerSecond kAnyRate{11e6};

}  // namespace

ModeSet::ModeSet(const RadioConfig& config) {
  std::visit([this](const auto& one) { add(one); }, config);
}

void ModeSet::add(const WavesConfig& config) {
  const DsssMode::Options options{config.phy.preamble, config.phy.rounding,
                                  config.receiver.error_model};
  for (const double rate : {1e6, 2e6, 5.5e6, 11e6}) {
    modes_.push_back(std::make_unique<DsssMode>(hal::BitsPerSecond{rate}, options));
  }
  data_ = &at(config.phy.data_rate);
  broadcast_ = &at(config.phy.broadcast_rate);
  control_ = &at(config.phy.control_rate);
}

void ModeSet::add(const DiskConfig& config) { add_plain(config.data_rate, false); }

void ModeSet::add(const IdealConfig&) { add_plain(kAnyRate, true); }

void ModeSet::add_plain(hal::BitsPerSecond rate, bool is_instant) {
  modes_.push_back(std::make_unique<PlainMode>(rate, is_instant));
  data_ = broadcast_ = control_ = &lowest();
}

const PhyMode& ModeSet::at(hal::BitsPerSecond rate) const {
  const auto found =
      std::ranges::find_if(modes_, [rate](const auto& mode) { return mode->rate() == rate; });
  BARAKA_CHECK(found != modes_.end());
  return **found;
}

}  // namespace sim::radio
