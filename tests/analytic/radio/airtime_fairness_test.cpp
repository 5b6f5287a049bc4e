#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "tests/unit/sim/radio/air.h"

// The anomaly of 802.11 (M. Heusse, F. Rousseau, G. Berger-Sabbatel, A. Duda, INFOCOM 2003) at one
// sender, and what airtime fairness makes of it (T. Hoeiland-Joergensen et al., USENIX ATC 2017).
namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kMsdu = 1400;  // bytes
constexpr std::uint16_t kFast = 2, kSlow = 3;
constexpr hal::Duration kLong = 20s;

/// Station 1 sends to a near station at 65 Mb/s and to a far one at 6.5 Mb/s, with whom it always
/// has something to do. Its rate control knows the SINR: 802.11n, MCS 7 and MCS 0.
class Anomaly : public testing::Test {
 protected:
  Anomaly() : air(Profile::kIeee80211n) {
    ht().rate_control.kind = RateControlKind::kIdeal;
    ht().receiver.sensitivity = hal::Dbm{-95};
    ht().propagation.interference_floor = hal::Dbm{-95};
    ht().propagation.propagation_delay = false;
    ht().queues.per = QueuePer::kStation;
    ht().contention.queue_limit = 200;
  }
  HtConfig& ht() { return *ht_of(air.config); }

  void run() {
    air.add({0, 0, 0});
    air.add({5, 0, 0});
    air.add({far, 0, 0});
    air.build();
    for (const std::uint16_t receiver : {kFast, kSlow}) {
      for (std::uint64_t i = 0; i < 200; ++i) air.send(1, receiver, kMsdu, receiver);
    }
    air.inbox(1).refill = [this] {
      air.send(1, static_cast<std::uint16_t>(air.inbox(1).ended.back().tag), kMsdu,
               air.inbox(1).ended.back().tag);
    };
    air.run(kWarmUp);
    air.log.starts.clear();
    for (std::uint16_t one = 1; one <= 3; ++one) air.inbox(one).received.clear();
    air.run(kWarmUp + kLong);
  }

  double mbps(std::uint16_t receiver) {
    return static_cast<double>(air.inbox(receiver).received.size()) * 8e-6 * kMsdu /
           hal::to_seconds(kLong);
  }
  /// Airtime of the data frames to a receiver.
  double airtime(std::uint16_t receiver) {
    hal::Duration sum{};
    for (const Log::Start& start : air.log.starts) {
      const bool is_it =
          start.frame.type == FrameType::kData && start.frame.receiver == hal::AgentId{receiver};
      if (is_it) sum += start.frame.airtime;
    }
    return hal::to_seconds(sum);
  }
  /// The airtime of each frame of a kind, which all have.
  hal::Duration airtime_of(FrameType type, std::uint16_t receiver) {
    const auto found = std::ranges::find_if(air.log.starts, [&](const Log::Start& start) {
      return start.frame.type == type &&
             (type == FrameType::kData ? start.frame.receiver : start.frame.transmitter) ==
                 hal::AgentId{receiver};
    });
    return found->frame.airtime;
  }
  double rate_to(std::uint16_t receiver) {
    for (const Log::Start& start : air.log.starts) {
      if (start.frame.type == FrameType::kData && start.frame.receiver == hal::AgentId{receiver}) {
        return start.frame.rate.value / 1e6;
      }
    }
    return 0;
  }
  /// s, the mean from one exchange to the next: AIFS of best effort, 7.5 slots of backoff (CWmin
  /// 15), data, SIFS and ACK (IEEE Std 802.11-2020, 10.23.2.4).
  double cycle(std::uint16_t receiver) {
    const hal::Duration aifs = 10us + 3 * 9us;
    return hal::to_seconds(aifs + airtime_of(FrameType::kData, receiver) + 10us +
                           airtime_of(FrameType::kAck, receiver)) +
           7.5 * 9e-6;
  }

  double far = 1450;  // m
  static constexpr hal::Duration kWarmUp = 1s;
  Air air;
};

// In turn, one frame each: both get what the slow one leaves. In 20 s there are 8000 exchanges,
// whose backoffs vary by 41 us each: 0.05 %.
TEST_F(Anomaly, TurnsGiveBothTheThroughputOfTheSlow) {
  ht().aggregation.max_ampdu = 0;
  run();
  EXPECT_EQ(rate_to(kFast), 65);
  EXPECT_EQ(rate_to(kSlow), 6.5);
  const double expected = 8e-6 * kMsdu / (cycle(kFast) + cycle(kSlow));
  EXPECT_NEAR(mbps(kFast), expected, 0.003 * expected);
  EXPECT_NEAR(mbps(kSlow), expected, 0.003 * expected);
  RecordProperty("mbps", std::to_string(mbps(kSlow)));
}

// Equal airtime of data: a frames to the fast and b to the slow, a D_fast = b D_slow, in a C_fast +
// b C_slow with the overheads.
TEST_F(Anomaly, AirtimeFairnessSharesTheTimeOnTheAir) {
  ht().aggregation.max_ampdu = 0;
  ht().queues.airtime_fairness = true;
  run();
  EXPECT_NEAR(airtime(kFast) / airtime(kSlow), 1, 0.003);
  const auto per_frame = [this](std::uint16_t one) {
    return hal::to_seconds(airtime_of(FrameType::kData, one));
  };
  const double time = cycle(kFast) / per_frame(kFast) + cycle(kSlow) / per_frame(kSlow);
  for (const std::uint16_t one : {kFast, kSlow}) {
    const double expected = 8e-6 * kMsdu / (per_frame(one) * time);
    EXPECT_NEAR(mbps(one), expected, 0.003 * expected);
  }
}

// What a receiver sends counts, too: the far one, here at the same rate as the near one, sends 500
// frames a second.
TEST_F(Anomaly, AirtimeFairnessCountsWhatReceiversSend) {
  ht().aggregation.max_ampdu = 0;
  ht().queues.airtime_fairness = true;
  far = 6;
  for (hal::Duration at{}; at < kWarmUp + kLong; at += 2ms) {
    air.at(at, [this] { air.send(kSlow, 1, kMsdu); });
  }
  run();
  // In a collision only its sender knows of a frame: those that came in count.
  const double came = static_cast<double>(air.inbox(1).received.size()) *
                      hal::to_seconds(airtime_of(FrameType::kData, kFast));
  EXPECT_GT(came, 0.1 * hal::to_seconds(kLong));
  EXPECT_NEAR(airtime(kFast) / (airtime(kSlow) + came), 1, 0.003);
}

// With A-MPDUs the overhead is small: each gets nearly half of what it would have alone, which is
// the paper's model (its equations 1 to 5).
TEST_F(Anomaly, AirtimeFairnessOfAggregatesGivesEachHalfOfWhatItHasAlone) {
  ht().queues.airtime_fairness = true;
  run();
  EXPECT_NEAR(airtime(kFast) / airtime(kSlow), 1, 0.01);
  EXPECT_NEAR(mbps(kFast) / mbps(kSlow), 10, 0.8) << "longer A-MPDUs have less overhead";
  EXPECT_GT(mbps(kFast), 0.9 * 65 / 2);
}

}  // namespace
}  // namespace sim::radio::test
