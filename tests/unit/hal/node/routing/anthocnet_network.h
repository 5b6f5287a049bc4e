#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "hal/node/routing/anthocnet_packet.h"
#include "tests/unit/hal/node/routing/test_network.h"

namespace hal::node::routing::anthocnet::test {

using routing::test::id;
using routing::test::Network;
using routing::test::SentFrame;
using routing::test::TestNode;
using namespace std::chrono_literals;

/// AntHocNet with its own jitter of 1 ms: frames take 1 ms on the test's medium.
inline RoutingConfig ant_config() {
  RoutingConfig config{.algorithm = Algorithm::kAntHocNet};
  config.jitter_max = 1ms;
  config.retry_period = 2s;
  return config;
}

/// The control packet of a frame; none: it carries something else.
inline std::optional<ControlPacket> control_in(const SentFrame& frame) {
  const auto packet = parse(frame.bytes);
  const auto* control = packet ? std::get_if<Control>(&*packet) : nullptr;
  if (control == nullptr) return std::nullopt;
  return parse_control(control->body);
}

/// Every control packet of one type that was sent, with its frame.
template <class Type>
std::vector<std::pair<SentFrame, Type>> sent_packets(const Network& network) {
  std::vector<std::pair<SentFrame, Type>> found;
  for (const SentFrame& frame : network.sent) {
    const auto packet = control_in(frame);
    if (!packet) continue;
    if (const auto* wanted = std::get_if<Type>(&*packet)) found.emplace_back(frame, *wanted);
  }
  return found;
}

/// Frames with forward ants of a kind.
inline std::vector<std::pair<SentFrame, ForwardAnt>> forward_ants(const Network& network,
                                                                  AntKind kind) {
  auto ants = sent_packets<ForwardAnt>(network);
  std::erase_if(ants, [kind](const auto& sent) { return sent.second.kind != kind; });
  return ants;
}

inline int events(Network& network, ProtocolEvent event) {
  int sum = 0;
  for (int number = 1; number <= network.size(); ++number) {
    const auto& counted = network.node(number).events;
    const auto found = counted.find(event);
    if (found != counted.end()) sum += found->second;
  }
  return sum;
}

/// 1 - {2, 3} - 4.
inline void connect_diamond(Network& network) {
  for (const auto& [a, b] : {std::pair{1, 2}, {2, 4}, {1, 3}, {3, 4}}) network.connect(a, b);
}

}  // namespace hal::node::routing::anthocnet::test
