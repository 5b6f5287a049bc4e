#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <utility>

#include "hal/exchange/courier.h"
#include "tests/contract/brain.h"
#include "tests/contract/contract_host.h"
#include "tests/unit/hal/dds/child.h"

namespace contract {
namespace {

using namespace std::chrono_literals;
using hal::exchange::Action;
using hal::exchange::ActionKind;
using hal::exchange::Cause;
using hal::exchange::Event;

const hal::AgentId kNobody{99};
constexpr hal::Duration kPatience = 30s;  // of the wall clock: reached by a failing test only
constexpr hal::Duration kPeriod = 20ms, kCommandTimeout = 200ms;

template <class Condition>
[[nodiscard]] bool until(Condition condition, hal::Duration patience = kPatience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!condition() && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(2ms);
  return condition();
}

Action action_of(ActionKind kind, const std::string& text = {}) {
  Action action;
  action.kind = kind;
  action.text = text;
  return action;
}

Action send(hal::AgentId to, hal::MessageId id, hal::Bytes payload = {1, 2, 3}) {
  Action action = action_of(ActionKind::kSend);
  action.message_id = id;
  action.destination = to;
  action.topic = "test";
  action.payload = std::move(payload);
  return action;
}

Action drive(double vx) {
  Action action = action_of(ActionKind::kDriveBody);
  action.twist.vx = vx;
  return action;
}

/// Does something once, in the control cycle of an agent when everybody has a controller: a message
/// to an agent without one is lost.
Brain::Rule once(hal::AgentId agent, std::vector<Action> actions) {
  return [agent, actions, started = 0](const Event& event) mutable {
    if (event.cause == Cause::kStart) ++started;
    if (started < 2 || event.agent != agent || event.cause != Cause::kControl) {
      return std::vector<Action>{};
    }
    return std::exchange(actions, {});
  };
}

/// What every AgentHost has to keep, seen through the gateway.
class HostContract : public testing::TestWithParam<Implementation> {
 protected:
  const Promises& promises() const { return GetParam().promises; }
  const Sight& sight() const { return host_->sight(); }
  Brain& brain(const std::string& process, std::vector<std::string> agents, Brain::Rule rule = {},
               std::uint32_t version = hal::exchange::kProtocolVersion) {
    brains_.push_back(std::make_unique<Brain>(host_->domain(), process, std::move(agents),
                                              std::move(rule), version));
    return *brains_.back();
  }

  /// While another controller is halted: until it is later than `time`, by what the mote is told.
  /// In lock-step it never is.
  bool goes_on_until(const Brain& mote, hal::Time time) const {
    if (promises().waits_for_answers) return true;
    return until([&] {
      const auto cycles = mote.seen(kMote, Cause::kControl);
      return !cycles.empty() && cycles.back().time > time;
    });
  }

  std::vector<std::unique_ptr<Brain>> brains_;  ///< They answer until the host has ended.
  std::unique_ptr<ContractHost> host_ = GetParam().make();
};

TEST_P(HostContract, StartsEveryAgentOnceAndThenCallsItEveryControlPeriod) {
  const Brain& both = brain("both", {"r0", "m0"});
  for (const hal::AgentId agent : {kRobot, kMote}) {
    ASSERT_TRUE(until([&] { return both.seen(agent, Cause::kControl).size() >= 5; }));
    EXPECT_EQ(both.seen(agent).front().cause, Cause::kStart);
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

TEST_P(HostContract, TakesTheActionsOfAnAgentInTheirOrder) {
  std::vector<Action> states;
  for (const char* name : {"one", "two", "three", "four"}) {
    states.push_back(action_of(ActionKind::kState, name));
  }
  brain("both", {"r0", "m0"}, once(kMote, states));
  ASSERT_TRUE(until([&] { return sight().states(kMote).size() >= 4; }));
  EXPECT_EQ(sight().states(kMote), (std::vector<std::string>{"one", "two", "three", "four"}));
  EXPECT_TRUE(sight().states(kRobot).empty());
}

TEST_P(HostContract, ATimerComesOnceAndNotBeforeItsTime) {
  const Brain& both = brain("both", {"r0", "m0"}, [](const Event& event) {
    std::vector<Action> actions;
    if (event.agent != kRobot || event.cause != Cause::kStart) return actions;
    Action timer = action_of(ActionKind::kTimer);
    timer.timer = 7;
    timer.at = event.time + 70ms;
    actions.push_back(timer);
    return actions;
  });
  ASSERT_TRUE(until([&] { return !both.seen(kRobot, Cause::kTimer).empty(); }));
  ASSERT_TRUE(until([&] {
    const auto timers = both.seen(kRobot, Cause::kTimer);
    return both.seen(kRobot).back().time > timers.front().time + 200ms;
  }));
  const auto timers = both.seen(kRobot, Cause::kTimer);
  ASSERT_EQ(timers.size(), 1u);
  EXPECT_EQ(timers[0].timer, 7u);
  EXPECT_GE(timers[0].time - both.seen(kRobot).front().time, 70ms);
  EXPECT_TRUE(both.seen(kMote, Cause::kTimer).empty());
}

TEST_P(HostContract, AMessageArrivesAsItWasSentAndItsSenderIsToldOnce) {
  const hal::Bytes payload{0, 255, 7, 0};
  const Brain& both = brain("both", {"r0", "m0"}, once(kRobot, {send(kMote, 1, payload)}));
  ASSERT_TRUE(until([&] { return !both.seen(kMote, Cause::kMessage).empty(); }));
  ASSERT_TRUE(until([&] { return !both.seen(kRobot, Cause::kNotice).empty(); }));
  const Event arrived = both.seen(kMote, Cause::kMessage)[0];
  ASSERT_TRUE(arrived.message);
  EXPECT_EQ(arrived.message->source, kRobot);
  EXPECT_EQ(arrived.message->destination, kMote);
  EXPECT_EQ(arrived.message->topic, "test");
  EXPECT_EQ(arrived.message->payload, payload);
  const std::size_t cycles = both.seen(kRobot, Cause::kControl).size();
  ASSERT_TRUE(until([&] { return both.seen(kRobot, Cause::kControl).size() >= cycles + 10; }));
  EXPECT_EQ(both.seen(kMote, Cause::kMessage).size(), 1u);
  const auto notices = both.seen(kRobot, Cause::kNotice);
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_EQ(notices[0].noticed, 1u);
  EXPECT_EQ(notices[0].fate, hal::Fate::kHandedOver);
}

TEST_P(HostContract, AMessageToNobodyEndsWithNoRoute) {
  const Brain& both = brain("both", {"r0", "m0"}, once(kMote, {send(kNobody, 1)}));
  ASSERT_TRUE(until([&] { return !both.seen(kMote, Cause::kNotice).empty(); }));
  const auto notices = both.seen(kMote, Cause::kNotice);
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_EQ(notices[0].fate, hal::Fate::kNoRoute);
}

TEST_P(HostContract, AControllerSeesTheRoutesOfWhatItWatches) {
  const Brain& both = brain("both", {"r0", "m0"}, once(kRobot, {send(kMote, 1)}));
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

TEST_P(HostContract, RefusesWhoAsksForWhatIsNotThereOrTakenOrSpeaksAnotherVersion) {
  const Brain& first = brain("first", {"m0"});
  const Brain& robot = brain("robot", {"r0"});
  ASSERT_TRUE(until([&] { return !first.seen(kMote).empty() && !robot.seen(kRobot).empty(); }));
  const Brain& unknown = brain("unknown", {"x9"});
  const Brain& taken = brain("taken", {"m0"});
  const Brain& other = brain("other", {"m0"}, {}, hal::exchange::kProtocolVersion + 1);
  for (const Brain* refused : {&taken, &other}) {
    EXPECT_TRUE(until([&] { return !refused->refusal().empty(); }));
    EXPECT_EQ(refused->steps(), 0u);
  }
  // One of several servers says nothing to who does not ask for what it has: another one may.
  if (!promises().has_neighbours) {
    EXPECT_TRUE(until([&] { return !unknown.refusal().empty(); }));
  }
  EXPECT_EQ(unknown.steps(), 0u);
  const std::size_t cycles = first.seen(kMote, Cause::kControl).size();
  EXPECT_TRUE(until([&] { return first.seen(kMote, Cause::kControl).size() > cycles + 5; }));
}

TEST_P(HostContract, WheelsStopWhenNobodyAnswersAndTurnAgainWhenSomebodyDoes) {
  Brain& robot = brain("robot", {"r0"}, [](const Event& event) {
    return event.cause == Cause::kControl ? std::vector{drive(0.2)} : std::vector<Action>{};
  });
  const Brain& mote = brain("mote", {"m0"});
  ASSERT_TRUE(until([&] { return sight().wheels_turn(); }));
  robot.hold(true);
  if (promises().waits_for_answers) {
    std::this_thread::sleep_for(2 * kCommandTimeout);
    const std::size_t cycles = mote.seen(kMote, Cause::kControl).size();
    std::this_thread::sleep_for(4 * kPeriod);
    EXPECT_EQ(mote.seen(kMote, Cause::kControl).size(), cycles) << "time has gone on";
  } else {
    EXPECT_TRUE(until([&] { return !sight().wheels_turn(); }));
  }
  robot.hold(false);
  EXPECT_TRUE(until([&] { return sight().wheels_turn(); }));
}

TEST_P(HostContract, ACommandThatAnswersWhatIsLongPastMovesNothing) {
  const auto to_halt = std::make_shared<std::atomic<Brain*>>(nullptr);  // Rules outlive the test.
  const auto asked = std::make_shared<std::atomic<hal::Time>>();
  Brain& robot = brain("robot", {"r0"}, [to_halt, asked](const Event& event) {
    std::vector<Action> actions;
    if (event.cause != Cause::kControl || *to_halt == nullptr) return actions;
    *asked = event.time;
    to_halt->exchange(nullptr)->hold(true);
    actions.push_back(drive(0.2));
    return actions;
  });
  const Brain& mote = brain("mote", {"m0"});
  *to_halt = &robot;
  ASSERT_TRUE(until([&] { return *to_halt == nullptr; }));
  ASSERT_TRUE(goes_on_until(mote, asked->load() + 2 * kCommandTimeout));
  const std::size_t cycles = robot.seen(kRobot, Cause::kControl).size();
  robot.hold(false);
  ASSERT_TRUE(until([&] { return robot.seen(kRobot, Cause::kControl).size() >= cycles + 10; }));
  EXPECT_EQ(sight().wheels_turn(), promises().waits_for_answers);
}

TEST_P(HostContract, WhatComesWhileAControllerIsBusyReachesItInOrder) {
  const auto mote_has_started = std::make_shared<std::atomic<bool>>(false);
  Brain& mote = brain("mote", {"m0"}, [mote_has_started](const Event&) {
    *mote_has_started = true;
    return std::vector<Action>{};
  });
  brain("robot", {"r0"}, [mote_has_started, id = 0u](const Event& event) mutable {
    std::vector<Action> actions;
    if (!*mote_has_started || event.cause != Cause::kControl || id == 50) return actions;
    ++id;
    actions.push_back(send(kMote, id, {static_cast<std::uint8_t>(id)}));
    return actions;
  });
  ASSERT_TRUE(until([&] { return mote.seen(kMote, Cause::kMessage).size() >= 5; }));
  mote.hold(true);
  std::this_thread::sleep_for(500ms);
  mote.hold(false);
  ASSERT_TRUE(until([&] { return mote.seen(kMote, Cause::kMessage).size() >= 50; }));
  const auto messages = mote.seen(kMote, Cause::kMessage);
  for (std::size_t i = 0; i < messages.size(); ++i) {
    EXPECT_EQ(messages[i].message->payload[0], i + 1);
  }
}

TEST_P(HostContract, WhatFindsNoRoomWhileAControllerIsHaltedIsCounted) {
  constexpr std::size_t kTimers = hal::exchange::Courier::kCapacity + 500;
  const auto to_halt = std::make_shared<std::atomic<Brain*>>(nullptr);
  const auto due = std::make_shared<std::atomic<hal::Time>>();
  Brain& robot = brain("robot", {"r0"}, [to_halt, due](const Event& event) {
    std::vector<Action> actions;
    if (event.cause != Cause::kControl || *to_halt == nullptr) return actions;
    if (due->load() != hal::Time{}) {  // The cycle after the one that set the timers.
      to_halt->exchange(nullptr)->hold(true);
      return actions;
    }
    *due = event.time + 500ms;
    for (hal::TimerId id = 1; id <= kTimers; ++id) {
      actions.push_back(action_of(ActionKind::kTimer));
      actions.back().timer = id;
      actions.back().at = *due;
    }
    return actions;
  });
  const Brain& mote = brain("mote", {"m0"});
  *to_halt = &robot;
  ASSERT_TRUE(until([&] { return *to_halt == nullptr; }));
  ASSERT_TRUE(goes_on_until(mote, due->load() + 100ms));
  robot.hold(false);
  ASSERT_TRUE(until([&] { return robot.seen(kRobot, Cause::kTimer).size() >= kTimers - 1000; }));
  const std::size_t cycles = robot.seen(kRobot, Cause::kControl).size();
  ASSERT_TRUE(until([&] { return robot.seen(kRobot, Cause::kControl).size() >= cycles + 3; }));
  const std::size_t missed = kTimers - robot.seen(kRobot, Cause::kTimer).size();
  const std::uint64_t lost = host_->end();
  EXPECT_EQ(missed == 0, promises().waits_for_answers);
  EXPECT_GE(lost, missed) << "control cycles may be among them";
}

TEST_P(HostContract, OneProcessMayDriveEverybodyAndNoStepIsMissing) {
  const Brain& both = brain("both", {"r0", "m0"});
  ASSERT_TRUE(until([&] { return both.steps() >= 60; }));
  EXPECT_EQ(both.gaps(), 0u);
}

TEST_P(HostContract, TheDeathOfAControllerStopsItsWheelsAndNothingElse) {
  const Brain& mote = brain("mote", {"m0"});
  const Child driver({"driver", std::to_string(host_->domain()), "driver"});
  ASSERT_TRUE(until([&] { return sight().wheels_turn(); }));
  driver.signal(SIGKILL);
  EXPECT_TRUE(until([&] { return !sight().wheels_turn(); }));
  const std::size_t cycles = mote.seen(kMote, Cause::kControl).size();
  EXPECT_TRUE(until([&] { return mote.seen(kMote, Cause::kControl).size() > cycles + 10; }));
}

TEST_P(HostContract, ASuccessorIsStartedAnewOrRefused) {
  brain("mote", {"m0"});
  {
    const Child driver({"driver", std::to_string(host_->domain()), "driver"});
    ASSERT_TRUE(until([&] { return sight().wheels_turn(); }));
  }
  const Brain& successor = brain("driver", {"r0"});
  if (promises().takes_successors) {
    ASSERT_TRUE(until([&] { return successor.seen(kRobot, Cause::kControl).size() > 5; }));
    EXPECT_EQ(successor.seen(kRobot).front().cause, Cause::kStart);
  } else {
    EXPECT_TRUE(until([&] { return !successor.refusal().empty(); }));
  }
}

INSTANTIATE_TEST_SUITE_P(Hosts, HostContract,
                         testing::Values(simulator_in_lock_step(), simulator_in_real_time(),
                                         two_daemons()),
                         [](const auto& tested) { return tested.param.name; });

/// One process, two servers, as fast as it goes.
TEST(TwoDaemons, OneControllerProcessLosesNoEventInTenThousandExchanges) {
  const auto daemons = two_daemons(1ms).make();
  std::atomic<hal::MessageId> sent = 0;
  const Brain both(
      daemons->domain(), "both", {"r0", "m0"}, [&, cycle = 0, started = 0](const Event& e) mutable {
        std::vector<Action> actions;
        started += e.cause == Cause::kStart ? 1 : 0;
        if (started == 2 && e.agent == kRobot && e.cause == Cause::kControl && ++cycle % 20 == 0) {
          actions.push_back(send(kMote, ++sent));
        }
        return actions;
      });
  ASSERT_TRUE(until([&] { return both.steps() >= 10'000; }, 5 * kPatience));
  EXPECT_EQ(both.gaps(), 0u);
  const hal::MessageId so_far = sent;
  ASSERT_TRUE(until([&] { return both.seen(kRobot, Cause::kNotice).size() >= so_far; }));
  const auto messages = both.seen(kMote, Cause::kMessage);
  ASSERT_GE(messages.size(), so_far);
  for (std::size_t i = 0; i < messages.size(); ++i) EXPECT_EQ(messages[i].message->id, i + 1);
}

}  // namespace
}  // namespace contract
