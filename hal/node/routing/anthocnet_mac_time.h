#pragma once

#include <map>
#include <optional>

#include "hal/node/routing/ports.h"

namespace hal::node::routing::anthocnet {

/// A link that measures its service time. T_mac is a running average (A1) of the time t from the
/// head of the queue to the end of a successful transmission. With the number Q of waiting frames
/// it gives the expected time of a hop (A2). Broadcasts are not averaged: they are not
/// acknowledged, and messages are unicast. Before the first unicast frame T_mac is T_hop. Numbers
/// of formulae: anthocnet_config.h.
///
/// In [PPSN] t begins with the arrival at the MAC. Here it excludes the wait behind other frames,
/// which the factor (Q + 1) already covers. A link without transmit status cannot be measured: its
/// own expected_delay() is used.
class MacTime final : public Link {
 public:
  /// @param alpha  0..1. @param hop_time  T_hop, > 0.
  MacTime(Link& link, Timers& timers, double alpha, Duration hop_time);

  LinkCapabilities capabilities() const override { return link_.capabilities(); }
  void transmit(AgentId next_hop, Bytes frame, const LinkOptions& options) override;
  /// T_i of (A2).
  Duration expected_delay() const override;
  double transmit_energy(std::size_t bytes) const override { return link_.transmit_energy(bytes); }

  /// @return the receiver of the frame; nullopt if the frame is not under way.
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
  Time last_end_{};  ///< End of the last frame that the link tried to transmit.
  std::map<LinkTag, UnderWay> under_way_;
};

}  // namespace hal::node::routing::anthocnet
