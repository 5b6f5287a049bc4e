#include "hal/node/agent/agent_core.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/types/log.h"
#include "tests/support/fake_clock.h"
#include "tests/support/printers.h"

namespace hal::node::agent {
namespace {

using namespace std::chrono_literals;
using exchange::Action;
using exchange::Cause;
using exchange::Event;
using exchange::Reading;
using tests::FakeClock;

const AgentId kSelf{1}, kOther{2};
const Neighbour kHeard{.id = kOther, .last_heard = Time{1s}, .rssi_dbm = -50};

class FakeLink final : public Link {
 public:
  routing::LinkCapabilities capabilities() const override { return {.tx_status = true}; }
  void transmit(AgentId, Bytes, const routing::LinkOptions& options) override {
    ++frames;
    last = options.priority;
  }
  Duration expected_delay() const override { return 1ms; }
  double transmit_energy(std::size_t) const override { return 0; }
  void set_radio(bool is_on) override { on = is_on; }

  int frames = 0;
  Priority last{};  ///< Of the last frame.
  bool on = true;
};

class FakeDrive final : public Drive {
 public:
  Result<void> drive(const Twist2& body, Time as_of) override {
    if (blind) return fail(Errc::kNotAvailable, "dust");
    twist = body;
    commanded_at = as_of;
    return {};
  }
  Result<void> drive_wheels(std::span<const double> of_wheels, Time) override {
    speeds.assign(of_wheels.begin(), of_wheels.end());
    return {};
  }
  void halt() override { twist = {}; }

  Twist2 twist;
  std::vector<double> speeds;
  Time commanded_at{};
  bool blind = false;
};

/// Each channel reads its own number and how often the sensors were advanced.
class FakeSensors final : public Sensors {
 public:
  void advance(Time) override { ++advanced; }
  bool sample(std::size_t channel, Time, std::vector<double>& values) override {
    ++samples;
    if (channel == silent) return false;
    values = {static_cast<double>(channel), static_cast<double>(advanced)};
    return true;
  }

  int advanced = 0, samples = 0;
  std::optional<std::size_t> silent;
};

class Notes final : public AgentObserver, public AgentListener {
 public:
  bool observes_readings() const override { return !observed.empty(); }
  bool observes(AgentId, const Channel& channel) const override { return channel.name == observed; }
  void on_reading(Time, AgentId, const Channel& channel, std::span<const double>) override {
    readings.push_back(channel.name);
  }
  void on_message_sent(Time, const Message& message) override {
    sent.push_back(message.id);
    priorities.push_back(message.priority);
  }
  void on_inbox(AgentId) override { ++inbox; }
  void on_state(AgentId, const std::string& state) override { states.push_back(state); }
  void on_state(Time, AgentId, std::string_view) override {}
  void on_record(Time at, AgentId, std::string_view name, double value) override {
    records.push_back(fmt::format("{} {} {}", to_seconds(at), name, value));
  }

  std::string observed;
  std::vector<std::string> readings, states, records;
  std::vector<MessageId> sent;
  std::vector<Priority> priorities;  ///< Of those.
  int inbox = 0;
};

/// A robot with two channels, "a" and "b", and a drive.
class Core : public testing::Test {
 protected:
  Core() {
    exchange::AgentSession session;
    session.agent = kSelf;
    session.name = "r0";
    session.limits = {
        .body_to_wheel = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, .wheel_to_body = {}, .wheel_speed = 20};
    for (const char* name : {"a", "b"}) {
      Channel& channel = session.channels.emplace_back();
      channel.id = static_cast<std::uint16_t>(10 * session.channels.size());
      channel.name = name;
    }
    core_.emplace(session, routing::RoutingConfig{.priorities = {{"alarm", Priority{7}}}},
                  AgentCore::Ports{clock_, link_, &drive_, sensors_, notes_, notes_});
    log::set_level(log::Level::kError);
  }

  void start(const Wants& wants = {}) {
    core_->connect(wants);
    core_->start();
    core_->take_events();
  }
  std::vector<Cause> causes() {
    std::vector<Cause> causes;
    for (const Event& event : core_->take_events()) causes.push_back(event.cause());
    return causes;
  }
  /// An action that comes now.
  Result<void> apply(Action::What what) { return apply(std::move(what), clock_.now()); }
  Result<void> apply(Action::What what, Time as_of) {
    return core_->apply({kSelf, 0, std::move(what)}, as_of);
  }
  bool send(MessageId id) {
    return apply(exchange::Send{.id = id, .destination = kOther, .topic = "test", .payload = {}})
        .has_value();
  }

  bool record(const std::string& name, double value, Time at) {
    return apply(exchange::Record{name, value, at}).has_value();
  }

  FakeClock clock_;
  MessageId last_ = 0;
  FakeLink link_;
  FakeDrive drive_;
  FakeSensors sensors_;
  Notes notes_;
  std::optional<AgentCore> core_;
};

TEST_F(Core, TheFileGivesTheMessagesOfATopicAPriorityInPlaceOfTheControllers) {
  start();
  link_.last = {};
  const auto priority_of = [&](const char* topic, Priority asked) {
    EXPECT_TRUE(apply(exchange::Send{.id = ++last_,
                                     .destination = kNeighbours,
                                     .topic = topic,
                                     .payload = {},
                                     .priority = asked}));
    EXPECT_EQ(link_.last, notes_.priorities.back()) << "on the air as in the record";
    return link_.last;
  };
  EXPECT_EQ(priority_of("plain", {}), Priority::kBestEffort);
  EXPECT_EQ(priority_of("plain", Priority::kVideo), Priority::kVideo);
  EXPECT_EQ(priority_of("alarm", {}), Priority{7});
  EXPECT_EQ(priority_of("alarm", Priority::kVideo), Priority{7});
}

TEST_F(Core, WithoutAControllerNothingWaitsForAnybody) {
  core_->on_message({kOther, kSelf, 1, "test", {}}, 1);
  core_->on_neighbour(kHeard);
  core_->control();
  core_->stop();
  EXPECT_TRUE(core_->take_events().empty());
  EXPECT_EQ(notes_.inbox, 0);
  EXPECT_EQ(sensors_.advanced, 1) << "odometry adds up all the same";
}

TEST_F(Core, WhatComesBeforeTheStartIsToldAfterItAsOfThen) {
  core_->connect({});
  core_->on_message({kOther, kSelf, 1, "test", {}}, 1);
  EXPECT_TRUE(core_->take_events().empty());
  clock_.run_until(Time{3s});
  core_->start();
  const auto events = core_->take_events();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].cause(), Cause::kStart);
  EXPECT_EQ(events[1].cause(), Cause::kMessage);
  EXPECT_EQ(events[1].time, Time{3s});
  core_->start();
  EXPECT_TRUE(core_->take_events().empty());
}

TEST_F(Core, AfterStopOnlyWordsTakeEffect) {
  start();
  core_->stop();
  core_->on_message({kOther, kSelf, 1, "test", {}}, 1);
  EXPECT_EQ(causes(), std::vector{Cause::kStop});
  EXPECT_TRUE(apply(exchange::DriveBody{{.vx = 1}}));
  EXPECT_TRUE(apply(exchange::SetState{"BYE"}));
  EXPECT_EQ(drive_.twist, Twist2{});
  EXPECT_EQ(notes_.states, std::vector<std::string>{"BYE"});
  EXPECT_EQ(core_->refused(), 0u);
}

TEST_F(Core, AControllerThatIsStoppedBeforeItStartsIsStartedFirst) {
  core_->connect({});
  core_->stop();
  EXPECT_EQ(causes(), (std::vector{Cause::kStart, Cause::kStop}));
}

TEST_F(Core, AControlEventHoldsWhatWasAskedForAndSilentOnesAsLost) {
  start({.channels = {"b"}});
  core_->control();
  EXPECT_EQ(core_->take_events().at(0).readings, (std::vector<Reading>{{20, {1, 1}}}));
  EXPECT_EQ(sensors_.samples, 1) << "nobody looks at the other one";
  sensors_.silent = 1;
  core_->control();
  EXPECT_EQ(core_->take_events().at(0).readings,
            (std::vector<Reading>{{.channel = 20, .values = {}, .lost = true}}));
}

TEST_F(Core, AChannelIsShownWhetherOrNotTheControllerAsksAndSampledOnce) {
  notes_.observed = "a";
  core_->control();
  EXPECT_EQ(notes_.readings, std::vector<std::string>{"a"}) << "without a controller";
  start({.channels = {"a"}});
  core_->control();
  EXPECT_EQ(notes_.readings.size(), 2u);
  EXPECT_EQ(sensors_.samples, 2);
  EXPECT_EQ(core_->take_events().at(0).readings.size(), 1u);
}

TEST_F(Core, ANeighbourLostAndHeardInOneInstantIsThereAndTheOtherWayRoundItIsNot) {
  start({.neighbours = true});
  core_->on_neighbour(kHeard);
  core_->take_events();
  core_->on_neighbour_lost(kOther);
  core_->on_neighbour(kHeard);
  auto events = core_->take_events();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].neighbours, std::vector{kHeard});
  EXPECT_TRUE(events[0].lost_neighbours.empty());
  core_->on_neighbour(kHeard);
  core_->on_neighbour_lost(kOther);
  events = core_->take_events();
  EXPECT_TRUE(events.at(0).neighbours.empty());
  EXPECT_EQ(events.at(0).lost_neighbours, std::vector{kOther});
}

TEST_F(Core, NoticesBearTheNumbersOfTheControllerThatSentAndEndWithIt) {
  start();
  EXPECT_TRUE(send(1));
  EXPECT_TRUE(send(2));
  core_->disconnect();
  start();
  EXPECT_TRUE(send(1));
  EXPECT_EQ(notes_.sent, (std::vector<MessageId>{1, 2, 3}));
  core_->on_fate(1, Fate::kFailed);
  EXPECT_TRUE(core_->take_events().empty()) << "of the controller before";
  core_->on_fate(3, Fate::kHandedOver);
  const auto events = core_->take_events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(std::get<exchange::Notice>(events[0].what).message, 1u);
}

TEST_F(Core, WhatIsAgainstTheRulesIsRefusedCountedAndTakesNoEffect) {
  start();
  const exchange::Send nowhere{.id = 1, .destination = {}, .topic = "test", .payload = {}};
  EXPECT_EQ(apply(nowhere).error().code, Errc::kInvalidArgument);
  EXPECT_FALSE(apply(exchange::DriveWheels{{21, 0, 0}}));
  EXPECT_TRUE(drive_.speeds.empty());
  drive_.blind = true;
  EXPECT_EQ(apply(exchange::DriveBody{}).error().code, Errc::kNotAvailable);
  EXPECT_EQ(core_->refused(), 3u);
  EXPECT_TRUE(notes_.sent.empty());
}

TEST_F(Core, ACommandIsAsOldAsItsAnswer) {
  start();
  EXPECT_TRUE(apply(exchange::DriveBody{{.vx = 0.5}}, Time{7s}));
  EXPECT_EQ(drive_.twist.vx, 0.5);
  EXPECT_EQ(drive_.commanded_at, Time{7s});
  core_->halt();
  EXPECT_EQ(drive_.twist, Twist2{});
}

TEST_F(Core, ATimerComesOnceMayBeMovedAndEndsWithItsController) {
  start();
  EXPECT_TRUE(apply(exchange::SetTimer{7, Time{1s}}));
  EXPECT_TRUE(apply(exchange::SetTimer{7, Time{2s}}));
  clock_.run_until(Time{5s});
  const auto events = core_->take_events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].time, Time{2s});
  EXPECT_EQ(std::get<exchange::TimerDue>(events[0].what).timer, 7u);
  EXPECT_TRUE(apply(exchange::SetTimer{7, Time{1s}})) << "which is over";
  clock_.run_until(clock_.now());
  EXPECT_EQ(causes(), std::vector{Cause::kTimer});
  EXPECT_TRUE(apply(exchange::SetTimer{7, Time{6s}}));
  core_->disconnect();
  start();
  clock_.run_until(Time{9s});
  EXPECT_TRUE(core_->take_events().empty());
}

TEST_F(Core, SwitchesTheRadio) {
  start();
  EXPECT_TRUE(apply(exchange::SetRadio{false}));
  EXPECT_FALSE(link_.on);
}

TEST_F(Core, ShowsWhatIsRecordedWithItsTimeUpToNowAndAlsoInTheEnd) {
  start();
  clock_.run_until(Time{2s});
  EXPECT_TRUE(record("a", 1.5, Time{1s}));
  EXPECT_TRUE(record("b", -2, Time{3s})) << "a time to come is none";
  core_->stop();
  EXPECT_TRUE(record("c", 0, Time{-1s}));
  EXPECT_FALSE(record("", 0, Time{1s}));
  EXPECT_EQ(notes_.records, (std::vector<std::string>{"1 a 1.5", "2 b -2", "0 c 0"}));
  EXPECT_EQ(core_->refused(), 1u);
}

TEST_F(Core, RecordsSoManyNamesOfEachControllerAndNoMore) {
  for (std::uint64_t controllers = 1; controllers <= 2; ++controllers) {
    start();
    for (std::size_t i = 0; i <= kMaxRecordedNames; ++i) {
      EXPECT_EQ(record(fmt::format("{} {}", controllers, i), 1, {}), i < kMaxRecordedNames);
    }
    EXPECT_EQ(core_->refused(), controllers);
    core_->disconnect();
  }
}

}  // namespace
}  // namespace hal::node::agent
