#include "sim/scenario/countable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "hal/node/routing/possible_events.h"
#include "results/record/recorder.h"
#include "results/record/run_reader.h"
#include "results/record/scalars.h"
#include "tests/unit/results/record/test_run.h"

namespace results::record::test {
namespace {

using hal::AgentId;
using hal::Verdict;

std::set<std::string> words(const sim::agents::SimulationConfig& config,
                            const std::string& family) {
  std::set<std::string> found;
  for (const sim::scenario::Countable& one : sim::scenario::countable_of(config, {})) {
    if (one.family == family) found.insert(one.word);
  }
  return found;
}

TEST(Countable, WithAMediumFramesCollideAndAreAcknowledged) {
  const sim::agents::SimulationConfig config = small_config();
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
  sim::agents::SimulationConfig config = small_config();
  config.radio = sim::radio::IdealConfig{};
  EXPECT_EQ(words(config, "receptions"),
            (std::set<std::string>{"delivered", "below sensitivity", "radio off", "under way"}));
  EXPECT_EQ(words(config, "frames"), (std::set<std::string>{"broadcast", "unicast"}));
  EXPECT_FALSE(words(config, "requests").contains("queue full"));
  config.radio = sim::radio::DiskConfig{};
  EXPECT_TRUE(words(config, "requests").contains("queue full"));
}

TEST(Countable, AccessPointsHaveBeaconsAndMayKnowNoRoute) {
  sim::agents::SimulationConfig config = small_config();
  config.radio = sim::radio::Ieee80211bConfig{};
  EXPECT_FALSE(words(config, "frames").contains("beacon"));
  EXPECT_FALSE(words(config, "requests").contains("no route"));
  EXPECT_TRUE(words(config, "requests").contains("expired"));
  config.agents[0].radio.access_points = {"m1"};
  EXPECT_TRUE(words(config, "frames").contains("beacon"));
  EXPECT_TRUE(words(config, "requests").contains("no route"));
}

TEST(Countable, StationsWithQosMayAgreeOnBlockAck) {
  sim::agents::SimulationConfig config = small_config();
  sim::radio::Ieee80211nConfig radio;
  config.radio = radio;
  EXPECT_EQ(words(config, "frames"), (std::set<std::string>{"broadcast", "unicast", "rts", "cts",
                                                            "ack", "management", "block_ack"}));
  radio.aggregation.block_ack_window = 0;
  config.radio = radio;
  EXPECT_FALSE(words(config, "frames").contains("block_ack"));
}

TEST(Countable, RoutingEventsAreThoseOfTheProtocolsInUse) {
  sim::agents::SimulationConfig config = small_config();
  EXPECT_TRUE(words(config, "routing.events").contains("forward ant sent"));
  EXPECT_FALSE(words(config, "routing.events").contains("rreq sent"));
  EXPECT_FALSE(words(config, "routing.events").contains("hello sent"));
  config.link = sim::agents::LinkKind::kUdpLike;
  EXPECT_TRUE(words(config, "routing.events").contains("hello sent"));
  config.agents[0].routing = hal::node::routing::Algorithm::kAodv;
  EXPECT_TRUE(words(config, "routing.events").contains("rreq sent"));
  config.routing.algorithm = hal::node::routing::Algorithm::kNone;
  config.agents.resize(2);
  config.agents[0].routing.reset();
  EXPECT_EQ(words(config, "routing.events"), (std::set<std::string>{"neighbour lost"}));
}

TEST(Countable, EveryRoutingEventIsPossibleWithSomeProtocol) {
  using hal::node::routing::Algorithm;
  std::set<hal::node::routing::ProtocolEvent> all;
  for (const Algorithm one : {Algorithm::kAnts, Algorithm::kFlooding, Algorithm::kAodv,
                              Algorithm::kAntHocNet, Algorithm::kNone}) {
    all.merge(hal::node::routing::possible_events(one, true));
  }
  EXPECT_EQ(all.size(), hal::node::routing::kProtocolEvents);
}

/// A run in which as many requests were given up as said; m0 and m1 could have been lost.
std::vector<Scalar> scalars_of_run(const std::string& name, int given_up, RecorderOptions options) {
  const test::Folder folder(name);
  {
    Recorder recorder(folder.file(), small_config(), options);
    recorder.add_countable({{"states", "program", "LOST"}});
    recorder.on_request_end({}, AgentId{1}, AgentId{2}, Verdict::kDelivered);
    for (int i = 0; i < given_up; ++i) {
      recorder.on_request_end({}, AgentId{1}, AgentId{2}, Verdict::kRetryLimit);
    }
    if (given_up > 0) recorder.on_state({}, AgentId{1}, "LOST");
    recorder.finish({}, sim::Fingerprint());
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
  const auto all = scalars_of_run(
      "nothing", 2,
      {.frames = sim::scenario::Detail::kNone, .messages = sim::scenario::Detail::kNone});
  for (const char* name :
       {"requests.retry_limit", "requests.queue_full", "receptions.collision", "frames.sent",
        "frames.ack", "messages.sent", "messages.ends.no_route", "broadcasts.sent"}) {
    EXPECT_EQ(value(all, name), std::nullopt) << name;
  }
}

}  // namespace
}  // namespace results::record::test
