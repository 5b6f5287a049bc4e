#include "results/fleet/fleet_answer.h"

#include <gtest/gtest.h>

#include <chrono>

#include "results/fleet/fleet_cause.h"
#include "results/fleet/fleet_page.h"
#include "results/fleet/fleet_text.h"

namespace results::fleet {
namespace {

FleetFile fleet() {
  FleetFile file;
  file.name = "halls";
  file.robots = {2, 4, 6};
  file.radios.push_back({.name = "", .values = {}, .xml = {}, .vendor = {}});
  file.sites = file.radios;
  for (const char* name : {"default", "one_frame"}) {
    file.profiles.push_back({.name = name, .values = {}, .xml = {}, .vendor = {}});
  }
  Need need;
  need.topic = "*/scan";
  need.delivered = 0.99;
  need.p95 = std::chrono::milliseconds{50};
  file.needs = {need};
  return file;
}

/// A run of which this share of 1000 samples arrives after the given latency [s].
FleetRun run(double delivered, double latency) {
  SampleMeasure samples;
  samples.pairs = 2;
  samples.samples = 1000;
  samples.delivered = static_cast<std::uint64_t>(1000 * delivered);
  samples.first_try = samples.delivered;
  samples.latencies.assign(samples.delivered, latency);
  samples.discovered = 1;
  samples.age95 = 0.1;
  if (samples.delivered < 1000) samples.lost["queue full at ap"] = 1000 - samples.delivered;
  FleetRun one;
  one.needs = {samples};
  one.topics["rt/*/scan"] = samples;
  one.busy = 0.3;
  one.busiest = "ap";
  one.backlogged = 0.2;
  one.most_backlogged = "ap";
  one.simulated_s = 60;
  one.air["rt/*/scan"] = 0.25;
  return one;
}

CaseAnswer answered(const Case& which, const std::vector<FleetRun>& runs) {
  return answer_of(fleet(), which, runs, 0);
}

Cause cause_of(const FleetRun& one) { return answered({}, {one, one}).misses.at(0).cause; }

TEST(FleetAnswer, HoldsIfTheMeansDo) {
  EXPECT_TRUE(answered({}, {run(0.985, 0.01), run(0.995, 0.01)}).holds());
  EXPECT_FALSE(answered({}, {run(0.985, 0.01), run(0.99, 0.01)}).holds());
  EXPECT_FALSE(answered({}, {run(1, 0.06), run(1, 0.06)}).holds());
  EXPECT_FALSE(answered({}, {}).holds()) << "nothing ran";
}

/// Runs in which a small sample waits for a large one, or does not.
TEST(FleetAnswer, LatenciesAreThoseOfTheSamplesOfAllRuns) {
  const std::vector runs{run(1, 0.01), run(1, 0.01), run(1, 0.01), run(0.9, 0.2), run(1, 0.01)};
  const CaseAnswer answer = answered({}, runs);
  EXPECT_DOUBLE_EQ(answer.needs[0].p50->value, 0.01) << "not the mean of medians, 0.048";
  EXPECT_DOUBLE_EQ(answer.topics.at("rt/*/scan").p95->value, 0.2);
  EXPECT_EQ(answer.needs[0].p95->runs, 5U);
  EXPECT_DOUBLE_EQ(answer.needs[0].p50->interval->low, 0.01);
  EXPECT_EQ(answered({}, {runs[0]}).needs[0].p50->interval, std::nullopt);
}

TEST(FleetAnswer, ARunWithoutASampleDoesNotHold) {
  FleetRun none = run(0, 0);
  EXPECT_FALSE(answered({}, {run(1, 0.01), none}).holds()) << "nothing arrived in one";
  none.needs[0].samples = 0;  // nothing was sent in the window, as on /tf_static
  none.needs[0].lost.clear();
  EXPECT_TRUE(answered({}, {run(1, 0.01), none}).holds());
  EXPECT_TRUE(answered({}, {none}).holds());
  FleetRun nobody = run(1, 0.01);
  nobody.needs[0] = {};
  EXPECT_EQ(cause_of(nobody), Cause::kOther);
  nobody.needs[0].pairs = nobody.needs[0].silent = 1;
  EXPECT_EQ(cause_of(nobody), Cause::kDiscovery);
}

TEST(FleetAnswer, LargestIsUpToTheFirstThatDoesNotHold) {
  const auto lines =
      lines_of({answered({0, 0, 0, 2}, {run(1, 0.01)}), answered({0, 0, 0, 4}, {run(0.9, 0.01)}),
                answered({0, 0, 0, 6}, {run(1, 0.01)}), answered({0, 0, 1, 2}, {run(0.9, 0.01)})});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].largest(), 2);
  EXPECT_EQ(lines[0].first_miss()->which.robots, 4);
  EXPECT_FALSE(lines[1].largest());
  EXPECT_EQ(largest_text(lines[0]), "2");
  EXPECT_EQ(largest_text(lines[1]), "fewer than 2");
}

TEST(FleetAnswer, MoreRobotsAreBetterAndThenLessAir) {
  FleetRun cheap = run(1, 0.01);
  cheap.air["rt/*/scan"] = 0.1;
  const auto lines =
      lines_of({answered({0, 0, 0, 2}, {run(1, 0.01)}), answered({0, 0, 1, 2}, {cheap})});
  EXPECT_EQ(ranked(lines, 0, 0).front()->profile, 1U);
  const std::string words = sentences(fleet(), lines).at(0);
  EXPECT_NE(words.find("at least 2 robots with profile one_frame"), std::string::npos) << words;
  EXPECT_NE(words.find("profile default holds as many and takes 25.0 % of the air"),
            std::string::npos)
      << words;
}

TEST(FleetAnswer, OfTwoThatDoNotHoldTheOneThatDeliversMoreIsFirst) {
  FleetRun dead = run(0.01, 0.01);
  dead.air["rt/*/scan"] = 0.001;
  const auto lines =
      lines_of({answered({0, 0, 0, 2}, {dead}), answered({0, 0, 1, 2}, {run(0.9, 0.01)})});
  EXPECT_EQ(ranked(lines, 0, 0).front()->profile, 1U);
  const std::string words = sentences(fleet(), lines).at(0);
  EXPECT_NE(words.find("profile default does not hold, either"), std::string::npos) << words;
}

TEST(FleetAnswer, WhatDidNotRunIsNotCompared) {
  FleetFile file = fleet();
  file.replications = 2;
  const auto lines = lines_of({answered({0, 0, 0, 2}, {run(1, 0.01)}), answered({0, 0, 1, 2}, {})});
  EXPECT_EQ(ranked(lines, 0, 0).size(), 1U);
  const std::string words = sentences(file, lines).at(0);
  EXPECT_NE(words.find("(so far: 1 of 2 runs)"), std::string::npos) << words;
  EXPECT_EQ(summary_cells(file, lines).rows[1][1], "no run");
}

TEST(FleetCause, IsWhatTheLossesAndTheRadiosTell) {
  FleetRun one = run(0.9, 0.01);
  EXPECT_EQ(cause_of(one), Cause::kQueue);
  one.backlogged = 0.95;
  one.busy = 0.6;
  EXPECT_EQ(cause_of(one), Cause::kAirFull);
  one.busy = 0.1;  // frames wait, but the medium is idle
  EXPECT_EQ(cause_of(one), Cause::kQueue);
  one.needs[0].lost = {{"noise at r0", 60}, {"retry limit at r0", 30}, {"collision at r1", 10}};
  EXPECT_EQ(cause_of(one), Cause::kRange);
  one.needs[0].lost = {{"collision at r0", 60}, {"noise at r0", 40}};
  EXPECT_EQ(cause_of(one), Cause::kCollision);
  one.needs[0].lost = {{kUndiscovered, 100}};
  EXPECT_EQ(cause_of(one), Cause::kDiscovery);
  one.needs[0].lost = {{"no route at r0", 100}};
  EXPECT_EQ(cause_of(one), Cause::kOther);
  one.unassociated = 1;
  EXPECT_EQ(cause_of(one), Cause::kNoAccessPoint);
  one.handovers = 3;
  EXPECT_EQ(cause_of(one), Cause::kHandover);
}

TEST(FleetCause, OfDelays) {
  FleetRun one = run(1, 0.2);
  EXPECT_EQ(cause_of(one), Cause::kQueue);
  one.needs[0].repaired = 100;
  EXPECT_EQ(cause_of(one), Cause::kRepairs);
  one.backlogged = one.busy = 0.95;
  EXPECT_EQ(cause_of(one), Cause::kAirFull);
}

TEST(FleetCause, OfAnOldSampleIsTheLossOfThoseAfterIt) {
  FleetFile file = fleet();
  file.needs[0].delivered.reset();
  file.needs[0].p95.reset();
  file.needs[0].age = std::chrono::milliseconds{10};
  FleetRun one = run(0.6, 0.01);
  one.needs[0].lost = {{"noise at r0", 400}};
  EXPECT_EQ(answer_of(file, {}, {one}, 0).misses.at(0).cause, Cause::kRange);
  one = run(1, 0.01);
  one.backlogged = 0.01;
  EXPECT_EQ(answer_of(file, {}, {one}, 0).misses.at(0).cause, Cause::kOther);
}

TEST(FleetText, SharesAreNeverRoundedToAllOrNone) {
  EXPECT_EQ(share_text(1), "100.0 %");
  EXPECT_EQ(share_text(0.99999), ">99.9 %");
  EXPECT_EQ(share_text(0.9994), "99.9 %");
  EXPECT_EQ(share_text(0), "0.0 %");
  EXPECT_EQ(share_text(0.0001), "<0.1 %");
  EXPECT_EQ(time_text(0.0123), "12.3 ms");
  EXPECT_EQ(time_text(2.5), "2.5 s");
}

TEST(FleetPage, HasEachLineAndEscapesNames) {
  FleetFile file = fleet();
  file.name = "halls & yards";
  const std::string page = fleet_page(file, lines_of({answered({0, 0, 0, 2}, {run(1, 0.01)}),
                                                      answered({0, 0, 1, 2}, {run(0.9, 0.01)})}));
  for (const char* part : {"halls &amp; yards", "<h2>default</h2>", "<h2>one_frame</h2>",
                           "rt/*/scan", "<svg", "queue full"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
}

}  // namespace
}  // namespace results::fleet
