#include <gtest/gtest.h>

#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kPayload = 1000;  // bytes

/// Cuts off everything that crosses x = 0 from one side to the other. The receiver stands on it.
class Screen final : public Obstacles {
 public:
  hal::Decibels loss(const hal::Vec3& from, const hal::Vec3& to) const override {
    return hal::Decibels{from.x * to.x < 0 ? 200.0 : 0.0};
  }
};

struct HiddenCase {
  double rate;  ///< bit/s
  bool hidden;
  bool rts;
};

/// Goodput of two saturated senders, both at -58.98 dBm at the receiver between them [Mb/s].
double goodput(const HiddenCase& c) {
  RadioConfig config = profile_defaults(Profile::kIeee80211b);
  waves_of(config)->phy.data_rate = hal::BitsPerSecond{c.rate};
  waves_of(config)->contention.rts_threshold = c.rts ? 0 : 2347;
  waves_of(config)->propagation.obstacles = c.hidden;
  EventQueue events;
  PlacedAntennas antennas;
  std::vector<RadioNetwork::Station> stations;
  for (const double x : {-55.6, 0.0, 55.6}) {
    const hal::AgentId agent{static_cast<std::uint16_t>(stations.size() + 1)};
    antennas.place(agent, {{x, 0, 0}});
    stations.push_back({agent, "s" + std::to_string(agent.value)});
  }
  const Screen screen;
  Log log;
  RadioNetwork network(config, stations, {events, antennas, screen, log, 1});
  std::vector<Inbox> inboxes(3, Inbox(events));
  for (std::size_t i = 0; i < 3; ++i) {
    MacSap& sap = network.sap(stations[i].agent);
    sap.add_client(kEthertypeRouting, inboxes[i]);
    if (i == 1) continue;
    inboxes[i].refill = [&sap] {
      sap.transmit({.destination = hal::AgentId{2},
                    .payload = std::make_shared<const hal::Bytes>(kPayload)});
    };
    inboxes[i].refill();
    inboxes[i].refill();
  }
  constexpr hal::Duration kTime = 4s;
  while (*events.next_time() < hal::Time{} + kTime) events.run_next();
  return static_cast<double>(inboxes[1].received.size()) * kPayload * 8e-6 / hal::to_seconds(kTime);
}

// Figures of ns-3.37 (hidden_ns3.csv, mean of three seeds), Mb/s. Hidden pairs live from rare
// lucky gaps and spread by some 5 % from seed to seed at both simulators: tolerance 12 %. Pairs
// that hear each other: 2 %.
TEST(HiddenTerminals, HalveTheThroughputAt11MbPerSecond) {
  const double open = goodput({11e6, false, false});
  const double hidden = goodput({11e6, true, false});
  EXPECT_NEAR(open, 5.262, 0.02 * 5.262);
  EXPECT_NEAR(hidden, 3.47, 0.12 * 3.47);
}

TEST(HiddenTerminals, AreNotHelpedByRtsAt11MbPerSecond) {
  const double open = goodput({11e6, false, true});
  const double hidden = goodput({11e6, true, true});
  EXPECT_NEAR(open, 3.667, 0.02 * 3.667);
  EXPECT_NEAR(hidden, 3.28, 0.12 * 3.28);
}

TEST(HiddenTerminals, AreRescuedByRtsAt2MbPerSecond) {
  const double without = goodput({2e6, true, false});
  const double with = goodput({2e6, true, true});
  EXPECT_NEAR(without, 0.612, 0.12 * 0.612);
  EXPECT_NEAR(with, 1.374, 0.05 * 1.374);
}

}  // namespace
}  // namespace sim::radio::test
