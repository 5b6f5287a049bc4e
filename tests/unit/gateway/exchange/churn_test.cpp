#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <thread>

#include "gateway/exchange/client.h"
#include "gateway/exchange/controller_process.h"
#include "gateway/exchange/endpoints.h"
#include "gateway/exchange/link_parts.h"
#include "tests/support/test_domain.h"
#include "tests/unit/gateway/exchange/echo_controller.h"

// A server serves for months, whoever comes.

namespace gateway::exchange {
namespace {

constexpr std::size_t kHellos = 100'000;

/// Controllers that come and go.
std::size_t controllers() {
  const char* given = std::getenv("BARAKA_CONTROLLERS");
  return given == nullptr ? 40 : std::strtoull(given, nullptr, 10);
}

void refuse(Server& server, const hal::node::exchange::Hello& hello) {
  hal::node::exchange::Session refusal;
  refusal.instance = hello.instance;
  refusal.refusal = "no";
  ASSERT_TRUE(server.answer(refusal));
}

void expect_service(Server& server, const std::string& name) {
  Client client(server.domain(), hello_of(echo_kind(), options_for(0, "m1", name)));
  const process::Deadline deadline(kPatience);
  while (!deadline.has_passed()) {
    for (const hal::node::exchange::Hello& hello : server.hellos(std::chrono::milliseconds{10})) {
      refuse(server, hello);
    }
    const Arrival arrival = client.next(hal::Duration::zero());
    if (const auto* session = std::get_if<hal::node::exchange::Session>(&arrival)) {
      EXPECT_EQ(session->refusal, "no");
      return;
    }
  }
  FAIL() << name << " is not answered";
}

/// A writer keeps what it wrote for readers that come late: some 100 kB a Hello, as Fast DDS 2.9
/// sets room aside. A new one now and then keeps the test small, not what the server gets.
constexpr std::size_t kHellosOfAWriter = 1000;

void await_reader(Server& server, const Writer<wire::Hello>& writer) {
  const process::Deadline deadline(kPatience);
  while (writer.readers() == 0 && !deadline.has_passed()) {
    server.hellos(std::chrono::milliseconds{10});
  }
  ASSERT_GT(writer.readers(), 0);
}

TEST(Churn, AParticipantThatSaysEndlessHellosKeepsNobodyElseFromBeingServed) {
  Server server(process::take_domain(test_domain()));
  domain::Participant hostile = domain::Participant::controller(server.domain());
  std::optional<Writer<wire::Hello>> writer;
  hal::node::exchange::Hello hello = hello_of(echo_kind(), options_for(0, "m1", "hostile"));
  const process::ProcessIdentity self = process::this_process();
  hello.host = self.host, hello.pid = self.pid, hello.pid_start_time = self.start_time;
  expect_service(server, "before");
  for (std::size_t i = 0; i < kHellos; ++i) {
    if (i % kHellosOfAWriter == 0) {
      writer.reset();
      writer.emplace(hostile, kHelloTopic);
      ASSERT_NO_FATAL_FAILURE(await_reader(server, *writer));
    }
    hello.instance = std::to_string(i);
    wire::Hello sample = to_wire(hello);
    ASSERT_TRUE(writer->write(sample));
    if (i % 100 != 0) continue;
    for (const hal::node::exchange::Hello& one : server.hellos(hal::Duration::zero()))
      refuse(server, one);
  }
  expect_service(server, "after");
}

TEST(Churn, ControllersThatComeAndGoLeaveNothingBehind) {
  Server server(process::take_domain(test_domain()));
  for (std::size_t i = 0; i < controllers(); ++i) {
    expect_service(server, std::to_string(i));
    if (testing::Test::HasFailure()) break;
  }
}

}  // namespace
}  // namespace gateway::exchange
