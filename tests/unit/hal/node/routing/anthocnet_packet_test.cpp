#include "hal/node/routing/anthocnet_packet.h"

#include <gtest/gtest.h>

#include "hal/types/random.h"
#include "tests/unit/hal/node/routing/test_network.h"

namespace hal::node::routing::anthocnet::test {
namespace {

using routing::test::id;
using namespace std::chrono_literals;

const PathStatistics kTwoHops{.hops = 2, .delay = 5ms, .min_snr_db = 12.5, .energy = 0.25};

std::vector<ControlPacket> examples() {
  const Header asked{"help", routing::test::id(1), routing::test::id(9), 77};
  const Header answer{"help", routing::test::id(9), routing::test::id(1), 77};
  return {
      ForwardAnt{asked,
                 AntKind::kRepair,
                 2,
                 kTwoHops,
                 {routing::test::id(1), routing::test::id(2), routing::test::id(3)}},
      BackwardAnt{
          answer,
          AntKind::kReactive,
          1,
          kTwoHops,
          {routing::test::id(1), routing::test::id(2), routing::test::id(3), routing::test::id(4)}},
      PheromoneHello{1500ms,
                     {{{"help", routing::test::id(9)}, routing::test::id(4), true, 0, 12.5},
                      {{"a", routing::test::id(3)}, routing::test::id(3), false, 1, 3}}},
      PheromoneHello{1s, {}},
      LossNotice{{{{"help", routing::test::id(9)}, 3, routing::test::id(4), 6ms},
                  {{"a", routing::test::id(3)}, 0, routing::test::id(0), 0ms}}},
      Warning{{"help", routing::test::id(9)}},
  };
}

TEST(AntHocNetPacket, ComesBackAsItWentIn) {
  for (const ControlPacket& packet : examples()) {
    const auto parsed = parse_control(encode_control(packet));
    ASSERT_TRUE(parsed.has_value()) << packet.index();
    EXPECT_EQ(*parsed, packet) << packet.index();
  }
}

TEST(AntHocNetPacket, IsRefusedIfAnOctetIsMissingOrTooMany) {
  for (const ControlPacket& packet : examples()) {
    const Bytes whole = encode_control(packet);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      EXPECT_FALSE(parse_control(std::span(whole).first(size))) << packet.index() << ' ' << size;
    }
    Bytes longer = whole;
    longer.push_back(0);
    EXPECT_FALSE(parse_control(longer)) << packet.index();
  }
}

// Whatever is accepted keeps the rules, so that it encodes to the same bytes.
TEST(AntHocNetPacket, OfAnyBytesIsRefusedOrKeepsTheRules) {
  RandomStream random(1, "fuzz");
  int accepted = 0;
  for (int round = 0; round < 20000; ++round) {
    const auto all = examples();
    Bytes bytes = encode_control(all[random.below(static_cast<std::uint32_t>(all.size()))]);
    const std::uint32_t changes = 1 + random.below(4);
    for (std::uint32_t i = 0; i < changes; ++i) {
      bytes[random.below(static_cast<std::uint32_t>(bytes.size()))] =
          static_cast<std::uint8_t>(random.below(256));
    }
    if (random.below(4) == 0) bytes.resize(random.below(80));
    const auto parsed = parse_control(bytes);
    if (!parsed) continue;
    ++accepted;
    EXPECT_EQ(encode_control(*parsed), bytes);
  }
  EXPECT_GT(accepted, 1000);
  for (int round = 0; round < 20000; ++round) {
    Bytes bytes(random.below(60));
    for (std::uint8_t& octet : bytes) octet = static_cast<std::uint8_t>(random.below(256));
    (void)parse_control(bytes);
  }
}

TEST(AntHocNetPacket, OfAnAntIsRefusedIfPathAndHopsContradict) {
  const Header asked{"help", routing::test::id(1), routing::test::id(9), 77};
  const auto refuses = [](const ControlPacket& packet) {
    return !parse_control(encode_control(packet)).has_value();
  };
  const std::vector<AgentId> path{routing::test::id(1), routing::test::id(2), routing::test::id(3)};
  EXPECT_TRUE(refuses(ForwardAnt{
      asked, AntKind::kReactive, 1, kTwoHops, {hal::node::routing::test::id(1), id(2)}}));
  EXPECT_TRUE(refuses(ForwardAnt{
      asked, AntKind::kReactive, 1, kTwoHops, {hal::node::routing::test::id(2), id(1), id(3)}}));
  EXPECT_TRUE(refuses(ForwardAnt{
      asked, AntKind::kReactive, 1, kTwoHops, {hal::node::routing::test::id(1), id(2), id(9)}}));
  EXPECT_TRUE(refuses(ForwardAnt{
      asked, AntKind::kReactive, 1, kTwoHops, {hal::node::routing::test::id(1), id(2), id(2)}}));
  EXPECT_FALSE(refuses(ForwardAnt{asked, AntKind::kReactive, 1, kTwoHops, path}));
  const Header answer{"help", routing::test::id(9), routing::test::id(1), 77};
  EXPECT_TRUE(refuses(BackwardAnt{answer, AntKind::kReactive, 1, kTwoHops, path}));
  EXPECT_FALSE(refuses(BackwardAnt{answer, AntKind::kReactive, 0, kTwoHops, path}));
}

TEST(AntHocNetPacket, OfPheromoneThatIsNoneIsRefused) {
  for (const double pheromone : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                                 std::numeric_limits<double>::infinity()}) {
    const PheromoneHello hello{
        1s, {{{"help", routing::test::id(9)}, routing::test::id(4), true, 0, pheromone}}};
    EXPECT_FALSE(parse_control(encode_control(hello))) << pheromone;
  }
}

}  // namespace
}  // namespace hal::node::routing::anthocnet::test
