#include "hal/node/routing/one_hop.h"

#include <gtest/gtest.h>

#include "hal/node/routing/packet.h"
#include "tests/unit/hal/node/routing/test_network.h"

namespace hal::node::routing::test {
namespace {

const RoutingConfig kDirect{.algorithm = Algorithm::kNone};

Message message(AgentId to) {
  return {.source = id(1), .destination = to, .id = 7, .topic = "help", .payload = {1, 2, 3}};
}

TEST(OneHopFrame, CarriesTopicIdAndPayloadBehindSixOctetsAndTheTopic) {
  for (const AgentId to : {id(2), kNeighbours, kEveryone}) {
    const Bytes bytes = encode_one_hop(message(to));
    EXPECT_EQ(bytes.size(), kOneHopHeader + 4 + 3);
    EXPECT_EQ(parse_one_hop(bytes, id(1), id(2)), message(to));
  }
  EXPECT_EQ(encode_one_hop(message(id(2))),
            (Bytes{0x17, 4, 'h', 'e', 'l', 'p', 0, 0, 0, 7, 1, 2, 3}));
}

TEST(OneHopFrame, HasAKindOfItsOwnAndOneOctetMoreWithAPriority) {
  Message urgent = message(id(2));
  urgent.priority = Priority{7};
  EXPECT_EQ(encode_one_hop(urgent), (Bytes{0x1b, 4, 'h', 'e', 'l', 'p', 0, 0, 0, 7, 7, 1, 2, 3}));
  for (const AgentId to : {id(2), kNeighbours, kEveryone}) {
    urgent.destination = to;
    Bytes bytes = encode_one_hop(urgent);
    EXPECT_EQ(parse_one_hop(bytes, id(1), id(2)), urgent);
    for (const std::uint8_t wrong : Bytes{0, 8}) {
      bytes[kOneHopHeader + 4] = wrong;
      EXPECT_FALSE(parse_one_hop(bytes, id(1), id(2))) << int{wrong};
    }
  }
}

TEST(OneHop, GivesTheLinkThePriorityOfTheMessageAndTellsItsReceiver) {
  Network network(2, kDirect);
  connect_chain(network);
  network.send(1, 2, "help", Priority::kVideo);
  network.send(1, 2);
  network.run(1s);
  ASSERT_EQ(network.sent.size(), 2u);
  EXPECT_EQ(network.sent[0].priority, Priority::kVideo);
  EXPECT_EQ(network.sent[1].priority, Priority::kBestEffort);
  ASSERT_EQ(network.node(2).messages.size(), 2u);
  EXPECT_EQ(network.node(2).messages[0].priority, Priority::kVideo);
  EXPECT_EQ(network.node(2).messages[1].priority, Priority::kBestEffort);
}

TEST(OneHopFrame, IsRefusedIfAnythingIsWrongWithIt) {
  const Bytes good = encode_one_hop(message(id(2)));
  const auto refused = [](const Bytes& bytes) { return !parse_one_hop(bytes, id(1), id(2)); };
  for (std::size_t size = 0; size < kOneHopHeader + 4; ++size) {
    EXPECT_TRUE(refused({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)})) << size;
  }
  const auto with = [&](std::size_t octet, std::uint8_t value) {
    Bytes bytes = good;
    bytes.at(octet) = value;
    return bytes;
  };
  EXPECT_TRUE(refused(with(0, 0x13))) << "data of ant routing";
  EXPECT_TRUE(refused(with(1, 0))) << "no topic";
  EXPECT_TRUE(refused(with(9, 0))) << "message 0";
  Bytes long_one = good;
  long_one.resize(good.size() + kMaxPayload);
  EXPECT_TRUE(refused(long_one));
}

TEST(OneHop, ReachesNeighboursOnlyAndIsNeverPassedOn) {
  Network network(3, kDirect);
  connect_chain(network);
  network.send(1, 3);
  network.flood(2);
  network.run(1min);
  ASSERT_EQ(network.node(3).messages.size(), 1u) << "the flood of its neighbour";
  EXPECT_EQ(network.node(3).messages.front().source, id(2));
  EXPECT_EQ(network.node(3).messages.front().destination, kEveryone);
  ASSERT_EQ(network.node(1).fates.size(), 1u);
  EXPECT_EQ(network.node(1).fates.front().fate, Fate::kFailed) << "3 does not hear 1";
  EXPECT_EQ(network.sent.size(), 2u) << "one frame for each message, and no other";
}

TEST(OneHop, TellsTheFateFromTheVerdictOfTheLink) {
  Network network(2, kDirect);
  connect_chain(network);
  network.send(1, 2);
  network.send(1, kNeighbours.value);
  network.run(1s);
  network.refusal = [](AgentId) { return Verdict::kQueueFull; };
  network.send(1, 2);
  network.run(1s);
  network.refusal = [](AgentId) { return Verdict::kRadioOff; };
  network.send(1, 2);
  network.run(1s);
  std::vector<Fate> fates;
  for (const FateRecord& record : network.node(1).fates) fates.push_back(record.fate);
  EXPECT_EQ(fates,
            (std::vector{Fate::kHandedOver, Fate::kHandedOver, Fate::kQueueFull, Fate::kFailed}));
  EXPECT_EQ(network.node(2).messages.size(), 2u);
  ASSERT_EQ(network.ends.size(), 4u) << "each message ends once";
  EXPECT_EQ(network.ends.back().verdict, Verdict::kRadioOff);
}

TEST(OneHop, KnowsNoRoutesAndWhomItHeard) {
  Network network(2, kDirect);
  connect_chain(network);
  network.send(1, 2);
  network.run(1s);
  EXPECT_TRUE(network.node(1).router->routes().empty());
  EXPECT_TRUE(network.node(1).router->routes("help", id(2)).empty());
  network.node(1).router->invalidate("help", id(2));
  ASSERT_EQ(network.node(2).router->neighbours().size(), 1u);
  EXPECT_EQ(network.node(2).router->neighbours().front().id, id(1));
}

TEST(OneHop, OverALinkThatTellsNothingIsHandedOverWhenTheLinkHasIt) {
  Network network(2, kDirect, 1, Network::kNothing);
  connect_chain(network);
  network.send(1, 2);
  network.run(1min);
  ASSERT_EQ(network.node(1).fates.size(), 1u);
  EXPECT_EQ(network.node(1).fates.front().fate, Fate::kHandedOver);
  EXPECT_EQ(network.sent.size(), 1u) << "no hellos, no acknowledgements";
}

TEST(OneHop, AndAntRoutingDoNotUnderstandEachOther) {
  Network ants(2), direct(2, kDirect);
  ants.node(1).router->on_frame({.from = id(2)}, encode_one_hop(message(id(1))));
  EXPECT_EQ(ants.node(1).router->malformed_frames(), 1u);
  const Data data{.header = {"help", id(2), id(1), 1}, .id = 1, .transmissions = 1, .payload = {}};
  direct.node(1).router->on_frame({.from = id(2)}, encode(Packet{data}));
  EXPECT_EQ(direct.node(1).router->malformed_frames(), 1u);
  EXPECT_TRUE(ants.node(1).messages.empty() && direct.node(1).messages.empty());
}

}  // namespace
}  // namespace hal::node::routing::test
