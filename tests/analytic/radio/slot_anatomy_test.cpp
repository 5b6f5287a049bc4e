#include <gtest/gtest.h>

#include <cmath>

#include "tests/analytic/radio/peer.h"
#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

struct Overlaps {
  double attempts = 0;
  double overlapping = 0;
  double share() const { return overlapping / attempts; }
};

/// Two saturated senders at d and 2 d on one side of their receiver, 802.11b at 11 Mb/s, 1500
/// bytes: how many DATA begin within a slot of one of the other sender's.
Overlaps overlaps_at(double distance) {
  Air air(Profile::kIeee80211b);
  air.add_line(3, distance);
  air.build();
  for (const std::uint16_t s : {std::uint16_t{2}, std::uint16_t{3}}) {
    air.inbox(s).refill = [&air, s] { air.send(s, 1, 1500); };
    air.send(s, 1, 1500);
    air.send(s, 1, 1500);
  }
  air.run(8s);
  Overlaps result;
  hal::Time last{};
  hal::AgentId last_sender{};
  for (const Log::Start& start : air.log.starts) {
    if (start.frame.type != FrameType::kData) continue;
    result.attempts += 1;
    const bool overlaps = start.at - last < 20us && start.frame.transmitter != last_sender;
    if (overlaps && result.attempts > 2) result.overlapping += 2;
    last = start.at;
    last_sender = start.frame.transmitter;
  }
  return result;
}

/// ns-3's mean of all distances.
double share_of_the_peer() {
  double attempts = 0, overlapping = 0;
  for (const PeerRow& row : read_peer("line_ns3.csv")) {
    const double started = std::stod(row.at("started"));
    attempts += started;
    overlapping += started * std::stod(row.at("overlap"));
  }
  return overlapping / attempts;
}

// IEEE Std 802.11-2016, 10.3.7: what begins in a slot cannot be sensed at its boundary, however
// near the other station is. Four standard deviations of a binomial about the share of all.
TEST(SlotAnatomy, TwoStationsOnALineOverlapEquallyOftenAtAllDistances) {
  std::vector<Overlaps> measured;
  Overlaps all;
  for (int i = 1; i <= 20; ++i) {
    measured.push_back(overlaps_at(5.0 * i));
    all.attempts += measured.back().attempts;
    all.overlapping += measured.back().overlapping;
  }
  EXPECT_NEAR(all.share(), share_of_the_peer(), 0.006);
  for (int i = 1; i <= 20; ++i) {
    const Overlaps& one = measured[static_cast<std::size_t>(i) - 1];
    // Overlaps come in pairs.
    const double deviation = std::sqrt(2 * all.share() * (1 - all.share()) / one.attempts);
    EXPECT_NEAR(one.share(), all.share(), 4 * deviation) << 5 * i << " m";
    RecordProperty("share_" + std::to_string(5 * i), std::to_string(one.share()));
  }
}

}  // namespace
}  // namespace sim::radio::test
