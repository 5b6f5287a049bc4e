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
  EXPECT_DOUBLE_EQ(*found.latency(0.95), 0.1);
  EXPECT_DOUBLE_EQ(*found.discovered, 6.6);
}

TEST(SampleMeasure, WhatIsUnderWayAtTheEndIsLeftOut) {
  SamplePair pair = every_second({});
  pair.samples.back().left.reset();
  EXPECT_EQ(measure({&pair}, kWindow).samples, 8U);
}

TEST(SampleMeasure, NothingSentIsNoShareAndNothingDeliveredIsNoLatency) {
  const SamplePair silent = silent_pair();
  const SampleMeasure found = measure({&silent}, kWindow);
  EXPECT_EQ(found.pairs, 1U);
  EXPECT_EQ(found.silent, 1U);
  EXPECT_FALSE(found.delivered_share());
  EXPECT_FALSE(found.latency(0.5));
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

TEST(SampleMeasure, CountsWhatWasWrittenBeforeDiscovery) {
  SamplePair late = silent_pair();
  late.rate = 2;  // Hz
  late.samples = {fate(at(seconds{15}), at(seconds{15}))};
  const SampleMeasure found = measure({&late}, kWindow);
  EXPECT_EQ(found.samples, 11U);
  EXPECT_EQ(found.lost, (std::map<std::string, std::uint64_t>{{kUndiscovered, 10}}));
  SamplePair never = silent_pair();
  never.rate = 2;
  EXPECT_EQ(measure({&never}, kWindow).samples, 20U);
  EXPECT_EQ(measure({&never}, kWindow).delivered, 0U);
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
