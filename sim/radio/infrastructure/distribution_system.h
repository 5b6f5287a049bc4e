#pragma once

#include <map>

#include "sim/core/event_queue.h"
#include "sim/radio/mac/mac_sap.h"

namespace sim::radio {

/// A frame on its way from one access point to another.
struct Distributed {
  MacRequest request;  ///< Addressed to the final destination.
  hal::AgentId source;
  double rssi_dbm = 0;  ///< At the first access point, as is the SNR.
  double snr_db = 0;
};

/// An access point as the distribution system sees it.
class DistributionPort {
 public:
  virtual ~DistributionPort() = default;
  virtual hal::AgentId address() const = 0;
  /// Called for a frame to this access point, to a station associated with it, or to everyone in
  /// its BSS.
  virtual void on_distributed(const Distributed& distributed) = 0;
  /// Called when the station has associated with another access point.
  virtual void on_moved(hal::AgentId station) = 0;
};

/// The link between the access points (IEEE Std 802.11-2016, 4.3.5): knows with which access point
/// each station is associated and delivers frames there, without loss, after a constant delay.
class DistributionSystem {
 public:
  DistributionSystem(EventQueue& events, hal::Duration delay) : events_(events), delay_(delay) {}

  /// Adds an access point, which outlives this object. @pre not added before.
  void add(DistributionPort& access_point) { ports_[access_point.address()] = &access_point; }

  /// Records that a station is associated with this access point and informs the previous one.
  void associate(hal::AgentId station, hal::AgentId access_point);
  /// Ends the association of a station with this access point. No effect if it is associated with
  /// another one.
  void release(hal::AgentId station, hal::AgentId access_point);

  /// Carries a frame to the access point of its destination, or, if it is for everyone, to all
  /// access points; never back to `from`.
  /// @return false if the destination is neither an access point nor associated with another one.
  bool carry(const Distributed& distributed, hal::AgentId from);

 private:
  void hand_over(const Distributed& distributed, hal::AgentId to);

  EventQueue& events_;
  hal::Duration delay_;
  std::map<hal::AgentId, DistributionPort*> ports_;
  std::map<hal::AgentId, hal::AgentId> with_;  ///< Access point of each station.
};

}  // namespace sim::radio
