#include "sim/radio/rate/rate_control.h"
#include "sim/radio/station_profile.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "sim/radio/rate/aarf.h"
#include "sim/radio/rate/minstrel.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

constexpr hal::AgentId kPeer{2}, kOther{3}, kOld{4};

/// The ladder of a station of 802.11g up to 54 Mb/s; kOld knows DSSS only.
class RateControlTest : public testing::Test {
 protected:
  RateControlTest() : config_(Ieee80211gConfig{}), modes_(config_) {
    cell_.add(kPeer, capabilities_of(Ieee80211gConfig{}));
    cell_.add(kOld, capabilities_of(Ieee80211bConfig{}));
    ladders_.emplace(make_ladder(std::get<Ieee80211gConfig>(config_), modes_), cell_);
  }
  double mbps(RateControl& control, hal::AgentId to = kPeer, std::uint32_t attempt = 0) {
    return control.mode(to, attempt, now).rate().value / 1e6;
  }
  void tell(RateControl& control, bool is_success, int times = 1, hal::AgentId to = kPeer) {
    for (int i = 0; i < times; ++i) {
      mbps(control, to);
      control.on_result(to, is_success);
    }
  }

  RateControlConfig rates;
  hal::Time now{};
  RadioConfig config_;
  ModeSet modes_;
  Cell cell_;
  std::optional<RateLadders> ladders_;
};

TEST_F(RateControlTest, FixedIsTheHighestThatTheOtherKnows) {
  FixedRate fixed(*ladders_);
  EXPECT_EQ(mbps(fixed), 54);
  EXPECT_EQ(mbps(fixed, kOld), 11);
  tell(fixed, false, 10);
  EXPECT_EQ(mbps(fixed), 54);
}

// Ladder: 1, 2, 5.5, 6, 9, 11, 12, 18, 24, 36, 48, 54 Mb/s.
TEST_F(RateControlTest, AarfClimbsAfterTenSuccessesInARow) {
  Aarf aarf(rates, *ladders_);
  EXPECT_EQ(mbps(aarf), 1);
  tell(aarf, true, 9);
  EXPECT_EQ(mbps(aarf), 1);
  tell(aarf, true);
  EXPECT_EQ(mbps(aarf), 2);
  tell(aarf, true, 10 * 10);
  EXPECT_EQ(mbps(aarf), 54);
  tell(aarf, true, 100);
  EXPECT_EQ(mbps(aarf), 54) << "there is none above";
}

TEST_F(RateControlTest, AarfDoublesItsThresholdWhenAProbeFails) {
  Aarf aarf(rates, *ladders_);
  for (const int threshold : {10, 20, 40, 50, 50}) {
    tell(aarf, true, threshold - 1);
    EXPECT_EQ(mbps(aarf), 1) << threshold;
    tell(aarf, true);
    EXPECT_EQ(mbps(aarf), 2) << threshold;
    tell(aarf, false);
    EXPECT_EQ(mbps(aarf), 1) << "back at once";
  }
}

TEST_F(RateControlTest, AarfFallsAfterTwoFailuresInARowAndForgetsItsThreshold) {
  Aarf aarf(rates, *ladders_);
  tell(aarf, true, 10);
  tell(aarf, false);     // threshold 20 at 1 Mb/s
  tell(aarf, true, 20);  // 2 Mb/s
  tell(aarf, true);      // the probe succeeds
  tell(aarf, false);
  EXPECT_EQ(mbps(aarf), 2) << "one failure is none";
  tell(aarf, true);
  tell(aarf, false);
  EXPECT_EQ(mbps(aarf), 2) << "not in a row";
  tell(aarf, false);
  EXPECT_EQ(mbps(aarf), 1);
  tell(aarf, true, 10);
  EXPECT_EQ(mbps(aarf), 2) << "the threshold is 10 again";
  tell(aarf, false, 5);
  EXPECT_EQ(mbps(aarf), 1) << "there is none below";
}

// Every fifth transmission fails: never ten in a row. After 15 transmissions it climbs anyway.
TEST_F(RateControlTest, AarfClimbsAfterItsTimeout) {
  Aarf aarf(rates, *ladders_);
  for (int i = 0; i < 14; ++i) tell(aarf, i % 5 != 4);
  EXPECT_EQ(mbps(aarf), 1);
  tell(aarf, true);
  EXPECT_EQ(mbps(aarf), 2);
}

TEST_F(RateControlTest, AarfKnowsEachDestinationByItself) {
  Aarf aarf(rates, *ladders_);
  tell(aarf, true, 110);
  EXPECT_EQ(mbps(aarf, kPeer), 54);
  EXPECT_EQ(mbps(aarf, kOther), 1);
  tell(aarf, true, 110, kOld);
  EXPECT_EQ(mbps(aarf, kOld), 11);
}

TEST_F(RateControlTest, AarfTakesItsConstantsFromTheConfig) {
  rates = {.aarf_threshold = 3, .aarf_max_threshold = 4, .aarf_timeout = 1000};
  Aarf aarf(rates, *ladders_);
  for (const int threshold : {3, 4, 4}) {
    tell(aarf, true, threshold - 1);
    EXPECT_EQ(mbps(aarf), 1);
    tell(aarf, true);
    EXPECT_EQ(mbps(aarf), 2);
    tell(aarf, false);
  }
}

/// Frames one after the other, 1 ms each, over a link on which each rate succeeds with a
/// probability. @return at which rate (Mb/s) how many first attempts went out.
std::map<double, int> play(RateControl& control, const std::function<double(double)>& success,
                           int frames, hal::Time& now) {
  hal::RandomStream random(1, "link");
  std::map<double, int> firsts;
  for (int i = 0; i < frames; ++i) {
    for (std::uint32_t attempt = 0; attempt < 7; ++attempt) {
      const double rate = control.mode(kPeer, attempt, now).rate().value / 1e6;
      if (attempt == 0) ++firsts[rate];
      now += 1ms;
      const bool is_success = random.uniform() < success(rate);
      control.on_result(kPeer, is_success);
      if (is_success) break;
    }
  }
  return firsts;
}

TEST_F(RateControlTest, MinstrelFindsTheRateWithTheMostFramesInTime) {
  struct Case {
    std::function<double(double)> success;
    double best;
  };
  const std::vector<Case> cases{
      {[](double) { return 1.0; }, 54},
      {[](double rate) { return rate <= 24 ? 1.0 : 0.0; }, 24},
      // 36 Mb/s at 0.9 gives more than 24 Mb/s at 1, 48 Mb/s at 0.5 less than either.
      {[](double rate) { return rate < 36   ? 1.0
                                : rate < 48 ? 0.9
                                : rate < 54 ? 0.5
                                            : 0.0; }, 36},
      {[](double rate) { return rate <= 1 ? 1.0 : 0.0; }, 1}};
  for (const Case& c : cases) {
    Minstrel minstrel(rates, *ladders_, hal::RandomStream(1, "rates"));
    play(minstrel, c.success, 5000, now);
    const auto firsts = play(minstrel, c.success, 5000, now);
    // A tenth of the frames sample another rate; slow ones only in their second attempt.
    EXPECT_GT(firsts.at(c.best), 4400) << c.best << " Mb/s";
  }
}

// 1200 octets of payload, 1236 with the MAC's, and by hand: at 54 Mb/s 210 us and an ACK at 24 Mb/s
// after SIFS 44 us: 254 us each, with mean backoffs of 150, 310, 630, 1270 us (slot 20 us, CW 15):
// five tries take 3630 us, six 6434 us. At 1 Mb/s one takes 10 ms.
TEST_F(RateControlTest, LadderTellsHowManyTriesFitInto6Ms) {
  const Ladder& ladder = ladders_->to(kPeer);
  EXPECT_EQ(ladder.front().airtime, 192us + 9888us);
  EXPECT_EQ(ladder.front().tries, 1u);
  EXPECT_EQ(ladder.back().airtime, 210us);
  EXPECT_EQ(ladder.back().tries, 5u);
}

// 54 Mb/s at 0.73 gives 0.73 / 210 us of frames on the air, 36 Mb/s 1 / 302 us. With DIFS, SIFS and
// ACK, which the algorithm leaves out, 36 Mb/s would be better.
TEST_F(RateControlTest, MinstrelComparesTimesOnTheAir) {
  Minstrel minstrel(rates, *ladders_, hal::RandomStream(1, "rates"));
  const auto success = [](double rate) { return rate <= 36 ? 1.0 : rate == 54 ? 0.73 : 0.0; };
  play(minstrel, success, 5000, now);
  const auto firsts = play(minstrel, success, 5000, now);
  EXPECT_GT(firsts.at(54), 4000);
}

// A rate that sometimes fails is tried until 6 ms are over, one that nearly never does twice.
TEST_F(RateControlTest, MinstrelTriesDoubtfulRatesMoreOften) {
  const auto best_of_7 = [this](double success_of_54) {
    Minstrel minstrel(rates, *ladders_, hal::RandomStream(1, "rates"));
    const auto success = [success_of_54](double rate) {
      return rate == 54 ? success_of_54 : rate == 1 ? 1.0 : 0.0;
    };
    play(minstrel, success, 5000, now);
    int tries = 0;
    // The first frame that does not look around.
    while (mbps(minstrel) != 54 || mbps(minstrel, kPeer, 1) != 54) tell(minstrel, true);
    for (std::uint32_t attempt = 0; attempt < 7; ++attempt) {
      tries += mbps(minstrel, kPeer, attempt) == 54 ? 1 : 0;
    }
    return tries;
  };
  EXPECT_EQ(best_of_7(0.7), 5);
  // It is the most reliable one, too: two tries in the first stage, two in the third.
  EXPECT_EQ(best_of_7(1), 4);
}

// Slower rates are looked at when the best one has failed; after 20 intervals of 100 ms, first.
TEST_F(RateControlTest, MinstrelLooksAtSlowRatesOnceIn20Intervals) {
  Minstrel minstrel(rates, *ladders_, hal::RandomStream(1, "rates"));
  const auto success = [](double) { return 1.0; };
  play(minstrel, success, 1000, now);
  const auto before = play(minstrel, success, 1000, now);  // the second second
  EXPECT_FALSE(before.contains(1));
  const auto firsts = play(minstrel, success, 10'000, now);
  for (const double rate : {1.0, 2.0, 5.5, 11.0}) {
    EXPECT_NEAR(firsts.at(rate), 9, 6) << rate << " Mb/s";
  }
}

// Whatever share of the frames looks around: four an interval at a rate that never succeeds.
TEST_F(RateControlTest, MinstrelLooksSeldomAtHopelessRates) {
  rates.minstrel_sampling = 1;
  Minstrel minstrel(rates, *ladders_, hal::RandomStream(1, "rates"));
  const auto success = [](double rate) { return rate <= 36 ? 1.0 : 0.0; };
  play(minstrel, success, 1000, now);
  const hal::Time start = now;
  const auto firsts = play(minstrel, success, 5000, now);
  const auto intervals = (now - start) / 100ms;
  for (const double rate : {48.0, 54.0}) {
    EXPECT_NEAR(firsts.at(rate), 4.0 * static_cast<double>(intervals),
                0.2 * static_cast<double>(intervals))
        << rate << " Mb/s";
  }
}

TEST_F(RateControlTest, MinstrelFollowsALinkThatBecomesWorseAndBetter) {
  Minstrel minstrel(rates, *ladders_, hal::RandomStream(1, "rates"));
  const auto up_to = [](double most) {
    return [most](double rate) { return rate <= most ? 1.0 : 0.0; };
  };
  for (const double most : {54.0, 12.0, 36.0}) {
    play(minstrel, up_to(most), 3000, now);
    const auto firsts = play(minstrel, up_to(most), 1000, now);
    EXPECT_GT(firsts.at(most), 850) << most << " Mb/s";
  }
}

TEST_F(RateControlTest, MinstrelEndsAFrameAtTheLowestRate) {
  Minstrel minstrel(rates, *ladders_, hal::RandomStream(1, "rates"));
  play(
      minstrel, [](double) { return 1.0; }, 3000, now);
  EXPECT_EQ(mbps(minstrel, kPeer, 6), 1);
}

TEST_F(RateControlTest, MinstrelSamplesAsOftenAsItIsTold) {
  rates.minstrel_sampling = 0;
  Minstrel never(rates, *ladders_, hal::RandomStream(1, "rates"));
  auto firsts = play(
      never, [](double) { return 1.0; }, 1000, now);
  EXPECT_EQ(firsts, (std::map<double, int>{{1.0, 1000}})) << "it never learns of others";
  rates.minstrel_sampling = 1;
  Minstrel always(rates, *ladders_, hal::RandomStream(1, "rates"));
  firsts = play(
      always, [](double) { return 1.0; }, 1000, now);
  EXPECT_GT(firsts.size(), 6u) << "until it knows the fastest one";
}

// With no weight of the past the last interval alone counts: one bad interval, and it leaves.
TEST_F(RateControlTest, MinstrelRemembersAsLongAsItIsTold) {
  const auto leaves_after = [this](double past) {
    rates.minstrel_past = past;
    rates.minstrel_interval = 10ms;
    Minstrel minstrel(rates, *ladders_, hal::RandomStream(1, "rates"));
    play(
        minstrel, [](double) { return 1.0; }, 3000, now);
    const auto fails = [](double rate) { return rate < 54 ? 1.0 : 0.0; };
    int frames = 0;
    while (play(minstrel, fails, 1, now).contains(54) && frames < 1000) ++frames;
    return frames;
  };
  EXPECT_LT(2 * leaves_after(0), leaves_after(0.98));
}

TEST_F(RateControlTest, IsTheOneThatTheConfigNames) {
  rates.kind = RateControlKind::kAarf;
  EXPECT_NE(
      dynamic_cast<Aarf*>(make_rate_control(rates, *ladders_, hal::RandomStream(1, "r")).get()),
      nullptr);
  rates.kind = RateControlKind::kMinstrel;
  EXPECT_NE(
      dynamic_cast<Minstrel*>(make_rate_control(rates, *ladders_, hal::RandomStream(1, "r")).get()),
      nullptr);
}

}  // namespace
}  // namespace sim::radio::test
