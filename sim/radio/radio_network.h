#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hal/types/agent_id.h"
#include "sim/core/event_queue.h"
#include "sim/core/ground.h"
#include "sim/radio/burst.h"
#include "sim/radio/mac_sap.h"
#include "sim/radio/observer.h"
#include "sim/radio/ports.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// All stations, on one air for each channel number. Built once; stations are then used through
/// their MacSap.
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
    std::string name;  ///< Of the agent; names its random streams.
    StationConfig radio{};
    hal::Milliwatts most_power{};  ///< That set_tx_power() will ask for; 0: it will not.
  };

  /// @throws std::invalid_argument  what check() refuses, and an access point that is no station.
  RadioNetwork(const RadioConfig& config, const std::vector<Station>& stations,
               Surroundings surroundings);
  ~RadioNetwork();
  RadioNetwork(const RadioNetwork&) = delete;
  RadioNetwork& operator=(const RadioNetwork&) = delete;

  MacSap& sap(hal::AgentId agent);

  /// The agent is somewhere else now, without having moved there.
  void displace(hal::AgentId agent);
  /// Into the antenna from its next frame on, > 0. @param power  at most Station::most_power.
  void set_tx_power(hal::AgentId agent, hal::Milliwatts power);
  /// Begins now. On a channel number that nobody uses: no effect. @pre a profile with waves.
  void interfere(const Burst& burst);

  /// Pairs that could receive each other's frames now, each once, lower address first: the arrows
  /// of the paper's Fig. 2.
  std::vector<std::pair<hal::AgentId, hal::AgentId>> links() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sim::radio
