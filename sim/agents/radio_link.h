#pragma once

#include "hal/node/agent/ports.h"
#include "hal/node/routing/router.h"
#include "sim/agents/simulation_config.h"
#include "sim/radio/mac/mac_sap.h"

namespace sim::agents {

/// The router's link over a simulated MAC.
class RadioLink final : public hal::node::agent::Link, public radio::MacClient {
 public:
  /// Registers as the MAC's client for routing frames. The MAC outlives the link.
  RadioLink(radio::MacSap& mac, LinkKind kind);

  /// Sets the receiver of frames. @pre called before the first frame arrives.
  void attach(hal::node::routing::Router& router) { router_ = &router; }

  hal::node::routing::LinkCapabilities capabilities() const override;
  void transmit(hal::AgentId next_hop, hal::Bytes frame,
                const hal::node::routing::LinkOptions& options) override;
  hal::Duration expected_delay() const override { return mac_.expected_delay(); }
  double transmit_energy(std::size_t bytes) const override { return mac_.transmit_energy(bytes); }
  void set_radio(bool on) override;
  /// Switches the radio off permanently.
  void cut_power();
  /// Off: the radio is off until power returns, and then as its controller wants it.
  void set_power(bool on);

  void on_receive(const radio::MacIndication& indication) override;
  void on_transmitted(std::uint64_t tag, hal::Verdict verdict) override;

 private:
  radio::MacSap& mac_;
  LinkKind kind_;
  bool is_wanted_ = true, has_power_ = true, is_empty_ = false;
  hal::node::routing::Router* router_ = nullptr;
};

}  // namespace sim::agents
