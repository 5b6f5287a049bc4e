// Events and conditions of a scenario: read, written, and read again.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "sim/scenario/judge.h"
#include "sim/scenario/resolved.h"

namespace sim::scenario {
namespace {

namespace fs = std::filesystem;
using agents::Combination;
using agents::CountOf;
using hal::AgentId;

constexpr const char* kText = R"(
version: 1
radio: {profile: ieee80211b}
agents:
  motes:
    name: m{}
    mote: {model: brick, size: [1 cm, 2 cm, 3 cm], mass: 7 g,
           sensors: [{kind: battery, capacity: 100 J, full_voltage: 3 V, idle_power: 1 W}]}
    poses: [{x: 0 m, y: 0 m}, {x: 5 m, y: 0 m}]
    controller: {program: help_mote}
  spare:
    mote: {model: brick, size: [1 cm, 2 cm, 3 cm], mass: 7 g}
    poses: [{x: 9 m, y: 0 m}]
    controller: {program: help_mote}
    present: false
events:
  - {at: 1500 ms, do: [{kill: m0}, {restart: 'm*'}, {switch_off: m1}, {switch_on: m1}]}
  - every: 2 s
    from: 500 ms
    until: 20 s
    count: 7
    do: [{add: spare0}, {remove: spare0}, {move: m1, to: [4 m, -2 m], yaw: 1 rad}]
  - when: {all_of: [{any: 'm*', state: IDLE, for: 3 s}, {not: {agent: m0, area: {centre: [1 m, 2 m], radius: 3 m}}}]}
    each_time: true
    do:
      - {set: 'm*', tx_power: 7 mW}
      - {drain: m0, energy: 5 J}
      - {drain: m1, level: 0.25}
      - {jam: {position: [1 m, 2 m], height: 3 m, power: 4 mW, channel: 6, duration: 5 s, duty_cycle: 0.5, period: 20 ms}}
end:
  - {when: {any_of: [{distance: [m0, m1], above: 1 m, below: 7 m}, {time: 9 s}]}, after: 3 s, result: a}
  - {when: {count: 'm*', received: help, at_least: 2, at_most: 9}, result: b}
  - {when: {all: 'm*', area: {from: [0 m, 1 m], to: [2 m, 3 m]}}, result: c}
expect:
  - {holds: {all: 'm*', battery: {above: 0.1, below: 0.9}}}
  - {held: {count: '*', state: FULFILLED, at_most: 0}}
)";

class EventsSection : public testing::Test {
 protected:
  EventsSection()
      : file_(fs::path(testing::TempDir()) / ("events_" + std::to_string(::getpid()) + ".yaml")) {}
  ~EventsSection() override { fs::remove(file_); }
  Scenario load(const std::string& text) const {
    std::ofstream(file_) << text;
    return load_scenario(file_);
  }
  fs::path file_;
};

TEST_F(EventsSection, ReadsBackToTheSameText) {
  const std::string once = resolved_yaml(load(kText));
  EXPECT_EQ(resolved_yaml(load(once)), once);
  EXPECT_NE(once.find("duty_cycle: 0.5"), std::string::npos) << once;
}

TEST_F(EventsSection, KeepsWhatItSays) {
  const Scenario scenario = load(resolved_yaml(load(kText)));
  const auto& c = scenario.simulation;
  ASSERT_EQ(c.script.size(), 3u);
  EXPECT_EQ(std::get<agents::AtTime>(c.script[0].when).at, 1500ms);
  EXPECT_EQ(c.script[0].actions[1].agents, (std::vector{AgentId{1}, AgentId{2}}));
  const auto& often = std::get<agents::Periodically>(c.script[1].when);
  EXPECT_EQ(often.every, 2s);
  EXPECT_EQ(often.from, 500ms);
  EXPECT_EQ(often.until, 20s);
  EXPECT_EQ(often.count, 7);
  const auto& move = std::get<agents::MoveTo>(c.script[1].actions[2].what);
  EXPECT_EQ(move.pose, (hal::Pose2{4, -2, 1}));
  const auto& whenever = std::get<agents::Whenever>(c.script[2].when);
  EXPECT_TRUE(whenever.each_time);
  EXPECT_EQ(std::get<Combination>(whenever.condition.what).parts.at(0).hold, 3s);
  const auto& jam = std::get<agents::Jam>(c.script[2].actions[3].what);
  EXPECT_EQ(jam.position, (hal::Vec3{1, 2, 3}));
  EXPECT_EQ(jam.channel, 6u);
  EXPECT_EQ(jam.period, 20ms);
  EXPECT_FALSE(c.agents[2].is_present);
  EXPECT_EQ(c.ends.at(0).after, 3s);
  EXPECT_EQ(std::get<CountOf>(c.ends.at(1).when->what).at_most, 9);
  ASSERT_EQ(c.asked.size(), 2u);
  EXPECT_TRUE(std::get<ExpectedCondition>(scenario.expectations.at(1).condition).at_some_time);
  ASSERT_EQ(scenario.awaited.size(), 2u);
  EXPECT_EQ(scenario.awaited[1].state, "FULFILLED");
  EXPECT_EQ(scenario.awaited[1].agents.size(), 3u);
}

TEST_F(EventsSection, ConditionsThatDoNotHoldAreUnmetExpectations) {
  const Scenario scenario = load(kText);
  const Judge judge(scenario);
  const auto at = [](AgentId) { return hal::Vec2{}; };
  EXPECT_EQ(judge.unmet("a", at, [](std::size_t, bool) { return true; }),
            std::vector<std::string>{});
  const auto lines = judge.unmet("a", at, [](std::size_t, bool) { return false; });
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_TRUE(
      lines[0].ends_with("does not hold at the end: battery of all of 'm*' above 0.1 below "
                         "0.9"))
      << lines[0];
  EXPECT_TRUE(
      lines[1].ends_with("never held in the run: count of '*' in state FULFILLED at most 0"))
      << lines[1];
}

}  // namespace
}  // namespace sim::scenario
