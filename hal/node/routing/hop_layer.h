#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hal/node/routing/hello.h"
#include "hal/node/routing/hop_acknowledgement.h"
#include "hal/node/routing/neighbourhood.h"
#include "hal/node/routing/node.h"
#include "hal/node/routing/outbox.h"

namespace hal::node::routing {

/// Receives events of the one-hop layer below a multi-hop protocol.
class HopListener {
 public:
  virtual ~HopListener() = default;
  /// A packet arrived. @return false if its contents contradict its transmitter.
  virtual bool on_packet(Packet packet, const Arrival& arrival) = 0;
  /// A neighbour did not acknowledge, or became silent. Called before on_sent of its messages.
  virtual void on_no_answer(AgentId neighbour) = 0;
  /// A message was transmitted, or was not: kRetryLimit if the next hop did not acknowledge.
  virtual void on_sent(Transit transit, Verdict verdict) = 0;
};

/// One hop with the same services over any link: it reports the result of each frame, and the
/// neighbours. Over a link without transmit status the next hop's router acknowledges unicast
/// frames, which are repeated until then (hop_acknowledgement.h), and hellos detect neighbours that
/// fall silent (hello.h).
class HopLayer final : private OutboxListener {
 public:
  /// @param listener  outlives the layer.   @pre the values of `config` that it uses are valid.
  HopLayer(AgentId self, const RoutingConfig& config, const RouterStreams& streams,
           const RouterPorts& ports, HopListener& listener);

  Node& node() { return node_; }
  Outbox& outbox() { return outbox_; }
  std::vector<Neighbour> neighbours() const { return neighbourhood_.known(); }

  /// As the functions of Protocol.
  bool on_frame(const Reception& reception, std::span<const std::uint8_t> bytes);
  void on_transmitted(const Transmission& transmission);

  /// The protocol has detected the loss of a neighbour: handled like a missing acknowledgement.
  void give_up(AgentId neighbour);

 private:
  void on_no_answer(AgentId neighbour) override;
  void on_sent(Transit transit, Verdict verdict) override;

  bool take(Packet packet, const Arrival& arrival);
  bool take(Numbered numbered, const Arrival& arrival);
  bool take(HopAck ack, const Arrival& arrival);
  bool take(Hello hello, const Arrival& arrival);

  const bool has_status_;
  HopListener& listener_;
  HopAcknowledgement acknowledgement_;
  Node node_;
  Hellos hellos_;
  Neighbourhood neighbourhood_{node_.ports.timers, node_.ports.observer};
  Outbox outbox_{node_, *this};
};

}  // namespace hal::node::routing
