#include "gateway/exchange/controller_process.h"

#include <gtest/gtest.h>

#include <thread>

#include "tests/support/test_domain.h"
#include "tests/unit/gateway/exchange/child.h"
#include "tests/unit/gateway/exchange/echo_controller.h"

namespace gateway::exchange {
namespace {

using hal::node::exchange::Start;
using hal::node::exchange::Step;
using hal::node::exchange::Stop;

/// Controllers in a thread of this process.
class Controllers {
 public:
  explicit Controllers(const runtime::ControllerOptions& options)
      : options_(options),
        client_(*options.domain, hello_of(kind_, options_)),
        thread_([this] { outcome_ = run_controllers(kind_, options_, client_); }) {}
  ~Controllers() {
    client_.interrupt();
    if (thread_.joinable()) thread_.join();
  }
  Controllers(const Controllers&) = delete;
  Controllers& operator=(const Controllers&) = delete;

  Outcome wait() {
    thread_.join();
    return outcome_;
  }
  void interrupt() { client_.interrupt(); }

 private:
  hal::ControllerKind kind_ = echo_kind();
  runtime::ControllerOptions options_;
  Client client_;
  Outcome outcome_ = Outcome::kDone;
  std::thread thread_;
};

/// Serves one run of a START and a STOP.
void serve_run(Server& server, const hal::node::exchange::Hello& hello, std::uint64_t run) {
  const auto link = server.link(hello, run, kPatience);
  ASSERT_TRUE(server.answer(session_for(hello, run)));
  for (const Step& step : {step_with(Start{}, 1), step_with(Stop{}, 2)}) {
    const auto reply = exchange_step(*link, step);
    ASSERT_TRUE(reply) << reply.error().message;
  }
}

TEST(ControllerProcess, RefusalEndsIt) {
  Server server(process::take_domain(test_domain()));
  Controllers controllers(options_for(server.domain(), "m1", "echo"));
  hal::node::exchange::Session refusal;
  refusal.instance = first_hello(server).instance;
  refusal.refusal = "unknown agent 'm1'";
  ASSERT_TRUE(server.answer(refusal));
  EXPECT_EQ(controllers.wait(), Outcome::kRefused);
}

TEST(ControllerProcess, ServerOfAnotherVersionEndsIt) {
  Server server(process::take_domain(test_domain()));
  Controllers controllers(options_for(server.domain(), "m1", "echo"));
  hal::node::exchange::Session session = session_for(first_hello(server), 1);
  session.version = hal::node::exchange::kProtocolVersion + 1;
  ASSERT_TRUE(server.answer(session));
  EXPECT_EQ(controllers.wait(), Outcome::kRefused);
}

TEST(ControllerProcess, SilenceForTheWaitingTimeEndsIt) {
  const process::DomainHold hold =
      process::take_domain(test_domain());  // Nobody else serves it meanwhile.
  runtime::ControllerOptions options = options_for(hold.domain(), "m1", "echo");
  options.wait = std::chrono::milliseconds{200};
  Controllers controllers(options);
  EXPECT_EQ(controllers.wait(), Outcome::kFailed);
}

TEST(ControllerProcess, WaitsForAServerThatStartsLater) {
  process::DomainHold hold = process::take_domain(test_domain());
  Controllers controllers(options_for(hold.domain(), "m1", "echo"));
  std::this_thread::sleep_for(std::chrono::milliseconds{500});  // Its first announcements are over.
  Server server(std::move(hold));
  serve_run(server, first_hello(server), 1);
  EXPECT_EQ(controllers.wait(), Outcome::kDone);
}

TEST(ControllerProcess, WrongParameterIsReportedToTheServer) {
  Server server(process::take_domain(test_domain()));
  Controllers controllers(options_for(server.domain(), "m1", "echo"));
  const hal::node::exchange::Hello hello = first_hello(server);
  const auto link = server.link(hello, 1, kPatience);
  hal::node::exchange::Session session = session_for(hello, 1);
  session.agents[0].parameters = {{"gain", "11", "s.yaml:4:9"}};  // Allowed: 0 to 10.
  ASSERT_TRUE(server.answer(session));
  const auto reply = exchange_step(*link, step_with(Start{}, 1));
  ASSERT_TRUE(reply) << reply.error().message;
  ASSERT_EQ(reply->actions.size(), 1);
  EXPECT_EQ(reply->actions[0].agent, hal::AgentId{1});
  const auto& error = std::get<hal::node::exchange::ControllerFailed>(reply->actions[0].what);
  EXPECT_NE(error.text.find("s.yaml:4:9: gain:"), std::string::npos);
  EXPECT_EQ(controllers.wait(), Outcome::kRefused);
}

TEST(ControllerProcess, WithStayItServesTheNextRunOfTheNextServer) {
  const int domain = test_domain();
  std::optional<Server> server(std::in_place, process::take_domain(domain));
  runtime::ControllerOptions options = options_for(domain, "m1", "echo");
  options.stay = true;
  Controllers controllers(options);
  serve_run(*server, first_hello(*server), 1);
  server.reset();
  server.emplace(process::take_domain(domain));
  serve_run(*server, first_hello(*server), 2);
  controllers.interrupt();
  EXPECT_EQ(controllers.wait(), Outcome::kInterrupted);
}

TEST(ControllerProcess, EndsWhenTheServerIsKilled) {
  const int domain = test_domain();
  Child server({"server", std::to_string(domain)});
  Client client(domain, hello_of(echo_kind(), options_for(domain, "m1", "echo")));
  ASSERT_TRUE(std::holds_alternative<hal::node::exchange::Session>(client.next(kPatience)));
  ASSERT_TRUE(std::holds_alternative<hal::node::exchange::Step>(client.next(kPatience)));
  server.signal(SIGKILL);
  EXPECT_TRUE(std::holds_alternative<ServerGone>(client.next(std::chrono::seconds{1})));
}

TEST(ControllerProcess, FailsWhenTheServerLeavesInTheMiddleOfARun) {
  std::optional<Server> server(std::in_place, process::take_domain(test_domain()));
  Controllers controllers(options_for(server->domain(), "m1", "echo"));
  const hal::node::exchange::Hello hello = first_hello(*server);
  auto link = server->link(hello, 1, kPatience);
  ASSERT_TRUE(server->answer(session_for(hello, 1)));
  ASSERT_TRUE(exchange_step(*link, step_with(Start{}, 1)));
  link.reset();
  server.reset();
  EXPECT_EQ(controllers.wait(), Outcome::kFailed);
}

TEST(ControllerProcess, SigtermEndsItInTheMiddleOfARun) {
  Server server(process::take_domain(test_domain()));
  Child child({"controller", std::to_string(server.domain()), "ann"});
  const hal::node::exchange::Hello hello = first_hello(server);
  const auto link = server.link(hello, 1, kPatience);
  ASSERT_TRUE(server.answer(session_for(hello, 1)));
  ASSERT_TRUE(exchange_step(*link, step_with(Start{}, 1)));
  child.signal(SIGTERM);
  EXPECT_EQ(child.wait(), 130);
}

TEST(Hello, DefaultNameIsProgramAndPid) {
  const hal::node::exchange::Hello hello = hello_of(echo_kind(), options_for(1, "m1", ""));
  EXPECT_EQ(hello.process, "echo." + std::to_string(getpid()));
}

}  // namespace
}  // namespace gateway::exchange
