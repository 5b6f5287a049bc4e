#pragma once

#include <map>
#include <memory>
#include <vector>

#include "hal/types/random.h"
#include "sim/radio/infrastructure/distribution_system.h"
#include "sim/radio/infrastructure/management.h"
#include "sim/radio/mac/mac_base.h"
#include "sim/radio/radio_network.h"

namespace sim::radio {

class Ieee80211Mac;

/// Infrastructure mode of one network: its access points, their stations, and the distribution
/// system.
class Infrastructure {
 public:
  /// A station and its own settings.
  struct Member {
    const MacBase::Context& context;
    const DcfConfig& config;  ///< Outlives the MAC.
    Standard rates;           ///< Rates that it supports.
    hal::RandomStream scan;   ///< "<agent>/scan"
  };

  /// @param config  outlives this object.
  /// @throws std::invalid_argument  an access point is not a station.
  Infrastructure(const BssConfig& config, const std::vector<RadioNetwork::Station>& stations,
                 EventQueue& events);

  /// Completes the MAC of a station: if it is in a BSS, adds the BSS layer above its DCF.
  std::unique_ptr<MacBase> completed(const Member& member, std::unique_ptr<Ieee80211Mac> dcf);

 private:
  std::unique_ptr<MacBase> access_point(const Member& member, std::unique_ptr<Ieee80211Mac> dcf);

  const BssConfig& config_;
  DistributionSystem distribution_;
  std::vector<hal::AgentId> access_points_;  ///< In ascending order.
  /// For each station that is in a BSS and is not an access point: the access points that it may
  /// use.
  std::map<hal::AgentId, std::vector<hal::AgentId>> usable_;
};

}  // namespace sim::radio
