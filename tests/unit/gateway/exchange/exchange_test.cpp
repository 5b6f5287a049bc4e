#include <gtest/gtest.h>

#include <thread>

#include "gateway/exchange/controller_process.h"
#include "gateway/process/waiting.h"
#include "tests/support/exchange.h"
#include "tests/support/test_domain.h"
#include "tests/unit/gateway/exchange/child.h"
#include "tests/unit/gateway/exchange/echo_controller.h"

namespace gateway::exchange {
namespace {

using hal::node::exchange::ControlDue;
using hal::node::exchange::Start;
using hal::node::exchange::Stop;

/// A server with one agent, and a process that was granted it.
class ExchangeWithProcess : public testing::Test {
 protected:
  void start() {
    hello_ = first_hello(server_);
    link_ = server_.link(hello_, 7, kPatience);
    ASSERT_TRUE(server_.answer(session_for(hello_, 7)));
  }

  void expect_state(const hal::node::exchange::Step& step, const std::string& state) {
    const auto reply = exchange_step(*link_, step);
    ASSERT_TRUE(reply) << reply.error().message;
    ASSERT_EQ(reply->actions.size(), 1);
    EXPECT_EQ(tests::text_of(reply->actions[0]), state);
    EXPECT_EQ(reply->sequence, step.sequence);
  }

  Server server_{process::take_domain(test_domain())};
  hal::node::exchange::Hello hello_;
  std::unique_ptr<ProcessLink> link_;
  const hal::ControllerKind kind_ = echo_kind();
};

TEST_F(ExchangeWithProcess, ControllersAnswerEveryStepAndEndWithTheStop) {
  Outcome outcome = Outcome::kFailed;
  std::thread controllers(
      [&] { outcome = run_controllers(kind_, options_for(server_.domain(), "m1", "echo")); });
  start();
  expect_state(step_with(Start{}, 1), "started");
  expect_state(step_with(ControlDue{}, 2), "stepped 1");
  expect_state(step_with(Stop{}, 3), "stopped");
  controllers.join();
  EXPECT_EQ(outcome, Outcome::kDone);
}

TEST_F(ExchangeWithProcess, HelloTellsWhoAsksForWhat) {
  const Child child({"controller", std::to_string(server_.domain()), "ann"});
  start();
  EXPECT_EQ(hello_.process, "ann");
  EXPECT_EQ(hello_.program, "echo");
  EXPECT_EQ(hello_.pid, child.pid());
  EXPECT_EQ(hello_.patterns, std::vector<std::string>{"m1"});
  EXPECT_EQ(hello_.kind, hal::AgentKind::kMote);
  EXPECT_FALSE(hello_.both_kinds);
  EXPECT_EQ(hello_.version, hal::node::exchange::kProtocolVersion);
}

TEST_F(ExchangeWithProcess, AnotherProcessIsServedAndExitsWithZero) {
  Child child({"controller", std::to_string(server_.domain()), "ann"});
  start();
  expect_state(step_with(Start{}, 1), "started");
  expect_state(step_with(Stop{}, 2), "stopped");
  EXPECT_EQ(child.wait(), 0);
}

TEST_F(ExchangeWithProcess, KillingTheProcessEndsTheExchangeAtOnce) {
  const Child child({"controller", std::to_string(server_.domain()), "ann"});
  start();
  expect_state(step_with(Start{}, 1), "started");
  child.signal(SIGSTOP);  // So that it cannot answer before it dies.
  ASSERT_TRUE(link_->begin(step_with(ControlDue{}, 2)));
  child.signal(SIGKILL);
  const process::Deadline soon(std::chrono::seconds{8});  // Less than the reply timeout.
  const auto reply = link_->finish();
  EXPECT_FALSE(soon.has_passed());
  ASSERT_FALSE(reply);
  EXPECT_EQ(reply.error().code, hal::Errc::kNotConnected);
  EXPECT_EQ(reply.error().message,
            "process 'ann' (pid " + std::to_string(child.pid()) + ") died: killed by signal 9");
  EXPECT_FALSE(link_->check_alive());
  EXPECT_FALSE(link_->begin(step_with(ControlDue{}, 3)));
}

TEST_F(ExchangeWithProcess, StoppedProcessIsNotDeadAndGoesOn) {
  const Child child({"controller", std::to_string(server_.domain()), "ann"});
  start();
  expect_state(step_with(Start{}, 1), "started");
  child.signal(SIGSTOP);
  ASSERT_TRUE(link_->begin(step_with(ControlDue{}, 2)));
  // Longer than the liveliness lease of 1.5 s and than the first resending after 1 s.
  std::this_thread::sleep_for(std::chrono::milliseconds{1700});
  EXPECT_TRUE(link_->check_alive());
  child.signal(SIGCONT);
  const auto reply = link_->finish();
  ASSERT_TRUE(reply) << reply.error().message;
  EXPECT_EQ(tests::text_of(reply->actions.at(0)), "stepped 1");
  expect_state(step_with(ControlDue{}, 3), "stepped 2");
  EXPECT_EQ(link_->dropped().stale, 0);
}

TEST_F(ExchangeWithProcess, ProcessOnAnotherHostIsDeadWhenItIsSilentForTheLease) {
  const Child child({"controller", std::to_string(server_.domain()), "ann"});
  hello_ = first_hello(server_);
  hello_.host = "elsewhere";
  link_ = server_.link(hello_, 7, kPatience);
  ASSERT_TRUE(server_.answer(session_for(hello_, 7)));
  expect_state(step_with(Start{}, 1), "started");
  EXPECT_TRUE(link_->check_alive());
  child.signal(SIGSTOP);
  ASSERT_TRUE(link_->begin(step_with(ControlDue{}, 2)));
  const auto reply = link_->finish();
  ASSERT_FALSE(reply);
  EXPECT_EQ(reply.error().code, hal::Errc::kNotConnected) << reply.error().message;
}

}  // namespace
}  // namespace gateway::exchange
