#include "gateway/exchange/convert.h"
#include "gateway/exchange/reply_bytes.h"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <variant>

#include "hal/types/random.h"

// Values are sent through the encoding of DDS, not only through the structures.

namespace gateway::exchange {
namespace {

using hal::node::exchange::Action;
using hal::node::exchange::Event;

constexpr int kRounds = 200;

template <class Wire>
Wire travelled(const Wire& sample) {
  std::vector<char> buffer(Wire::getCdrSerializedSize(sample));
  eprosima::fastcdr::FastBuffer out_buffer(buffer.data(), buffer.size());
  eprosima::fastcdr::Cdr out(out_buffer);
  sample.serialize(out);
  eprosima::fastcdr::FastBuffer in_buffer(buffer.data(), buffer.size());
  eprosima::fastcdr::Cdr in(in_buffer);
  Wire arrived;
  arrived.deserialize(in);
  return arrived;
}

/// Random values of every kind, extremes included.
class Anything {
 public:
  bool flag() { return random_.below(2) == 1; }
  std::uint16_t u16() { return static_cast<std::uint16_t>(random_.next()); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(random_.next()); }
  std::uint64_t u64() { return random_.next(); }
  std::int64_t i64() { return static_cast<std::int64_t>(random_.next()); }
  hal::Duration duration() { return hal::Duration{i64()}; }
  hal::Time time() { return hal::time_from_ns(i64()); }
  hal::Priority priority() { return hal::Priority{static_cast<std::uint8_t>(random_.below(256))}; }
  hal::AgentId agent() { return hal::AgentId{u16()}; }
  double number() {
    const double extremes[] = {0.0,
                               -0.0,
                               std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::denorm_min(),
                               std::numeric_limits<double>::max(),
                               random_.normal()};
    return extremes[random_.below(6)];
  }
  template <class E>
  E enumerator(E last) {
    return static_cast<E>(random_.below(static_cast<std::uint32_t>(last) + 1));
  }
  template <class F>
  auto list(F&& make) {
    std::vector<decltype(make())> items;
    for (std::uint32_t n = random_.below(4); n > 0; --n) items.push_back(make());
    return items;
  }
  /// Any bytes but zero, which ends a string in DDS; also longer than any bound.
  std::string text() {
    std::string text;
    for (std::uint32_t n = random_.below(300); n > 0; --n) {
      text += static_cast<char>(1 + random_.below(255));
    }
    return text;
  }
  std::vector<std::string> texts() {
    return list([this] { return text(); });
  }
  std::vector<double> numbers() {
    return list([this] { return number(); });
  }
  hal::Bytes bytes() {
    return list([this] { return static_cast<std::uint8_t>(random_.below(256)); });
  }

 private:
  hal::RandomStream random_{1, "convert_test"};
};

hal::node::exchange::Hello any_hello(Anything& any) {
  hal::node::exchange::Hello hello;
  hello.version = any.u32();
  hello.process = any.text();
  hello.instance = any.text();
  hello.program = any.text();
  hello.host = any.text();
  hello.pid = any.i64();
  hello.pid_start_time = any.u64();
  hello.patterns = any.texts();
  hello.kind = any.enumerator(hal::AgentKind::kRobot);
  hello.both_kinds = any.flag();
  hello.wants = {any.texts(), any.texts(), any.flag(), any.texts(), any.flag()};
  return hello;
}

hal::Channel any_channel(Anything& any) {
  return {any.u16(),
          any.text(),
          any.text(),
          any.text(),
          any.u32(),
          any.duration(),
          any.text(),
          any.numbers(),
          any.number(),
          any.number(),
          {any.number(), any.number(), any.number()},
          any.number()};
}

hal::RobotBody any_body(Anything& any) {
  const auto solid = [&] {
    return hal::Solid{any.enumerator(hal::Solid::Shape::kCylinder),
                      {any.number(), any.number(), any.number()},
                      {any.number(), any.number(), any.number()},
                      any.number()};
  };
  const auto wheel = [&] {
    return hal::BodyWheel{any.flag(),   {any.number(), any.number()},
                          any.number(), any.number(),
                          any.number(), any.number(),
                          any.number()};
  };
  return {any.text(), any.list(solid), any.list(wheel)};
}

hal::node::exchange::AgentSession any_agent(Anything& any) {
  hal::node::exchange::AgentSession agent;
  agent.agent = any.agent();
  agent.name = any.text();
  agent.kind = any.enumerator(hal::AgentKind::kRobot);
  agent.seed = any.u64();
  agent.control_period = any.duration();
  agent.parameters = any.list([&] {
    return hal::node::exchange::ParameterText{any.text(), any.text(), any.text(), any.flag(),
                                              any.texts()};
  });
  agent.channels = any.list([&] { return any_channel(any); });
  agent.limits.body_to_wheel = any.list([&] {
    return std::array{any.number(), any.number(), any.number()};
  });
  agent.limits.wheel_to_body = agent.limits.body_to_wheel;
  for (auto& row : agent.limits.wheel_to_body) row[1] = any.number();
  agent.limits.wheel_speed = any.number();
  agent.air_interface = any.text();
  agent.body = any_body(any);
  return agent;
}

/// One of each cause, in their order.
std::vector<Event::What> any_happenings(Anything& any) {
  return {hal::node::exchange::Start{},
          hal::node::exchange::MessageArrived{
              {any.agent(), any.agent(), any.u32(), any.text(), any.bytes(), any.priority()}},
          hal::node::exchange::TimerDue{any.u32()},
          hal::node::exchange::Notice{any.u32(), any.enumerator(hal::Fate::kFailed)},
          hal::node::exchange::LinkChanged{},
          hal::node::exchange::ControlDue{},
          hal::node::exchange::Stop{}};
}

Event::What any_happening(Anything& any) {
  const auto cause = static_cast<std::size_t>(any.enumerator(hal::node::exchange::Cause::kStop));
  return any_happenings(any).at(cause);
}

Event any_event(Anything& any, Event::What what) {
  Event event;
  event.agent = any.agent();
  event.time = any.time();
  event.what = std::move(what);
  event.readings = any.list([&] {
    return hal::node::exchange::Reading{any.u16(), any.numbers(), any.flag()};
  });
  event.routes = any.list([&] {
    const hal::PathStatistics path{any.u16(), any.duration(), any.number(), any.number()};
    return hal::RouteChange{{any.text(), any.agent(), any.agent(), path}, any.flag()};
  });
  event.neighbours = any.list([&] {
    return hal::Neighbour{any.agent(), any.time(), any.number()};
  });
  event.lost_neighbours = any.list([&] { return any.agent(); });
  return event;
}

/// One of each kind, in their order.
std::vector<Action::What> any_commands(Anything& any) {
  return {
      hal::node::exchange::DriveBody{{any.number(), any.number(), any.number()}},
      hal::node::exchange::DriveWheels{any.numbers()},
      hal::node::exchange::Send{any.u32(), any.agent(), any.text(), any.bytes(), any.priority()},
      hal::node::exchange::Invalidate{any.agent(), any.text()},
      hal::node::exchange::SetTimer{any.u32(), any.time()},
      hal::node::exchange::SetRadio{any.flag()},
      hal::node::exchange::SetState{any.text()},
      hal::node::exchange::Log{any.enumerator(hal::log::Level::kError), any.text()},
      hal::node::exchange::ControllerFailed{any.text()},
      hal::node::exchange::Record{any.text(), any.number(), any.time()}};
}

Action any_action(Anything& any) {
  constexpr std::uint32_t kKinds = std::variant_size_v<Action::What>;
  return {any.agent(), any.u32(), any_commands(any).at(any.u32() % kKinds)};
}

TEST(Conversion, AnyHelloArrivesAsItWas) {
  Anything any;
  for (int round = 0; round < kRounds; ++round) {
    const hal::node::exchange::Hello hello = any_hello(any);
    EXPECT_EQ(*from_wire(travelled(to_wire(hello))), hello);
  }
}

TEST(Conversion, AnySessionArrivesAsItWas) {
  Anything any;
  for (int round = 0; round < kRounds; ++round) {
    const hal::node::exchange::Session session{
        any.u32(),
        any.text(),
        any.text(),
        any.u64(),
        any.text(),
        any.list([&] { return any_agent(any); }),
        any.list([&] {
          return hal::node::exchange::AgentName{any.agent(), any.text()};
        })};
    const process::ProcessIdentity server{any.text(), any.i64(), any.u64()};
    const wire::Session arrived = travelled(to_wire(session, server));
    EXPECT_EQ(*from_wire(arrived), session);
    EXPECT_EQ(from_wire(arrived.identity()), server);
  }
}

TEST(Conversion, AnyStepArrivesAsItWas) {
  Anything any;
  wire::Step sample;  // These two keep what was in them before.
  hal::node::exchange::Step arrived;
  for (int round = 0; round < kRounds; ++round) {
    const hal::node::exchange::Step step{
        any.text(), any.u64(), any.u64(), any.time(),
        any.list([&] { return any_event(any, any_happening(any)); })};
    to_wire(step, sample);
    ASSERT_TRUE(from_wire(travelled(sample), arrived));
    EXPECT_EQ(arrived, step);
  }
}

TEST(Conversion, AnyReplyArrivesAsItWas) {
  Anything any;
  wire::Reply sample;  // Keeps what was in it before.
  for (int round = 0; round < kRounds; ++round) {
    const hal::node::exchange::Reply reply{any.text(), any.u64(), any.u64(),
                                           any.list([&] { return any_action(any); })};
    to_wire(reply, "server", sample);
    EXPECT_EQ(*from_wire(travelled(sample)), reply);
    EXPECT_EQ(*reply_of(bytes_of(reply)), reply);
  }
}

TEST(Conversion, BytesOfNoReplyAreAProtocolError) {
  std::vector<std::uint8_t> bytes = bytes_of({"p", 1, 2, {}});
  bytes.resize(bytes.size() - 9);
  EXPECT_EQ(reply_of(bytes).error().code, hal::Errc::kProtocol);
  EXPECT_EQ(reply_of({}).error().code, hal::Errc::kProtocol);
}

TEST(Conversion, NotANumberKeepsItsBits) {
  const double nan = std::bit_cast<double>(std::uint64_t{0x7ff8'0000'0000'beef});
  hal::node::exchange::Step step;
  step.events.resize(1);
  step.events[0].readings = {{1, {nan}}};
  wire::Step sample;
  to_wire(step, sample);
  hal::node::exchange::Step arrived;
  ASSERT_TRUE(from_wire(travelled(sample), arrived));
  EXPECT_EQ(std::bit_cast<std::uint64_t>(arrived.events.at(0).readings.at(0).values.at(0)),
            0x7ff8'0000'0000'beef);
}

TEST(Conversion, ValueOutsideItsEnumerationIsAProtocolError) {
  hal::node::exchange::Step step;
  step.events.resize(1);
  wire::Step sample;
  to_wire(step, sample);
  sample.events()[0].cause(static_cast<wire::Cause>(7));  // kStop is 6.
  hal::node::exchange::Step arrived;
  const auto result = from_wire(travelled(sample), arrived);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, hal::Errc::kProtocol);
  EXPECT_EQ(result.error().message, "event 0 of agent 0: unknown cause 7");
}

TEST(Conversion, EachCauseOfAnEventArrivesAsItWas) {
  Anything any;
  wire::Step sample;
  hal::node::exchange::Step arrived;
  for (int round = 0; round < kRounds; ++round) {
    hal::node::exchange::Step step;
    for (Event::What& what : any_happenings(any))
      step.events.push_back(any_event(any, std::move(what)));
    ASSERT_EQ(step.events.size(), std::variant_size_v<Event::What>);
    to_wire(step, sample);
    ASSERT_TRUE(from_wire(travelled(sample), arrived));
    EXPECT_EQ(arrived, step);
    for (std::size_t i = 0; i < step.events.size(); ++i) EXPECT_EQ(step.events[i].what.index(), i);
  }
}

TEST(Conversion, EachKindOfActionArrivesAsItWas) {
  Anything any;
  wire::Reply sample;
  for (int round = 0; round < kRounds; ++round) {
    hal::node::exchange::Reply reply;
    for (Action::What& what : any_commands(any)) {
      reply.actions.push_back({any.agent(), any.u32(), std::move(what)});
    }
    ASSERT_EQ(reply.actions.size(), std::variant_size_v<Action::What>);
    to_wire(reply, "server", sample);
    EXPECT_EQ(*from_wire(travelled(sample)), reply);
    for (std::size_t i = 0; i < reply.actions.size(); ++i) {
      EXPECT_EQ(reply.actions[i].what.index(), i);
    }
    // In the memory of other kinds it is written the same.
    std::ranges::reverse(reply.actions);
    wire::Reply anew;
    to_wire(reply, "server", sample);
    to_wire(reply, "server", anew);
    EXPECT_EQ(sample, anew);
  }
}

std::string mistake_in(const wire::Action& action) {
  wire::Reply sample;
  sample.actions().resize(2);  // The first one is a good one.
  sample.actions()[0].kind(wire::STATE);
  sample.actions()[1] = action;
  const auto arrived = from_wire(travelled(sample));
  if (arrived) return {};
  EXPECT_EQ(arrived.error().code, hal::Errc::kProtocol);
  return arrived.error().message;
}

TEST(Conversion, AnActionWithoutWhatItsKindNeedsIsAProtocolErrorThatNamesIt) {
  wire::Action action;
  action.agent(7);
  for (const auto& [kind, message] :
       {std::pair{wire::SEND, "0 messages instead of 1"},
        std::pair{wire::INVALIDATE, "0 messages instead of 1"},
        std::pair{wire::DRIVE_BODY, "0 velocities instead of 1"},
        std::pair{wire::DRIVE_WHEELS, "0 velocities instead of 1"},
        std::pair{wire::RECORD, "0 values instead of 1"},
        std::pair{static_cast<wire::ActionKind>(200), "unknown action kind 200"}}) {
    action.kind(kind);
    EXPECT_EQ(mistake_in(action), "action 1 of agent 7: " + std::string(message));
  }
  action.kind(wire::STATE);
  EXPECT_EQ(mistake_in(action), "");
  action.outgoing().resize(1);
  EXPECT_EQ(mistake_in(action), "action 1 of agent 7: 1 messages instead of 0");
  action.outgoing().clear();
  action.level(static_cast<wire::LogLevel>(4));
  EXPECT_EQ(mistake_in(action), "action 1 of agent 7: unknown log level 4");
}

TEST(Conversion, AnEventWithoutItsMessageOrWithTwoIsAProtocolErrorThatNamesIt) {
  wire::Step sample;
  sample.events().resize(1);
  wire::Event& event = sample.events()[0];
  event.agent(7);
  hal::node::exchange::Step arrived;
  const auto mistake = [&] {
    const auto result = from_wire(travelled(sample), arrived);
    return result ? std::string() : result.error().message;
  };
  event.cause(wire::MESSAGE);
  EXPECT_EQ(mistake(), "event 0 of agent 7: 0 messages instead of 1");
  event.message().resize(1);
  EXPECT_EQ(mistake(), "");
  event.message().resize(2);
  EXPECT_EQ(mistake(), "event 0 of agent 7: 2 messages instead of 1");
  event.message().resize(1);
  event.cause(wire::CONTROL);
  EXPECT_EQ(mistake(), "event 0 of agent 7: 1 messages instead of 0");
  event.message().clear();
  event.fate(static_cast<wire::Fate>(4));
  EXPECT_EQ(mistake(), "event 0 of agent 7: unknown fate 4");
  event.fate(wire::HANDED_OVER);
  event.network().resize(2);
  EXPECT_EQ(mistake(), "event 0 of agent 7: 2 changes of the network instead of at most 1");
}

}  // namespace
}  // namespace gateway::exchange
