#pragma once

#include <deque>
#include <map>
#include <memory>
#include <vector>

#include "sim/radio/distribution_system.h"
#include "sim/radio/mac_base.h"
#include "sim/radio/management.h"
#include "sim/radio/radio_network.h"

namespace sim::radio {

class DcfMac;

/// Infrastructure mode of one network: who is an access point, who uses which, and the wire.
class Infrastructure {
 public:
  /// @param config  outlives it.
  /// @throws std::invalid_argument  an access point that is no station.
  Infrastructure(const DcfConfig& config, const std::vector<RadioNetwork::Station>& stations,
                 EventQueue& events);

  /// Of one station, which may differ from the network's.
  struct Own {
    Profile profile;
    const DcfConfig& config;  ///< Outlives the station.
  };
  /// The MAC of a station: its DCF, and what it has above that if it is in a BSS.
  std::unique_ptr<MacBase> completed(const MacBase::Context& context, std::unique_ptr<DcfMac> dcf,
                                     const Own& own);

 private:
  std::unique_ptr<MacBase> access_point(const MacBase::Context& context,
                                        std::unique_ptr<DcfMac> dcf, const Own& own);

  const DcfConfig& config_;
  std::deque<BssParameters> parameters_;  ///< Of each station in a BSS, which refers to it.
  DistributionSystem distribution_;
  std::vector<hal::AgentId> access_points_;  ///< By address.
  /// Of the stations that are in a BSS and are no access points: those that they may use.
  std::map<hal::AgentId, std::vector<hal::AgentId>> usable_;
};

}  // namespace sim::radio
