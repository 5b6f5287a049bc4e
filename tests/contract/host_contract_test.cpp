#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <utility>

#include "hal/node/exchange/courier.h"
#include "tests/contract/actions.h"
#include "tests/unit/gateway/exchange/child.h"

namespace contract {
namespace {

/// What every AgentHost has to keep to controller processes, seen through the gateway.
class HostContract : public testing::TestWithParam<Implementation> {
 protected:
  const Promises& promises() const { return GetParam().promises; }
  const Sight& sight() const { return host_->sight(); }
  int domain() const { return host_->domain().value(); }
  RemoteBrain& brain(const std::string& process, std::vector<std::string> agents,
                     Brain::Rule rule = {},
                     std::uint32_t version = hal::node::exchange::kProtocolVersion) {
    brains_.push_back(std::make_unique<RemoteBrain>(domain(), process, std::move(agents),
                                                    std::move(rule), hal::Wants{}, version));
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

  std::vector<std::unique_ptr<RemoteBrain>> brains_;  ///< They answer until the host has ended.
  std::unique_ptr<ContractHost> host_ = GetParam().make();
};

TEST_P(HostContract, RefusesWhoAsksForWhatIsNotThereOrTakenOrSpeaksAnotherVersion) {
  const RemoteBrain& first = brain("first", {"m0"});
  const RemoteBrain& robot = brain("robot", {"r0"});
  ASSERT_TRUE(until([&] { return !first.seen(kMote).empty() && !robot.seen(kRobot).empty(); }));
  const RemoteBrain& unknown = brain("unknown", {"x9"});
  const RemoteBrain& taken = brain("taken", {"m0"});
  const RemoteBrain& other = brain("other", {"m0"}, {}, hal::node::exchange::kProtocolVersion + 1);
  for (const RemoteBrain* refused : {&taken, &other}) {
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
  RemoteBrain& robot = brain("robot", {"r0"}, [](const Event& event) {
    return event.cause() == Cause::kControl ? std::vector{drive(0.2)} : std::vector<Action>{};
  });
  const RemoteBrain& mote = brain("mote", {"m0"});
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
  const auto to_halt =
      std::make_shared<std::atomic<RemoteBrain*>>(nullptr);  // Rules outlive the test.
  const auto asked = std::make_shared<std::atomic<hal::Time>>();
  RemoteBrain& robot = brain("robot", {"r0"}, [to_halt, asked](const Event& event) {
    std::vector<Action> actions;
    if (event.cause() != Cause::kControl || *to_halt == nullptr) return actions;
    *asked = event.time;
    to_halt->exchange(nullptr)->hold(true);
    actions.push_back(drive(0.2));
    return actions;
  });
  const RemoteBrain& mote = brain("mote", {"m0"});
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
  RemoteBrain& mote = brain("mote", {"m0"}, [mote_has_started](const Event&) {
    *mote_has_started = true;
    return std::vector<Action>{};
  });
  const RemoteBrain& robot =
      brain("robot", {"r0"}, [mote_has_started, id = 0u](const Event& event) mutable {
        std::vector<Action> actions;
        if (!*mote_has_started || event.cause() != Cause::kControl || id == 50) return actions;
        ++id;
        actions.push_back(send(kMote, id, {static_cast<std::uint8_t>(id)}));
        return actions;
      });
  ASSERT_TRUE(until([&] { return mote.seen(kMote, Cause::kMessage).size() >= 5; }));
  mote.hold(true);
  const std::size_t cycles = robot.seen(kRobot, Cause::kControl).size();
  // In lock-step time stands still meanwhile.
  ASSERT_TRUE(promises().waits_for_answers ||
              until([&] { return robot.seen(kRobot, Cause::kControl).size() >= cycles + 25; }));
  mote.hold(false);
  ASSERT_TRUE(until([&] { return mote.seen(kMote, Cause::kMessage).size() >= 50; }));
  const auto messages = mote.seen(kMote, Cause::kMessage);
  for (std::size_t i = 0; i < messages.size(); ++i) {
    EXPECT_EQ(std::get<MessageArrived>(messages[i].what).message.payload[0], i + 1);
  }
}

TEST_P(HostContract, WhatFindsNoRoomWhileAControllerIsHaltedIsCounted) {
  constexpr std::size_t kTimers = hal::node::exchange::Courier::kCapacity + 500;
  const auto to_halt = std::make_shared<std::atomic<RemoteBrain*>>(nullptr);
  const auto due = std::make_shared<std::atomic<hal::Time>>();
  RemoteBrain& robot = brain("robot", {"r0"}, [to_halt, due](const Event& event) {
    std::vector<Action> actions;
    if (event.cause() != Cause::kControl || *to_halt == nullptr) return actions;
    if (due->load() != hal::Time{}) {  // The cycle after the one that set the timers.
      to_halt->exchange(nullptr)->hold(true);
      return actions;
    }
    *due = event.time + 500ms;
    for (hal::TimerId id = 1; id <= kTimers; ++id) {
      actions.push_back({.what = SetTimer{id, *due}});
    }
    return actions;
  });
  const RemoteBrain& mote = brain("mote", {"m0"});
  *to_halt = &robot;
  ASSERT_TRUE(until([&] { return *to_halt == nullptr; }));
  ASSERT_TRUE(goes_on_until(mote, due->load() + 100ms));
  robot.hold(false);
  ASSERT_TRUE(until([&] { return robot.seen(kRobot, Cause::kTimer).size() >= kTimers - 1000; }));
  const std::size_t cycles = robot.seen(kRobot, Cause::kControl).size();
  ASSERT_TRUE(until([&] { return robot.seen(kRobot, Cause::kControl).size() >= cycles + 3; }));
  const std::size_t missed = kTimers - robot.seen(kRobot, Cause::kTimer).size();
  const std::uint64_t lost = host_->end().lost;
  EXPECT_EQ(missed == 0, promises().waits_for_answers);
  EXPECT_GE(lost, missed) << "control cycles may be among them";
}

TEST_P(HostContract, AnActionThatAnswersNoEventOfItsAgentTakesNoEffect) {
  const RemoteBrain& robot = brain("robot", {"r0"});
  brain("mote", {"m0"}, [done = false](const Event& event) mutable {
    std::vector<Action> actions;
    if (event.cause() != Cause::kControl || std::exchange(done, true)) return actions;
    actions.assign(3, {.what = SetState{"WRONG"}});
    actions[0].agent = kRobot;
    actions[1].agent = kMote;
    actions[1].event = 99;
    actions[2].agent = kNobody;
    actions.push_back({.what = SetState{"RIGHT"}});
    return actions;
  });
  ASSERT_TRUE(until([&] { return !sight().states(kMote).empty(); }));
  const std::size_t cycles = robot.seen(kRobot, Cause::kControl).size();
  ASSERT_TRUE(until([&] { return robot.seen(kRobot, Cause::kControl).size() > cycles + 2; }));
  EXPECT_EQ(sight().states(kMote), std::vector<std::string>{"RIGHT"});
  EXPECT_TRUE(sight().states(kRobot).empty());
}

TEST_P(HostContract, TheDeathOfAControllerStopsItsWheelsAndNothingElse) {
  const RemoteBrain& mote = brain("mote", {"m0"});
  const Child driver({"driver", std::to_string(domain()), "driver"});
  ASSERT_TRUE(until([&] { return sight().wheels_turn(); }));
  driver.signal(SIGKILL);
  EXPECT_TRUE(until([&] { return !sight().wheels_turn(); }));
  const std::size_t cycles = mote.seen(kMote, Cause::kControl).size();
  EXPECT_TRUE(until([&] { return mote.seen(kMote, Cause::kControl).size() > cycles + 10; }));
}

TEST_P(HostContract, ASuccessorIsStartedAnewOrRefused) {
  brain("mote", {"m0"});
  {
    const Child driver({"driver", std::to_string(domain()), "driver"});
    ASSERT_TRUE(until([&] { return sight().wheels_turn(); }));
  }
  const RemoteBrain& successor = brain("driver", {"r0"});
  if (promises().takes_successors) {
    ASSERT_TRUE(until([&] { return successor.seen(kRobot, Cause::kControl).size() > 5; }));
    EXPECT_EQ(successor.seen(kRobot).front().cause(), Cause::kStart);
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
  const RemoteBrain both(
      daemons->domain().value(), "both", {"r0", "m0"},
      [&, cycle = 0, started = 0](const Event& e) mutable {
        std::vector<Action> actions;
        started += e.cause() == Cause::kStart ? 1 : 0;
        if (started == 2 && e.agent == kRobot && e.cause() == Cause::kControl &&
            ++cycle % 20 == 0) {
          actions.push_back(send(kMote, ++sent));
        }
        return actions;
      },
      hal::Wants{});
  ASSERT_TRUE(until([&] { return both.steps() >= 10'000; }, 5 * kPatience));
  EXPECT_EQ(both.gaps(), 0u);
  const hal::MessageId so_far = sent;
  // Either daemon may be the first to tell the controller of what was sent last.
  ASSERT_TRUE(until([&] { return both.seen(kRobot, Cause::kNotice).size() >= so_far; }));
  ASSERT_TRUE(until([&] { return both.seen(kMote, Cause::kMessage).size() >= so_far; }));
  const auto messages = both.seen(kMote, Cause::kMessage);
  for (std::size_t i = 0; i < messages.size(); ++i) {
    EXPECT_EQ(std::get<MessageArrived>(messages[i].what).message.id, i + 1);
  }
}

}  // namespace
}  // namespace contract
