#include <gtest/gtest.h>

#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

// Replica of the Mobility Framework, section 2, in ns: the two minima are
//   one hop    DIFS 50000 + RTS 206545 + 10000 + CTS 202182 + 10000 + DATA 216727 = 695454
//   broadcast  DIFS 50000 + DATA 216727 = 266727
// and a relayed hop takes SIFS 10000 + ACK 202182 + DIFS 50000 + b * 20000 + RTS … DATA 645454
//   = 907636 + b * 20000, b = 0 … 7.
constexpr hal::Duration kOneHop = 695454ns;
constexpr hal::Duration kBroadcast = 266727ns;
constexpr hal::Duration kRelayedHop = 907636ns;

TEST(Minima, OneHopTakes695454Nanoseconds) {
  Air air(Profile::kMobilityFramework);
  air.add_line(2, 250);
  air.build();
  air.send(1, 2);
  air.run();
  EXPECT_EQ(air.inbox(2).received.at(0).at, hal::Time{} + kOneHop);
}

TEST(Minima, BroadcastTakes266727Nanoseconds) {
  Air air(Profile::kMobilityFramework);
  air.add_line(2, 250);
  air.build();
  air.broadcast(1);
  air.run();
  EXPECT_EQ(air.inbox(2).received.at(0).at, hal::Time{} + kBroadcast);
}

// A forward ant by broadcast, answered at once by a backward ant: 266727 + 695454 ns.
TEST(Minima, DiscoveryTakes962181Nanoseconds) {
  Air air(Profile::kMobilityFramework);
  air.add_line(2, 250);
  air.build();
  air.inbox(2).forward = [&air](const MacIndication& ant) { air.send(2, ant.source.value); };
  air.broadcast(1);
  air.run();
  EXPECT_EQ(air.inbox(1).received.at(0).at, hal::Time{} + 962181ns);
}

class SilentChain : public testing::TestWithParam<int> {};

/// Times at which station 2, 3, … hops+1 of a chain gets a packet that each one relays.
std::vector<hal::Duration> relay(int hops, std::uint64_t seed) {
  Air air(Profile::kMobilityFramework);
  air.seed = seed;
  air.add_line(hops + 1, 250);
  air.build();
  for (std::uint16_t s = 2; s <= hops; ++s) {
    air.inbox(s).forward = [&air, s](const MacIndication&) {
      air.send(s, static_cast<std::uint16_t>(s + 1));
    };
  }
  air.send(1, 2);
  air.run();
  std::vector<hal::Duration> times;
  for (int s = 2; s <= hops + 1; ++s) {
    const auto& received = air.inbox(static_cast<std::uint16_t>(s)).received;
    times.push_back(received.at(0).at.time_since_epoch());
  }
  return times;
}

// The framework ends a station's own ACK one nanosecond late; ten are allowed.
TEST_P(SilentChain, EveryRelayedHopAdds907636NanosecondsAndUpToSevenSlots) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto times = relay(GetParam(), seed);
    EXPECT_EQ(times[0], kOneHop);
    for (std::size_t i = 1; i < times.size(); ++i) {
      const hal::Duration extra = times[i] - times[i - 1] - kRelayedHop;
      EXPECT_GE(extra, 0ns);
      EXPECT_LE(extra % 20us, 10ns) << "hop " << i + 1 << ", seed " << seed;
      EXPECT_LE(extra / 20us, 7) << "hop " << i + 1 << ", seed " << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Hops, SilentChain, testing::Range(1, 9));

}  // namespace
}  // namespace sim::radio::test
