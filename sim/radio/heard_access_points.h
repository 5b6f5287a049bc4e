#pragma once

#include <map>
#include <optional>

#include "hal/types/agent_id.h"
#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "sim/radio/bss_config.h"

namespace sim::radio {

/// The beacons of access points that one station hears: of each the running mean of its RSSI in
/// dBm, in which the newest beacon has the weight `beacon_weight`.
class HeardAccessPoints {
 public:
  /// @param config  outlives it.
  explicit HeardAccessPoints(const BssConfig& config) : config_(config) {}

  /// @param interval  that the beacon names.
  void on_beacon(hal::AgentId access_point, hal::Dbm rssi, hal::Duration interval, hal::Time now);
  /// Until it is heard again.
  void forget(hal::AgentId access_point) { heard_.erase(access_point); }
  void clear() { heard_.clear(); }

  /// When it counts as lost: so many intervals after its last beacon. @pre it was heard.
  hal::Time lost_at(hal::AgentId access_point) const;

  /// Of those that are not lost the one with the strongest mean, of equals the lowest address;
  /// none: there is none.
  std::optional<hal::AgentId> strongest(hal::Time now) const;

  /// The same if it is stronger than `current` by more than the hysteresis. @pre that was heard.
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
