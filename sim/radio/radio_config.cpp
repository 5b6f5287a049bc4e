#include "sim/radio/radio_config.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "hal/types/check.h"

namespace sim::radio {
namespace {

template <class Config>
constexpr bool kHasWaves = std::is_base_of_v<WavesConfig, Config>;

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("radio: ") + what);
}

constexpr std::array kDsssRates{1e6, 2e6, 5.5e6, 11e6};
constexpr std::array kOfdmRates{6e6, 9e6, 12e6, 18e6, 24e6, 36e6, 48e6, 54e6};

bool is_contention_window(std::uint32_t window) {
  return window < (1u << 16) && (window & (window + 1)) == 0;
}

void check_rate(Standard standard, const char* key, hal::BitsPerSecond rate) {
  const std::string what = std::string(key) + " must be " + std::string(rates_of(standard));
  require(is_rate(standard, rate), what.c_str());
}

void check_chain(const std::vector<PathLossConfig>& chain) {
  require(std::ranges::count_if(chain, is_law_of_distance) == 1,
          "the chain of propagation must have one law of distance");
  require(std::ranges::count_if(chain, is_fading) <= 1,
          "the chain of propagation must have one kind of fading at most");
}

void check_channel(std::uint32_t channel) {
  require(channel >= 1 && channel <= kChannels, "channel must be 1 .. 14");
}

void check_loss(const LossConfig& loss) {
  const auto is_probability = [](double p) { return p >= 0 && p <= 1; };
  require(is_probability(loss.probability) &&
              std::ranges::all_of(loss.links, is_probability, &LossConfig::Link::probability),
          "probabilities of loss must be 0 .. 1");
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

void check_waves(Standard rates, const WavesConfig& config) {
  require(config.tx_power.value > 0, "tx_power must be positive");
  require(config.propagation.wavelength.value > 0, "wavelength must be positive");
  require(config.propagation.path_loss_exponent >= 1, "path_loss_exponent must be 1 or more");
  require(config.propagation.antenna_height.value >= 0, "antenna_height must be 0 or more");
  check_chain(config.propagation.chain);
  check_channel(config.phy.channel);
  check_loss(config.receiver.loss);
  require(config.propagation.interference_floor <= config.receiver.sensitivity,
          "interference_floor must not be above sensitivity");
  check_rate(rates, "data_rate", config.phy.data_rate);
  check_rate(rates, "control_rate", config.phy.control_rate);
  check_rate(rates, "broadcast_rate", config.phy.broadcast_rate);
  check_contention(config.contention);
}

void check_bss(const BssConfig& config) {
  require(!config.ssid.empty() && config.ssid.size() <= kMaxSsid, "ssid must have 1 to 32 bytes");
  const auto units = config.beacon_interval / kTimeUnit;
  require(config.beacon_interval % kTimeUnit == hal::Duration{} && units >= 1 && units <= 65535,
          "beacon_interval must be 1 to 65535 times 1.024 ms");
  require(config.hysteresis.value >= 0, "hysteresis must not be negative");
  require(config.beacon_weight > 0 && config.beacon_weight <= 1, "beacon_weight must be in (0, 1]");
  require(config.beacon_loss >= 1, "beacon_loss must be 1 or more");
  require(config.scan_time > hal::Duration{} && config.answer_timeout > hal::Duration{},
          "scan_time and answer_timeout must be positive");
  require(config.distribution_delay >= hal::Duration{}, "distribution_delay must not be negative");
}

void check_rate_control(const RateControlConfig& rates) {
  require(rates.aarf_threshold >= 1 && rates.aarf_max_threshold >= rates.aarf_threshold &&
              rates.aarf_timeout >= 1,
          "thresholds of AARF must be 1 or more, the largest not the smallest");
  require(rates.minstrel_interval > hal::Duration{} && rates.minstrel_past >= 0 &&
              rates.minstrel_past < 1 && rates.minstrel_sampling >= 0 &&
              rates.minstrel_sampling <= 1,
          "minstrel_interval must be positive, and its shares 0 .. 1, minstrel_past below 1");
}

void check_dcf(Standard rates, const DcfConfig& config) {
  check_waves(rates, config);
  require(config.long_retry_limit >= 1, "retry limits must be 1 or more");
  require(!config.basic_rates.empty(), "basic_rates must not be empty");
  for (const auto rate : config.basic_rates) check_rate(rates, "basic_rates", rate);
  require(config.cca_time >= hal::Duration{} && config.cca_time < config.contention.slot,
          "cca_time must not be negative, and shorter than the slot");
  check_bss(config.bss);
  require(!config.msdu_lifetime || *config.msdu_lifetime > hal::Duration{},
          "msdu_lifetime must be positive");
  require(is_dsss_rate(config.protection_rate), "protection_rate must be 1, 2, 5.5 or 11 Mb/s");
  check_rate_control(config.rate_control);
}

void check_one(const MobilityFrameworkConfig& config) { check_waves(config.kRates, config); }

void check_one(const ForeignProfileConfig& config) {
  check_waves(config.kRates, config);
  require(config.make_mac != nullptr, "a foreign profile must have a MAC");
}

void check_one(const Ieee80211bConfig& config) { check_dcf(config.kRates, config); }

void check_one(const Ieee80211gConfig& config) {
  check_dcf(config.kRates, config);
  require(config.receiver.error_model == ErrorModel::kDsss, "error_model must be dsss");
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

void check(const RadioConfig& config) {
  std::visit([](const auto& one) { check_one(one); }, config);
}

void check(const RadioConfig& config, const StationConfig& station) {
  const std::optional<Standard> known = rates_of(config);
  require(!station.tx_power || station.tx_power->value > 0, "tx_power must be positive");
  require(!station.antenna_height || station.antenna_height->value >= 0,
          "antenna_height must be 0 or more");
  require(known || (!station.channel && !station.antenna_gain && !station.data_rate &&
                    !station.control_rate && !station.broadcast_rate),
          "stations without waves have neither channel nor gain nor rates of their own");
  require(!station.standard || std::holds_alternative<Ieee80211gConfig>(config),
          "only in a network of ieee80211g may stations be of another standard");
  if (!known) return;
  if (station.channel) check_channel(*station.channel);
  const Standard rates = station.standard.value_or(*known);
  if (station.data_rate) check_rate(rates, "data_rate", *station.data_rate);
  if (station.control_rate) check_rate(rates, "control_rate", *station.control_rate);
  if (station.broadcast_rate) check_rate(rates, "broadcast_rate", *station.broadcast_rate);
}

}  // namespace sim::radio
