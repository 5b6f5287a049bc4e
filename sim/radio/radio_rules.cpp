#include "sim/radio/radio_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>

#include "sim/radio/phy/error_table.h"
#include "sim/radio/qos_rules.h"
#include "sim/radio/station_profile.h"

namespace sim::radio {
namespace {

constexpr hal::Duration kNone{};

void ask_rate(Rules& rules, Standard standard, std::string_view key, hal::BitsPerSecond rate) {
  rules.ask(is_rate(standard, rate), key, fmt::format("must be {}", rates_of(standard)));
}

void ask_chain(Rules& rules, const std::vector<PathLossConfig>& chain) {
  rules.ask(std::ranges::count_if(chain, is_law_of_distance) == 1, "propagation",
            "must have exactly one of " + models_of(PathLossKind::kLawOfDistance));
  rules.ask(std::ranges::count_if(chain, is_fading) <= 1, "propagation",
            "must not have more than one of " + models_of(PathLossKind::kFading));
}

/// @param standard  nullopt: of a profile without rates.
void ask_channel(Rules& rules, std::optional<Standard> standard, std::uint32_t channel) {
  const bool may_be_5ghz = standard && *standard >= Standard::kIeee80211n;
  if (!may_be_5ghz) {
    return rules.ask(channel >= 1 && channel <= kChannels, "channel",
                     fmt::format("must be 1 .. {}", kChannels));
  }
  if (standard == Standard::kIeee80211ac) {
    return rules.ask(is_channel(channel) && is_5ghz(channel), "channel",
                     "must be 36, 40 .. 64, 100, 104 .. 144, or 149, 153 .. 165");
  }
  rules.ask(is_channel(channel), "channel",
            "must be 1 .. 14, 36, 40 .. 64, 100, 104 .. 144, or 149, 153 .. 165");
}

void ask_loss(Rules& rules, const LossConfig& loss) {
  const auto is_probability = [](double p) { return p >= 0 && p <= 1; };
  rules.ask(is_probability(loss.probability), "loss.probability", "must be 0 .. 1");
  rules.ask(std::ranges::all_of(loss.links, is_probability, &LossConfig::Link::probability),
            "loss.links", "must have probabilities of 0 .. 1");
}

void ask_contention(Rules& rules, const ContentionConfig& mac) {
  rules.ask(mac.cw_min <= mac.cw_max, "cw_max",
            fmt::format("{} is below cw_min, {}", mac.cw_max, mac.cw_min));
  ask_window(rules, "cw_min", mac.cw_min);
  ask_window(rules, "cw_max", mac.cw_max);
  rules.ask(mac.short_retry_limit >= 1, "short_retry_limit", "must be 1 or more");
  rules.ask(mac.queue_limit >= 1, "queue_limit", "must be 1 or more");
  rules.ask(mac.slot > kNone, "slot", "must be positive");
  rules.ask(mac.sifs > kNone, "sifs", "must be positive");
}

void ask_waves(Rules& rules, Standard rates, const WavesConfig& c) {
  rules.ask(c.tx_power.value > 0, "tx_power", "must be positive");
  rules.ask(c.propagation.wavelength.value > 0, "wavelength", "must be positive");
  rules.ask(c.propagation.path_loss_exponent >= 1, "path_loss_exponent", "must be 1 or more");
  rules.ask(c.propagation.antenna_height.value >= 0, "antenna_height", "must be 0 or more");
  ask_chain(rules, c.propagation.chain);
  ask_channel(rules, rates, c.phy.channel);
  ask_loss(rules, c.receiver.loss);
  rules.ask(c.propagation.interference_floor <= c.receiver.sensitivity, "interference_floor",
            fmt::format("{} dBm is above the sensitivity, {} dBm",
                        c.propagation.interference_floor.value, c.receiver.sensitivity.value));
  ask_rate(rules, rates, "data_rate", c.phy.data_rate);
  ask_rate(rules, rates, "control_rate", c.phy.control_rate);
  ask_rate(rules, rates, "broadcast_rate", c.phy.broadcast_rate);
  ask_contention(rules, c.contention);
}

void ask_bss(Rules& rules, const BssConfig& c) {
  rules.ask(!c.ssid.empty(), "bss.ssid", "must not be empty");
  rules.ask(c.ssid.size() <= kMaxSsid, "bss.ssid",
            fmt::format("{} bytes are above the limit of {}", c.ssid.size(), kMaxSsid));
  const auto units = c.beacon_interval / kTimeUnit;
  rules.ask(c.beacon_interval % kTimeUnit == kNone && units >= 1 && units <= 65535,
            "bss.beacon_interval",
            fmt::format("{:g} ms is not 1 to 65535 times 1.024 ms",
                        hal::to_seconds(c.beacon_interval) * 1e3));
  rules.ask(c.hysteresis.value >= 0, "bss.hysteresis", "must not be negative");
  rules.ask(c.beacon_weight > 0 && c.beacon_weight <= 1, "bss.beacon_weight",
            "must be above 0 and at most 1");
  rules.ask(c.beacon_loss >= 1, "bss.beacon_loss", "must be 1 or more");
  rules.ask(c.scan_time > kNone, "bss.scan_time", "must be positive");
  rules.ask(c.answer_timeout > kNone, "bss.answer_timeout", "must be positive");
  rules.ask(c.distribution_delay >= kNone, "bss.distribution_delay", "must not be negative");
}

void ask_rate_control(Rules& rules, const RateControlConfig& c) {
  rules.ask(c.aarf_threshold >= 1, "aarf_threshold", "must be 1 or more");
  rules.ask(c.aarf_max_threshold >= c.aarf_threshold, "aarf_max_threshold",
            "must not be below aarf_threshold");
  rules.ask(c.aarf_timeout >= 1, "aarf_timeout", "must be 1 or more");
  rules.ask(c.minstrel_interval > kNone, "minstrel_interval", "must be positive");
  rules.ask(c.minstrel_past >= 0 && c.minstrel_past < 1, "minstrel_past",
            "must be 0 or more and below 1");
  rules.ask(c.minstrel_sampling >= 0 && c.minstrel_sampling <= 1, "minstrel_sampling",
            "must be 0 .. 1");
  rules.ask(c.ideal_loss > 0 && c.ideal_loss < 1, "ideal_loss", "must be above 0 and below 1");
}

void ask_dcf(Rules& rules, Standard rates, const DcfConfig& c) {
  ask_waves(rules, rates, c);
  rules.ask(c.long_retry_limit >= 1, "long_retry_limit", "must be 1 or more");
  rules.ask(!c.basic_rates.empty(), "basic_rates", "must not be empty");
  for (const auto rate : c.basic_rates) ask_rate(rules, rates, "basic_rates", rate);
  if (c.beacon_rate) ask_rate(rules, rates, "beacon_rate", *c.beacon_rate);
  ask_edca(rules, c.edca);
  ask_queues(rules, c.queues);
  rules.ask(c.cca_time >= kNone, "cca_time", "must not be negative");
  rules.ask(c.cca_time < c.contention.slot, "cca_time", "must be shorter than the slot");
  ask_bss(rules, c.bss);
  ask_announced_edca(rules, c.bss.edca);
  rules.ask(!c.msdu_lifetime || *c.msdu_lifetime > kNone, "msdu_lifetime", "must be positive");
  rules.ask(is_dsss_rate(c.protection_rate), "protection_rate", "must be 1, 2, 5.5 or 11 Mb/s");
  ask_rate_control(rules, c.rate_control);
}

/// @param newest  modulation class of the profile.
void ask_error_table(Rules& rules, const ErrorTable& table, ModulationClass newest) {
  const auto wrong = wrong_rows(table);
  if (!wrong.empty()) {
    rules.ask(false, "error_table",
              fmt::format("row {} {}", wrong.front().row + 1, wrong.front().what));
  }
  const bool has_mode = std::ranges::any_of(
      table, [newest](const ErrorRow& row) { return row.modulation <= newest; });
  rules.ask(table.empty() || has_mode, "error_table", "has no mode of this profile");
}

void ask_one(Rules& rules, const MobilityFrameworkConfig& c) { ask_waves(rules, c.kRates, c); }

void ask_one(Rules& rules, const ForeignProfileConfig& c) {
  ask_waves(rules, c.kRates, c);
  rules.ask(c.make_mac != nullptr, "profile", "must have a MAC");
}

void ask_one(Rules& rules, const Ieee80211bConfig& c) { ask_dcf(rules, c.kRates, c); }

void ask_one(Rules& rules, const Ieee80211gConfig& c) {
  ask_dcf(rules, c.kRates, c);
  rules.ask(c.receiver.error_model == ErrorModel::kDsss, "error_model", "must be dsss");
  ask_error_table(rules, c.error_table, ModulationClass::kOfdm);
}

template <class Config>
requires std::is_base_of_v<HtConfig, Config>
void ask_one(Rules& rules, const Config& c) {
  ask_dcf(rules, c.kRates, c);
  rules.ask(c.receiver.error_model == ErrorModel::kDsss, "error_model", "must be dsss");
  ask_mcs(rules, c);
  ask_aggregation(rules, c);
  ask_error_table(rules, c.error_table, c.modulation);
}

void ask_one(Rules& rules, const DiskConfig& c) {
  rules.ask(c.tx_power.value > 0, "tx_power", "must be positive");
  rules.ask(c.range.value > 0, "range", "must be positive");
  rules.ask(c.data_rate.value >= 1, "data_rate", "must be 1 bit/s or more");
  rules.ask(c.queue_limit >= 1, "queue_limit", "must be 1 or more");
}

void ask_one(Rules& rules, const IdealConfig& c) {
  rules.ask(c.range.value > 0, "range", "must be positive");
}

void throw_first(const std::vector<BrokenRule>& broken) {
  if (!broken.empty())
    throw std::invalid_argument(
        fmt::format("radio: {} {}", broken.front().key, broken.front().what));
}

/// Whether stations of a standard can be in a network, beside those of its profile.
bool fits(Standard standard, const RadioConfig& network) {
  if (standard > *rates_of(network)) return false;
  const bool is_5 = is_5ghz(waves_of(network)->phy.channel);
  return standard != (is_5 ? Standard::kIeee80211b : Standard::kIeee80211ac);
}

void ask_station_mcs(Rules& rules, const RadioConfig& config, const StationConfig& c) {
  if (!c.mcs && !c.streams && !c.width) return;
  const Standard rates = c.standard.value_or(*rates_of(config));
  rules.ask(rates >= Standard::kIeee80211n, "mcs",
            "is not for stations without MCSs, nor are streams and width");
  if (rates < Standard::kIeee80211n) return;
  const RadioConfig own = config_for(config, c, false);
  ask_mcs(rules, *ht_of(own));
}

void ask_station_standard(Rules& rules, const RadioConfig& config, const StationConfig& c) {
  if (!c.standard) return;
  rules.ask(ofdm_of(config) != nullptr, "standard",
            "may differ in a network of ieee80211g or newer only");
  rules.ask(ofdm_of(config) == nullptr || fits(*c.standard, config), "standard",
            "must be as old as the network's or older, and exist in its band");
}

void ask_station_channel(Rules& rules, const RadioConfig& config, std::uint32_t channel) {
  ask_channel(rules, rates_of(config), channel);
  if (!rules.is_empty()) return;
  rules.ask(is_5ghz(channel) == is_5ghz(waves_of(config)->phy.channel), "channel",
            "must be in the band of the network");
}

/// What a station may have of its own.
void ask_station(Rules& rules, const RadioConfig& config, const StationConfig& c) {
  const std::optional<Standard> known = rates_of(config);
  rules.ask(!c.tx_power || c.tx_power->value > 0, "tx_power", "must be positive");
  rules.ask(!c.antenna_height || c.antenna_height->value >= 0, "antenna_height",
            "must be 0 or more");
  rules.ask(known || (!c.channel && !c.antenna_gain && !c.antenna && !c.data_rate &&
                      !c.control_rate && !c.broadcast_rate && !c.mcs && !c.streams && !c.width),
            "channel", "is not for stations without waves, nor are gain and rates");
  ask_station_standard(rules, config, c);
  if (!known || !rules.is_empty()) return;
  if (c.channel) ask_station_channel(rules, config, *c.channel);
  const Standard rates = c.standard.value_or(*known);
  if (c.data_rate) ask_rate(rules, rates, "data_rate", *c.data_rate);
  if (c.control_rate) ask_rate(rules, rates, "control_rate", *c.control_rate);
  if (c.broadcast_rate) ask_rate(rules, rates, "broadcast_rate", *c.broadcast_rate);
  ask_station_mcs(rules, config, c);
}

}  // namespace

std::string models_of(PathLossKind kind) {
  std::vector<std::string_view> names;
  const auto add = [&]<class Law>(const Law& law) {
    if (Law::kKind == kind) names.push_back(law.kModel);
  };
  [&]<std::size_t... kIndex>(std::index_sequence<kIndex...> /*all*/) {
    (add(std::variant_alternative_t<kIndex, PathLossConfig>{}), ...);
  }
  (std::make_index_sequence<kNamedLaws>{});
  if (names.size() == 1) return std::string(names.front());
  return fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

std::vector<BrokenRule> broken_rules(const RadioConfig& config) {
  Rules rules;
  std::visit([&](const auto& one) { ask_one(rules, one); }, config);
  return rules.take();
}

void check(const RadioConfig& config) { throw_first(broken_rules(config)); }

std::vector<BrokenRule> broken_rules(const RadioConfig& config, const StationConfig& station) {
  Rules rules;
  ask_station(rules, config, station);
  return rules.take();
}

void check(const RadioConfig& config, const StationConfig& station) {
  throw_first(broken_rules(config, station));
}

}  // namespace sim::radio
