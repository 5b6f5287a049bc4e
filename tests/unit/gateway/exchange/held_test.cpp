#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <variant>

#include "gateway/exchange/client.h"
#include "gateway/exchange/held_link.h"
#include "tests/support/exchange.h"

namespace gateway::exchange {
namespace {

using namespace std::chrono_literals;
using hal::node::exchange::Reply;
using hal::node::exchange::Session;
using hal::node::exchange::Step;

constexpr std::size_t kLarge = 3'000'000;  // byte, several times what a socket takes

/// A message of so many bytes.
Step step_of(std::size_t bytes) {
  Step step;
  step.sequence = 1;
  step.events.resize(1);
  step.events[0].what =
      hal::node::exchange::MessageArrived{{.source = {},
                                           .destination = {},
                                           .id = 1,
                                           .topic = "t",
                                           .payload = std::vector<std::uint8_t>(bytes)}};
  return step;
}

/// The controller's end is on a thread of this process, which goes on whenever it likes.
class HeldExchange : public testing::Test {
 protected:
  ~HeldExchange() override {
    if (controller_.joinable()) controller_.join();
  }

  /// @param run  of the controller.
  void begin(std::function<void(Client&)> run) {
    setenv(kHeldVariable, std::to_string(dup(link_.controllers_end())).c_str(), 1);
    link_.started();
    controller_ = std::thread([run = std::move(run)] {
      hal::node::exchange::Hello hello;
      hello.process = "r0";
      Client client(0, hello);
      run(client);
    });
    const process::Deadline limit(10s);
    auto hello = link_.hello(limit);
    while (!hello && !limit.has_passed()) hello = link_.hello(limit);
    ASSERT_TRUE(hello);
    EXPECT_EQ(hello->process, "r0");
    EXPECT_EQ(hello->pid, getpid());
  }

  void admit(std::optional<hal::Duration> reply_timeout = std::nullopt) {
    Session session;
    session.instance = "r0";
    session.run = 7;
    link_.admit(session, 7, reply_timeout);
  }

  hal::Result<std::optional<Reply>> answer() {
    const process::Deadline limit(20s);
    auto reply = link_.try_finish();
    while (reply && !*reply && !limit.has_passed()) reply = link_.try_finish();
    return reply;
  }

  hal::Time now_{};
  HeldLink link_{{.give =
                      [](const auto& may_go_on) {
                        std::this_thread::sleep_for(1ms);
                        (void)may_go_on();
                      },
                  .now = [this] { return now_; }}};
  std::thread controller_;
};

/// Answers one Step with the length of its message, and with as long a text.
void echo(Client& client) {
  const Arrival arrival = client.next(10s);
  const auto* session = std::get_if<Session>(&arrival);
  ASSERT_NE(session, nullptr);
  client.answer(session->server, [&client](const Step& step) {
    const auto& message =
        std::get<hal::node::exchange::MessageArrived>(step.events[0].what).message;
    Reply reply;
    reply.run = step.run;
    reply.sequence = step.sequence;
    reply.actions.resize(1);
    reply.actions[0].what = hal::node::exchange::SetState{std::string(message.payload.size(), 'x')};
    EXPECT_TRUE(client.reply(step.server, reply));
    return true;
  });
  EXPECT_TRUE(std::holds_alternative<Woken>(client.next(10s)));
}

TEST_F(HeldExchange, CarriesWhatIsLargerThanASocketTakes) {
  begin(echo);
  admit();
  ASSERT_TRUE(link_.begin(step_of(kLarge)));
  const auto reply = answer();
  ASSERT_TRUE(reply) << reply.error().message;
  ASSERT_TRUE(*reply);
  EXPECT_EQ(tests::text_of((*reply)->actions.at(0)), std::string(kLarge, 'x'));
  EXPECT_EQ((*reply)->run, 7U);
}

TEST(HeldClient, SeesTheEndOfTheRun) {
  std::optional<HeldLink> other(
      std::in_place, HeldTurns{.give = [](const auto&) {}, .now = [] { return hal::Time{}; }});
  Arrival last;
  {
    setenv(kHeldVariable, std::to_string(dup(other->controllers_end())).c_str(), 1);
    other->started();
    hal::node::exchange::Hello hello;
    hello.process = "r0";
    Client client(0, hello);
    ASSERT_TRUE(other->hello(process::Deadline(1s)));
    Session session;
    session.instance = "r0";
    other->admit(session, 7, std::nullopt);
    ASSERT_TRUE(other->begin(step_of(1)));
    EXPECT_FALSE(*other->try_finish());  // sent, and not answered
    EXPECT_TRUE(std::holds_alternative<Session>(client.next(1s)));
    EXPECT_TRUE(std::holds_alternative<Step>(client.next(1s)));
    other.reset();
    last = client.next(1s);
    EXPECT_TRUE(std::holds_alternative<Silence>(client.next(10ms)));
  }
  EXPECT_TRUE(std::holds_alternative<ServerGone>(last));
}

TEST_F(HeldExchange, TheEndOfTheControllerIsSeenByTheRun) {
  begin([](Client& client) { (void)client.next(10s); });
  admit();
  ASSERT_TRUE(link_.begin(step_of(1)));
  const auto reply = answer();
  ASSERT_FALSE(reply);
  EXPECT_EQ(reply.error().message, "process 'r0' (pid " + std::to_string(getpid()) +
                                       ") died: has closed its end of the exchange");
  EXPECT_FALSE(link_.begin(step_of(1)));
}

TEST_F(HeldExchange, OneThatWaitsForLongerThanTheTimeoutIsSilent) {
  begin([](Client&) { std::this_thread::sleep_for(300ms); });
  admit(2s);
  now_ = hal::Time{5s};
  ASSERT_TRUE(link_.begin(step_of(1)));
  now_ = hal::Time{6s};
  auto reply = link_.try_finish();
  ASSERT_TRUE(reply) << reply.error().message;
  EXPECT_FALSE(*reply);
  now_ = hal::Time{7s};
  reply = link_.try_finish();
  ASSERT_FALSE(reply);
  EXPECT_EQ(reply.error().code, hal::Errc::kTimeout);
  EXPECT_NE(reply.error().message.find("did not answer within 2 s of simulated time"),
            std::string::npos);
}

TEST(HeldChannel, WhatIsNoMessageClosesIt) {
  HeldEnds ends = make_held_ends();
  HeldChannel channel(std::move(ends.own), HeldChannel::Sends::kAtOnce);
  const std::uint32_t head[] = {1, 0xffff'ffff};
  ASSERT_EQ(send(ends.controllers.number(), head, sizeof head, 0),
            static_cast<ssize_t>(sizeof head));
  EXPECT_TRUE(channel.receive());
  EXPECT_FALSE(channel.is_closed());
  EXPECT_FALSE(channel.take());
  EXPECT_TRUE(channel.is_closed());
}

TEST(HeldChannel, ItsNumberHasToBeThatOfASocket) {
  for (const char* number : {"", "x", "0", "999"}) {
    setenv(kHeldVariable, number, 1);
    EXPECT_THROW(take_held_end(), std::runtime_error) << number;
    EXPECT_FALSE(take_held_end());
  }
}

}  // namespace
}  // namespace gateway::exchange
