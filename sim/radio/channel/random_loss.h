#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hal/types/agent_id.h"
#include "sim/radio/channel/loss_config.h"
#include "sim/radio/mac/frame.h"

namespace sim::radio {

/// Draws independently for each frame at each receiver. Every directed link has its own random
/// stream, so other stations and links do not affect the result.
class RandomLoss {
 public:
  using Names = std::vector<std::pair<hal::AgentId, std::string>>;

  /// @param names  of all stations, in ascending order of addresses.
  RandomLoss(const LossConfig& config, std::uint64_t seed, const Names& names);

  /// Whether this frame is lost at this station. Repeated calls give the same result.
  bool strikes(const Frame& frame, hal::AgentId receiver) const;

 private:
  struct Station {
    hal::AgentId agent;
    std::uint64_t name;  ///< Hash of the name and the run's seed.
  };
  struct Link {
    std::vector<bool> from, to;  ///< Whether each station is at that end.
    double probability;
  };

  std::size_t place_of(hal::AgentId agent) const;
  double probability(std::size_t from, std::size_t to) const;

  double everywhere_;
  std::vector<Station> stations_;
  std::vector<Link> links_;
};

}  // namespace sim::radio
