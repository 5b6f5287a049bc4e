#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hal/types/message.h"
#include "hal/types/record.h"
#include "tests/contract/actions.h"

namespace contract {
namespace {

/// What every agent keeps to its controller, simulated or real, asked in process or over DDS.
class AgentContract : public testing::TestWithParam<Implementation> {
 protected:
  const Promises& promises() const { return GetParam().promises; }
  const Sight& sight() const { return host_->sight(); }

  /// The one that drives both agents.
  const Brain& brain(Brain::Rule rule = {}, const hal::Wants& wants = {.watched = {"test"}}) {
    if (const auto domain = host_->domain()) {
      brain_ = std::make_unique<RemoteBrain>(*domain, "both", std::vector<std::string>{"r0", "m0"},
                                             std::move(rule), wants);
      return *brain_;
    }
    brain_ = std::make_unique<Brain>(std::move(rule));
    for (const auto& [agent, name] : {std::pair(kRobot, "r0"), std::pair(kMote, "m0")}) {
      host_->connect(std::make_shared<BrainPort>(*brain_, name), agent, wants);
    }
    return *brain_;
  }

  /// Who is who, as the controllers of both agents were told.
  std::vector<std::vector<hal::node::exchange::AgentName>> directories() const {
    if (!host_->domain()) return {host_->directory(kRobot), host_->directory(kMote)};
    return dynamic_cast<const RemoteBrain&>(*brain_).directories();
  }

  /// Until both agents had so many control cycles more.
  [[nodiscard]] bool pass(std::size_t cycles) const {
    const std::size_t robot = brain_->seen(kRobot, Cause::kControl).size() + cycles;
    const std::size_t mote = brain_->seen(kMote, Cause::kControl).size() + cycles;
    return until([&] {
      return brain_->seen(kRobot, Cause::kControl).size() >= robot &&
             brain_->seen(kMote, Cause::kControl).size() >= mote;
    });
  }

  std::unique_ptr<Brain> brain_;  ///< It answers until the host has ended.
  std::unique_ptr<ContractHost> host_ = GetParam().make();
};

TEST_P(AgentContract, StartsEveryAgentOnceAndThenCallsItEveryControlPeriod) {
  const Brain& both = brain();
  for (const hal::AgentId agent : {kRobot, kMote}) {
    ASSERT_TRUE(until([&] { return both.seen(agent, Cause::kControl).size() >= 5; }));
    EXPECT_EQ(both.seen(agent).front().cause(), Cause::kStart);
    EXPECT_EQ(both.seen(agent, Cause::kStart).size(), 1u);
    const auto cycles = both.seen(agent, Cause::kControl);
    // On a busy machine real time leaves cycles out and has some late; it never adds any.
    const auto periods = static_cast<long>(cycles.size()) - 1;
    const hal::Duration took = cycles.back().time - cycles.front().time;
    EXPECT_GE(took, (periods - 1) * kPeriod);
    if (promises().waits_for_answers) {
      EXPECT_EQ(took, periods * kPeriod);
    }
  }
}

TEST_P(AgentContract, TakesTheActionsOfAnAgentInTheirOrder) {
  std::vector<Action> states;
  for (const char* name : {"one", "two", "three", "four"}) {
    states.push_back({.what = SetState{name}});
  }
  brain(once(kMote, states));
  ASSERT_TRUE(until([&] { return sight().states(kMote).size() >= 4; }));
  EXPECT_EQ(sight().states(kMote), (std::vector<std::string>{"one", "two", "three", "four"}));
  EXPECT_TRUE(sight().states(kRobot).empty());
}

TEST_P(AgentContract, ATimerComesOnceAndNotBeforeItsTime) {
  const Brain& both = brain([](const Event& event) {
    std::vector<Action> actions;
    if (event.agent != kRobot || event.cause() != Cause::kStart) return actions;
    actions.push_back({.what = SetTimer{7, event.time + 70ms}});
    return actions;
  });
  ASSERT_TRUE(until([&] { return !both.seen(kRobot, Cause::kTimer).empty(); }));
  ASSERT_TRUE(until([&] {
    const auto timers = both.seen(kRobot, Cause::kTimer);
    return both.seen(kRobot).back().time > timers.front().time + 200ms;
  }));
  const auto timers = both.seen(kRobot, Cause::kTimer);
  ASSERT_EQ(timers.size(), 1u);
  EXPECT_EQ(timers[0].what, Event::What(TimerDue{7}));
  EXPECT_GE(timers[0].time - both.seen(kRobot).front().time, 70ms);
  EXPECT_TRUE(both.seen(kMote, Cause::kTimer).empty());
}

TEST_P(AgentContract, AMessageArrivesAsItWasSentAndItsSenderIsToldOnce) {
  const hal::Bytes payload{0, 255, 7, 0};
  Action message = send(kMote, 1, payload);
  std::get<Send>(message.what).priority = hal::Priority::kVoice;
  const Brain& both = brain(once(kRobot, {message}));
  ASSERT_TRUE(until([&] { return !both.seen(kMote, Cause::kMessage).empty(); }));
  ASSERT_TRUE(until([&] { return !both.seen(kRobot, Cause::kNotice).empty(); }));
  const Event event = both.seen(kMote, Cause::kMessage)[0];
  const hal::Message& arrived = std::get<MessageArrived>(event.what).message;
  EXPECT_EQ(arrived.source, kRobot);
  EXPECT_EQ(arrived.destination, kMote);
  EXPECT_EQ(arrived.topic, "test");
  EXPECT_EQ(arrived.payload, payload);
  EXPECT_EQ(arrived.priority, hal::Priority::kVoice);
  const std::size_t cycles = both.seen(kRobot, Cause::kControl).size();
  ASSERT_TRUE(until([&] { return both.seen(kRobot, Cause::kControl).size() >= cycles + 10; }));
  EXPECT_EQ(both.seen(kMote, Cause::kMessage).size(), 1u);
  const auto notices = both.seen(kRobot, Cause::kNotice);
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_EQ(notices[0].what, Event::What(Notice{1, hal::Fate::kHandedOver}));
}

TEST_P(AgentContract, AMessageToNobodyEndsWithNoRoute) {
  const Brain& both = brain(once(kMote, {send(kNobody, 1)}));
  ASSERT_TRUE(until([&] { return !both.seen(kMote, Cause::kNotice).empty(); }));
  const auto notices = both.seen(kMote, Cause::kNotice);
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_EQ(std::get<Notice>(notices[0].what).fate, hal::Fate::kNoRoute);
}

TEST_P(AgentContract, AControllerSeesTheRoutesOfWhatItWatches) {
  const Brain& both = brain(once(kRobot, {send(kMote, 1)}));
  const auto has_route = [&] {
    return std::ranges::any_of(both.seen(kRobot), [](const Event& event) {
      return std::ranges::any_of(event.routes, [](const hal::RouteChange& change) {
        return change.route.topic == "test" && change.route.destination == kMote &&
               change.route.next_hop == kMote && change.route.path.hops == 1 && !change.removed;
      });
    });
  };
  EXPECT_TRUE(until(has_route));
}

TEST_P(AgentContract, OneProcessMayDriveEverybodyAndNoStepIsMissing) {
  const Brain& both = brain();
  ASSERT_TRUE(until([&] { return both.steps() >= 60; }));
  EXPECT_EQ(both.gaps(), 0u);
}

/// What a message was told to have come to, by its number.
std::map<hal::MessageId, hal::Fate> fates(const Brain& brain, hal::AgentId agent) {
  std::map<hal::MessageId, hal::Fate> fates;
  for (const Event& event : brain.seen(agent, Cause::kNotice)) {
    const auto& notice = std::get<Notice>(event.what);
    EXPECT_TRUE(fates.emplace(notice.message, notice.fate).second) << "told twice";
  }
  return fates;
}

using Fates = std::map<hal::MessageId, hal::Fate>;

TEST_P(AgentContract, AMessageToAddressZeroIsRefusedSoThatEveryNoticeThatIsPromisedComes) {
  const Brain& both = brain(once(kMote, {send(hal::AgentId{}, 1), send(kNobody, 2)}));
  ASSERT_TRUE(until([&] { return !both.seen(kMote, Cause::kNotice).empty(); }));
  ASSERT_TRUE(pass(10));
  EXPECT_EQ(fates(both, kMote), (Fates{{2, hal::Fate::kNoRoute}}));
  EXPECT_EQ(host_->end().refused, 1u);
}

TEST_P(AgentContract, AMessageAsLongAsMayBeArrivesAndOneByteMoreIsRefused) {
  const std::string topic(hal::kMaxTopic, 't');
  std::vector<Send> sends;
  for (hal::MessageId id = 1; id <= 6; ++id) {
    sends.push_back({id, kMote, topic, hal::Bytes(hal::kMaxPayload)});
  }
  sends[0].topic += 't';
  sends[1].topic.clear();
  sends[2].payload.push_back(0);
  sends[3].destination = kRobot;
  sends[4].id = 0;
  std::vector<Action> actions;
  for (const Send& one : sends) actions.push_back({.what = one});
  actions.push_back({.what = Invalidate{kMote, topic + 't'}});
  const Brain& both = brain(once(kRobot, actions));
  ASSERT_TRUE(until([&] { return !both.seen(kMote, Cause::kMessage).empty(); }));
  ASSERT_TRUE(until([&] { return !both.seen(kRobot, Cause::kNotice).empty(); }));
  ASSERT_TRUE(pass(3));
  const auto messages = both.seen(kMote, Cause::kMessage);
  ASSERT_EQ(messages.size(), 1u);
  const hal::Message& arrived = std::get<MessageArrived>(messages[0].what).message;
  EXPECT_EQ(arrived.topic, topic);
  EXPECT_EQ(arrived.payload.size(), hal::kMaxPayload);
  EXPECT_EQ(fates(both, kRobot), (Fates{{6, hal::Fate::kHandedOver}}));
  EXPECT_EQ(host_->end().refused, 6u);
}

TEST_P(AgentContract, WheelsTurnAsFastAsTheyCanAndNoFaster) {
  double most = 0;  // Of a wheel, rad/s, for 1 m/s ahead.
  for (const auto& row : host_->limits().body_to_wheel) most = std::max(most, std::abs(row[0]));
  const double limit = host_->limits().wheel_speed / most;
  brain([](const Event& event) {
    return event.cause() == Cause::kControl && event.agent == kRobot ? std::vector{drive(100)}
                                                                     : std::vector<Action>{};
  });
  ASSERT_TRUE(until([&] { return sight().speed() > 0.97 * limit; }));
  ASSERT_TRUE(pass(10));
  EXPECT_GT(sight().speed(), 0.97 * limit);
  EXPECT_LT(sight().top_speed(), 1.02 * limit) << "a simulated wheel slips, and is controlled";
}

TEST_P(AgentContract, SpeedsThatNoWheelCanTurnAtAreRefused) {
  const double limit = host_->limits().wheel_speed;
  const std::vector<Action> drives{
      {.what = DriveWheels{{1.01 * limit, 0, 0}}},
      {.what = DriveWheels{{0.5 * limit, 0}}},
      {.what = DriveWheels{{0, 0, std::numeric_limits<double>::quiet_NaN()}}},
      drive(std::numeric_limits<double>::infinity())};
  const Brain& both = brain(once(kRobot, drives));
  ASSERT_TRUE(until([&] { return both.seen(kRobot, Cause::kControl).size() >= 10; }));
  ASSERT_TRUE(pass(5));
  EXPECT_FALSE(sight().wheels_turn());
  EXPECT_EQ(host_->end().refused, 4u);
}

/// The neighbours that a controller knows after all it was told, as gateway/runtime keeps them. An
/// event has one word on a neighbour: it is there, or it was lost.
std::set<hal::AgentId> neighbours(const Brain& brain, hal::AgentId agent) {
  std::set<hal::AgentId> known;
  for (const Event& event : brain.seen(agent)) {
    for (const hal::Neighbour& heard : event.neighbours) known.insert(heard.id);
    for (const hal::AgentId lost : event.lost_neighbours) {
      EXPECT_FALSE(std::ranges::count(event.neighbours, lost, &hal::Neighbour::id)) << lost.value;
      known.erase(lost);
    }
  }
  return known;
}

/// The robot and the mote talk; the mote switches its radio off; some cycles later the robot's next
/// message finds nobody and the mote is heard again, in the simulator in one instant.
class LostAndHeard {
 public:
  std::vector<Action> operator()(const Event& event) {
    if (event.cause() == Cause::kStart) ++started_;
    if (event.agent == kRobot && event.cause() == Cause::kNotice && !talked_at_) {
      talked_at_ = event.time;
    }
    if (event.cause() != Cause::kControl || started_ < 2) return {};
    return event.agent == kRobot ? of_robot(event.time) : of_mote(event.time);
  }

 private:
  std::vector<Action> of_robot(hal::Time now) {
    if (!asked_ || (is_back(now) && asked_ == 1)) return {send(kMote, ++asked_)};
    return {};
  }
  std::vector<Action> of_mote(hal::Time now) {
    if (talked_at_ && !off_at_ && now > *talked_at_) {
      off_at_ = now;
      return {{.what = SetRadio{false}}};
    }
    if (!is_back(now) || std::exchange(is_over_, true)) return {};
    return {{.what = SetRadio{true}}, send(hal::kEveryone, 1)};
  }
  bool is_back(hal::Time now) const { return off_at_ && now >= *off_at_ + 3 * kPeriod; }

  int started_ = 0;
  hal::MessageId asked_ = 0;
  std::optional<hal::Time> talked_at_, off_at_;
  bool is_over_ = false;
};

TEST_P(AgentContract, ANeighbourThatIsLostAndHeardInOneInstantIsThere) {
  const Brain& both = brain(LostAndHeard{}, {.neighbours = true});
  ASSERT_TRUE(until([&] { return fates(both, kRobot).contains(2); }));
  ASSERT_TRUE(until([&] { return !both.seen(kRobot, Cause::kMessage).empty(); }));
  EXPECT_TRUE(until([&] { return neighbours(both, kRobot).contains(kMote); }));
}

TEST_P(AgentContract, RangesAreShownWhetherOrNotAControllerAsksForThem) {
  const Brain& both = brain({}, {});
  ASSERT_TRUE(until([&] { return both.seen(kRobot, Cause::kControl).size() >= 3; }));
  for (const Event& control : both.seen(kRobot, Cause::kControl)) {
    EXPECT_TRUE(control.readings.empty()) << "nobody asked";
  }
  EXPECT_TRUE(until([&] { return sight().ranges(kRobot) >= 3; }));
  EXPECT_EQ(sight().ranges(kMote), 0u);
}

TEST_P(AgentContract, EveryControllerThatAsksIsToldWhoIsWho) {
  brain({}, {.names = true});
  ASSERT_TRUE(pass(1));
  std::vector<std::vector<hal::node::exchange::AgentName>> told = directories();
  ASSERT_FALSE(told.empty());
  for (auto& directory : told) {
    std::ranges::sort(directory, {}, &hal::node::exchange::AgentName::agent);
    EXPECT_EQ(directory,
              (std::vector<hal::node::exchange::AgentName>{{kRobot, "r0"}, {kMote, "m0"}}));
  }
}

TEST_P(AgentContract, WhatAControllerRecordsIsShownInItsOrderIfItIsFiniteAndHasAName) {
  std::vector<Action> records;
  for (const auto& [name, value] : {std::pair(std::string("near"), 0.125),
                                    {"far", -1e300},
                                    {"", 1.0},
                                    {std::string(hal::kMaxRecordedName + 1, 'x'), 1.0},
                                    {"nan", std::numeric_limits<double>::quiet_NaN()},
                                    {"near", 0.25}}) {
    records.push_back({.what = Record{name, value, {}}});
  }
  brain(once(kMote, records));
  ASSERT_TRUE(until([&] { return sight().records(kMote).size() >= 3; }));
  ASSERT_TRUE(pass(3));
  const std::vector<std::pair<std::string, double>> good{
      {"near", 0.125}, {"far", -1e300}, {"near", 0.25}};
  EXPECT_EQ(sight().records(kMote), good);
  EXPECT_TRUE(sight().records(kRobot).empty());
  EXPECT_EQ(host_->end().refused, 3u);
}

/// A kind of sensor, as the robot of all hosts has it.
struct KindOfSensor {
  std::string kind;  ///< And name.
  std::uint16_t channel = 0;
  std::size_t values = 0;
  bool needs_a_world = false;
  std::function<bool(const std::vector<double>&)> is_plausible;
};

std::vector<KindOfSensor> kinds_of_sensors() {
  using Values = std::vector<double>;
  const auto close = [](double a, double b, double by) { return std::abs(a - b) < by; };
  return {{"battery", 16, 5, false,
           [=](const Values& v) {
             return close(v[0], 0.73, 0.01) && close(v[1], 12, 0.01) && close(v[3], 730, 10) &&
                    close(v[4], 1000, 1e-6);
           }},
          {"imu", 17, 6, false,
           [=](const Values& v) { return close(v[2], 0, 0.01) && close(v[5], 9.81, 0.05); }},
          {"pose", 18, 3, true,
           [=](const Values& v) { return close(v[0], 0, 0.01) && close(v[1], 0, 0.01); }},
          {"bumper", 19, 1, true, [](const Values& v) { return v[0] == 0; }},
          {"scan", 20, 90, true, [](const Values& v) {
             return std::ranges::all_of(v, [](double range) { return std::isnan(range); });
           }}};
}

TEST_P(AgentContract, EachKindOfSensorGivesTheValuesOfItsChannelToWhoAsksForIt) {
  hal::Wants wants;
  for (const KindOfSensor& sensor : kinds_of_sensors()) wants.optional.push_back(sensor.kind);
  const Brain& both = brain({}, wants);
  for (const KindOfSensor& sensor : kinds_of_sensors()) {
    if (sensor.needs_a_world && !promises().senses_the_world) continue;
    SCOPED_TRACE(sensor.kind);
    std::vector<double> values;
    ASSERT_TRUE(until([&] {
      for (const Event& control : both.seen(kRobot, Cause::kControl))
        for (const hal::node::exchange::Reading& reading : control.readings)
          if (reading.channel == sensor.channel && !reading.lost) values = reading.values;
      return !values.empty();
    }));
    ASSERT_EQ(values.size(), sensor.values);
    EXPECT_TRUE(sensor.is_plausible(values)) << values.front();
  }
  EXPECT_TRUE(both.seen(kMote, Cause::kControl).empty() ||
              both.seen(kMote, Cause::kControl).back().readings.empty())
      << "the mote has none";
}

TEST_P(AgentContract, ASensorThatNobodyAskedForGivesNothing) {
  const Brain& both = brain({}, {.channels = {}, .optional = {"imu"}});
  ASSERT_TRUE(until([&] {
    return std::ranges::any_of(both.seen(kRobot, Cause::kControl),
                               [](const Event& control) { return !control.readings.empty(); });
  }));
  for (const Event& control : both.seen(kRobot, Cause::kControl))
    for (const hal::node::exchange::Reading& reading : control.readings)
      EXPECT_EQ(reading.channel, 17);
}

INSTANTIATE_TEST_SUITE_P(Hosts, AgentContract,
                         testing::Values(simulator_in_process(), simulator_in_lock_step(),
                                         simulator_in_real_time(), two_daemons(),
                                         two_daemons_in_process()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace contract
