#pragma once

#include <map>
#include <memory>
#include <vector>

#include "hal/types/random.h"
#include "sim/radio/distribution_system.h"
#include "sim/radio/mac_base.h"
#include "sim/radio/management.h"
#include "sim/radio/radio_network.h"

namespace sim::radio {

class DcfMac;

/// Infrastructure mode of one network: its access points, their stations, and the wire.
class Infrastructure {
 public:
  /// A station and the values of its own.
  struct Member {
    const MacBase::Context& context;
    const DcfConfig& config;  ///< Outlives the MAC.
    Standard rates;           ///< That it knows.
    hal::RandomStream scan;   ///< "<agent>/scan"
  };

  /// @param config  outlives it.
  /// @throws std::invalid_argument  an access point that is no station.
  Infrastructure(const BssConfig& config, const std::vector<RadioNetwork::Station>& stations,
                 EventQueue& events);

  /// The MAC of a station: its DCF, and what it has above that if it is in a BSS.
  std::unique_ptr<MacBase> completed(const Member& member, std::unique_ptr<DcfMac> dcf);

 private:
  std::unique_ptr<MacBase> access_point(const Member& member, std::unique_ptr<DcfMac> dcf);

  const BssConfig& config_;
  DistributionSystem distribution_;
  std::vector<hal::AgentId> access_points_;  ///< By address.
  /// Of the stations that are in a BSS and are no access points: those that they may use.
  std::map<hal::AgentId, std::vector<hal::AgentId>> usable_;
};

}  // namespace sim::radio
