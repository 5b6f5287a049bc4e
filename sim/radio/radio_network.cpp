#include "sim/radio/radio_network.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "hal/types/check.h"
#include "sim/radio/channel.h"
#include "sim/radio/dcf_mac.h"
#include "sim/radio/disk_mac.h"
#include "sim/radio/mobility_framework_mac.h"
#include "sim/radio/mode_set.h"
#include "sim/radio/neighbourhood.h"
#include "sim/radio/propagation.h"
#include "sim/radio/radio.h"

namespace sim::radio {
namespace {

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("radio: ") + what);
}

bool is_dsss_rate(hal::BitsPerSecond rate) {
  return rate.value == 1e6 || rate.value == 2e6 || rate.value == 5.5e6 || rate.value == 11e6;
}

bool is_contention_window(std::uint32_t window) {
  return window < (1u << 16) && (window & (window + 1)) == 0;
}

void check_mac(const RadioConfig& config) {
  require(is_dsss_rate(config.data_rate), "data_rate must be 1, 2, 5.5 or 11 Mb/s");
  require(is_dsss_rate(config.control_rate), "control_rate must be 1, 2, 5.5 or 11 Mb/s");
  require(is_dsss_rate(config.broadcast_rate), "broadcast_rate must be 1, 2, 5.5 or 11 Mb/s");
  require(config.wavelength.value > 0, "wavelength must be positive");
  require(config.path_loss_exponent >= 1, "path_loss_exponent must be 1 or more");
  require(config.interference_floor <= config.sensitivity,
          "interference_floor must not be above sensitivity");
  require(is_contention_window(config.cw_min) && is_contention_window(config.cw_max) &&
              config.cw_min <= config.cw_max,
          "contention windows must be one less than a power of two, cw_min <= cw_max");
  require(config.short_retry_limit >= 1 && config.long_retry_limit >= 1,
          "retry limits must be 1 or more");
  require(config.slot > hal::Duration{} && config.sifs > hal::Duration{},
          "slot and sifs must be positive");
}

RadioConfig checked(RadioConfig config) {
  require(config.tx_power.value > 0, "tx_power must be positive");
  require(config.queue_limit >= 1, "queue_limit must be 1 or more");
  require(config.range.value > 0, "range must be positive");
  require(config.data_rate.value >= 1, "data_rate must be 1 bit/s or more");
  if (has_mac(config)) {
    check_mac(config);
  } else {
    config.broadcast_rate = config.data_rate;
  }
  return config;
}

std::vector<RadioNetwork::Station> by_address(std::vector<RadioNetwork::Station> stations) {
  std::sort(stations.begin(), stations.end(),
            [](const auto& a, const auto& b) { return a.agent < b.agent; });
  return stations;
}

std::vector<hal::AgentId> addresses(const std::vector<RadioNetwork::Station>& stations) {
  std::vector<hal::AgentId> result;
  result.reserve(stations.size());
  for (const auto& station : stations) result.push_back(station.agent);
  return result;
}

}  // namespace

struct RadioNetwork::State {
  State(const RadioConfig& wanted, std::vector<Station> sorted, Surroundings around)
      : config(checked(wanted)),
        stations(std::move(sorted)),
        surroundings(around),
        modes(config),
        propagation(config, around.obstacles),
        neighbourhood(around.events, around.positions, propagation, addresses(stations)),
        rules(config),
        channel(around.events, neighbourhood, around.observer, config),
        disk{neighbourhood, {}} {
    for (const Station& station : stations) add(station);
  }

  hal::RandomStream stream(const Station& station, const char* purpose) const {
    return {surroundings.seed, station.name + purpose};
  }

  void add(const Station& station) {
    const MacBase::Context context{surroundings.events, surroundings.observer, config, modes,
                                   station.agent};
    if (!has_mac(config)) {
      macs.push_back(std::make_unique<DiskMac>(context, disk));
      return;
    }
    radios.push_back(std::make_unique<Radio>(
        Radio::Air{surroundings.events, channel, surroundings.observer, config, rules},
        static_cast<StationIndex>(radios.size()), station.agent, stream(station, "/errors")));
    channel.add(*radios.back());
    const hal::RandomStream backoff = stream(station, "/backoff");
    if (config.profile == Profile::kMobilityFramework) {
      macs.push_back(std::make_unique<MobilityFrameworkMac>(context, *radios.back(), backoff));
    } else {
      macs.push_back(std::make_unique<DcfMac>(context, *radios.back(), backoff));
    }
  }

  RadioConfig config;
  std::vector<Station> stations;  ///< In order of addresses.
  Surroundings surroundings;
  ModeSet modes;
  Propagation propagation;
  Neighbourhood neighbourhood;
  ReceptionRules rules;
  Channel channel;
  DiskAir disk;
  std::vector<std::unique_ptr<Radio>> radios;
  std::vector<std::unique_ptr<MacBase>> macs;
};

RadioNetwork::RadioNetwork(const RadioConfig& config, const std::vector<Station>& stations,
                           Surroundings surroundings)
    : state_(std::make_unique<State>(config, by_address(stations), surroundings)) {}

RadioNetwork::~RadioNetwork() = default;

MacSap& RadioNetwork::sap(hal::AgentId agent) {
  const auto& stations = state_->stations;
  const auto found =
      std::lower_bound(stations.begin(), stations.end(), agent,
                       [](const Station& station, hal::AgentId id) { return station.agent < id; });
  BARAKA_CHECK(found != stations.end() && found->agent == agent);
  return *state_->macs[static_cast<std::size_t>(found - stations.begin())];
}

std::vector<std::pair<hal::AgentId, hal::AgentId>> RadioNetwork::links() const {
  std::vector<std::pair<hal::AgentId, hal::AgentId>> pairs;
  for (StationIndex from = 0; from < state_->stations.size(); ++from) {
    for (const Link& link : state_->neighbourhood.links_from(from).audible) {
      if (link.receiver < from || !state_->propagation.is_receivable(link.arrival.power)) continue;
      pairs.emplace_back(state_->stations[from].agent, state_->stations[link.receiver].agent);
    }
    state_->neighbourhood.forget(from);
  }
  return pairs;
}

}  // namespace sim::radio
