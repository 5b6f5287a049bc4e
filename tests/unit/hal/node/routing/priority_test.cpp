#include <gtest/gtest.h>

#include <string>

#include "hal/node/routing/frame.h"
#include "tests/unit/hal/node/routing/test_network.h"

/// Messages keep their priority over every hop of every protocol (of static routes: see
/// static_routing_test); packets of the protocol have its own.
namespace hal::node::routing::test {
namespace {

constexpr Priority kControl{4};

struct Way {
  const char* name;
  Algorithm algorithm;
  LinkCapabilities link;
};

class EveryProtocol : public testing::TestWithParam<Way> {
 protected:
  static RoutingConfig config() {
    return {.algorithm = GetParam().algorithm,
            .jitter_max = Duration::zero(),
            .control_priority = kControl};
  }
};

bool carries_message(const SentFrame& frame) {
  const auto parsed = parse_frame(frame.bytes);
  const Packet* const packet = parsed ? packet_in(*parsed) : nullptr;
  return packet != nullptr && std::holds_alternative<Data>(*packet);
}

bool acknowledges(const SentFrame& frame) {
  const auto parsed = parse_frame(frame.bytes);
  return parsed && std::holds_alternative<HopAck>(*parsed);
}

TEST_P(EveryProtocol, PassesAMessageOnWithItsPriorityAndItsOwnPacketsWithTheirs) {
  Network network(3, config(), 1, GetParam().link);
  connect_chain(network);
  network.run(3s);
  network.send(1, 3, "help", Priority::kVoice);
  network.run(5s);
  ASSERT_EQ(network.node(3).messages.size(), 1u);
  EXPECT_EQ(network.node(3).messages[0].priority, Priority::kVoice);
  int messages = 0;
  for (const SentFrame& frame : network.sent) {
    if (acknowledges(frame)) continue;  // as what they acknowledge: hop_acknowledgement_test
    messages += carries_message(frame);
    EXPECT_EQ(frame.priority, carries_message(frame) ? Priority::kVoice : kControl);
  }
  EXPECT_GE(messages, 2) << "one for each hop";
}

constexpr Way kWays[] = {{"Ants", Algorithm::kAnts, Network::kEverything},
                         {"AntsUdp", Algorithm::kAnts, Network::kNothing},
                         {"AntHocNet", Algorithm::kAntHocNet, Network::kEverything},
                         {"AntHocNetUdp", Algorithm::kAntHocNet, Network::kNothing},
                         {"Aodv", Algorithm::kAodv, Network::kEverything},
                         {"AodvUdp", Algorithm::kAodv, Network::kNothing},
                         {"Flooding", Algorithm::kFlooding, Network::kEverything}};

INSTANTIATE_TEST_SUITE_P(Routing, EveryProtocol, testing::ValuesIn(kWays),
                         [](const auto& way) { return std::string(way.param.name); });

TEST(Priority, WithoutOneTheFramesAreThoseOfBefore) {
  Network network(3, {.jitter_max = Duration::zero()});
  connect_chain(network);
  network.send(1, 3);
  network.run(1s);
  ASSERT_EQ(network.node(3).messages.size(), 1u);
  for (const SentFrame& frame : network.sent) {
    EXPECT_EQ(frame.priority, Priority::kBestEffort);
    EXPECT_NE(frame.bytes.front(), 0x1e);
  }
}

}  // namespace
}  // namespace hal::node::routing::test
