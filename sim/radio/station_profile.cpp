#include "sim/radio/station_profile.h"

#include <algorithm>

#include "hal/types/check.h"

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

Ieee80211bConfig without_ofdm(const Ieee80211gConfig& network) {
  const Ieee80211gConfig g;
  const Ieee80211bConfig b;
  Ieee80211bConfig config;
  static_cast<DcfConfig&>(config) = network;
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
  return config;
}

void mix(DcfConfig& config) {
  config.contention.slot = std::max(config.contention.slot, kLongSlot);
  if (!is_dsss_rate(config.phy.broadcast_rate)) config.phy.broadcast_rate = kRateOfAll;
  std::erase_if(config.basic_rates, [](auto rate) { return !is_dsss_rate(rate); });
  if (config.basic_rates.empty()) config.basic_rates.push_back(kRateOfAll);
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

bool knows_ofdm(const RadioConfig& network, const StationConfig& own) {
  const std::optional<Standard> known = rates_of(network);
  return known && own.standard.value_or(*known) == Standard::kIeee80211g;
}

RadioConfig config_for(const RadioConfig& network, const StationConfig& own, bool is_mixed) {
  RadioConfig config = network;
  if (own.standard == Standard::kIeee80211b) {
    config = without_ofdm(std::get<Ieee80211gConfig>(network));
  }
  if (WavesConfig* const waves = waves_of(config)) apply(own, *waves);
  if (is_mixed) mix(*dcf_of(config));
  return config;
}

StationProfile::StationProfile(const RadioConfig& the_config) : config(the_config), modes(config) {
  if (const WavesConfig* const waves = waves_of(config)) rules.emplace(waves->receiver);
}

}  // namespace sim::radio
