#include "tests/unit/hal/node/routing/test_network.h"

#include <gtest/gtest.h>

namespace hal::node::routing::test {

TestNode::TestNode(Network& network, AgentId own, const RoutingConfig& config, std::uint64_t seed)
    : self(own), network_(network) {
  router =
      std::make_unique<Router>(self, config, RouterStreams(seed, "n" + std::to_string(self.value)),
                               RouterPorts{*this, network.clock, *this, *this});
}

LinkCapabilities TestNode::capabilities() const { return network_.capabilities; }

Duration TestNode::expected_delay() const { return network_.delay_of(self); }

double TestNode::transmit_energy(std::size_t) const { return network_.energy_of(self); }

void TestNode::transmit(AgentId next_hop, Bytes frame, const LinkOptions& options) {
  network_.transmit(self, next_hop, frame, options);
}

void TestNode::on_fate(MessageId message, Fate fate) {
  EXPECT_FALSE(is_sending) << "fate of message " << message << " from within send()";
  fates.push_back({network_.clock.now(), message, fate});
}

void TestNode::on_message_end(AgentId sent_by, MessageId message, std::string_view,
                              Verdict verdict) {
  network_.ends.push_back({network_.clock.now(), self, sent_by, message, verdict});
}

Network::Network(int nodes, RoutingConfig config, std::uint64_t seed, LinkCapabilities can)
    : capabilities(can) {
  for (int number = 1; number <= nodes; ++number) {
    nodes_.push_back(std::make_unique<TestNode>(*this, id(number), config, seed));
  }
}

void Network::connect(int a, int b) {
  edges_.insert({id(a), id(b)});
  edges_.insert({id(b), id(a)});
}

void Network::disconnect(int a, int b) {
  edges_.erase({id(a), id(b)});
  edges_.erase({id(b), id(a)});
}

MessageId Network::send(int from, int to, const std::string& topic, Priority priority) {
  TestNode& sender = node(from);
  const MessageId message = ++sender.last_id;
  sender.is_sending = true;
  sender.router->send({.source = id(from),
                       .destination = id(to),
                       .id = message,
                       .topic = topic,
                       .payload = {static_cast<std::uint8_t>(message)},
                       .priority = priority});
  sender.is_sending = false;
  return message;
}

void Network::transmit(AgentId from, AgentId to, const Bytes& frame, const LinkOptions& options) {
  if (const auto verdict = refusal(from)) {
    report(from, options.tag, *verdict, Duration::zero());
    return;
  }
  sent.push_back({clock.now(), from, to, frame, options.priority});
  bool acknowledged = to == kEveryone;
  for (const auto& receiver : nodes_) {
    const bool addressed = to == kEveryone || to == receiver->self;
    if (!addressed || !are_connected(from, receiver->self)) continue;
    if (is_lost(from, receiver->self)) continue;
    acknowledged = true;
    clock.schedule(clock.now() + kHop,
                   [this, from, target = receiver->self, frame] { arrive(from, target, frame); });
  }
  report(from, options.tag, acknowledged ? Verdict::kDelivered : Verdict::kRetryLimit, kHop);
}

void Network::report(AgentId sender, LinkTag tag, Verdict verdict, Duration after) {
  if (!capabilities.tx_status) return;
  clock.schedule(clock.now() + after, [this, sender, tag, verdict] {
    node(sender.value).router->on_transmitted({tag, verdict});
  });
}

void Network::arrive(AgentId from, AgentId to, const Bytes& frame) {
  const auto& router = node(to.value).router;
  if (!router) return;  // the test took it away
  if (capabilities.rssi) {
    router->on_frame({.from = from, .rssi_dbm = -60, .snr_db = snr_db(from, to)}, frame);
  } else {
    router->on_frame({.from = from}, frame);
  }
}

void connect_chain(Network& network) {
  for (int a = 1; a < network.size(); ++a) network.connect(a, a + 1);
}

void connect_grid(Network& network, int width) {
  for (int a = 1; a <= network.size(); ++a) {
    if (a % width != 0) network.connect(a, a + 1);
    if (a + width <= network.size()) network.connect(a, a + width);
  }
}

}  // namespace hal::node::routing::test
