#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hal/types/agent_id.h"
#include "sim/air/ethertypes.h"
#include "sim/air/refusal.h"
#include "sim/radio/mac_sap.h"

namespace sim::air {

/// Told of the frames of an interface; on the run's thread.
class InterfaceListener {
 public:
  virtual ~InterfaceListener() = default;
  /// A frame became this request, whose tag no other of this agent's interface has.
  virtual void on_entered(hal::AgentId agent, const radio::MacRequest& request) = 0;
  /// What was received, and the Ethernet frame of it, which is valid during the call.
  virtual void on_left(hal::AgentId agent, const radio::MacIndication& indication,
                       std::span<const std::uint8_t> ethernet) = 0;
  virtual void on_refused(hal::AgentId agent, Refusal refusal, std::size_t bytes) = 0;
  /// A request ended: its place in the queue is free.
  virtual void on_ended(hal::AgentId agent) = 0;
};

/// The agent's `wlan0`: converts between Ethernet II frames, without preamble and check sequence,
/// and the station's MacSap, for IPv4, ARP and IPv6. Addresses, type and payload of the Ethernet
/// header are kept; a multicast frame is sent as a broadcast, and keeps its group.
class Interface final : public radio::MacClient {
 public:
  /// @param mac, listener  outlive it.
  Interface(hal::AgentId agent, radio::MacSap& mac, InterfaceListener& listener);

  /// Sends it, or refuses it. Between two events.
  void send(std::span<const std::uint8_t> ethernet);

  /// Free places in the station's queue now, frames.
  std::size_t room() const { return mac_.room(); }

  /// Whether TCP has passed here: its timers do not follow simulated time.
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
  std::vector<std::uint8_t> ethernet_;  ///< The one that leaves; kept for its memory.
};

}  // namespace sim::air
