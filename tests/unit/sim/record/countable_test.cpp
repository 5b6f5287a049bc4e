#include "sim/record/countable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "hal/routing/possible_events.h"
#include "sim/record/recorder.h"
#include "sim/record/run_reader.h"
#include "sim/record/scalars.h"
#include "tests/unit/sim/record/test_run.h"

namespace sim::record::test {
namespace {

using hal::AgentId;
using hal::Verdict;

std::set<std::string> words(const agents::SimulationConfig& config, const std::string& family) {
  std::set<std::string> found;
  for (const Countable& one : countable_of(config, true, true)) {
    if (one.family == family) found.insert(one.word);
  }
  return found;
}

TEST(Countable, WithAMediumFramesCollideAndAreAcknowledged) {
  const agents::SimulationConfig config = small_config();
  EXPECT_TRUE(words(config, "receptions").contains("collision"));
  EXPECT_TRUE(words(config, "receptions").contains("random loss")) << "also where loss is 0";
  EXPECT_TRUE(words(config, "receptions").contains("under way"));
  EXPECT_EQ(words(config, "requests"),
            (std::set<std::string>{"delivered", "transmitted", "retry limit", "queue full",
                                   "radio off"}));
  EXPECT_EQ(words(config, "frames"),
            (std::set<std::string>{"broadcast", "unicast", "rts", "cts", "ack"}));
}

TEST(Countable, WithoutAMediumNothingCollidesAndOnlyTheIdealQueueIsNeverFull) {
  agents::SimulationConfig config = small_config();
  config.radio = radio::IdealConfig{};
  EXPECT_EQ(words(config, "receptions"),
            (std::set<std::string>{"delivered", "below sensitivity", "radio off", "under way"}));
  EXPECT_EQ(words(config, "frames"), (std::set<std::string>{"broadcast", "unicast"}));
  EXPECT_FALSE(words(config, "requests").contains("queue full"));
  config.radio = radio::DiskConfig{};
  EXPECT_TRUE(words(config, "requests").contains("queue full"));
}

TEST(Countable, AccessPointsHaveBeaconsAndMayKnowNoRoute) {
  agents::SimulationConfig config = small_config();
  config.radio = radio::Ieee80211bConfig{};
  EXPECT_FALSE(words(config, "frames").contains("beacon"));
  EXPECT_FALSE(words(config, "requests").contains("no route"));
  EXPECT_TRUE(words(config, "requests").contains("expired"));
  config.agents[0].radio.access_points = {"m1"};
  EXPECT_TRUE(words(config, "frames").contains("beacon"));
  EXPECT_TRUE(words(config, "requests").contains("no route"));
}

TEST(Countable, RoutingEventsAreThoseOfTheProtocolsInUse) {
  agents::SimulationConfig config = small_config();
  EXPECT_TRUE(words(config, "routing.events").contains("forward ant sent"));
  EXPECT_FALSE(words(config, "routing.events").contains("rreq sent"));
  EXPECT_FALSE(words(config, "routing.events").contains("hello sent"));
  config.link = agents::LinkKind::kUdpLike;
  EXPECT_TRUE(words(config, "routing.events").contains("hello sent"));
  config.agents[0].routing = hal::routing::Algorithm::kAodv;
  EXPECT_TRUE(words(config, "routing.events").contains("rreq sent"));
  config.routing.algorithm = hal::routing::Algorithm::kNone;
  config.agents.resize(2);
  config.agents[0].routing.reset();
  EXPECT_EQ(words(config, "routing.events"), (std::set<std::string>{"neighbour lost"}));
}

TEST(Countable, EveryRoutingEventIsPossibleWithSomeProtocol) {
  using hal::routing::Algorithm;
  std::set<hal::routing::ProtocolEvent> all;
  for (const Algorithm one : {Algorithm::kAnts, Algorithm::kFlooding, Algorithm::kAodv,
                              Algorithm::kAntHocNet, Algorithm::kNone}) {
    all.merge(hal::routing::possible_events(one, true));
  }
  EXPECT_EQ(all.size(), hal::routing::kProtocolEvents);
}

/// A run in which as many requests were given up as said; m0 and m1 could have been lost.
std::vector<Scalar> scalars_of_run(const std::string& name, int given_up, RecorderOptions options) {
  const Folder folder(name);
  {
    Recorder recorder(folder.file(), small_config(), options);
    recorder.add_countable({{"states", "program", "LOST"}});
    recorder.on_request_end({}, AgentId{1}, AgentId{2}, Verdict::kDelivered);
    for (int i = 0; i < given_up; ++i) {
      recorder.on_request_end({}, AgentId{1}, AgentId{2}, Verdict::kRetryLimit);
    }
    if (given_up > 0) recorder.on_state({}, AgentId{1}, "LOST");
    recorder.finish({}, Fingerprint());
  }
  RunReader reader(folder.path());
  return scalars_of(reader);
}

std::optional<double> value(const std::vector<Scalar>& all, const std::string& name,
                            const std::string& agent = "") {
  const auto found = std::ranges::find_if(
      all, [&](const Scalar& one) { return one.name == name && one.agent == agent; });
  return found == all.end() ? std::nullopt : std::optional(found->value);
}

// Of two runs the verdict comes up in one only; both have the number.
TEST(Countable, AVerdictThatOneRunHasIsZeroInTheOther) {
  const auto one = scalars_of_run("with", 2, {});
  const auto other = scalars_of_run("without", 0, {});
  EXPECT_EQ(value(one, "requests.retry_limit"), 2);
  EXPECT_EQ(value(other, "requests.retry_limit"), 0);
  EXPECT_EQ(value(one, "states.lost.entries", "m0"), 1);
  EXPECT_EQ(value(other, "states.lost.entries", "m0"), 0);
  EXPECT_EQ(value(other, "states.lost.time", "r0"), 0);
  EXPECT_EQ(value(other, "requests.no_route"), std::nullopt) << "only access points end them so";
  const auto names = [](const std::vector<Scalar>& all) {
    std::set<std::pair<std::string, std::string>> found;
    for (const Scalar& scalar : all) {
      if (scalar.name != "states.lost.first") found.emplace(scalar.name, scalar.agent);
    }
    return found;
  };
  EXPECT_EQ(names(one), names(other));
}

TEST(Countable, WhatIsNotCountedIsNoZero) {
  const auto all =
      scalars_of_run("nothing", 2, {.frames = Detail::kNone, .messages = Detail::kNone});
  for (const char* name :
       {"requests.retry_limit", "requests.queue_full", "receptions.collision", "frames.sent",
        "frames.ack", "messages.sent", "messages.ends.no_route", "broadcasts.sent"}) {
    EXPECT_EQ(value(all, name), std::nullopt) << name;
  }
}

}  // namespace
}  // namespace sim::record::test
