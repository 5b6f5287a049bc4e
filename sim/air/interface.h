#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hal/types/agent_id.h"
#include "sim/air/ethertypes.h"
#include "sim/air/refusal.h"
#include "sim/radio/mac/mac_sap.h"

namespace sim::air {

/// Callbacks about the frames of an interface, on the run's thread.
class InterfaceListener {
 public:
  virtual ~InterfaceListener() = default;
  /// A frame was accepted as this request, whose tag is unique among the requests of this agent's
  /// interface.
  virtual void on_entered(hal::AgentId agent, const radio::MacRequest& request) = 0;
  /// A frame was received. @param ethernet  its Ethernet II frame, valid during the call.
  virtual void on_left(hal::AgentId agent, const radio::MacIndication& indication,
                       std::span<const std::uint8_t> ethernet) = 0;
  virtual void on_refused(hal::AgentId agent, Refusal refusal, std::size_t bytes) = 0;
  /// A request ended: its place in the queue is free.
  virtual void on_ended(hal::AgentId agent) = 0;
};

/// The agent's `wlan0`: converts between Ethernet II frames, without preamble and check sequence,
/// and the station's MacSap, for IPv4, ARP and IPv6. Addresses, type and payload of the Ethernet
/// header are kept; a multicast frame is sent as a broadcast that keeps its group.
class Interface final : public radio::MacClient {
 public:
  /// @param mac,listener  outlive the interface.
  Interface(hal::AgentId agent, radio::MacSap& mac, InterfaceListener& listener);

  /// Sends a frame or refuses it. Call between two events.
  void send(std::span<const std::uint8_t> ethernet);

  /// Free places in the station's queue, in frames.
  std::size_t room() const { return mac_.room(); }

  /// Whether TCP segments have passed, whose timers do not follow simulated time.
  bool has_seen_tcp() const { return has_seen_tcp_; }

  void on_receive(const radio::MacIndication& indication) override;
  void on_transmitted(std::uint64_t tag, hal::Verdict verdict) override;

 private:
  void look_for_tcp(radio::Ethertype ethertype, std::span<const std::uint8_t> packet);

  hal::AgentId agent_;
  radio::MacSap& mac_;
  InterfaceListener& listener_;
  std::uint64_t last_tag_ = 0;
  bool has_seen_tcp_ = false;
  std::vector<std::uint8_t> ethernet_;  ///< The outgoing frame; a member to reuse its memory.
};

}  // namespace sim::air
