#include "sim/radio/radio_network.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

#include "hal/types/check.h"
#include "hal/types/math.h"
#include "sim/core/large_pages.h"
#include "sim/radio/cell.h"
#include "sim/radio/channel/band.h"
#include "sim/radio/channel/random_loss.h"
#include "sim/radio/infrastructure/infrastructure.h"
#include "sim/radio/mac/disk_mac.h"
#include "sim/radio/mac/ieee80211_mac.h"
#include "sim/radio/mac/mac_parts.h"
#include "sim/radio/mac/mobility_framework_mac.h"
#include "sim/radio/phy/radio.h"
#include "sim/radio/radio_rules.h"
#include "sim/radio/station_profile.h"

namespace sim::radio {
namespace {

RadioConfig checked(RadioConfig config) {
  check(config);
  return config;
}

/// Transmit power of a station that does not set its own.
hal::Milliwatts tx_power(const RadioConfig& config) {
  return std::visit(
      [](const auto& one) {
        if constexpr (requires { one.tx_power; }) return one.tx_power;
        return hal::Milliwatts{1};  // any value will do: a frame arrives or not
      },
      config);
}

std::vector<RadioNetwork::Station> by_address(std::vector<RadioNetwork::Station> stations) {
  std::sort(stations.begin(), stations.end(),
            [](const auto& a, const auto& b) { return a.agent < b.agent; });
  return stations;
}

void check_station(const RadioConfig& config, const RadioNetwork::Station& station) {
  try {
    check(config, station.radio);
  } catch (const std::invalid_argument& wrong) {
    throw std::invalid_argument(std::string(wrong.what()) + " (of '" + station.name + "')");
  }
}

/// Of a station with some 200 others in range, measured (tests/bench/radio memory, and growth).
constexpr std::size_t kBytesPerStation = 12'000;

double ratio(hal::Decibels gain) { return hal::math::pow(10, gain.value / 10); }

/// Null: equal in all directions.
std::shared_ptr<const AntennaPattern> pattern_of(const AntennaConfig& config) {
  if (std::holds_alternative<OmniAntenna>(config)) return nullptr;
  return std::make_shared<const AntennaPattern>(config);
}

Neighbourhood::Antenna antenna(const RadioNetwork::Station& station, const RadioConfig& config,
                               std::uint64_t seed) {
  const WavesConfig* const waves = waves_of(config);
  const hal::Metres height = waves ? waves->propagation.antenna_height : hal::Metres{};
  const hal::Decibels gain = waves ? waves->propagation.antenna_gain : hal::Decibels{};
  const AntennaConfig pattern = waves ? waves->propagation.antenna : AntennaConfig{};
  return {.agent = station.agent,
          .tx_power = station.radio.tx_power.value_or(tx_power(config)),
          .height = station.radio.antenna_height.value_or(height).value,
          .name = hal::RandomStream(seed, station.name + "/propagation").next(),
          .gain = ratio(station.radio.antenna_gain.value_or(gain)),
          .most_power = station.most_power,
          .pattern = pattern_of(station.radio.antenna.value_or(pattern))};
}

/// Tells the laws that know stations by name which they are.
RadioConfig with_names(RadioConfig config, const std::vector<RadioNetwork::Station>& stations) {
  WavesConfig* const waves = waves_of(config);
  if (waves == nullptr) return config;
  for (PathLossConfig& law : waves->propagation.chain) {
    auto* const measured = std::get_if<MeasuredConfig>(&law);
    if (measured == nullptr) continue;
    for (const auto& station : stations)
      measured->stations.emplace_back(station.agent, station.name);
  }
  return config;
}

/// Channel number of a station; 0 in profiles without a medium, which have no channels.
std::uint32_t channel_of(const RadioNetwork::Station& station, const RadioConfig& config) {
  const WavesConfig* const waves = waves_of(config);
  return waves ? station.radio.channel.value_or(waves->phy.channel) : 0;
}

std::vector<std::pair<hal::AgentId, hal::AgentId>> links_in(Band& band) {
  std::vector<std::pair<StationIndex, StationIndex>> ways;  // in ascending order
  for (StationIndex from = 0; from < band.stations().size(); ++from) {
    for (const AudibleLink& link : band.neighbourhood().links_from(from).audible) {
      if (!band.propagation().is_receivable(link.arrival.power)) continue;
      ways.emplace_back(from, link.receiver);
    }
    band.neighbourhood().forget(from);
  }
  std::vector<std::pair<hal::AgentId, hal::AgentId>> pairs;
  for (const auto& [from, to] : ways) {
    // A link may work in one direction only, if the transmit powers differ.
    if (to < from || !std::ranges::binary_search(ways, std::pair(to, from))) continue;
    pairs.emplace_back(band.stations()[from], band.stations()[to]);
  }
  return pairs;
}

RandomLoss::Names names(const std::vector<RadioNetwork::Station>& stations) {
  RandomLoss::Names names;
  for (const auto& station : stations) names.emplace_back(station.agent, station.name);
  return names;
}

}  // namespace

struct RadioNetwork::State {
  /// A band and the stations on it.
  struct Air {
    std::uint32_t channel = 0;
    Cell cell{};
    std::vector<Neighbourhood::Antenna> antennas{};
    std::unique_ptr<Band> band{};
    std::unique_ptr<DiskAir> disk{};  ///< For profiles without a medium.
  };
  struct Shared {
    StationConfig settings;  ///< Without the settings that may differ between stations.
    StationProfile profile;
  };

  State(const RadioConfig& wanted, std::vector<Station> sorted, Surroundings around)
      : config(with_names(checked(wanted), sorted)),
        stations(std::move(sorted)),
        surroundings(around) {
    expect_allocations(stations.size() * kBytesPerStation);
    for (const Station& station : stations) {
      check_station(config, station);
      Air& air = air_of(channel_of(station, config));
      air.cell.add(station.agent, capabilities_of(config_for(config, station.radio, false)));
      air.antennas.push_back(antenna(station, config, around.seed));
    }
    const WavesConfig* const waves = waves_of(config);
    if (waves != nullptr && !waves->receiver.loss.is_none()) {
      loss.emplace(waves->receiver.loss, around.seed, names(stations));
    }
    if (const DcfConfig* const dcf = dcf_of(config)) {
      infrastructure = std::make_unique<Infrastructure>(dcf->bss, stations, surroundings.events);
    }
    for (const auto& air : airs) open(*air);
    for (const Station& station : stations) add(station);
  }

  Air& air_of(std::uint32_t channel) {
    const auto found =
        std::ranges::find_if(airs, [channel](const auto& air) { return air->channel == channel; });
    if (found != airs.end()) return **found;
    return *airs.emplace_back(std::make_unique<Air>(Air{.channel = channel}));
  }

  void open(Air& air) {
    StationConfig there;
    if (waves_of(config) != nullptr) there.channel = air.channel;
    air.band = std::make_unique<Band>(
        config_for(config, there, false),
        Band::Surroundings{surroundings.events, surroundings.positions, surroundings.obstacles,
                           surroundings.observer, surroundings.ground},
        air.antennas);
    if (waves_of(config) == nullptr) {
      air.disk = std::make_unique<DiskAir>(DiskAir{air.band->neighbourhood(), {}});
    }
  }

  std::size_t number_of(hal::AgentId agent) const {
    const auto found = std::ranges::lower_bound(stations, agent, {}, &Station::agent);
    BARAKA_CHECK(found != stations.end() && found->agent == agent);
    return static_cast<std::size_t>(found - stations.begin());
  }

  /// The neighbourhood of an agent, and its station index there.
  std::pair<Neighbourhood*, StationIndex> place_of(hal::AgentId agent) {
    Air& air = air_of(channel_of(stations[number_of(agent)], config));
    const auto& all = air.band->stations();
    return {&air.band->neighbourhood(),
            static_cast<StationIndex>(std::ranges::lower_bound(all, agent) - all.begin())};
  }

  const StationProfile& profile_of(const Station& station, const Air& air) {
    StationConfig settings = station.radio;
    settings.tx_power.reset();
    settings.antenna_height.reset();
    settings.antenna_gain.reset();
    settings.antenna.reset();
    settings.access_points.reset();
    if (waves_of(config) != nullptr) settings.channel = air.channel;
    const auto found = std::ranges::find_if(
        profiles, [&settings](const auto& shared) { return shared->settings == settings; });
    if (found != profiles.end()) return (*found)->profile;
    const RadioConfig own = config_for(config, settings, air.cell.is_mixed());
    profiles.push_back(std::make_unique<Shared>(Shared{settings, StationProfile(own)}));
    return profiles.back()->profile;
  }

  hal::RandomStream stream(const Station& station, const char* purpose) const {
    return {surroundings.seed, station.name + purpose};
  }

  void add(const Station& station) {
    Air& air = air_of(channel_of(station, config));
    const StationProfile& profile = profile_of(station, air);
    const MacBase::Context context{.events = surroundings.events,
                                   .observer = surroundings.observer,
                                   .modes = profile.modes,
                                   .lengths = lengths_of(profile.config),
                                   .tx_power = station.radio.tx_power.value_or(tx_power(config)),
                                   .agent = station.agent,
                                   .cell = air.cell};
    std::visit([&](const auto& one) { add(station, air, profile, context, one); }, profile.config);
  }

  void add(const Station&, Air& air, const StationProfile&, const MacBase::Context& context,
           const DiskConfig& one) {
    macs.push_back(std::make_unique<DiskMac>(context, one.queue_limit, *air.disk));
  }
  void add(const Station&, Air& air, const StationProfile&, const MacBase::Context& context,
           const IdealConfig&) {
    macs.push_back(std::make_unique<DiskMac>(context, std::nullopt, *air.disk));
  }
  void add(const Station& station, Air& air, const StationProfile& profile,
           const MacBase::Context& context, const MobilityFrameworkConfig& one) {
    Radio& radio = add_radio(station, air, profile);
    macs.push_back(
        std::make_unique<MobilityFrameworkMac>(context, one, radio, stream(station, "/backoff")));
  }
  void add(const Station& station, Air& air, const StationProfile& profile,
           const MacBase::Context& context, const DcfConfig& one) {
    Radio& radio = add_radio(station, air, profile);
    auto dcf = std::make_unique<Ieee80211Mac>(
        context, one, radio,
        Ieee80211Mac::Streams{stream(station, "/backoff"), stream(station, "/rates"),
                              stream(station, "/flows").next()});
    macs.push_back(infrastructure->completed(
        {context, one, *rates_of(profile.config), stream(station, "/scan")}, std::move(dcf)));
  }

  void add(const Station& station, Air& air, const StationProfile& profile,
           const MacBase::Context& context, const ForeignProfileConfig& one) {
    Radio& radio = add_radio(station, air, profile);
    macs.push_back(one.make_mac({context, one, radio, stream(station, "/backoff")}));
  }

  Radio& add_radio(const Station& station, Air& air, const StationProfile& profile) {
    const auto index =
        static_cast<StationIndex>(std::ranges::lower_bound(air.band->stations(), station.agent) -
                                  air.band->stations().begin());
    radios.push_back(std::make_unique<Radio>(
        Radio::Air{surroundings.events, air.band->channel(), surroundings.observer,
                   waves_of(profile.config)->receiver, *profile.rules,
                   // Among equals no frame is foreign, and the test is unnecessary.
                   air.cell.is_uniform() ? Capabilities{} : air.cell.capabilities(station.agent),
                   loss ? &*loss : nullptr},
        index, station.agent, stream(station, "/errors")));
    air.band->channel().add(*radios.back());
    return *radios.back();
  }

  RadioConfig config;
  std::vector<Station> stations;  ///< In order of addresses.
  Surroundings surroundings;
  std::optional<RandomLoss> loss;
  std::vector<std::unique_ptr<Air>> airs;  ///< In order of their first station.
  std::vector<std::unique_ptr<Shared>> profiles;
  std::unique_ptr<Infrastructure> infrastructure;  ///< For profiles with a DCF.
  std::vector<std::unique_ptr<Radio>> radios;
  std::vector<std::unique_ptr<MacBase>> macs;
};

RadioNetwork::RadioNetwork(const RadioConfig& config, const std::vector<Station>& stations,
                           Surroundings surroundings)
    : state_(std::make_unique<State>(config, by_address(stations), surroundings)) {}

RadioNetwork::~RadioNetwork() = default;

MacSap& RadioNetwork::sap(hal::AgentId agent) { return *state_->macs[state_->number_of(agent)]; }

void RadioNetwork::displace(hal::AgentId agent) {
  const auto [neighbourhood, station] = state_->place_of(agent);
  neighbourhood->displace(station);
}

void RadioNetwork::set_tx_power(hal::AgentId agent, hal::Milliwatts power) {
  const auto [neighbourhood, station] = state_->place_of(agent);
  neighbourhood->set_tx_power(station, power);
  state_->macs[state_->number_of(agent)]->set_tx_power(power);
}

void RadioNetwork::interfere(const Burst& burst) {
  const WavesConfig* const waves = waves_of(state_->config);
  BARAKA_CHECK(waves != nullptr);
  const std::uint32_t channel = burst.channel.value_or(waves->phy.channel);
  for (const auto& air : state_->airs) {
    if (air->channel == channel) air->band->interfere(burst);
  }
}

std::vector<std::pair<hal::AgentId, hal::AgentId>> RadioNetwork::links() const {
  std::vector<std::pair<hal::AgentId, hal::AgentId>> pairs;
  for (const auto& air : state_->airs) {
    const auto more = links_in(*air->band);
    pairs.insert(pairs.end(), more.begin(), more.end());
  }
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace sim::radio
