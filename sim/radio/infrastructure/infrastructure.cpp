#include "sim/radio/infrastructure/infrastructure.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "sim/radio/channel/propagation.h"
#include "sim/radio/infrastructure/access_point.h"
#include "sim/radio/infrastructure/bss_station.h"
#include "sim/radio/mac/ieee80211_mac.h"

namespace sim::radio {
namespace {

/// Rates of all modes (IEEE Std 802.11-2016, 16.1.2 and 18.1.2), Mb/s.
constexpr double kAllRates[] = {1, 2, 5.5, 6, 9, 11, 12, 18, 24, 36, 48, 54};
constexpr double kRateUnit = 0.5;              // Mb/s, 9.4.2.3
constexpr std::uint8_t kBasicRateFlag = 0x80;  // marks a rate of the basic rate set
constexpr hal::Duration kShortSlotTime{9'000};

std::vector<std::uint8_t> supported_rates(Standard standard, const DcfConfig& config) {
  std::vector<std::uint8_t> rates;
  for (const double rate : kAllRates) {
    const hal::BitsPerSecond in_bits{rate * 1e6};
    if (!is_rate(standard, in_bits)) continue;
    if (is_5ghz(config.phy.channel) && is_dsss_rate(in_bits)) continue;
    const bool basic = std::ranges::find(config.basic_rates, in_bits) != config.basic_rates.end();
    rates.push_back(static_cast<std::uint8_t>(static_cast<int>(rate / kRateUnit) |
                                              (basic ? kBasicRateFlag : 0)));
  }
  return rates;
}

BssParameters parameters(const Infrastructure::Member& member, const std::string& ssid) {
  const DcfConfig& config = member.config;
  const std::uint32_t channel = config.phy.channel;
  const bool is_5 = is_5ghz(channel);
  const bool erp = !is_5 && member.rates >= Standard::kIeee80211g;
  const Capabilities own = member.context.cell.capabilities(member.context.agent);
  return {.ssid = ssid,
          .rates = supported_rates(member.rates, config),
          .channel = is_5 ? std::nullopt : std::optional(static_cast<std::uint8_t>(channel)),
          .short_preamble = config.phy.preamble == Preamble::kShort,
          .short_slot = config.contention.slot == kShortSlotTime,
          .erp = erp,
          .use_protection = erp && member.context.cell.is_mixed(),
          .qos = config.qos,
          .capabilities = own.supports(ModulationClass::kHt) ? std::optional(own) : std::nullopt,
          .primary_channel = static_cast<std::uint8_t>(channel)};
}

/// What an access point announces, too.
BssParameters parameters_of_access_point(const Infrastructure::Member& member,
                                         const BssConfig& config) {
  BssParameters bss = parameters(member, config.ssid);
  if (member.config.qos) bss.edca = config.edca.value_or(member.config.edca);
  return bss;
}

std::vector<hal::AgentId> agents_of(const std::vector<std::string>& names,
                                    const std::vector<RadioNetwork::Station>& stations) {
  std::vector<hal::AgentId> agents;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(stations, name, &RadioNetwork::Station::name);
    if (found == stations.end()) {
      throw std::invalid_argument("radio: the access point '" + name + "' is no station");
    }
    agents.push_back(found->agent);
  }
  return agents;
}

}  // namespace

Infrastructure::Infrastructure(const BssConfig& config,
                               const std::vector<RadioNetwork::Station>& stations,
                               EventQueue& events)
    : config_(config), distribution_(events, config.distribution_delay) {
  const std::vector<hal::AgentId> of_all = agents_of(config.access_points, stations);
  std::set<hal::AgentId> named(of_all.begin(), of_all.end());
  for (const RadioNetwork::Station& station : stations) {
    const auto& names = station.radio.access_points;
    const auto own = names ? agents_of(*names, stations) : of_all;
    if (!own.empty()) usable_[station.agent] = own;
    named.insert(own.begin(), own.end());
  }
  for (const hal::AgentId access_point : named) usable_.erase(access_point);
  access_points_.assign(named.begin(), named.end());
}

std::unique_ptr<MacBase> Infrastructure::completed(const Member& member,
                                                   std::unique_ptr<Ieee80211Mac> dcf) {
  if (std::ranges::binary_search(access_points_, member.context.agent)) {
    return access_point(member, std::move(dcf));
  }
  const auto usable = usable_.find(member.context.agent);
  if (usable == usable_.end()) return dcf;
  return std::make_unique<BssStation>(
      member.context, member.config, std::move(dcf),
      BssStation::Membership{config_, parameters(member, config_.ssid), usable->second,
                             member.scan});
}

/// Target beacon transmission times are spread evenly over the interval.
std::unique_ptr<MacBase> Infrastructure::access_point(const Member& member,
                                                      std::unique_ptr<Ieee80211Mac> dcf) {
  const auto place =
      std::ranges::find(access_points_, member.context.agent) - access_points_.begin();
  const auto count = static_cast<std::int64_t>(access_points_.size());
  const double power = to_dbm(member.context.tx_power).value;
  return std::make_unique<AccessPoint>(
      member.context, member.config, std::move(dcf),
      AccessPoint::Network{.config = config_,
                           .bss = parameters_of_access_point(member, config_),
                           .distribution = distribution_,
                           .first_beacon = place * config_.beacon_interval / count,
                           .rssi_dbm = power,
                           .snr_db = power - member.config.receiver.noise_floor.value});
}

}  // namespace sim::radio
