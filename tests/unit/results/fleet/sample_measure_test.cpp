#include "results/fleet/sample_measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "results/fleet/fleet_run.h"

namespace results::fleet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

hal::Time at(milliseconds time) { return hal::Time{time}; }

const Window kWindow{at(seconds{10}), at(seconds{20})};

SamplePair silent_pair() {
  SamplePair pair;
  pair.topic = "rt/r0/scan";
  pair.writer = "r0";
  pair.reader = "base";
  return pair;
}

SampleFate fate(hal::Time entered, hal::Time left) {
  SampleFate one;
  one.entered = entered;
  one.left = left;
  return one;
}

/// A sample every second from 5.5 s on that takes 100 ms; the number that do not arrive is given.
SamplePair every_second(std::vector<int> lost) {
  SamplePair pair = silent_pair();
  for (int i = 0; i < 14; ++i) {
    const hal::Time entered = at(milliseconds{5500 + 1000 * i});
    SampleFate one = fate(entered, entered + milliseconds{100});
    if (std::ranges::find(lost, i) != lost.end()) {
      one.left.reset();
      one.verdict = "queue full";
      one.lost_at = "ap";
    }
    pair.samples.push_back(one);
  }
  return pair;
}

TEST(SampleMeasure, CountsWhatWasSentInTheWindow) {
  const SamplePair pair = every_second({0, 6, 7});  // the first before the window
  const SampleMeasure found = measure({&pair}, kWindow);
  EXPECT_EQ(found.samples, 9U);  // 10.5 s, 11.5 s, … 18.5 s
  EXPECT_EQ(found.delivered, 7U);
  EXPECT_EQ(found.lost, (std::map<std::string, std::uint64_t>{{"queue full at ap", 2}}));
  EXPECT_DOUBLE_EQ(*found.delivered_share(), 7.0 / 9.0);
  ASSERT_EQ(found.latencies.size(), 7U);
  EXPECT_DOUBLE_EQ(found.latencies.front(), 0.1);
  EXPECT_DOUBLE_EQ(found.latencies.back(), 0.1);
  EXPECT_DOUBLE_EQ(*found.discovered, 6.6);
}

TEST(SampleMeasure, WhatIsUnderWayIsLeftOutForASecondOnly) {
  SamplePair pair = every_second({});
  pair.samples.back().left.reset();  // sent at 18.5 s
  const SampleMeasure soon = measure({&pair}, {kWindow.from, at(seconds{19})});
  EXPECT_EQ(soon.samples, 8U);
  EXPECT_EQ(soon.under_way, 1U);
  const SampleMeasure late = measure({&pair}, kWindow);
  EXPECT_EQ(late.samples, 9U);
  EXPECT_EQ(late.under_way, 0U);
  EXPECT_EQ(late.lost, (std::map<std::string, std::uint64_t>{{kUnderWay, 1}}));
}

TEST(SampleMeasure, NothingSentIsNoShareAndNothingDeliveredIsNoLatency) {
  const SamplePair silent = silent_pair();
  const SampleMeasure found = measure({&silent}, kWindow);
  EXPECT_EQ(found.pairs, 1U);
  EXPECT_EQ(found.silent, 1U);
  EXPECT_FALSE(found.delivered_share());
  EXPECT_TRUE(found.latencies.empty());
  EXPECT_FALSE(found.discovered);
  EXPECT_FALSE(measure({}, kWindow).age95);
}

TEST(SampleMeasure, AgeGrowsFromTheLatencyToThatPlusThePeriod) {
  const SamplePair pair = every_second({});
  // It is uniform from 0.1 s to 1.1 s up to 18.6 s, and then grows to 1.5 s; at 10 s it is 0.5 s.
  const auto below = [](double age) {
    const double periods = 8 * (age - 0.1);               // 10.6 s to 18.6 s
    const double first = std::clamp(age - 0.5, 0., 0.6);  // 10 s to 10.6 s
    const double last = age - 0.1;                        // 18.6 s to 20 s
    return (std::min(periods, 8.0) + first + last) / 10;
  };
  EXPECT_NEAR(below(*measure({&pair}, kWindow).age95), 0.95, 1e-5);
}

TEST(SampleMeasure, BeforeTheFirstSampleTheAgeIsTheTimeOfTheRun) {
  const SamplePair silent = silent_pair();
  EXPECT_NEAR(*measure({&silent}, kWindow).age95, 19.5, 1e-5);  // from 10 s to 20 s
}

TEST(SampleMeasure, AnOlderSampleThatArrivesLaterDoesNotMakeTheReaderOlder) {
  SamplePair pair = silent_pair();
  pair.samples = {fate(at(seconds{9}), at(seconds{19})),
                  fate(at(milliseconds{9500}), at(seconds{10}))};
  EXPECT_NEAR(*measure({&pair}, kWindow).age95, 10.0, 1e-5);  // 0.5 s to 10.5 s
}

using Lost = std::map<std::string, std::uint64_t>;

TEST(SampleMeasure, CountsWhatWasWrittenBeforeDiscovery) {
  SamplePair late = silent_pair();
  late.samples = {fate(at(seconds{15}), at(seconds{15}))};
  late.plan = WriterPlan{at(seconds{5}), 21, {}};  // 20 from 5 s to 15 s
  EXPECT_EQ(measure({&late}, kWindow).lost, (Lost{{kUndiscovered, 10}}));
  EXPECT_EQ(measure({&late}, kWindow).samples, 11U);
  SamplePair never = silent_pair();
  never.plan = WriterPlan{at(seconds{5}), 30, {}};  // 30 from 5 s to 20 s
  EXPECT_EQ(measure({&never}, kWindow).lost, (Lost{{kUndiscovered, 20}}));
  EXPECT_EQ(measure({&never}, kWindow).delivered, 0U);
}

TEST(SampleMeasure, WhatIsInTheRecordWasNotWrittenBeforeDiscovery) {
  SamplePair all = every_second({});
  all.plan = WriterPlan{at(seconds{1}), all.samples.size(), {}};
  EXPECT_EQ(measure({&all}, kWindow).lost, Lost{});
  all.plan->begin = at(seconds{12});  // it began in the window: nothing was due before
  EXPECT_EQ(measure({&all}, kWindow).samples, 9U);
}

TEST(SampleMeasure, CountsWhatCouldNotBeWrittenInTime) {
  SamplePair slow = every_second({});
  slow.plan = WriterPlan{at(seconds{0}), slow.samples.size(), slow.samples.size() + 40};
  EXPECT_EQ(measure({&slow}, kWindow).lost, (Lost{{kUnwritten, 20}}));  // half of the time
  slow.plan->due = slow.samples.size() + 1;  // the last one is due at the end
  EXPECT_EQ(measure({&slow}, kWindow).lost, Lost{});
}

TEST(TopicGroup, HasAStarForEachAgent) {
  const std::vector<std::string> agents{"r0", "r1", "base"};
  EXPECT_EQ(group_of("rt/r1/scan", agents), "rt/*/scan");
  EXPECT_EQ(group_of("r0", agents), "*");
  EXPECT_EQ(group_of("rt/r10/scan", agents), "rt/r10/scan");
  EXPECT_EQ(group_of("rt/base/of/r0", agents), "rt/*/of/*");
}

}  // namespace
}  // namespace results::fleet
