#include "sim/radio/radio_config.h"

#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "hal/types/check.h"

namespace sim::radio {
namespace {

template <class Config>
constexpr bool kHasWaves = std::is_base_of_v<WavesConfig, Config>;

constexpr hal::Duration kSifs24 = 10us, kSifs5 = 16us;

/// The part of a profile that is a Base; null if it has none.
template <class Base>
const Base* part_of(const RadioConfig& config) {
  return std::visit(
      [](const auto& one) -> const Base* {
        if constexpr (std::is_base_of_v<Base, std::decay_t<decltype(one)>>) return &one;
        return nullptr;
      },
      config);
}

}  // namespace

DcfConfig::DcfConfig() {
  tx_power = hal::Milliwatts{40};
  propagation = {.wavelength = hal::Metres{299792458.0 / 2.412e9},  // channel 1
                 .propagation_delay = true,
                 .interference_floor = hal::Dbm{-101}};
  receiver = {.sensitivity = hal::Dbm{-82},
              .noise_floor = hal::Dbm{-93.97},  // 20 MHz at 290 K, noise figure 7 dB
              .cca_threshold = hal::Dbm{-82},
              .energy_detection = hal::Dbm{-70},
              .error_model = ErrorModel::kDsss,
              .preamble_window = 4us,
              .capture_margin = std::nullopt};
  phy = {.control_rate = hal::BitsPerSecond{1e6},
         .broadcast_rate = hal::BitsPerSecond{1e6},
         .rounding = Rounding::kMicrosecond};
  lengths = {};
  contention = {.cw_min = 31,
                .cw_max = 1023,
                .rts_threshold = 2347,  // IEEE Std 802.11-2016, dot11RTSThreshold: never
                .queue_limit = 500};
}

Ieee80211bConfig::Ieee80211bConfig() = default;

Ieee80211gConfig::Ieee80211gConfig() {
  receiver.energy_detection = hal::Dbm{-62};  // 17.3.10.6
  phy = {.data_rate = hal::BitsPerSecond{54e6},
         .control_rate = hal::BitsPerSecond{24e6},
         .broadcast_rate = hal::BitsPerSecond{6e6},
         .rounding = Rounding::kMicrosecond};
  basic_rates = {hal::BitsPerSecond{6e6}, hal::BitsPerSecond{12e6}, hal::BitsPerSecond{24e6}};
  contention.cw_min = 15;
  edca = edca_defaults(15, 1023, false);
  cca_time = 4us;
}

HtConfig::HtConfig(ModulationClass newest, const McsConfig& the_mcs, std::uint32_t channel,
                   std::uint32_t max_ampdu)
    : modulation(newest), mcs(the_mcs) {
  contention.slot = 9us;
  contention.rts_threshold = 4'692'480;  // as in ns-3.37: never
  qos = true;
  aggregation.max_ampdu = max_ampdu;
  set_channel(*this, channel);
}

Ieee80211axConfig::Ieee80211axConfig()
    : HtConfig(ModulationClass::kHe, {.mcs = 11, .width = 80}, 36, 4'194'303) {
  aggregation.block_ack_window = 256;
}

void set_channel(HtConfig& config, std::uint32_t channel) {
  hal::Metres& wavelength = config.propagation.wavelength;
  wavelength = wavelength_on(channel, wavelength, config.phy.channel);
  config.phy.channel = channel;
  config.contention.sifs = is_5ghz(channel) ? kSifs5 : kSifs24;
}

RadioConfig profile_defaults(Profile profile) {
  switch (profile) {
    case Profile::kMobilityFramework:
      return MobilityFrameworkConfig{};
    case Profile::kIeee80211b:
      return Ieee80211bConfig{};
    case Profile::kIeee80211g:
      return Ieee80211gConfig{};
    case Profile::kIeee80211n:
      return Ieee80211nConfig{};
    case Profile::kIeee80211ac:
      return Ieee80211acConfig{};
    case Profile::kIeee80211ax:
      return Ieee80211axConfig{};
    case Profile::kDisk:
      return DiskConfig{};
    case Profile::kIdeal:
      return IdealConfig{};
  }
  BARAKA_CHECK(false);
}

std::string_view profile_name(const RadioConfig& config) {
  return std::visit(
      [](const auto& one) {
        if constexpr (requires { one.profile; })
          return one.profile;
        else
          return one.kProfile;
      },
      config);
}

const WavesConfig* waves_of(const RadioConfig& config) { return part_of<WavesConfig>(config); }
WavesConfig* waves_of(RadioConfig& config) {
  return const_cast<WavesConfig*>(waves_of(std::as_const(config)));
}

const DcfConfig* dcf_of(const RadioConfig& config) { return part_of<DcfConfig>(config); }
DcfConfig* dcf_of(RadioConfig& config) {
  return const_cast<DcfConfig*>(dcf_of(std::as_const(config)));
}

const Ieee80211gConfig* ofdm_of(const RadioConfig& config) {
  return part_of<Ieee80211gConfig>(config);
}

const HtConfig* ht_of(const RadioConfig& config) { return part_of<HtConfig>(config); }
HtConfig* ht_of(RadioConfig& config) { return const_cast<HtConfig*>(ht_of(std::as_const(config))); }

std::optional<Standard> rates_of(const RadioConfig& config) {
  return std::visit(
      [](const auto& one) -> std::optional<Standard> {
        if constexpr (kHasWaves<std::decay_t<decltype(one)>>) return one.kRates;
        return std::nullopt;
      },
      config);
}

const LengthsConfig& lengths_of(const RadioConfig& config) {
  return std::visit([](const auto& one) -> const LengthsConfig& { return one.lengths; }, config);
}

}  // namespace sim::radio
