#pragma once

#include <map>

#include "sim/core/event_queue.h"
#include "sim/radio/mac_sap.h"

namespace sim::radio {

/// A frame between two access points.
struct Distributed {
  MacRequest request;  ///< To its final destination.
  hal::AgentId source;
  double rssi_dbm = 0;  ///< With which it came to the first access point.
  double snr_db = 0;
};

/// An access point as the distribution system sees it.
class DistributionPort {
 public:
  virtual ~DistributionPort() = default;
  virtual hal::AgentId address() const = 0;
  /// For this access point, a station associated with it, or everyone in its BSS.
  virtual void on_distributed(const Distributed& distributed) = 0;
  /// The station has associated with another access point.
  virtual void on_moved(hal::AgentId station) = 0;
};

/// The wire between the access points (IEEE Std 802.11-2016, 4.3.5): knows where each station is
/// associated and delivers frames there, without loss, after a constant delay.
class DistributionSystem {
 public:
  DistributionSystem(EventQueue& events, hal::Duration delay) : events_(events), delay_(delay) {}

  /// @pre outlives it; once each.
  void add(DistributionPort& access_point) { ports_[access_point.address()] = &access_point; }

  /// The station is with this access point from now on; the one before is told.
  void associate(hal::AgentId station, hal::AgentId access_point);
  /// It is not with this one any more. No effect if it is with another.
  void release(hal::AgentId station, hal::AgentId access_point);

  /// Takes it to the access point of its destination, but not back, or to all other ones if it is
  /// for everyone.
  /// @return false: the destination is neither an access point nor with another one.
  bool carry(const Distributed& distributed, hal::AgentId from);

 private:
  void hand_over(const Distributed& distributed, hal::AgentId to);

  EventQueue& events_;
  hal::Duration delay_;
  std::map<hal::AgentId, DistributionPort*> ports_;
  std::map<hal::AgentId, hal::AgentId> with_;  ///< By station.
};

}  // namespace sim::radio
