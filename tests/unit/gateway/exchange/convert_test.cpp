#include "gateway/exchange/convert.h"
#include "gateway/exchange/reply_bytes.h"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "hal/types/random.h"

// Values are sent through the encoding of DDS, not only through the structures.

namespace gateway::exchange {
namespace {

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
  return agent;
}

hal::node::exchange::Event any_event(Anything& any) {
  hal::node::exchange::Event event;
  event.agent = any.agent();
  event.time = any.time();
  event.cause = any.enumerator(hal::node::exchange::Cause::kStop);
  event.readings = any.list([&] {
    return hal::node::exchange::Reading{any.u16(), any.numbers(), any.flag()};
  });
  if (any.flag()) event.message = {any.agent(), any.agent(), any.u32(), any.text(), any.bytes()};
  event.timer = any.u32();
  event.noticed = any.u32();
  event.fate = any.enumerator(hal::Fate::kFailed);
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

/// Only what belongs to its kind travels with an action.
hal::node::exchange::Action any_action(Anything& any) {
  using enum hal::node::exchange::ActionKind;
  hal::node::exchange::Action action;
  action.agent = any.agent();
  action.event = any.u32();
  action.kind = any.enumerator(kRecord);
  if (action.kind == kDriveBody || action.kind == kDriveWheels) {
    action.twist = {any.number(), any.number(), any.number()};
    action.wheel_speeds = any.numbers();
  }
  if (action.kind == kSend || action.kind == kInvalidate) {
    action.message_id = any.u32();
    action.destination = any.agent();
    action.topic = any.text();
    action.payload = any.bytes();
  }
  action.timer = any.u32();
  action.at = any.time();
  action.radio_on = any.flag();
  action.text = any.text();
  if (action.kind == kRecord) action.value = any.number();
  action.level = any.enumerator(hal::log::Level::kError);
  return action;
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
    const hal::node::exchange::Step step{any.text(), any.u64(), any.u64(), any.time(),
                                         any.list([&] { return any_event(any); })};
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
  EXPECT_EQ(result.error().message, "unknown cause 7");
}

TEST(Conversion, AnActionWithoutWhatItsKindNeedsIsAProtocolError) {
  for (const auto& [kind, message] : {std::pair{wire::SEND, "0 messages in an action"},
                                      std::pair{wire::DRIVE_BODY, "0 velocities in an action"},
                                      std::pair{wire::RECORD, "0 values in an action"}}) {
    wire::Reply sample;
    sample.actions().resize(1);
    sample.actions()[0].kind(kind);
    const auto arrived = from_wire(travelled(sample));
    ASSERT_FALSE(arrived);
    EXPECT_EQ(arrived.error().code, hal::Errc::kProtocol);
    EXPECT_EQ(arrived.error().message, message);
  }
}

TEST(Conversion, TwoMessagesInAnEventAreAProtocolError) {
  wire::Step sample;
  sample.events().resize(1);
  sample.events()[0].message().resize(2);
  hal::node::exchange::Step arrived;
  const auto result = from_wire(travelled(sample), arrived);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, hal::Errc::kProtocol);
  EXPECT_EQ(result.error().message, "2 messages in an event");
}

}  // namespace
}  // namespace gateway::exchange
