#include "gateway/server/server.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "gateway/exchange/client.h"
#include "hal/types/log.h"
#include "tests/support/test_domain.h"
#include "tests/unit/gateway/server/offers.h"

namespace gateway::server {
namespace {

using exchange::Client;
using hal::node::exchange::Action;
using hal::node::exchange::Session;
using hal::node::exchange::Step;

constexpr hal::Duration kPatience = std::chrono::seconds{30};
const auto kGoOn = [] { return hal::Result<void>{}; };

/// Keeps what it is connected with.
class FakeHost : public hal::node::exchange::AgentHost {
 public:
  std::vector<hal::node::exchange::AgentOffer> offers() const override { return sample_offers(); }
  std::vector<hal::node::exchange::AgentName> directory() const override { return directory_; }
  void connect(std::shared_ptr<hal::node::exchange::ControllerPort> port,
               const std::vector<hal::AgentId>& agents, const hal::Wants& wants) override {
    wants_.push_back(wants);
    agents_.push_back(agents);
    ports_.push_back(std::move(port));
  }
  std::vector<std::shared_ptr<hal::node::exchange::ControllerPort>> ports_;
  std::vector<std::vector<hal::AgentId>> agents_;
  std::vector<hal::Wants> wants_;
  std::vector<hal::node::exchange::AgentName> directory_ = {{hal::AgentId{1}, "m1"},
                                                            {hal::AgentId{7}, "x"}};
};

hal::node::exchange::Hello robot_hello(const std::string& process) {
  hal::node::exchange::Hello hello = hello_for(process, {"r0"});
  hello.program = "driver";
  hello.kind = hal::AgentKind::kRobot;
  hello.wants.channels = {"infrared"};
  return hello;
}

/// A server of sample_offers(): motes 1, 2, 3 and robot 4.
class ServedHost : public testing::Test {
 protected:
  hal::Result<void> gather() { return server_.gather(kGoOn); }

  static std::string refusal_of(Client& client) {
    const auto arrival = client.next(kPatience);
    const auto* session = std::get_if<Session>(&arrival);
    return session != nullptr ? session->refusal : "nothing came";
  }

  /// One exchange over the first port; `answer` makes the Reply's actions.
  template <class F>
  std::vector<Action> exchange(Client& client, const Step& step, F&& answer) {
    EXPECT_TRUE(host_.ports_.at(0)->begin(step));
    exchange::Arrival arrival = client.next(kPatience);
    if (std::holds_alternative<Session>(arrival)) arrival = client.next(kPatience);
    const Step received = std::get<Step>(arrival);
    hal::node::exchange::Reply reply;
    reply.run = received.run;
    reply.sequence = received.sequence;
    reply.actions = answer();
    EXPECT_TRUE(client.reply(received.server, reply));
    return host_.ports_.at(0)->finish()->actions;
  }

  FakeHost host_;
  AgentServer server_{process::take_domain(test_domain()), host_, {.run = 3, .wait = kPatience}};
};

Step step_for(hal::AgentId agent) {
  hal::node::exchange::Event event;
  event.agent = agent;
  Step step;
  step.sequence = 1;
  step.events = {event};
  return step;
}

Action log_of(hal::AgentId agent) {
  return {agent, 0, hal::node::exchange::Log{hal::log::Level::kInfo, "hello"}};
}

TEST_F(ServedHost, ProcessesAreConnectedInOrderOfTheirAgentsNotOfArrival) {
  Client robot(server_.domain(), robot_hello("a"));
  Client second(server_.domain(), hello_for("b", {"m2", "m3"}));
  Client first(server_.domain(), hello_for("c", {"m1"}));
  ASSERT_TRUE(gather());
  ASSERT_EQ(host_.ports_.size(), 3);
  EXPECT_EQ(host_.ports_[0]->name(), "c");
  EXPECT_EQ(host_.ports_[1]->name(), "b");
  EXPECT_EQ(host_.ports_[2]->name(), "a");
  EXPECT_EQ(host_.agents_[1], (std::vector{hal::AgentId{2}, hal::AgentId{3}}));
  EXPECT_EQ(host_.wants_[2].channels, std::vector<std::string>{"infrared"});
}

TEST_F(ServedHost, WhoAsksForNamesGetsThemOnceForAllItsAgents) {
  hal::node::exchange::Hello asks = hello_for("asks", {"m1", "m2"});
  asks.wants.names = true;
  Client asking(server_.domain(), asks);
  Client other(server_.domain(), hello_for("other", {"m3"}));
  Client robot(server_.domain(), robot_hello("robot"));
  ASSERT_TRUE(gather());
  const auto arrival = asking.next(kPatience);
  const auto& session = std::get<Session>(arrival);
  EXPECT_EQ(session.agents.size(), 2);
  EXPECT_EQ(session.directory, host_.directory_);
  const auto silence = other.next(kPatience);
  EXPECT_TRUE(std::get<Session>(silence).directory.empty());
}

TEST_F(ServedHost, ActionsForOthersAgentsAndMalformedOnesAreDroppedCountedAndNamed) {
  Client motes(server_.domain(), hello_for("motes", {"m*"}));
  Client robot(server_.domain(), robot_hello("robot"));
  ASSERT_TRUE(gather());
  const hal::AgentId m1{1}, r0{4};
  const auto actions = exchange(motes, step_for(m1), [&] {
    Action no_event = log_of(m1);
    no_event.event = 1;
    return std::vector{log_of(r0), log_of(m1), log_of(hal::AgentId{9}), log_of(r0), no_event};
  });
  EXPECT_EQ(actions, std::vector{log_of(m1)});
  const GatewaySummary summary = server_.summary();
  EXPECT_EQ(summary.processes.at(0).exchanges, 1);
  EXPECT_EQ(summary.processes[0].foreign_actions, 3);
  EXPECT_EQ(summary.processes[0].foreign_agents, (std::vector{r0, hal::AgentId{9}}));
  EXPECT_EQ(summary.processes[0].malformed_actions, 1);
  const auto lines = complaints(summary);
  const std::string who = "dropped from process 'motes' (pid " + std::to_string(getpid()) + "): ";
  ASSERT_EQ(lines.size(), 2);
  EXPECT_EQ(lines[0], who + "3 actions for agents it was not granted (addresses 4, 9)");
  EXPECT_EQ(lines[1], who + "1 malformed actions");
}

std::vector<std::string> warnings;
void note_warning(hal::log::Level level, hal::Time, std::string_view, std::string_view text) {
  if (level == hal::log::Level::kWarning) warnings.emplace_back(text);
}

TEST_F(ServedHost, RefusalsReachTheProcessAndOnceTheLog) {
  warnings.clear();
  hal::log::set_sink(note_warning);
  std::thread gathering([&] { EXPECT_TRUE(gather()); });
  Client motes(server_.domain(), hello_for("motes", {"m*"}));
  EXPECT_EQ(refusal_of(motes), "");
  Client rival(server_.domain(), hello_for("rival", {"m2"}));
  EXPECT_EQ(refusal_of(rival), "agent 'm2' is taken by process 'motes'");
  hal::node::exchange::Hello future = hello_for("future", {"m2"});
  future.version = 99;
  Client other_version(server_.domain(), future);
  EXPECT_EQ(refusal_of(other_version), "protocol version 99; this server speaks " +
                                           std::to_string(hal::node::exchange::kProtocolVersion));
  Client robot(server_.domain(), robot_hello("robot"));
  gathering.join();
  ASSERT_EQ(warnings.size(), 2);
  EXPECT_EQ(warnings[0], "refused process 'rival' (pid " + std::to_string(getpid()) +
                             "): agent 'm2' is taken by process 'motes'");
  EXPECT_TRUE(complaints(server_.summary()).empty()) << "not a second time in the end";
}

TEST_F(ServedHost, LatecomersAreRefusedDuringTheRun) {
  Client motes(server_.domain(), hello_for("motes", {"m*"}));
  Client robot(server_.domain(), robot_hello("robot"));
  ASSERT_TRUE(gather());
  Client late(server_.domain(), hello_for("late", {"m1"}));
  std::string refusal = "nothing came";
  for (int tries = 0; tries < 1000 && refusal == "nothing came"; ++tries) {
    exchange(motes, step_for(hal::AgentId{1}), [] { return std::vector<Action>{}; });
    const auto arrival = late.next(std::chrono::milliseconds{10});
    if (const auto* session = std::get_if<Session>(&arrival)) refusal = session->refusal;
  }
  EXPECT_EQ(refusal, "the run has begun; no process can join it");
}

TEST_F(ServedHost, WaitingCanBeInterrupted) {
  const auto result =
      server_.gather([] { return hal::fail(hal::Errc::kNotConnected, "interrupted"); });
  EXPECT_EQ(result.error().message, "interrupted");
}

TEST(AgentServer, NamesTheAgentsThatNobodyControls) {
  FakeHost host;
  AgentServer server(process::take_domain(test_domain()), host,
                     {.wait = std::chrono::milliseconds{500}});
  Client robot(server.domain(), robot_hello("robot"));
  const auto result = server.gather(kGoOn);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, hal::Errc::kTimeout);
  EXPECT_EQ(result.error().message,
            "no controller within 0.5 s for m1 (help_mote), m2 (help_mote), m3 (help_mote)");
}

TEST(AgentServer, ItsPortsFailOnceItIsGone) {
  FakeHost host;
  {
    AgentServer server(process::take_domain(test_domain()), host, {.wait = kPatience});
    Client motes(server.domain(), hello_for("motes", {"m*"}));
    Client robot(server.domain(), robot_hello("robot"));
    ASSERT_TRUE(server.gather(kGoOn));
  }
  EXPECT_EQ(host.ports_.at(0)->begin(step_for(hal::AgentId{1})).error().code,
            hal::Errc::kNotConnected);
}

TEST(OpenServer, TakesWhoComesWhenTheyComeAndConnectsThemAtOnce) {
  FakeHost host;
  AgentServer server(process::take_domain(test_domain()), host,
                     {.run = 1, .attendance = Attendance::kAnyTime});
  const auto attend_until_connected = [&](std::size_t count) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (host.ports_.size() < count && std::chrono::steady_clock::now() < end) {
      server.attend(hal::Time{});
      std::this_thread::sleep_for(std::chrono::milliseconds{1});
    }
    ASSERT_EQ(host.ports_.size(), count);
  };
  Client robot(server.domain(), robot_hello("robot"));
  attend_until_connected(1);
  EXPECT_TRUE(std::get<Session>(robot.next(kPatience)).refusal.empty());
  hal::node::exchange::Hello of_two_servers = hello_for("motes", {"elsewhere", "m2"});
  Client motes(server.domain(), of_two_servers);
  attend_until_connected(2);
  EXPECT_EQ(host.agents_[1], std::vector{hal::AgentId{2}});
  EXPECT_EQ(server.summary().processes.size(), 2u);
}

}  // namespace
}  // namespace gateway::server
