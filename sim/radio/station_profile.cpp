#include "sim/radio/station_profile.h"

#include <algorithm>

#include "hal/types/check.h"
#include "sim/radio/phy/mcs_modes.h"

namespace sim::radio {
namespace {

constexpr hal::Duration kLongSlot = 20us;
constexpr hal::BitsPerSecond kRateOfAll{1e6};

template <class T>
void replace(T& value, const T& from, const T& to) {
  if (value == from) value = to;
}

/// Like replace(), but also replaces any rate that is not a DSSS rate.
void replace_rate(hal::BitsPerSecond& rate, hal::BitsPerSecond from, hal::BitsPerSecond to) {
  if (rate == from || !is_dsss_rate(rate)) rate = to;
}

/// Neither QoS nor aggregation, which a profile with MCSs has from the start.
void without_qos(DcfConfig& config) {
  config.qos = false;
  config.aggregation = {};
}

Ieee80211bConfig without_ofdm(const Ieee80211gConfig& network) {
  const Ieee80211gConfig g;
  const Ieee80211bConfig b;
  Ieee80211bConfig config;
  static_cast<DcfConfig&>(config) = network;
  replace(config.edca, g.edca, b.edca);
  replace_rate(config.phy.data_rate, g.phy.data_rate, b.phy.data_rate);
  replace_rate(config.phy.control_rate, g.phy.control_rate, b.phy.control_rate);
  replace_rate(config.phy.broadcast_rate, g.phy.broadcast_rate, b.phy.broadcast_rate);
  replace(config.receiver.energy_detection, g.receiver.energy_detection,
          b.receiver.energy_detection);
  replace(config.contention.cw_min, g.contention.cw_min, b.contention.cw_min);
  replace(config.cca_time, g.cca_time, b.cca_time);
  config.contention.cw_max = std::max(config.contention.cw_max, config.contention.cw_min);
  config.contention.slot = std::max(config.contention.slot, kLongSlot);
  std::erase_if(config.basic_rates, [](auto rate) { return !is_dsss_rate(rate); });
  if (config.basic_rates.empty()) config.basic_rates.push_back(kRateOfAll);
  if (config.beacon_rate && !is_dsss_rate(*config.beacon_rate)) config.beacon_rate.reset();
  return config;
}

/// A station of an older standard with MCSs, with what the network has of them.
template <class Older>
Older with_mcs(const HtConfig& network) {
  const Older own;
  Older config;
  static_cast<Ieee80211gConfig&>(config) = network;
  AggregationConfig& aggregation = config.aggregation;
  aggregation.max_ampdu = std::min(aggregation.max_ampdu, own.aggregation.max_ampdu);
  aggregation.block_ack_window =
      std::min(aggregation.block_ack_window, own.aggregation.block_ack_window);
  const McsConfig& mcs = network.mcs;
  const ModeId wanted = nearest({network.modulation, mcs.mcs, mcs.streams, mcs.width, mcs.guard},
                                {.classes = Capabilities::bit(own.modulation)});
  config.mcs = {.mcs = std::min(mcs.mcs, highest_mcs(own.modulation)),
                .streams = mcs.streams,
                .width = wanted.width,
                .guard = wanted.guard,
                .times = mcs.times};
  return config;
}

/// @param network  with OFDM.
RadioConfig of_standard(const RadioConfig& network, Standard standard) {
  const Ieee80211gConfig& ofdm = *ofdm_of(network);
  const bool is_older = standard != rates_of(network);
  if (standard == Standard::kIeee80211b) {
    Ieee80211bConfig config = without_ofdm(ofdm);
    if (ht_of(network) != nullptr) without_qos(config);
    return config;
  }
  if (!is_older) return network;
  if (standard == Standard::kIeee80211n) return with_mcs<Ieee80211nConfig>(*ht_of(network));
  if (standard == Standard::kIeee80211ac) return with_mcs<Ieee80211acConfig>(*ht_of(network));
  Ieee80211gConfig config = ofdm;
  without_qos(config);
  return config;
}

void mix(DcfConfig& config) {
  config.contention.slot = std::max(config.contention.slot, kLongSlot);
  if (!is_dsss_rate(config.phy.broadcast_rate)) config.phy.broadcast_rate = kRateOfAll;
  std::erase_if(config.basic_rates, [](auto rate) { return !is_dsss_rate(rate); });
  if (config.basic_rates.empty()) config.basic_rates.push_back(kRateOfAll);
  if (config.beacon_rate && !is_dsss_rate(*config.beacon_rate)) config.beacon_rate.reset();
}

void apply(const StationConfig& own, McsConfig& mcs) {
  mcs.mcs = own.mcs.value_or(mcs.mcs);
  mcs.streams = own.streams.value_or(mcs.streams);
  mcs.width = own.width.value_or(mcs.width);
}

void apply(const StationConfig& own, WavesConfig& config) {
  PhyConfig& phy = config.phy;
  phy.data_rate = own.data_rate.value_or(phy.data_rate);
  phy.control_rate = own.control_rate.value_or(phy.control_rate);
  phy.broadcast_rate = own.broadcast_rate.value_or(phy.broadcast_rate);
  const std::uint32_t channel = own.channel.value_or(phy.channel);
  hal::Metres& wavelength = config.propagation.wavelength;
  wavelength = wavelength_on(channel, wavelength, phy.channel);
  phy.channel = channel;
}

}  // namespace

Capabilities capabilities_of(const RadioConfig& config) {
  const std::optional<Standard> known = rates_of(config);
  if (!known) return {};
  const auto bit = [](ModulationClass one) {
    return static_cast<unsigned>(Capabilities::bit(one));
  };
  const bool is_5 = is_5ghz(waves_of(config)->phy.channel);
  unsigned classes = bit(ModulationClass::kNone);
  for (int i = static_cast<int>(newest_class(*known)); i > 0; --i) {
    classes |= bit(static_cast<ModulationClass>(i));
  }
  classes &= ~bit(is_5 ? ModulationClass::kDsss : ModulationClass::kVht);
  Capabilities all{.classes = static_cast<std::uint8_t>(classes),
                   .streams = 1,
                   .width = 20,
                   .short_guard = false};
  if (const HtConfig* const ht = ht_of(config)) {
    all.streams = ht->mcs.streams;
    all.width = ht->mcs.width;
    all.short_guard = ht->mcs.guard == Capabilities::kShortGuard;
  }
  return all;
}

RadioConfig config_for(const RadioConfig& network, const StationConfig& own, bool is_mixed) {
  RadioConfig config = own.standard ? of_standard(network, *own.standard) : network;
  if (WavesConfig* const waves = waves_of(config)) apply(own, *waves);
  if (HtConfig* const ht = ht_of(config)) apply(own, ht->mcs);
  if (is_mixed) mix(*dcf_of(config));
  return config;
}

StationProfile::StationProfile(const RadioConfig& the_config) : config(the_config), modes(config) {
  if (const WavesConfig* const waves = waves_of(config)) rules.emplace(waves->receiver);
}

}  // namespace sim::radio
