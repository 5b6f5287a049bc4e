#include "sim/agents/interfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <utility>

#include "sim/agents/fingerprint_feed.h"
#include "tests/unit/sim/agents/two_motes.h"

namespace tests {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// From one mote to the other.
Bytes ethernet(AgentId from, AgentId to, std::uint8_t payload) {
  return {2,    0,    0,      0, 0, static_cast<std::uint8_t>(to.value),
          2,    0,    0,      0, 0, static_cast<std::uint8_t>(from.value),
          0x08, 0x00, payload};
}

/// The programs' side, by a clock that a run follows: frames are there at given times of the clock,
/// and the run looks for them late.
class Outside final : public sim::agents::FollowedClock,
                      public sim::air::FrameSink,
                      public sim::air::FrameSource {
 public:
  struct Left {
    AgentId agent;
    Time at;
    Bytes bytes;
    bool operator==(const Left&) const = default;
  };

  Time now() override { return now_; }
  bool wait(Time until, std::span<const int>, const sim::agents::Progress&) override {
    Time wake = until + late;
    if (!sent.empty()) wake = std::min(wake, sent.front().since + late);
    now_ = std::max(now_, wake);
    return true;
  }
  void on_frame(AgentId agent, Time at, std::span<const std::uint8_t> bytes) override {
    left.push_back({agent, at, Bytes(bytes.begin(), bytes.end())});
  }
  void on_room(AgentId agent, const Room& room) override { rooms[agent] = room; }
  int descriptor() const override { return -1; }
  void read(std::size_t most, const std::function<void(sim::air::SentFrame)>& take) override {
    for (most = std::min(most, most_at_once);
         most > 0 && !sent.empty() && sent.front().since <= now_; --most) {
      take(std::move(sent.front()));
      sent.pop_front();
    }
  }

  hal::Duration late{};  ///< Every wait ends so much too late.
  std::size_t most_at_once = 1000;
  std::deque<sim::air::SentFrame> sent;
  std::vector<Left> left;
  std::map<AgentId, Room> rooms;

 private:
  Time now_{};
};

class Arrivals final : public sim::agents::Observer {
 public:
  void on_arrival(const sim::OutsideArrival& arrival) override { all.push_back(arrival); }
  void on_air_entered(Time at, AgentId, const sim::radio::MacRequest& request) override {
    entered.emplace_back(at, request.tag);
    if (then) std::exchange(then, {})();
  }
  void on_air_left(Time at, AgentId, const sim::radio::MacIndication&) override {
    left.push_back(at);
  }
  void on_air_refused(Time, AgentId, sim::air::Refusal refusal, std::size_t) override {
    refused.push_back(refusal);
  }
  std::function<void()> then;  ///< Once, when the next frame enters.
  std::vector<sim::OutsideArrival> all;
  std::vector<std::pair<Time, std::uint64_t>> entered;
  std::vector<Time> left;
  std::vector<sim::air::Refusal> refused;
};

/// Nobody drives the motes.
class InterfacesTest : public TwoMotes {
 protected:
  InterfacesTest() {
    for (auto& agent : config.agents) agent.network.emplace();
    config.lateness_limit = 1ms;
  }

  Outcome follow(Time until) {
    sim::agents::Simulation simulation(config, {&arrivals, &feed});
    simulation.connect_air(outside, outside);
    return simulation.follow(until, outside);
  }

  Outside outside;
  Arrivals arrivals;
  sim::agents::FingerprintFeed feed;
};

TEST_F(InterfacesTest, AFrameEntersWhenItIsReadAndLeavesWhenItsReceptionEnds) {
  outside.sent.push_back({kA, Time{30ms}, ethernet(kA, kB, 7)});
  const Outcome outcome = follow(Time{100ms});
  EXPECT_EQ(outside.left, (std::vector<Outside::Left>{{kB, Time{30ms}, ethernet(kA, kB, 7)}}));
  EXPECT_EQ(arrivals.entered.size(), 1u);
  EXPECT_EQ(arrivals.left, std::vector<Time>{Time{30ms}});
  ASSERT_EQ(arrivals.all.size(), 1u);
  EXPECT_EQ(arrivals.all[0].door, "air of a");
  EXPECT_EQ(arrivals.all[0].at, Time{30ms});
  EXPECT_EQ(outcome.ended_at, Time{100ms});
  EXPECT_GT(outside.rooms.at(kA).capacity, 0u);
}

TEST_F(InterfacesTest, HowLateFramesAreIsCountedAtBothEdges) {
  outside.late = 3ms;
  for (int i = 0; i < 10; ++i) {
    outside.sent.push_back({kA, Time{10ms * i + 5ms}, ethernet(kA, kB, 7)});
  }
  const Outcome outcome = follow(Time{200ms});
  ASSERT_TRUE(outcome.real_time && outcome.real_time->air);
  const sim::agents::AirSummary& air = *outcome.real_time->air;
  EXPECT_EQ(air.entering.frames, 10u);
  EXPECT_EQ(air.entering.beyond_limit, 10u);
  EXPECT_EQ(air.entering.greatest, 3ms);
  EXPECT_EQ(air.leaving.frames, 10u);
  EXPECT_EQ(air.leaving.beyond_limit, 0u) << "an ideal radio takes no time, nor does this clock";
}

/// The kernels send while the agents' interfaces come up.
TEST_F(InterfacesTest, WhatWasSentBeforeTheClockStartedEntersAtTheStartAndIsNotLate) {
  outside.late = 3ms;
  for (const AgentId agent : {kA, kB}) {
    outside.sent.push_back({agent, Time{-50ms}, ethernet(agent, agent == kA ? kB : kA, 7)});
  }
  outside.sent.push_back({kA, Time{5ms}, ethernet(kA, kB, 8)});
  const Outcome outcome = follow(Time{100ms});
  feed.finish();
  ASSERT_EQ(arrivals.all.size(), 3u);
  EXPECT_EQ(arrivals.all[0].at, Time{});
  EXPECT_EQ(arrivals.all[1].at, Time{});
  const sim::agents::EdgeSummary& entering = outcome.real_time->air->entering;
  EXPECT_EQ(entering.frames, 3u);
  EXPECT_EQ(entering.beyond_limit, 1u);
  EXPECT_EQ(entering.median, hal::Duration{});
  EXPECT_EQ(entering.greatest, 3ms);

  sim::agents::FingerprintFeed second;
  sim::agents::Simulation repeated(config, {&second});
  repeated.outside().replay(arrivals.all);
  NoPace pace;
  (void)repeated.repeat(outcome.ended_at, {}, pace);
  second.finish();
  EXPECT_EQ(second.fingerprint().total(), feed.fingerprint().total());
}

/// More than the first look takes.
TEST_F(InterfacesTest, WhatIsLeftOfThatIsAsLateAsTheRunIsOld) {
  outside.late = 3ms;
  outside.most_at_once = 1;
  for (int i = 0; i < 2; ++i) outside.sent.push_back({kA, Time{-50ms}, ethernet(kA, kB, 7)});
  const Outcome outcome = follow(Time{100ms});
  ASSERT_EQ(arrivals.all.size(), 2u);
  EXPECT_EQ(outcome.real_time->air->entering.greatest, arrivals.all[1].at.time_since_epoch());
}

TEST_F(InterfacesTest, WhatNoRadioSendsIsToldAndCounted) {
  outside.sent.push_back({kB, Time{1ms}, {1, 2, 3}});
  outside.sent.push_back({kB, Time{2ms}, ethernet(kA, kB, 1)});
  const Outcome outcome = follow(Time{10ms});
  EXPECT_EQ(arrivals.refused,
            (std::vector{sim::air::Refusal::kTooShort, sim::air::Refusal::kSource}));
  EXPECT_EQ(outcome.real_time->air->refused,
            (std::vector<std::pair<std::string, std::uint64_t>>{{"too short", 1}, {"source", 1}}));
  EXPECT_EQ(arrivals.all.size(), 2u) << "they are repeated, too";
}

/// Whatever the clock did: late, or not at all.
TEST_F(InterfacesTest, ARepetitionOfTheArrivalsIsTheSameRun) {
  config.radio = sim::radio::profile_defaults(sim::radio::Profile::kIeee80211b);
  outside.late = 700us;
  for (int i = 0; i < 300; ++i) {
    const bool there = i % 3 != 0;
    outside.sent.push_back(
        {there ? kA : kB, Time{i * 311us}, there ? ethernet(kA, kB, 1) : ethernet(kB, kA, 2)});
  }
  const Outcome first = follow(Time{150ms});
  feed.finish();
  EXPECT_GT(outside.left.size(), 100u);

  Arrivals again;
  sim::agents::FingerprintFeed second;
  sim::agents::Simulation simulation(config, {&again, &second});
  simulation.outside().replay(arrivals.all);
  NoPace pace;
  const Outcome repeated = simulation.repeat(first.ended_at, {}, pace);
  second.finish();
  EXPECT_EQ(second.fingerprint().total(), feed.fingerprint().total());
  EXPECT_EQ(again.entered, arrivals.entered);
  EXPECT_EQ(again.left, arrivals.left);
  EXPECT_EQ(repeated.ended_at, first.ended_at);

  // What enters is part of it: one octet is another run.
  std::vector<sim::OutsideArrival> other = arrivals.all;
  other.back().bytes.back() ^= 1;
  sim::agents::FingerprintFeed third;
  sim::agents::Simulation changed(config, {&third});
  changed.outside().replay(other);
  (void)changed.repeat(first.ended_at, {}, pace);
  third.finish();
  EXPECT_NE(third.fingerprint().part(sim::Part::kExchange),
            feed.fingerprint().part(sim::Part::kExchange));
}

/// While a turn goes on, another thread puts in what has no time of its own: it gets the turn's, at
/// which a frame came, too.
TEST_F(InterfacesTest, ARepetitionTakesWhatCameAtTheTimeOfAFrameWithIt) {
  const auto is_end = [](sim::agents::Simulation& simulation) {
    simulation.outside().open("end",
                              [&](std::span<const std::uint8_t>) { simulation.end("enough"); });
  };
  outside.sent.push_back({kA, Time{30ms}, ethernet(kA, kB, 7)});
  sim::agents::Simulation simulation(config, {&arrivals, &feed});
  simulation.connect_air(outside, outside);
  is_end(simulation);
  arrivals.then = [&] { simulation.outside().put("end", {}); };
  const Outcome first = simulation.follow(Time{100ms}, outside);
  feed.finish();
  EXPECT_EQ(first.result, "enough");

  Arrivals again;
  sim::agents::FingerprintFeed second;
  sim::agents::Simulation repeated(config, {&again, &second});
  is_end(repeated);
  repeated.outside().replay(arrivals.all);
  NoPace pace;
  const Outcome outcome = repeated.repeat(first.ended_at, {}, pace);
  second.finish();
  EXPECT_EQ(outcome.result, first.result);
  EXPECT_EQ(outcome.ended_at, first.ended_at);
  EXPECT_EQ(again.left, arrivals.left);
  EXPECT_EQ(second.fingerprint().total(), feed.fingerprint().total());
}

TEST_F(InterfacesTest, AReceiverEndsTheRun) {
  sim::agents::Simulation simulation(config, {&arrivals});
  simulation.connect_air(outside, outside);
  simulation.outside().open("end",
                            [&](std::span<const std::uint8_t>) { simulation.end("enough"); });
  simulation.outside().put("end", {});
  const Outcome outcome = simulation.follow(Time{10s}, outside);
  EXPECT_EQ(outcome.result, "enough");
  EXPECT_LT(outcome.ended_at, Time{1s});
}

}  // namespace
}  // namespace tests
