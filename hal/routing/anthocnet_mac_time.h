#pragma once

#include <map>
#include <optional>

#include "hal/routing/ports.h"

namespace hal::routing::anthocnet {

/// A link that measures itself: how long a frame takes from the head of the queue to the end of its
/// successful transmission, as a running average T_mac = alpha T_mac + (1 - alpha) t, and how many
/// frames wait. From these the time of a hop is (Q + 1) T_mac ([PPSN], 3.1). Broadcasts, which need
/// no acknowledgement, are not averaged: messages are unicast. Until the first unicast, T_mac is
/// T_hop.
///
/// [PPSN] lets t begin with the arrival at the MAC. Here the time behind other frames is left out
/// of it: (Q + 1) counts them already. Over a link without transmit status there is nothing to
/// measure: the time of a hop is what the link itself expects.
class MacTime final : public Link {
 public:
  /// @param alpha  0..1. @param hop_time  T_hop, > 0.
  MacTime(Link& link, Timers& timers, double alpha, Duration hop_time);

  LinkCapabilities capabilities() const override { return link_.capabilities(); }
  void transmit(AgentId next_hop, Bytes frame, LinkTag tag) override;
  /// (Q + 1) T_mac.
  Duration expected_delay() const override;
  double transmit_energy(std::size_t bytes) const override { return link_.transmit_energy(bytes); }

  /// @return to whom the frame was; none if it is not under way.
  std::optional<AgentId> on_transmitted(const Transmission& transmission);

  double mac_time() const { return mac_time_; }  ///< T_mac, s.

 private:
  struct UnderWay {
    AgentId next_hop;
    Time handed_over{};
  };

  Link& link_;
  Timers& timers_;
  const double alpha_;
  double mac_time_;  ///< s
  Time last_end_{};  ///< Of a transmission; what the link refused or dropped was none.
  std::map<LinkTag, UnderWay> under_way_;
};

}  // namespace hal::routing::anthocnet
