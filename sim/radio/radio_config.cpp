#include "sim/radio/radio_config.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace sim::radio {
namespace {

template <class Config>
constexpr bool kHasWaves = std::is_base_of_v<WavesConfig, Config>;

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("radio: ") + what);
}

bool is_dsss_rate(hal::BitsPerSecond rate) {
  return rate.value == 1e6 || rate.value == 2e6 || rate.value == 5.5e6 || rate.value == 11e6;
}

bool is_contention_window(std::uint32_t window) {
  return window < (1u << 16) && (window & (window + 1)) == 0;
}

void check_phy(const DsssConfig& phy) {
  require(is_dsss_rate(phy.data_rate), "data_rate must be 1, 2, 5.5 or 11 Mb/s");
  require(is_dsss_rate(phy.control_rate), "control_rate must be 1, 2, 5.5 or 11 Mb/s");
  require(is_dsss_rate(phy.broadcast_rate), "broadcast_rate must be 1, 2, 5.5 or 11 Mb/s");
}

void check_chain(const std::vector<PathLossConfig>& chain) {
  require(std::ranges::count_if(chain, is_law_of_distance) == 1,
          "the chain of propagation must have one law of distance");
  require(std::ranges::count_if(chain, is_fading) <= 1,
          "the chain of propagation must have one kind of fading at most");
}

void check_contention(const ContentionConfig& mac) {
  require(is_contention_window(mac.cw_min) && is_contention_window(mac.cw_max) &&
              mac.cw_min <= mac.cw_max,
          "contention windows must be one less than a power of two, cw_min <= cw_max");
  require(mac.short_retry_limit >= 1, "retry limits must be 1 or more");
  require(mac.queue_limit >= 1, "queue_limit must be 1 or more");
  require(mac.slot > hal::Duration{} && mac.sifs > hal::Duration{},
          "slot and sifs must be positive");
}

void check_one(const WavesConfig& config) {
  require(config.tx_power.value > 0, "tx_power must be positive");
  require(config.propagation.wavelength.value > 0, "wavelength must be positive");
  require(config.propagation.path_loss_exponent >= 1, "path_loss_exponent must be 1 or more");
  require(config.propagation.antenna_height.value >= 0, "antenna_height must be 0 or more");
  check_chain(config.propagation.chain);
  require(config.propagation.interference_floor <= config.receiver.sensitivity,
          "interference_floor must not be above sensitivity");
  check_phy(config.phy);
  check_contention(config.contention);
}

void check_one(const Ieee80211bConfig& config) {
  check_one(static_cast<const WavesConfig&>(config));
  require(config.long_retry_limit >= 1, "retry limits must be 1 or more");
}

void check_one(const DiskConfig& config) {
  require(config.tx_power.value > 0, "tx_power must be positive");
  require(config.range.value > 0, "range must be positive");
  require(config.data_rate.value >= 1, "data_rate must be 1 bit/s or more");
  require(config.queue_limit >= 1, "queue_limit must be 1 or more");
}

void check_one(const IdealConfig& config) {
  require(config.range.value > 0, "range must be positive");
}

}  // namespace

Ieee80211bConfig::Ieee80211bConfig() {
  tx_power = hal::Milliwatts{40};
  propagation = {.wavelength = hal::Metres{299792458.0 / 2.412e9},  // channel 1
                 .propagation_delay = true,
                 .interference_floor = hal::Dbm{-101}};
  receiver = {.sensitivity = hal::Dbm{-82},
              .noise_floor = hal::Dbm{-93.97},  // 20 MHz at 290 K, noise figure 7 dB
              .cca_threshold = hal::Dbm{-82},
              .energy_detection = hal::Dbm{-62},
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

Profile profile_of(const RadioConfig& config) { return static_cast<Profile>(config.index()); }

RadioConfig profile_defaults(Profile profile) {
  switch (profile) {
    case Profile::kMobilityFramework:
      return MobilityFrameworkConfig{};
    case Profile::kIeee80211b:
      return Ieee80211bConfig{};
    case Profile::kDisk:
      return DiskConfig{};
    case Profile::kIdeal:
      break;
  }
  return IdealConfig{};
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

const LengthsConfig& lengths_of(const RadioConfig& config) {
  return std::visit([](const auto& one) -> const LengthsConfig& { return one.lengths; }, config);
}

void check(const RadioConfig& config) {
  std::visit([](const auto& one) { check_one(one); }, config);
}

}  // namespace sim::radio
