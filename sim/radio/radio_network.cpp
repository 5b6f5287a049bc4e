#include "sim/radio/radio_network.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "hal/types/check.h"
#include "sim/radio/channel.h"
#include "sim/radio/dcf_mac.h"
#include "sim/radio/disk_mac.h"
#include "sim/radio/infrastructure.h"
#include "sim/radio/mobility_framework_mac.h"
#include "sim/radio/mode_set.h"
#include "sim/radio/neighbourhood.h"
#include "sim/radio/propagation.h"
#include "sim/radio/radio.h"

namespace sim::radio {
namespace {

RadioConfig checked(RadioConfig config) {
  check(config);
  return config;
}

/// Of a station that has none of its own.
hal::Milliwatts tx_power(const RadioConfig& config) {
  return std::visit(
      [](const auto& one) {
        if constexpr (requires { one.tx_power; }) return one.tx_power;
        return hal::Milliwatts{1};  // only whether something arrives counts
      },
      config);
}

/// Of a station that has none of its own, m above its position.
double antenna_height(const RadioConfig& config) {
  const WavesConfig* const waves = waves_of(config);
  return waves != nullptr ? waves->propagation.antenna_height.value : 0;
}

std::vector<RadioNetwork::Station> by_address(std::vector<RadioNetwork::Station> stations) {
  std::sort(stations.begin(), stations.end(),
            [](const auto& a, const auto& b) { return a.agent < b.agent; });
  return stations;
}

std::vector<Neighbourhood::Antenna> antennas(const std::vector<RadioNetwork::Station>& stations,
                                             const RadioConfig& config, std::uint64_t seed) {
  std::vector<Neighbourhood::Antenna> result;
  result.reserve(stations.size());
  for (const auto& station : stations) {
    const hal::Metres height{antenna_height(config)};
    result.push_back({.agent = station.agent,
                      .tx_power = station.tx_power.value_or(tx_power(config)),
                      .height = station.antenna_height.value_or(height).value,
                      .name = hal::RandomStream(seed, station.name + "/propagation").next()});
    if (!(result.back().tx_power.value > 0)) {
      throw std::invalid_argument("radio: tx_power of '" + station.name + "' must be positive");
    }
  }
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
        antennas(radio::antennas(stations, config, around.seed)),
        neighbourhood(around.events, around.positions, propagation, antennas) {
    std::visit([this](const auto& one) { add_all(one); }, config);
  }

  hal::RandomStream stream(const Station& station, const char* purpose) const {
    return {surroundings.seed, station.name + purpose};
  }

  MacBase::Context context(std::size_t index) const {
    return {surroundings.events, surroundings.observer,    modes,
            lengths_of(config),  antennas[index].tx_power, antennas[index].agent};
  }

  void add_all(const DiskConfig& one) { add_disks(one.queue_limit); }
  void add_all(const IdealConfig&) { add_disks(std::nullopt); }
  void add_disks(std::optional<std::uint32_t> queue_limit) {
    disk = std::make_unique<DiskAir>(DiskAir{neighbourhood, {}});
    for (std::size_t i = 0; i < stations.size(); ++i) {
      macs.push_back(std::make_unique<DiskMac>(context(i), queue_limit, *disk));
    }
  }

  void add_all(const MobilityFrameworkConfig& one) { add_radios<MobilityFrameworkMac>(one); }
  void add_all(const DcfConfig& one) {
    infrastructure =
        std::make_unique<Infrastructure>(profile_of(config), one, stations, surroundings.events);
    add_radios<DcfMac>(one);
  }
  template <class Mac, class Config>
  void add_radios(const Config& one) {
    rules = std::make_unique<ReceptionRules>(one.receiver);
    channel =
        std::make_unique<Channel>(surroundings.events, neighbourhood, surroundings.observer, one);
    for (std::size_t i = 0; i < stations.size(); ++i) {
      const Station& station = stations[i];
      radios.push_back(std::make_unique<Radio>(
          Radio::Air{surroundings.events, *channel, surroundings.observer, one.receiver, *rules},
          static_cast<StationIndex>(i), station.agent, stream(station, "/errors")));
      channel->add(*radios.back());
      macs.push_back(completed(
          i, std::make_unique<Mac>(context(i), one, *radios.back(), stream(station, "/backoff"))));
    }
  }
  std::unique_ptr<MacBase> completed(std::size_t, std::unique_ptr<MacBase> mac) { return mac; }
  std::unique_ptr<MacBase> completed(std::size_t index, std::unique_ptr<DcfMac> mac) {
    return infrastructure->completed(context(index), std::move(mac));
  }

  RadioConfig config;
  std::vector<Station> stations;  ///< In order of addresses.
  Surroundings surroundings;
  ModeSet modes;
  Propagation propagation;
  std::vector<Neighbourhood::Antenna> antennas;
  Neighbourhood neighbourhood;
  std::unique_ptr<ReceptionRules> rules;  ///< This and the next: of profiles with waves.
  std::unique_ptr<Channel> channel;
  std::unique_ptr<DiskAir> disk;                   ///< Of the others.
  std::unique_ptr<Infrastructure> infrastructure;  ///< Of profiles with a DCF.
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
  std::vector<std::pair<StationIndex, StationIndex>> ways;  // in ascending order
  for (StationIndex from = 0; from < state_->stations.size(); ++from) {
    for (const AudibleLink& link : state_->neighbourhood.links_from(from).audible) {
      if (!state_->propagation.is_receivable(link.arrival.power)) continue;
      ways.emplace_back(from, link.receiver);
    }
    state_->neighbourhood.forget(from);
  }
  std::vector<std::pair<hal::AgentId, hal::AgentId>> pairs;
  for (const auto& [from, to] : ways) {
    // A stronger transmitter may not hear whom it reaches.
    if (to < from || !std::ranges::binary_search(ways, std::pair(to, from))) continue;
    pairs.emplace_back(state_->stations[from].agent, state_->stations[to].agent);
  }
  return pairs;
}

}  // namespace sim::radio
