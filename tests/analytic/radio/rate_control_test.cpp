#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/unit/sim/radio/air.h"

/// What rate control achieves beside the best fixed rate: one sender that always has something to
/// send, one receiver, log-distance with the exponent 3.
namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kMsdu = 1000;  // bytes

struct Setting {
  std::string name;
  Profile profile = Profile::kIeee80211g;
  double distance = 5;  ///< m
  double loss = 0;      ///< `loss` of every link.
  bool is_mixed = false;
};

RadioConfig config_of(const Setting& setting) {
  RadioConfig config = profile_defaults(setting.profile);
  WavesConfig& waves = *waves_of(config);
  waves.propagation.chain = {LogDistanceConfig{}};
  // Every rate down to where it drowns in noise, and not only to -82 dBm.
  waves.receiver.sensitivity = waves.receiver.cca_threshold = hal::Dbm{-101};
  waves.receiver.min_sinr = hal::Decibels{-10};
  waves.receiver.loss.probability = setting.loss;
  return config;
}

/// Station 1 sends to station 2. @param velocity  of station 2, m/s, away from station 1.
std::unique_ptr<Air> saturated(const Setting& setting, const RadioConfig& config,
                               double velocity = 0) {
  auto air = std::make_unique<Air>(config);
  air->add({0, 0, 0});
  air->add({setting.distance, 0, 0}, {velocity, 0, 0});
  if (setting.is_mixed) {
    air->add({0, 2, 0});
    air->station_config(3).standard = Standard::kIeee80211b;
  }
  air->build();
  air->inbox(1).refill = [one = air.get()] { one->send(1, 2, kMsdu); };
  air->send(1, 2, kMsdu);
  air->send(1, 2, kMsdu);
  return air;
}

/// Mb/s of each second.
std::vector<double> by_second(const std::vector<Inbox::Received>& received, hal::Duration time) {
  std::vector<double> mbps(static_cast<std::size_t>(time / 1s));
  for (const auto& one : received) {
    const auto second = static_cast<std::size_t>(one.at.time_since_epoch() / 1s);
    if (second < mbps.size()) mbps[second] += kMsdu * 8e-6;
  }
  return mbps;
}

/// With each fixed rate of the profile.
std::vector<std::vector<double>> fixed_rates(const Setting& setting, double velocity,
                                             hal::Duration time) {
  std::vector<std::vector<double>> all;
  for (const double rate : {1e6, 2e6, 5.5e6, 6e6, 9e6, 11e6, 12e6, 18e6, 24e6, 36e6, 48e6, 54e6}) {
    RadioConfig config = config_of(setting);
    if (!is_rate(*rates_of(config), hal::BitsPerSecond{rate})) continue;
    waves_of(config)->phy.data_rate = hal::BitsPerSecond{rate};
    const auto air = saturated(setting, config, velocity);
    air->run(time);
    all.push_back(by_second(air->inbox(2).received, time));
  }
  return all;
}

std::vector<double> automatic(const Setting& setting, RateControlKind kind, double velocity,
                              hal::Duration time) {
  RadioConfig config = config_of(setting);
  dcf_of(config)->rate_control.kind = kind;
  const auto air = saturated(setting, config, velocity);
  air->run(time);
  return by_second(air->inbox(2).received, time);
}

class RateControlGoodput : public testing::TestWithParam<Setting> {};

// From the third second on. AARF probes a rate that fails once in 50 frames at its best, and knows
// no middle way where two rates fail sometimes; minstrel looks around in a tenth of its frames, and
// compares rates by the time on the air alone: where faster ones fail every second time, as at 80
// m, it takes them too often. ns-3's does so, too: 3.5 Mb/s there, where 6 Mb/s gives 4.8.
TEST_P(RateControlGoodput, IsNearThatOfTheBestFixedRate) {
  constexpr std::size_t kFrom = 2, kTo = 5;
  const auto mean = [](const std::vector<double>& mbps) {
    double sum = 0;
    for (std::size_t i = kFrom; i < kTo; ++i) sum += mbps[i] / (kTo - kFrom);
    return sum;
  };
  double best = 0;
  for (const auto& one : fixed_rates(GetParam(), 0, 5s)) best = std::max(best, mean(one));
  ASSERT_GT(best, 0.3);
  const double aarf = mean(automatic(GetParam(), RateControlKind::kAarf, 0, 5s));
  const double minstrel = mean(automatic(GetParam(), RateControlKind::kMinstrel, 0, 5s));
  EXPECT_GE(aarf, 0.88 * best);
  EXPECT_GE(minstrel, (GetParam().distance == 80 ? 0.72 : 0.86) * best);
}

INSTANTIATE_TEST_SUITE_P(
    StaticLinks, RateControlGoodput,
    testing::Values(
        Setting{"b_near", Profile::kIeee80211b, 10}, Setting{"b_middle", Profile::kIeee80211b, 90},
        Setting{"b_far", Profile::kIeee80211b, 150}, Setting{"g_near", Profile::kIeee80211g, 5},
        Setting{"g_middle", Profile::kIeee80211g, 30},
        Setting{"g_between", Profile::kIeee80211g, 45}, Setting{"g_far", Profile::kIeee80211g, 80},
        Setting{"g_farthest", Profile::kIeee80211g, 140},
        Setting{"mixed_near", Profile::kIeee80211g, 5, 0, true},
        Setting{"mixed_far", Profile::kIeee80211g, 80, 0, true},
        Setting{"b_near_with_loss", Profile::kIeee80211b, 10, 0.05},
        Setting{"g_middle_with_loss", Profile::kIeee80211g, 30, 0.05}),
    [](const auto& c) { return c.param.name; });

class RateControlOfADrive : public testing::TestWithParam<RateControlKind> {};

// From 5 m to 105 m in 20 s. Second by second the best fixed rate is another one; what rate control
// achieves over the whole drive is compared with the sum of those.
TEST_P(RateControlOfADrive, FollowsAStationThatMovesAway) {
  const Setting setting{"drive", Profile::kIeee80211g, 5};
  const auto fixed = fixed_rates(setting, 5, 20s);
  const auto followed = automatic(setting, GetParam(), 5, 20s);
  double best = 0, sum = 0;
  for (std::size_t second = 0; second < followed.size(); ++second) {
    double most = 0;
    for (const auto& one : fixed) most = std::max(most, one[second]);
    best += most;
    sum += followed[second];
    EXPECT_GT(followed[second], 0.4 * most) << "second " << second;
  }
  EXPECT_GE(sum, (GetParam() == RateControlKind::kMinstrel ? 0.85 : 0.9) * best);
}

TEST_P(RateControlOfADrive, IsTheSameInEachRun) {
  const Setting setting{"drive", Profile::kIeee80211g, 40, 0.1};
  EXPECT_EQ(automatic(setting, GetParam(), 5, 3s), automatic(setting, GetParam(), 5, 3s));
}

INSTANTIATE_TEST_SUITE_P(Automatic, RateControlOfADrive,
                         testing::Values(RateControlKind::kAarf, RateControlKind::kMinstrel));

}  // namespace
}  // namespace sim::radio::test
