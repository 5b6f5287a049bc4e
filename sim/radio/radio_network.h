#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hal/types/agent_id.h"
#include "sim/core/event_queue.h"
#include "sim/core/ground.h"
#include "sim/radio/channel/burst.h"
#include "sim/radio/channel/ports.h"
#include "sim/radio/mac/mac_sap.h"
#include "sim/radio/mac/observer.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// All stations, with one medium per channel number. Constructed once; stations are then used
/// through their MacSap.
class RadioNetwork {
 public:
  struct Surroundings {
    EventQueue& events;
    const Positions& positions;
    const Obstacles& obstacles;
    RadioObserver& observer;
    std::uint64_t seed = 0;
    const Ground& ground = *kFlatGround;
  };
  struct Station {
    hal::AgentId agent;
    std::string name;  ///< Agent's name, from which its random streams are named.
    StationConfig radio{};
    /// Largest power that set_tx_power() will request; 0 if it will not be called.
    hal::Milliwatts most_power{};
  };

  /// @throws std::invalid_argument  check() rejects the config, or an access point is not a
  /// station.
  RadioNetwork(const RadioConfig& config, const std::vector<Station>& stations,
               Surroundings surroundings);
  ~RadioNetwork();
  RadioNetwork(const RadioNetwork&) = delete;
  RadioNetwork& operator=(const RadioNetwork&) = delete;

  MacSap& sap(hal::AgentId agent);

  /// Reports that the agent jumped to another position.
  void displace(hal::AgentId agent);
  /// Sets the power into the antenna from the next frame on. @param power  > 0, at most
  /// Station::most_power.
  void set_tx_power(hal::AgentId agent, hal::Milliwatts power);
  /// Starts a burst now. No effect on a channel number without stations. @pre the profile has a
  /// medium (WavesConfig).
  void interfere(const Burst& burst);

  /// Pairs of agents that could receive each other's frames now, each once, lower address first:
  /// the arrows in Fig. 2 of the paper.
  std::vector<std::pair<hal::AgentId, hal::AgentId>> links() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sim::radio
