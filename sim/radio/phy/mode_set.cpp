#include "sim/radio/phy/mode_set.h"

#include <algorithm>

#include "hal/types/check.h"
#include "sim/radio/phy/dsss_mode.h"
#include "sim/radio/phy/mcs_modes.h"
#include "sim/radio/phy/ofdm_mode.h"

namespace sim::radio {
namespace {

/// Nominal rate of instant frames.
constexpr hal::BitsPerSecond kAnyRate{11e6};

}  // namespace

ModeSet::ModeSet(const RadioConfig& config) {
  std::visit([this](const auto& one) { add(one); }, config);
}

void ModeSet::add(const WavesConfig& config) {
  add_dsss(config);
  choose(config.phy);
}

void ModeSet::add(const DcfConfig& config) {
  add_dsss(config);
  choose(config.phy);
  choose_basic(config);
}

void ModeSet::add(const Ieee80211gConfig& config) {
  add_ofdm(config);
  choose(config.phy);
  choose_basic(config);
}

void ModeSet::add(const HtConfig& config) {
  add_ofdm(config);
  choose(config.phy);
  choose_basic(config);
  add_mcs(config);
  const McsConfig& mcs = config.mcs;
  data_ = &at({config.modulation, mcs.mcs, mcs.streams, mcs.width, mcs.guard});
}

void ModeSet::choose_basic(const DcfConfig& config) {
  for (const hal::BitsPerSecond rate : config.basic_rates) basic_.push_back(&at(rate));
  if (config.beacon_rate) beacon_ = &at(*config.beacon_rate);
}

/// DSSS does not exist in 5 GHz.
void ModeSet::add_ofdm(const Ieee80211gConfig& config) {
  const bool is_erp = !is_5ghz(config.phy.channel);
  OfdmMode::Options options{.at_risk = config.bits_at_risk, .is_erp = is_erp};
  ModeId id{.modulation = ModulationClass::kOfdm};
  for (const double rate : kOfdmRates) {
    options.curve = curve_of(config.error_table, id);
    modes_.push_back(std::make_unique<OfdmMode>(hal::BitsPerSecond{rate}, options));
    ++id.mcs;
  }
  if (is_erp) add_dsss(config);
}

/// The modes for all receivers: of each class up to the station's own, up to its width, streams and
/// MCS, with the guard interval that nearest() gives.
void ModeSet::add_mcs(const HtConfig& config) {
  McsMode::Options options{.at_risk = config.bits_at_risk,
                           .has_extension = !is_5ghz(config.phy.channel),
                           .times = config.mcs.times};
  const ModeId most{config.modulation, config.mcs.mcs, config.mcs.streams, config.mcs.width,
                    config.mcs.guard};
  for (const ModeId& id : modes_up_to(most, config.phy.channel)) {
    options.curve = curve_of(config.error_table, id);
    modes_.push_back(make_mcs_mode(id, options));
  }
}

void ModeSet::add_dsss(const WavesConfig& config) {
  const DsssMode::Options options{config.phy.preamble, config.phy.rounding,
                                  config.receiver.error_model};
  for (const double rate : kDsssRates) {
    modes_.push_back(std::make_unique<DsssMode>(hal::BitsPerSecond{rate}, options));
  }
  std::ranges::sort(modes_, {}, [](const auto& mode) { return mode->rate().value; });
}

void ModeSet::choose(const PhyConfig& config) {
  data_ = &at(config.data_rate);
  broadcast_ = beacon_ = &at(config.broadcast_rate);
  control_ = &at(config.control_rate);
}

void ModeSet::add(const DiskConfig& config) { add_plain(config.data_rate, false); }

void ModeSet::add(const IdealConfig&) { add_plain(kAnyRate, true); }

void ModeSet::add_plain(hal::BitsPerSecond rate, bool is_instant) {
  modes_.push_back(std::make_unique<PlainMode>(rate, is_instant));
  data_ = broadcast_ = beacon_ = control_ = &lowest();
}

const PhyMode& ModeSet::response_to(const PhyMode& mode) const {
  if (basic_.empty()) return *control_;
  const bool is_plain = !has_streams(mode.modulation_class());
  const ModulationClass wanted = is_plain ? mode.modulation_class() : ModulationClass::kOfdm;
  const hal::BitsPerSecond most = mode.reference_rate();
  const auto fits = [wanted, most](const PhyMode& one) {
    return one.modulation_class() == wanted && one.rate() <= most;
  };
  const PhyMode* best = nullptr;
  for (const PhyMode* const one : basic_) {
    if (fits(*one) && (best == nullptr || one->rate() > best->rate())) best = one;
  }
  if (best != nullptr) return *best;
  for (const auto& one : modes_) {
    if (fits(*one) && one->is_mandatory()) best = one.get();
  }
  BARAKA_CHECK(best != nullptr);  // the lowest mode of each class is mandatory
  return *best;
}

const PhyMode& ModeSet::at(hal::BitsPerSecond rate) const {
  const auto found = std::ranges::find_if(modes_, [rate](const auto& mode) {
    return mode->rate() == rate && !has_streams(mode->modulation_class());
  });
  BARAKA_CHECK(found != modes_.end());
  return **found;
}

const PhyMode* ModeSet::find(const ModeId& id) const {
  const auto found =
      std::ranges::find_if(modes_, [&id](const auto& mode) { return mode->id() == id; });
  return found == modes_.end() ? nullptr : found->get();
}

const PhyMode& ModeSet::at(const ModeId& id) const {
  const PhyMode* const found = find(id);
  BARAKA_CHECK(found != nullptr);
  return *found;
}

}  // namespace sim::radio
