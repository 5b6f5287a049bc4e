#include "gateway/domain/invitation.h"

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <fstream>
#include <map>
#include <utility>

#include "gateway/exchange/controller_process.h"
#include "gateway/process/process_watch.h"
#include "gateway/process/waiting.h"
#include "tests/support/exchange.h"
#include "tests/support/test_domain.h"
#include "tests/unit/gateway/exchange/echo_controller.h"
#include "tests/unit/gateway/exchange/guest_child.h"

namespace gateway::exchange {
namespace {

using hal::node::exchange::ControlDue;
using hal::node::exchange::Start;
using hal::node::exchange::Stop;

std::string network_of(std::int64_t pid) {
  return std::filesystem::read_symlink("/proc/" + std::to_string(pid) + "/ns/net").string();
}

bool is_halted(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("State:")) return line.find('T') != std::string::npos;
  }
  return false;
}

/// It does nothing more when this returns: a signal takes effect some time after kill().
void halt(std::int64_t number) {
  const auto process = static_cast<pid_t>(number);
  kill(process, SIGSTOP);
  for (const process::Deadline deadline(kPatience);
       !is_halted(process) && !deadline.has_passed();) {
    process::wait_readable({}, std::chrono::milliseconds{1});
  }
}

/// A controller in namespaces of its own, and the server that it was invited by.
class Guests : public testing::Test {
 protected:
  void SetUp() override {
    if (!GuestChild::is_possible()) GTEST_SKIP() << "no namespaces can be made here";
    server_.emplace(process::take_domain(test_domain()));
    guest_.emplace(*server_, std::vector<std::string>{"controller",
                                                      std::to_string(server_->domain()), "guest"});
    hello_ = first_hello(*server_);
    link_ = server_->link(hello_, 1, kPatience);
    ASSERT_TRUE(server_->answer(session_for(hello_, 1)));
  }

  std::optional<Server> server_;
  std::optional<GuestChild> guest_;
  hal::node::exchange::Hello hello_;
  std::unique_ptr<ProcessLink> link_;
};

TEST_F(Guests, AreNamedAsTheyAreCalledHere) {
  EXPECT_EQ(hello_.host, gateway::process::this_process().host);
  EXPECT_NE(hello_.pid, guest_->first().pid()) << "that is `unshare`";
  EXPECT_EQ(gateway::process::start_time_of(hello_.pid), hello_.pid_start_time);
  EXPECT_NE(network_of(hello_.pid), network_of(getpid()));
}

TEST_F(Guests, ExchangeStepsToTheEndOfTheRun) {
  for (const auto& [step, state] : {std::pair{step_with(Start{}, 1), "started"},
                                    std::pair{step_with(ControlDue{}, 2), "stepped 1"},
                                    std::pair{step_with(Stop{}, 3), "stopped"}}) {
    const auto reply = exchange_step(*link_, step);
    ASSERT_TRUE(reply) << reply.error().message;
    ASSERT_EQ(reply->actions.size(), 1);
    EXPECT_EQ(tests::text_of(reply->actions[0]), state);
  }
  EXPECT_EQ(guest_->first().wait(), 0);
}

TEST_F(Guests, TakeStepsOfManyDatagrams) {
  ASSERT_TRUE(exchange_step(*link_, step_with(Start{}, 1)));
  hal::node::exchange::Step step = step_with(ControlDue{}, 2);
  step.events.resize(20'000, step.events[0]);  // 1 MB
  const auto reply = exchange_step(*link_, step);
  ASSERT_TRUE(reply) << reply.error().message;
  EXPECT_EQ(reply->actions.size(), step.events.size());
}

TEST_F(Guests, DeathEndsAnExchangeAtOnce) {
  ASSERT_TRUE(exchange_step(*link_, step_with(Start{}, 1)));
  halt(hello_.pid);
  ASSERT_TRUE(link_->begin(step_with(ControlDue{}, 2)));
  EXPECT_FALSE(gateway::process::wait_readable(std::vector{link_->death_descriptor()},
                                               hal::Duration::zero()))
      << "one that is halted is not dead";
  kill(static_cast<pid_t>(hello_.pid), SIGKILL);
  const auto reply = link_->finish();
  ASSERT_FALSE(reply);
  EXPECT_EQ(reply.error().code, hal::Errc::kNotConnected);
  EXPECT_NE(reply.error().message.find("process 'guest' (pid " + std::to_string(hello_.pid)),
            std::string::npos)
      << reply.error().message;
}

TEST_F(Guests, WhoIsSilentForTheReplyTimeoutIsNamed) {
  link_.reset();
  link_ = server_->link(hello_, 1, std::chrono::milliseconds{300});
  halt(hello_.pid);
  const auto reply = exchange_step(*link_, step_with(Start{}, 1));
  ASSERT_FALSE(reply);
  EXPECT_EQ(reply.error().code, hal::Errc::kTimeout);
}

/// Says what an honest guest would, from another port of this namespace.
TEST_F(Guests, OthersDoNotPassForThem) {
  Client impostor(server_->domain(),
                  hello_of(echo_kind(), options_for(server_->domain(), "m1", "guest")));
  const hal::node::exchange::Hello hello = first_hello(*server_);
  EXPECT_EQ(hello.pid, getpid());
  EXPECT_NE(hello.instance, hello_.instance);
}

TEST(GuestsOfOneServer, AreSeveral) {
  if (!GuestChild::is_possible()) GTEST_SKIP() << "no namespaces can be made here";
  Server server(process::take_domain(test_domain()));
  const std::string domain = std::to_string(server.domain());
  GuestChild first(server, {"controller", domain, "first"});
  GuestChild second(server, {"controller", domain, "second"});
  std::map<std::string, hal::node::exchange::Hello> hellos;
  const process::Deadline deadline(kPatience);
  while (hellos.size() < 2 && !deadline.has_passed()) {
    for (const auto& hello : server.hellos(std::chrono::seconds{1})) hellos[hello.process] = hello;
  }
  ASSERT_EQ(hellos.size(), 2);
  EXPECT_NE(hellos["first"].pid, hellos["second"].pid);
  EXPECT_NE(network_of(hellos["first"].pid), network_of(hellos["second"].pid));
  std::vector<std::unique_ptr<ProcessLink>> links;
  for (const auto& [process, hello] : hellos) {
    links.push_back(server.link(hello, 1, kPatience));
    ASSERT_TRUE(server.answer(session_for(hello, 1)));
  }
  for (const auto& link : links) EXPECT_TRUE(exchange_step(*link, step_with(Start{}, 1)));
}

TEST(Guest, EndsWhenTheProcessThatInvitedItIsKilled) {
  if (!GuestChild::is_possible()) GTEST_SKIP() << "no namespaces can be made here";
  const auto told =
      std::filesystem::temp_directory_path() / ("baraka_guest_" + std::to_string(getpid()));
  Child host({"host", std::to_string(test_domain()), told.string()});
  std::int64_t pid = 0;
  for (const process::Deadline deadline(kPatience); pid == 0 && !deadline.has_passed();) {
    process::wait_readable({}, std::chrono::milliseconds{10});
    std::ifstream(told) >> pid;
  }
  std::filesystem::remove(told);
  ASSERT_NE(pid, 0);
  const int guest = static_cast<int>(syscall(SYS_pidfd_open, static_cast<pid_t>(pid), 0));
  ASSERT_GE(guest, 0);
  host.signal(SIGSTOP);
  EXPECT_FALSE(gateway::process::wait_readable(std::vector{guest}, std::chrono::seconds{3}))
      << "a process that a debugger holds is not gone";
  host.signal(SIGKILL);
  EXPECT_TRUE(gateway::process::wait_readable(std::vector{guest}, kPatience));
  close(guest);
}

}  // namespace
}  // namespace gateway::exchange
