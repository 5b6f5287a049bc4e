#include <gtest/gtest.h>

#include <map>

#include "controllers/traffic_stamp.h"
#include "tests/unit/gateway/runtime/one_agent.h"

namespace {

using namespace std::chrono_literals;
using controllers::stamped;
using hal::AgentId;
using hal::Time;

std::map<std::string, double> stop(tests::OneAgent& sink) {
  std::map<std::string, double> recorded;
  const tests::Actions actions = sink.feed(sink.event(hal::node::exchange::Stop{}));
  for (const auto& record : tests::all<hal::node::exchange::Record>(actions)) {
    recorded[record.name] = record.value;
  }
  return recorded;
}

tests::OneAgent sink(std::vector<hal::node::exchange::ParameterText> parameters) {
  auto session = tests::mote_session();
  session.parameters = std::move(parameters);
  return {*baraka_controller(), session};
}

TEST(TrafficSink, CountsMessagesOfItsTopicBetweenItsTimes) {
  auto mote = sink({{"start", "1 s", "t:1:1"},
                    {"stop", "3 s", "t:2:1"},
                    {"topic", "x", "t:3:1"},
                    {"overhead", "7", "t:4:1"}});
  mote.start();
  const auto hear = [&](hal::Duration at, const char* topic, hal::Duration age) {
    mote.now = Time{at};
    mote.hear(AgentId{2}, topic, controllers::stamped({.sent = Time{at - age}, .number = 1}, 93));
  };
  hear(900ms, "x", 1ms);
  hear(1s, "x", 10ms);
  hear(2s, "y", 1ms);
  hear(2s, "x", 30ms);
  hear(3s, "x", 1ms);
  mote.now = Time{10s};
  const auto recorded = stop(mote);
  EXPECT_EQ(recorded.at("received"), 2);
  EXPECT_EQ(recorded.at("bytes"), 186);
  EXPECT_DOUBLE_EQ(recorded.at("goodput"), 2 * 100 * 8 / 2.0);
  EXPECT_DOUBLE_EQ(recorded.at("latency_mean"), 0.02);
  EXPECT_DOUBLE_EQ(recorded.at("latency_max"), 0.03);
}

TEST(TrafficSink, RecordsNoLatencyOfWhatHasNoStamp) {
  auto mote = sink({});
  mote.start();
  mote.now = Time{1s};
  mote.hear(AgentId{2}, "traffic", hal::Bytes(3));
  const auto recorded = stop(mote);
  EXPECT_EQ(recorded.at("received"), 1);
  EXPECT_EQ(recorded.count("latency_mean"), 0u);
}

}  // namespace
