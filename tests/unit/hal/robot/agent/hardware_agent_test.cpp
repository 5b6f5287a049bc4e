#include "hal/robot/agent/hardware_agent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "hal/node/devices/robot_outline.h"
#include "hal/robot/drivers/iio.h"
#include "tests/support/fake_clock.h"
#include "tests/unit/hal/robot/agent/fakes.h"

namespace hal::robot::agent {
namespace {

using namespace std::chrono_literals;
using node::exchange::Action;
using node::exchange::Cause;
using node::exchange::Event;
using node::exchange::MessageArrived;
using node::exchange::Notice;
using node::exchange::Send;
using node::exchange::SetState;
using node::exchange::SetTimer;
using node::exchange::TimerDue;

constexpr Duration kPatience = 30s;  // reached by a failing test only
constexpr Duration kPeriod = 10ms, kTimeout = 300ms;

RobotFile file_of(int agent) {
  RobotFile file;
  file.name = "a" + std::to_string(agent);
  file.address = AgentId{static_cast<std::uint16_t>(agent)};
  file.control_period = kPeriod;
  file.command_timeout = kTimeout;
  file.routing.jitter_max = 1ms;
  file.localisation.map = {{AgentId{7}, "m7", {1, 2}}};
  return file;
}

/// A robot with all devices; some tests give it a neighbour. Time passes only while it waits.
class HardwareAgents : public testing::Test {
 protected:
  explicit HardwareAgents(Clock* clock = nullptr) : loop_(clock == nullptr ? clock_ : *clock) {}

  struct Node {
    Node(platform::EventLoop& loop, int agent, std::uint16_t port, Devices devices)
        : file(file_of(agent)),
          link({.self = file.address,
                .interface = "lo",
                .address = "127.0.78." + std::to_string(agent),
                .port = port},
               loop) {
      if (devices.wheels != nullptr) {
        file.kind = AgentKind::kRobot;
        file.robot.emplace();
        file.robot->wheels = drivers::three_wheels();
        file.robot->infrared.resize(1);
        file.infrared =
            std::make_shared<drivers::ChosenDriver<drivers::InfraredDriver, drivers::IioSettings>>(
                drivers::IioSettings{}, drivers::make_iio_infrared);
      }
      agent_.emplace(file, HardwareAgent::Surroundings{loop, link, devices, observer});
    }
    HardwareAgent& agent() { return *agent_; }

    RobotFile file;
    radio::UdpLink link;
    node::agent::AgentObserver observer;
    std::optional<HardwareAgent> agent_;
  };

  void SetUp() override { log::set_level(log::Level::kError); }

  HardwareAgent& agent() { return robot_.agent(); }
  std::shared_ptr<ScriptedPort> connect(Node& node, const Wants& wants,
                                        ScriptedPort::Rule behaviour = {}) {
    auto port = std::make_shared<ScriptedPort>(std::move(behaviour));
    node.agent().connect(port, {node.file.address}, wants);
    return port;
  }

  template <class Condition>
  [[nodiscard]] bool until(Condition condition) {
    const Time end = loop_.now() + kPatience;
    while (!condition() && loop_.now() < end) loop_.run_once(5ms);
    return condition();
  }
  void run_for(Duration time) {
    const Time end = loop_.now() + time;
    while (loop_.now() < end) loop_.run_once(end - loop_.now());
  }

  tests::FakeClock clock_;
  platform::EventLoop loop_;
  RecordedWheels wheels_;
  FixedInfrared infrared_;
  StaticPose pose_{{1, 1, 0}};
  Node robot_{loop_, 1, 0, {&wheels_, &infrared_, &pose_}};
};

TEST_F(HardwareAgents, OffersTheChannelsOfASimulatedRobot) {
  const auto offers = agent().offers();
  ASSERT_EQ(offers.size(), 1u);
  const node::exchange::AgentSession& session = offers[0].session;
  EXPECT_EQ(session.agent, AgentId{1});
  EXPECT_EQ(session.kind, AgentKind::kRobot);
  EXPECT_EQ(session.control_period, kPeriod);
  EXPECT_EQ(session.limits.body_to_wheel.size(), 3u);
  EXPECT_EQ(session.body, node::devices::body_of(*robot_.file.robot));
  // The table in hal/types/channel.h.
  std::vector<std::string> found;
  for (const Channel& c : session.channels) found.push_back(c.name + "|" + c.kind + "|" + c.unit);
  EXPECT_EQ(found, (std::vector<std::string>{"localisation|relative_position|address, m",
                                             "odometry|odometry|m, rad, m/s", "infrared|range|m",
                                             "infrared_volts|voltage|V"}));
  EXPECT_EQ(session.channels[2].headings.size(), session.channels[2].length);
}

TEST_F(HardwareAgents, KnowsItselfAndTheAgentsOnItsMapByName) {
  EXPECT_EQ(agent().directory(), (std::vector<node::exchange::AgentName>{
                                     {AgentId{1}, robot_.file.name}, {AgentId{7}, "m7"}}));
}

TEST_F(HardwareAgents, AMoteOffersNeitherWheelsNorWhatItLacks) {
  Node mote(loop_, 2, robot_.link.port(), {});
  const node::exchange::AgentSession session = mote.agent().offers()[0].session;
  EXPECT_EQ(session.kind, AgentKind::kMote);
  EXPECT_TRUE(session.limits.body_to_wheel.empty());
  EXPECT_TRUE(session.channels.empty());
}

TEST_F(HardwareAgents, AControllerGetsStartAndThenItsControlCycleWithWhatItAskedFor) {
  const auto port = connect(robot_, {.channels = {"infrared", "localisation"}});
  ASSERT_TRUE(until([&] { return port->of(Cause::kControl).size() >= 5; }));
  EXPECT_EQ(port->seen.front().cause(), Cause::kStart);
  EXPECT_EQ(port->of(Cause::kStart).size(), 1u);
  const Event control = port->of(Cause::kControl).front();
  ASSERT_EQ(control.readings.size(), 2u);
  EXPECT_EQ(control.readings[0], (node::exchange::Reading{0, {7, 0, 1}}))
      << "m7 is 1 m to the left";
  EXPECT_EQ(control.readings[1], (node::exchange::Reading{2, {0.25}}));
  for (std::size_t i = 1; i < port->seen.size(); ++i) {
    EXPECT_GE(port->seen[i].time, port->seen[i - 1].time);
  }
}

TEST_F(HardwareAgents, ActionsTakeEffectInTheOrderTheyWereMade) {
  const auto port = connect(robot_, {}, [](const Event& event) -> std::vector<Action> {
    if (event.cause() != Cause::kStart) return {};
    return {drive_action({0.1, 0, 0}), drive_action({0.2, 0, 0})};
  });
  ASSERT_TRUE(until([&] { return wheels_.commands == 2; }));
  EXPECT_EQ(wheels_.twist, (Twist2{0.2, 0, 0}));
}

TEST_F(HardwareAgents, AControllerThatIsBusyLosesItsWheelsButNoMessage) {
  const auto port = connect(robot_, {}, [](const Event& event) -> std::vector<Action> {
    if (event.cause() != Cause::kControl) return {};
    return {drive_action({0.1, 0, 0})};
  });
  ASSERT_TRUE(until([&] { return wheels_.commands > 0; }));
  port->answers = 0;
  for (MessageId i = 1; i <= 100; ++i) {
    agent().core().on_message({AgentId{2}, AgentId{1}, i, "test", {}}, 1);
  }
  ASSERT_TRUE(until([&] { return wheels_.twist == Twist2{}; }));
  run_for(3 * kPeriod);
  port->answers.reset();
  ASSERT_TRUE(until([&] { return port->of(Cause::kMessage).size() == 100; }));
  EXPECT_EQ(agent().guard()->counts().silences, 1u);
  EXPECT_GE(agent().counts().missed_cycles, 1u) << "its cycles are superseded, and counted";
  EXPECT_EQ(agent().counts().overflow, 0u);
}

TEST_F(HardwareAgents, WhenTheControllerDiesTheWheelsStopAndAnotherOneBeginsAnew) {
  const auto drives = [](const Event&) { return std::vector{drive_action({0.1, 0, 0})}; };
  const auto first = connect(robot_, {}, drives);
  ASSERT_TRUE(until([&] { return wheels_.commands > 0; }));
  first->dead = true;
  ASSERT_TRUE(until([&] { return !agent().has_controller(); }));
  EXPECT_EQ(wheels_.twist, Twist2{});
  run_for(2 * kPeriod);
  EXPECT_EQ(wheels_.twist, Twist2{});
  const auto second = connect(robot_, {}, drives);
  ASSERT_TRUE(until([&] { return wheels_.twist != Twist2{}; }));
  EXPECT_EQ(second->seen.front().cause(), Cause::kStart);
  EXPECT_EQ(agent().counts().controllers, 2u);
}

TEST_F(HardwareAgents, TimersOfAControllerRunAndDieWithIt) {
  const auto sets_timer = [this](const Event& event) -> std::vector<Action> {
    if (event.cause() != Cause::kStart) return {};
    return {{.what = SetTimer{5, event.time + 3 * kPeriod}}};
  };
  const auto first = connect(robot_, {}, sets_timer);
  ASSERT_TRUE(until([&] { return !first->of(Cause::kTimer).empty(); }));
  EXPECT_EQ(first->of(Cause::kTimer).front().what, Event::What(TimerDue{5}));
  EXPECT_GE(first->of(Cause::kTimer).front().time, first->seen.front().time + 3 * kPeriod);
  agent().disconnect({AgentId{1}});
  (void)connect(robot_, {}, sets_timer);
  run_for(kPeriod);
  agent().disconnect({AgentId{1}});
  const auto third = connect(robot_, {});
  run_for(6 * kPeriod);
  EXPECT_TRUE(third->of(Cause::kTimer).empty());
}

TEST_F(HardwareAgents, WithoutAnInfraredReadingTheRobotStands) {
  (void)connect(robot_, {.channels = {"infrared"}}, [](const Event&) {
    return std::vector{drive_action({0.1, 0, 0})};
  });
  ASSERT_TRUE(until([&] { return wheels_.twist != Twist2{}; }));
  infrared_.metres.reset();
  ASSERT_TRUE(until([&] { return wheels_.twist == Twist2{}; }));
  run_for(3 * kPeriod);
  EXPECT_EQ(wheels_.twist, Twist2{});
  infrared_.metres = 1;
  EXPECT_TRUE(until([&] { return wheels_.twist != Twist2{}; }));
}

/// The channels that the last control cycle marked as lost.
std::vector<std::uint16_t> lost_of(const ScriptedPort& port) {
  std::vector<std::uint16_t> lost;
  const auto cycles = port.of(Cause::kControl);
  if (cycles.empty()) return lost;
  for (const node::exchange::Reading& reading : cycles.back().readings) {
    if (reading.lost) lost.push_back(reading.channel);
  }
  return lost;
}

TEST_F(HardwareAgents, WithoutOdometryTheRobotStandsIfTheControllerAskedForIt) {
  const auto port = connect(robot_, {.channels = {"odometry", "infrared_volts"}}, [](const Event&) {
    return std::vector{drive_action({0.1, 0, 0})};
  });
  ASSERT_TRUE(until([&] { return wheels_.twist != Twist2{}; }));
  EXPECT_TRUE(lost_of(*port).empty());
  wheels_.odometry = false;
  ASSERT_TRUE(until([&] { return wheels_.twist == Twist2{}; }));
  ASSERT_TRUE(until([&] { return lost_of(*port) == std::vector<std::uint16_t>{1}; }));
  EXPECT_EQ(wheels_.twist, Twist2{});
  infrared_.metres.reset();
  ASSERT_TRUE(until([&] { return lost_of(*port) == (std::vector<std::uint16_t>{1, 3}); }));
  wheels_.odometry = true;
  run_for(3 * kPeriod);
  EXPECT_EQ(wheels_.twist, Twist2{}) << "the other one is still away";
  infrared_.metres = 1;
  ASSERT_TRUE(until([&] { return wheels_.twist != Twist2{}; }));
  EXPECT_TRUE(lost_of(*port).empty());
}

TEST_F(HardwareAgents, WithoutOdometryItDrivesOnIfTheFileSaysSoOrNobodyAskedForIt) {
  const auto drives = [](const Event&) { return std::vector{drive_action({0.1, 0, 0})}; };
  wheels_.odometry = false;
  {
    const auto port = connect(robot_, {.channels = {"infrared"}}, drives);
    ASSERT_TRUE(until([&] { return wheels_.twist != Twist2{}; }));
    agent().disconnect({AgentId{1}});
    ASSERT_TRUE(until([&] { return wheels_.twist == Twist2{}; }));
  }
  robot_.file.on_lost_sensor = OnLostSensor::kIgnore;
  const auto port = connect(robot_, {.channels = {"odometry"}}, drives);
  ASSERT_TRUE(until([&] { return lost_of(*port) == std::vector<std::uint16_t>{1}; }));
  EXPECT_TRUE(until([&] { return wheels_.twist != Twist2{}; }));
  EXPECT_EQ(agent().guard()->counts().blind, 0u);
}

TEST_F(HardwareAgents, WithoutAChannelThatTheControllerCanDoWithoutItDrivesOn) {
  const auto port =
      connect(robot_, {.channels = {"infrared"}, .optional = {"odometry"}}, [](const Event&) {
        return std::vector{drive_action({0.1, 0, 0})};
      });
  ASSERT_TRUE(until([&] { return wheels_.twist != Twist2{}; }));
  wheels_.odometry = false;
  ASSERT_TRUE(until([&] { return lost_of(*port) == std::vector<std::uint16_t>{1}; }));
  run_for(3 * kPeriod);
  EXPECT_NE(wheels_.twist, Twist2{});
  EXPECT_EQ(agent().guard()->counts().blind, 0u);
}

TEST_F(HardwareAgents, EachControllerMayUseSoManyTopicsAndNoMore) {
  const auto invent = [count = 0](const Event& event) mutable {
    std::vector<Action> actions;
    if (event.cause() != Cause::kStart) return actions;
    for (std::size_t i = 0; i < kMaxTopics + 3; ++i) {
      actions.push_back({.what = Send{.id = static_cast<MessageId>(i + 1),
                                      .destination = AgentId{2},
                                      .topic = "topic " + std::to_string(++count),
                                      .payload = {}}});
    }
    return actions;
  };
  for (std::uint64_t controllers = 1; controllers <= 2; ++controllers) {
    const auto port = connect(robot_, {}, invent);
    EXPECT_TRUE(until([&] { return agent().counts().refused_actions == 3 * controllers; }));
    agent().disconnect({AgentId{1}});
  }
}

TEST_F(HardwareAgents, ACommandIsAsOldAsTheAnswerItCameWith) {
  const auto port = connect(robot_, {}, [](const Event&) {
    return std::vector{drive_action({0.1, 0, 0})};
  });
  ASSERT_TRUE(until([&] { return wheels_.commands > 3; }));
  EXPECT_EQ(wheels_.as_of, loop_.on_boot_clock(loop_.now()));
  EXPECT_EQ(wheels_.kept, wheels_.as_of) << "one reading of the clock for the whole answer";
}

TEST_F(HardwareAgents, StopStandsTheWheelsFirstAndThenTellsTheController) {
  const auto port = connect(robot_, {}, [](const Event& event) -> std::vector<Action> {
    if (event.cause() == Cause::kStop) {
      return {drive_action({0.3, 0, 0}), {.what = SetState{"BYE"}}};
    }
    return {drive_action({0.1, 0, 0})};
  });
  ASSERT_TRUE(until([&] { return wheels_.twist != Twist2{}; }));
  agent().stop();
  EXPECT_EQ(wheels_.twist, Twist2{}) << "before anything else";
  ASSERT_TRUE(until([&] { return agent().is_over(); }));
  EXPECT_EQ(port->seen.back().cause(), Cause::kStop);
  EXPECT_EQ(wheels_.twist, Twist2{}) << "after STOP nobody drives";
}

TEST_F(HardwareAgents, WhatIsMalformedIsRefusedAndCounted) {
  (void)connect(robot_, {}, [](const Event& event) -> std::vector<Action> {
    if (event.cause() != Cause::kStart) return {};
    const Send long_topic{1, AgentId{2}, std::string(kMaxTopic + 1, 'x'), {}};
    return {send_action(AgentId{1}, 1),
            send_action(AgentId{2}, 2, Bytes(kMaxPayload + 1)),
            {.what = long_topic},
            drive_action({std::nan(""), 0, 0})};
  });
  EXPECT_TRUE(until([&] { return agent().counts().refused_actions == 4; }));
}

/// A robot and a mote that talk over real sockets, which take their time.
class TwoAgents : public HardwareAgents {
 protected:
  TwoAgents() : HardwareAgents(&platform::boot_clock()) {}

  Node mote_{loop_, 2, robot_.link.port(), {}};
};

TEST_F(TwoAgents, AMessageFindsItsWayAndItsSenderHearsOfIt) {
  const auto sender = connect(mote_, {}, [](const Event& event) -> std::vector<Action> {
    if (event.cause() != Cause::kStart) return {};
    return {send_action(AgentId{1}, 1, {9, 8, 7})};
  });
  const auto receiver = connect(robot_, {});
  ASSERT_TRUE(until([&] {
    return !receiver->of(Cause::kMessage).empty() && !sender->of(Cause::kNotice).empty();
  }));
  const Message message =
      std::get<MessageArrived>(receiver->of(Cause::kMessage).front().what).message;
  EXPECT_EQ(message.source, AgentId{2});
  EXPECT_EQ(message.payload, (Bytes{9, 8, 7}));
  EXPECT_EQ(sender->of(Cause::kNotice).front().what, Event::What(Notice{1, Fate::kHandedOver}));
}

TEST_F(TwoAgents, ALateControllerIsToldTheRoutesAndNeighboursThatWereFoundBeforeIt) {
  const auto first = connect(mote_, {}, [](const Event& event) -> std::vector<Action> {
    if (event.cause() != Cause::kStart) return {};
    return {send_action(AgentId{1}, 1)};
  });
  ASSERT_TRUE(until([&] { return !first->of(Cause::kNotice).empty(); }));
  mote_.agent().disconnect({AgentId{2}});
  const auto second = connect(mote_, {.watched = {"test"}, .neighbours = true});
  ASSERT_TRUE(until([&] { return !second->seen.empty(); }));
  const Event start = second->seen.front();
  ASSERT_FALSE(start.routes.empty());
  EXPECT_EQ(start.routes.front().route.destination, AgentId{1});
  ASSERT_EQ(start.neighbours.size(), 1u);
  EXPECT_EQ(start.neighbours.front().id, AgentId{1});
}

TEST_F(TwoAgents, ANewControllerIsNotToldTheFatesOfTheOneBeforeIt) {
  const auto sends_to_nobody = [](const Event& event) -> std::vector<Action> {
    if (event.cause() != Cause::kStart) return {};
    return {send_action(AgentId{99}, 1)};
  };
  mote_.file.routing.retries = 1;
  const auto first = connect(mote_, {}, sends_to_nobody);
  run_for(2 * kPeriod);
  mote_.agent().disconnect({AgentId{2}});
  const auto second = connect(mote_, {}, [](const Event& event) -> std::vector<Action> {
    if (event.cause() != Cause::kStart) return {};
    return {send_action(AgentId{1}, 1)};
  });
  ASSERT_TRUE(until([&] { return !second->of(Cause::kNotice).empty(); }));
  run_for(5 * kPeriod);
  ASSERT_EQ(second->of(Cause::kNotice).size(), 1u);
  EXPECT_EQ(std::get<Notice>(second->of(Cause::kNotice).front().what).fate, Fate::kHandedOver);
}

TEST_F(TwoAgents, AThousandMessagesArriveOnceEachAndInOrder) {
  constexpr MessageId kMessages = 1000;
  MessageId next = 0;
  const auto sender = connect(mote_, {}, [&](const Event& event) -> std::vector<Action> {
    std::vector<Action> actions;
    if (event.cause() == Cause::kStart) actions.push_back(send_action(AgentId{1}, ++next));
    if (event.cause() == Cause::kNotice && next < kMessages) {
      actions.push_back(send_action(AgentId{1}, ++next));
    }
    return actions;
  });
  MessageId received = 0;
  const auto receiver = connect(robot_, {}, [&](const Event& event) {
    received += event.cause() == Cause::kMessage ? 1 : 0;
    return std::vector<Action>{};
  });
  ASSERT_TRUE(until([&] { return received >= kMessages; }));
  const auto messages = receiver->of(Cause::kMessage);
  ASSERT_EQ(messages.size(), kMessages);
  for (MessageId i = 0; i < kMessages; ++i) {
    EXPECT_EQ(std::get<MessageArrived>(messages[i].what).message.id, i + 1);
  }
}

}  // namespace
}  // namespace hal::robot::agent
