#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/core/event_queue.h"
#include "sim/core/ground.h"
#include "sim/radio/channel/burst.h"
#include "sim/radio/channel/channel.h"
#include "sim/radio/channel/neighbourhood.h"
#include "sim/radio/channel/ports.h"
#include "sim/radio/channel/propagation.h"
#include "sim/radio/mac/observer.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// The medium of the stations that share a channel number, independent of other channel numbers.
class Band {
 public:
  struct Surroundings {
    EventQueue& events;
    const Positions& positions;
    const Obstacles& obstacles;
    RadioObserver& observer;
    const Ground& ground;
  };
  /// @param config  of any station on this channel number.
  /// @param antennas  of all stations on it, in ascending order of agents.
  Band(const RadioConfig& config, Surroundings around,
       const std::vector<Neighbourhood::Antenna>& antennas)
      : propagation_(config, around.obstacles, around.ground),
        neighbourhood_(around.events, around.positions, propagation_, antennas) {
    for (const auto& antenna : antennas) stations_.push_back(antenna.agent);
    if (const WavesConfig* const waves = waves_of(config)) {
      channel_ = std::make_unique<Channel>(around.events, neighbourhood_, around.observer, *waves);
    }
  }

  /// Starts a burst now. @pre the profile has a medium (WavesConfig).
  void interfere(const Burst& burst) {
    const Site from(burst.from);
    for (StationIndex to = 0; to < stations_.size(); ++to) {
      const auto arrival = neighbourhood_.arrival(burst.power, from, to);
      if (arrival.power.value > 0)
        channel_->interfere(to, arrival.delay, burst.length, arrival.power.value);
    }
  }

  const Propagation& propagation() const { return propagation_; }
  Neighbourhood& neighbourhood() { return neighbourhood_; }
  /// @pre the profile has a medium (WavesConfig).
  Channel& channel() { return *channel_; }
  /// The stations, by StationIndex.
  const std::vector<hal::AgentId>& stations() const { return stations_; }

 private:
  Propagation propagation_;
  Neighbourhood neighbourhood_;
  std::unique_ptr<Channel> channel_;
  std::vector<hal::AgentId> stations_;
};

}  // namespace sim::radio
