#include "sim/radio/radio_config.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "hal/types/check.h"

namespace sim::radio {
namespace {

template <class Config>
constexpr bool kHasWaves = std::is_base_of_v<WavesConfig, Config>;

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

RadioConfig profile_defaults(Profile profile) {
  switch (profile) {
    case Profile::kMobilityFramework:
      return MobilityFrameworkConfig{};
    case Profile::kIeee80211b:
      return Ieee80211bConfig{};
    case Profile::kIeee80211g:
      return Ieee80211gConfig{};
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

const WavesConfig* waves_of(const RadioConfig& config) {
  return std::visit(
      [](const auto& one) -> const WavesConfig* {
        if constexpr (kHasWaves<std::decay_t<decltype(one)>>) return &one;
        return nullptr;
      },
      config);
}

WavesConfig* waves_of(RadioConfig& config) {
  return const_cast<WavesConfig*>(waves_of(std::as_const(config)));
}

const DcfConfig* dcf_of(const RadioConfig& config) {
  return std::visit(
      [](const auto& one) -> const DcfConfig* {
        if constexpr (std::is_base_of_v<DcfConfig, std::decay_t<decltype(one)>>) return &one;
        return nullptr;
      },
      config);
}

DcfConfig* dcf_of(RadioConfig& config) {
  return const_cast<DcfConfig*>(dcf_of(std::as_const(config)));
}

std::optional<Standard> rates_of(const RadioConfig& config) {
  return std::visit(
      [](const auto& one) -> std::optional<Standard> {
        if constexpr (kHasWaves<std::decay_t<decltype(one)>>) return one.kRates;
        return std::nullopt;
      },
      config);
}

std::string_view rates_of(Standard standard) {
  switch (standard) {
    case Standard::kIeee80211b:
      return "1, 2, 5.5 or 11 Mb/s";
    case Standard::kIeee80211g:
      return "1, 2, 5.5, 11, 6, 9, 12, 18, 24, 36, 48 or 54 Mb/s";
  }
  return {};
}

bool is_dsss_rate(hal::BitsPerSecond rate) {
  return std::ranges::find(kDsssRates, rate.value) != kDsssRates.end();
}

bool is_rate(Standard standard, hal::BitsPerSecond rate) {
  switch (standard) {
    case Standard::kIeee80211b:
      return is_dsss_rate(rate);
    case Standard::kIeee80211g:
      return is_dsss_rate(rate) || std::ranges::find(kOfdmRates, rate.value) != kOfdmRates.end();
  }
  return false;
}

const LengthsConfig& lengths_of(const RadioConfig& config) {
  return std::visit([](const auto& one) -> const LengthsConfig& { return one.lengths; }, config);
}

}  // namespace sim::radio
