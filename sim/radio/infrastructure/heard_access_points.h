#pragma once

#include <map>
#include <optional>

#include "hal/types/agent_id.h"
#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "sim/radio/infrastructure/bss_config.h"

namespace sim::radio {

/// The access points whose beacons one station hears, each with the running mean of its RSSI in
/// dBm, in which the newest beacon has the weight `beacon_weight`.
class HeardAccessPoints {
 public:
  /// @param config  outlives this object.
  explicit HeardAccessPoints(const BssConfig& config) : config_(config) {}

  /// @param interval  beacon interval that the beacon announces.
  void on_beacon(hal::AgentId access_point, hal::Dbm rssi, hal::Duration interval, hal::Time now);
  /// Removes an access point until it is heard again.
  void forget(hal::AgentId access_point) { heard_.erase(access_point); }
  void clear() { heard_.clear(); }

  /// Time at which it counts as lost: `beacon_loss` intervals after its last beacon. @pre it was
  /// heard.
  hal::Time lost_at(hal::AgentId access_point) const;

  /// The access point with the strongest mean among those that are not lost; ties go to the lowest
  /// address. @return nullopt if there is none.
  std::optional<hal::AgentId> strongest(hal::Time now) const;

  /// The strongest access point if it is stronger than `current` by more than the hysteresis, else
  /// nullopt. @pre `current` was heard.
  std::optional<hal::AgentId> better_than(hal::AgentId current, hal::Time now) const;

 private:
  struct Heard {
    double mean_dbm = 0;
    hal::Time last{};
    hal::Duration interval{};
  };

  const BssConfig& config_;
  std::map<hal::AgentId, Heard> heard_;
};

}  // namespace sim::radio
