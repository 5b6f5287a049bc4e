#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hal/routing/hello.h"
#include "hal/routing/hop_acknowledgement.h"
#include "hal/routing/neighbourhood.h"
#include "hal/routing/node.h"
#include "hal/routing/outbox.h"

namespace hal::routing {

/// What a protocol over several hops hears from the one hop below it.
class HopListener {
 public:
  virtual ~HopListener() = default;
  /// A packet came in. @return false if it contradicts how it came in.
  virtual bool on_packet(Packet packet, const Arrival& arrival) = 0;
  /// A neighbour did not answer, or fell silent. Comes before on_sent of what was for it.
  virtual void on_no_answer(AgentId neighbour) = 0;
  /// A message left, or did not: kRetryLimit if the next hop did not answer.
  virtual void on_sent(Transit transit, Verdict verdict) = 0;
};

/// One hop as every protocol over several of them wants it, over any link: it tells what became of
/// each frame, and who the neighbours are. Over a link without transmit status unicast frames are
/// acknowledged by the next hop's router and repeated until they are (hop_acknowledgement.h), and
/// neighbours that fall silent are missed by their hellos (hello.h).
class HopLayer final : private OutboxListener {
 public:
  /// @param listener  outlives the layer.   @pre the values of `config` that it uses are valid.
  HopLayer(AgentId self, const RoutingConfig& config, const RouterStreams& streams,
           const RouterPorts& ports, HopListener& listener);

  Node& node() { return node_; }
  Outbox& outbox() { return outbox_; }
  std::vector<Neighbour> neighbours() const { return neighbourhood_.known(); }

  /// As those of Protocol.
  bool on_frame(const Reception& reception, std::span<const std::uint8_t> bytes);
  void on_transmitted(const Transmission& transmission);

  /// The protocol itself found out that a neighbour is gone: as if it had not answered.
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

}  // namespace hal::routing
