#include <gtest/gtest.h>

#include <thread>

#include "gateway/exchange/client.h"
#include "gateway/exchange/controller_process.h"
#include "gateway/exchange/endpoints.h"
#include "gateway/exchange/link_parts.h"
#include "tests/support/test_domain.h"
#include "tests/unit/gateway/exchange/child.h"
#include "tests/unit/gateway/exchange/echo_controller.h"

// What happens when the other end does not keep to the rules.

namespace gateway::exchange {
namespace {

using hal::node::exchange::Cause;
using hal::node::exchange::ControlDue;
using hal::node::exchange::Start;
using hal::node::exchange::Stop;
constexpr hal::Duration kReplyTimeout = std::chrono::milliseconds{300};

/// A server and a client of this process, linked up.
class LinkedClient : public testing::Test {
 protected:
  void SetUp() override {
    hello_ = first_hello(server_);
    link_ = server_.link(hello_, 7, kReplyTimeout);
    ASSERT_TRUE(server_.answer(session_for(hello_, 7)));
    ASSERT_TRUE(std::holds_alternative<hal::node::exchange::Session>(client_.next(kPatience)));
  }

  hal::node::exchange::Step next_step() {
    return std::get<hal::node::exchange::Step>(client_.next(kPatience));
  }

  static hal::node::exchange::Reply reply_to(const hal::node::exchange::Step& step) {
    hal::node::exchange::Reply reply;
    reply.run = step.run;
    reply.sequence = step.sequence;
    return reply;
  }

  Server server_{process::take_domain(test_domain())};
  Client client_{server_.domain(), hello_of(echo_kind(), options_for(0, "m1", "rogue"))};
  hal::node::exchange::Hello hello_;
  std::unique_ptr<ProcessLink> link_;
};

TEST_F(LinkedClient, SilenceEndsWithATimeoutThatNamesTheProcess) {
  ASSERT_TRUE(link_->begin(step_with(Start{}, 1)));
  const auto reply = link_->finish();
  ASSERT_FALSE(reply);
  EXPECT_EQ(reply.error().code, hal::Errc::kTimeout);
  EXPECT_NE(reply.error().message.find("process 'rogue'"), std::string::npos);
  EXPECT_NE(reply.error().message.find("0.3 s"), std::string::npos);
}

TEST_F(LinkedClient, RepliesOfAnotherSequenceOrRunAreDroppedAndCounted) {
  ASSERT_TRUE(link_->begin(step_with(Start{}, 1)));
  const hal::node::exchange::Step step = next_step();
  hal::node::exchange::Reply other_sequence = reply_to(step);
  other_sequence.sequence = 99;
  ASSERT_TRUE(client_.reply(step.server, other_sequence));
  EXPECT_EQ(link_->finish().error().code, hal::Errc::kTimeout);
  EXPECT_EQ(link_->dropped().stale, 1);

  ASSERT_TRUE(link_->begin(step_with(ControlDue{}, 2)));
  hal::node::exchange::Reply other_run = reply_to(next_step());
  other_run.run = 6;
  ASSERT_TRUE(client_.reply(step.server, other_run));
  EXPECT_EQ(link_->finish().error().code, hal::Errc::kTimeout);
  EXPECT_EQ(link_->dropped().stale, 2);
}

TEST_F(LinkedClient, ReplyWithAnUnknownLogLevelIsDroppedAndCounted) {
  ASSERT_TRUE(link_->begin(step_with(Start{}, 1)));
  const hal::node::exchange::Step step = next_step();
  hal::node::exchange::Reply reply = reply_to(step);
  reply.actions.resize(1);
  reply.actions[0].what = hal::node::exchange::Log{static_cast<hal::log::Level>(200), ""};
  ASSERT_TRUE(client_.reply(step.server, reply));
  EXPECT_EQ(link_->finish().error().code, hal::Errc::kTimeout);
  EXPECT_EQ(link_->dropped().malformed, 1);
}

TEST_F(LinkedClient, AStepAndItsReplyCarryTheNumberThatTheCallerGaveIt) {
  ASSERT_TRUE(link_->begin(step_with(Start{}, 41)));
  const hal::node::exchange::Step step = next_step();
  EXPECT_EQ(step.sequence, 41);
  EXPECT_EQ(step.server, server_.name());
  EXPECT_EQ(step.run, 7);
  ASSERT_TRUE(client_.reply(step.server, reply_to(step)));
  const auto reply = link_->finish();
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->sequence, 41);
}

TEST_F(LinkedClient, AStepOfAThousandEventsArrivesWhole) {
  hal::node::exchange::Step big = step_with(ControlDue{}, 1);
  big.events[0].readings = {{3, std::vector<double>(40, 0.5)}};
  big.events.resize(1000, big.events[0]);  // About 400 kB: several UDP datagrams.
  ASSERT_TRUE(link_->begin(big));
  EXPECT_EQ(next_step().events, big.events);
}

/// Another participant that writes what it likes.
class Forger {
 public:
  explicit Forger(int domain) : participant_(domain::Participant::controller(domain)) {}
  domain::Participant& participant() { return participant_; }

 private:
  domain::Participant participant_;
};

/// Waits until as many readers are in sight.
template <class Wire>
void await_readers(const Writer<Wire>& writer, int count) {
  const process::Deadline deadline(kPatience);
  while (writer.readers() < count && !deadline.has_passed()) {
    std::this_thread::sleep_for(std::chrono::milliseconds{5});
  }
  ASSERT_EQ(writer.readers(), count);
}

/// Writes until somebody has heard it.
template <class Wire, class Heard>
void write_until(Writer<Wire>& writer, Wire& sample, const Heard& is_heard) {
  const process::Deadline deadline(kPatience);
  while (!is_heard() && !deadline.has_passed()) {
    ASSERT_TRUE(writer.write(sample));
    std::this_thread::sleep_for(std::chrono::milliseconds{5});
  }
  ASSERT_TRUE(is_heard());
}

TEST_F(LinkedClient, RepliesOfAnotherParticipantAreDroppedAndNamed) {
  Forger forger(server_.domain());
  Writer<wire::Reply> forged(forger.participant(), reply_topic("rogue"));
  ASSERT_TRUE(link_->begin(step_with(Start{}, 1)));
  const hal::node::exchange::Step step = next_step();
  hal::node::exchange::Reply reply = reply_to(step);
  reply.actions.resize(1);
  reply.actions[0].what = hal::node::exchange::Log{hal::log::Level::kInfo, "forged"};
  wire::Reply sample;
  to_wire(reply, step.server, sample);
  sample.process("rogue");
  write_until(forged, sample, [this] {
    EXPECT_FALSE(*link_->try_finish());
    return link_->dropped().foreign > 0;
  });
  EXPECT_EQ(link_->dropped().first_foreign.size(), 24);
  EXPECT_EQ(link_->dropped().stale, 0);
  ASSERT_TRUE(client_.reply(step.server, reply_to(step)));
  const auto answer = link_->finish();
  ASSERT_TRUE(answer) << answer.error().message;
  EXPECT_TRUE(answer->actions.empty());
}

TEST_F(LinkedClient, RepliesForOtherServersAreNobodysFault) {
  ASSERT_TRUE(link_->begin(step_with(Start{}, 1)));
  const hal::node::exchange::Step step = next_step();
  ASSERT_TRUE(client_.reply("another server", reply_to(step)));
  ASSERT_TRUE(client_.reply(step.server, reply_to(step)));
  EXPECT_TRUE(link_->finish());
  EXPECT_EQ(link_->dropped().stale, 0);
}

TEST_F(LinkedClient, StepsOfAnotherParticipantAreNotAnswered) {
  domain::Participant rival = domain::Participant::server(server_.domain(), 7);
  Writer<wire::Step> steps(rival, step_topic("rogue"));
  hal::node::exchange::Step forged = step_with(ControlDue{}, 1);
  forged.server = server_.name();
  forged.run = 7;
  wire::Step sample;
  to_wire(forged, sample);
  await_readers(steps, 1);
  ASSERT_TRUE(steps.write(sample));
  steps.flush(kPatience);
  EXPECT_TRUE(std::holds_alternative<Silence>(client_.next(std::chrono::milliseconds{100})));
  ASSERT_TRUE(link_->begin(step_with(Start{}, 1)));
  EXPECT_EQ(next_step().events.at(0).cause(), Cause::kStart);
}

TEST_F(LinkedClient, ASessionOfAnotherParticipantForTheSameServerIsNotHeard) {
  domain::Participant rival = domain::Participant::server(server_.domain(), 7);
  Writer<wire::Session> sessions(rival, kSessionTopic);
  hal::node::exchange::Session refusal;
  refusal.instance = hello_.instance;
  refusal.server = server_.name();
  refusal.refusal = "forged";
  wire::Session sample = to_wire(refusal, process::this_process());
  await_readers(sessions, 1);
  ASSERT_TRUE(sessions.write(sample));
  sessions.flush(kPatience);
  EXPECT_TRUE(std::holds_alternative<Silence>(client_.next(std::chrono::milliseconds{100})));
}

/// A Session of another server.
wire::Session rival_session(const hal::node::exchange::Hello& hello, const std::string& agent) {
  hal::node::exchange::Session session = session_for(hello, 8);
  session.server = "rival";
  session.agents[0].name = agent;
  return to_wire(session, process::this_process());
}

TEST_F(LinkedClient, ASessionOfAnotherServerIsTakenForOtherAgentsOnly) {
  domain::Participant rival = domain::Participant::server(server_.domain(), 7);
  Writer<wire::Session> sessions(rival, kSessionTopic);
  await_readers(sessions, 1);
  wire::Session same = rival_session(hello_, "m1");
  ASSERT_TRUE(sessions.write(same));
  sessions.flush(kPatience);
  EXPECT_TRUE(std::holds_alternative<Silence>(client_.next(std::chrono::milliseconds{100})));
  wire::Session other = rival_session(hello_, "m2");
  ASSERT_TRUE(sessions.write(other));
  const auto arrival = client_.next(kPatience);
  ASSERT_TRUE(std::holds_alternative<hal::node::exchange::Session>(arrival));
  EXPECT_EQ(std::get<hal::node::exchange::Session>(arrival).server, "rival");
}

TEST(Successor, OfAServerThatIsGoneIsTakenForTheSameAgents) {
  std::optional<Server> server(std::in_place, process::take_domain(test_domain()));
  const int domain = server->domain();
  Client client(domain, hello_of(echo_kind(), options_for(0, "m1", "staying")));
  const hal::node::exchange::Hello hello = first_hello(*server);
  ASSERT_TRUE(server->answer(session_for(hello, 7)));
  ASSERT_TRUE(std::holds_alternative<hal::node::exchange::Session>(client.next(kPatience)));
  domain::Participant successor = domain::Participant::server(domain, 7);
  Writer<wire::Session> sessions(successor, kSessionTopic);
  await_readers(sessions, 1);
  server.reset();
  wire::Session session = rival_session(hello, "m1");
  ASSERT_TRUE(sessions.write(session));
  bool is_taken = false;
  for (int arrivals = 0; arrivals < 3 && !is_taken; ++arrivals) {  // that the first is gone, too
    is_taken = std::holds_alternative<hal::node::exchange::Session>(client.next(kPatience));
  }
  EXPECT_TRUE(is_taken);
}

TEST_F(LinkedClient, AHelloInTheNameOfAnotherIsNotAnsweredAndNamed) {
  Forger forger(server_.domain());
  Writer<wire::Hello> hellos(forger.participant(), kHelloTopic);
  wire::Hello sample = to_wire(hello_);
  std::vector<std::string> refusals;
  write_until(hellos, sample, [&] {
    EXPECT_TRUE(server_.hellos(hal::Duration::zero()).empty());
    for (std::string& one : server_.take_refusals()) refusals.push_back(std::move(one));
    return !refusals.empty();
  });
  EXPECT_NE(refusals[0].find("process 'rogue'"), std::string::npos);
  EXPECT_NE(refusals[0].find("it says to be instance '" + hello_.instance), std::string::npos);
  EXPECT_NE(link_, nullptr);
  EXPECT_TRUE(link_->check_alive());
}

TEST_F(LinkedClient, AHelloOfAProcessThatDoesNotSpeakFromThatPortIsNotAnswered) {
  const Child child({"sleep"});
  Forger forger(server_.domain());
  Writer<wire::Hello> hellos(forger.participant(), kHelloTopic);
  hal::node::exchange::Hello hello = hello_;
  hello.instance = "other";
  hello.pid = child.pid();
  hello.pid_start_time = process::start_time_of(child.pid()).value_or(0);
  wire::Hello sample = to_wire(hello);
  std::vector<std::string> refusals;
  write_until(hellos, sample, [&] {
    EXPECT_TRUE(server_.hellos(hal::Duration::zero()).empty());
    for (std::string& one : server_.take_refusals()) refusals.push_back(std::move(one));
    return !refusals.empty();
  });
  EXPECT_NE(refusals[0].find("that it speaks from"), std::string::npos) << refusals[0];
}

TEST(Withdrawal, ServersThatStartAfterItDoNotSeeTheHello) {
  process::DomainHold hold = process::take_domain(test_domain());
  Client leaving(hold.domain(), hello_of(echo_kind(), options_for(0, "m1", "leaving")));
  leaving.withdraw();
  Server server(std::move(hold));
  const process::Deadline deadline(kPatience);
  while (leaving.servers() == 0 && !deadline.has_passed()) {
    EXPECT_TRUE(server.hellos(std::chrono::milliseconds{10}).empty());
  }
  ASSERT_EQ(leaving.servers(), 1);
  const Client staying(server.domain(), hello_of(echo_kind(), options_for(0, "m1", "staying")));
  EXPECT_EQ(first_hello(server).process, "staying");
  EXPECT_TRUE(server.hellos(std::chrono::milliseconds{300}).empty());
}

TEST(RepeatedStep, IsAnsweredFromMemoryWithoutASecondCallback) {
  const process::DomainHold hold = process::take_domain(test_domain());
  domain::Participant participant = domain::Participant::server(hold.domain(), 0);
  process::Signal signal;
  Reader<wire::Hello> hellos(participant, kHelloTopic, signal);
  Writer<wire::Session> sessions(participant, kSessionTopic);
  Writer<wire::Step> steps(participant, step_topic("echo"));
  Reader<wire::Reply> replies(participant, reply_topic("echo"), signal);
  const auto wait_for = [&signal](auto& reader) {
    const process::Deadline deadline(kPatience);
    while (true) {
      signal.lower();
      if (const auto* sample = reader.take()) return *sample;
      if (deadline.has_passed()) throw std::runtime_error("nothing came");
      process::wait_readable(std::array{signal.descriptor()}, deadline.left());
    }
  };
  const hal::ControllerKind kind = echo_kind();
  std::thread controllers([&] { run_controllers(kind, options_for(hold.domain(), "m1", "echo")); });

  hal::node::exchange::Session session = session_for(*from_wire(wait_for(hellos)), 1);
  session.server = "s";
  wire::Session session_sample = to_wire(session, process::this_process());
  EXPECT_TRUE(sessions.write(session_sample));
  std::vector<std::string> states;
  const std::array<hal::node::exchange::Event::What, 3> happens{Start{}, ControlDue{}, Stop{}};
  for (const std::uint64_t sequence : {1U, 2U, 2U, 3U}) {
    hal::node::exchange::Step step = step_with(happens.at(sequence - 1), sequence);
    step.server = "s";
    step.run = 1;
    wire::Step sample;
    to_wire(step, sample);
    EXPECT_TRUE(steps.write(sample));
    states.push_back(wait_for(replies).actions().at(0).text());
  }
  controllers.join();
  EXPECT_EQ(states, (std::vector<std::string>{"started", "stepped 1", "stepped 1", "stopped"}));
}

}  // namespace
}  // namespace gateway::exchange
