#include "sim/agents/fingerprint_feed.h"

#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "sim/radio/mac/frame.h"

namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Time;
using hal::node::exchange::Action;
using hal::node::exchange::Event;
namespace exchange = hal::node::exchange;
using sim::agents::BodyState;
using sim::agents::FingerprintFeed;
using sim::radio::Frame;

/// One of everything a fingerprint is made of.
struct Observations {
  Time at{1500ms};
  Frame frame;
  AgentId receiver{2};
  hal::Verdict verdict = hal::Verdict::kDelivered;
  double power = -70.5;
  std::optional<AgentId> access_point{AgentId{3}};
  sim::radio::MacRequest lost{.destination = AgentId{4}, .payload = nullptr};
  hal::Verdict why = hal::Verdict::kRetryLimit;
  BodyState body{.x = 1, .y = 2, .theta = 0.5, .tilt = 1e-4};
  Event event;
  exchange::MessageArrived arrived{{AgentId{2}, AgentId{1}, 9, "help", {4}}};
  exchange::TimerDue due{1};
  exchange::Notice notice{2, hal::Fate::kFailed};
  AgentId actor{1};
  exchange::DriveBody body_speed{{0.1, 0.2, 0.3}};
  exchange::DriveWheels wheel_speeds{{1, 2, 3}};
  exchange::Send send{4, AgentId{6}, "help", {9, 8}};
  exchange::Invalidate invalidate{AgentId{6}, "help"};
  exchange::SetTimer timer{2, Time{3s}};
  exchange::SetRadio radio{true};
  exchange::SetState state{"IDLE"};
  exchange::Log line{hal::log::Level::kInfo, "IDLE"};
  exchange::ControllerFailed failed{"IDLE"};
  exchange::Record record{"IDLE", 0.5, Time{3s}};
  hal::RouteChange route;
  bool swap = false;  ///< The two events the other way round.

  Observations() {
    frame.id = 7;
    frame.transmitter = AgentId{1};
    frame.receiver = AgentId{2};
    frame.duration = 300us;
    frame.sequence = 5;
    frame.rate = hal::BitsPerSecond{11e6};
    frame.air_length = 272;
    frame.ds = sim::radio::Ds::kTo;
    frame.address3 = AgentId{5};
    frame.ethertype = 0x88b5;
    frame.payload = std::make_shared<const hal::Bytes>(hal::Bytes{1, 2, 3});
    event = {.agent = AgentId{1},
             .time = at,
             .what = {},
             .readings = {{.channel = 3, .values = {0.25, 0.5}}},
             .routes = {{{"help", AgentId{4}, AgentId{3}, {2, 1ms, 20.0, 0.1}}, false}},
             .neighbours = {{AgentId{3}, Time{1s}, -60}},
             .lost_neighbours = {AgentId{5}}};
    route = {{"help", AgentId{4}, AgentId{3}, {2, 1ms, 20.0, 0.1}}, false};
  }

  std::uint64_t total() const {
    FingerprintFeed feed;
    feed.on_frame_start(at, frame);
    feed.on_reception(at, frame, receiver, verdict, power);
    feed.on_association(at, AgentId{1}, access_point);
    feed.on_relay_lost(at, AgentId{1}, lost, why);
    feed.on_body(at, AgentId{1}, body);
    feed_event(feed, swap ? Event::What(due) : Event::What(arrived));
    feed_event(feed, swap ? Event::What(arrived) : Event::What(due));
    feed_event(feed, notice);
    for (const Action::What& what : actions()) feed.on_action(at, {actor, 0, what});
    feed.on_route_change(at, AgentId{1}, route);
    return feed.fingerprint().total();
  }

  std::vector<Action::What> actions() const {
    return {body_speed, wheel_speeds, send, invalidate, timer, radio, state, line, failed, record};
  }

 private:
  void feed_event(FingerprintFeed& feed, const Event::What& what) const {
    Event happened = event;
    happened.what = what;
    feed.on_event(happened);
  }
};

/// The next representable number: one bit.
void nudge(double& value) {
  value = std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^ 1u);
}

using Mutation = std::function<void(Observations&)>;

std::vector<Mutation> air_and_body_mutations() {
  return {
      [](auto& o) { o.at += 1ns; },
      [](auto& o) { o.frame.id ^= 1; },
      [](auto& o) { o.frame.type = sim::radio::FrameType::kRts; },
      [](auto& o) { o.frame.transmitter.value ^= 1; },
      [](auto& o) { o.frame.receiver.value ^= 1; },
      [](auto& o) { o.frame.duration += 1ns; },
      [](auto& o) { o.frame.sequence ^= 1; },
      [](auto& o) { o.frame.retry = true; },
      [](auto& o) { nudge(o.frame.rate.value); },
      [](auto& o) { o.frame.air_length ^= 1; },
      [](auto& o) { o.frame.ethertype ^= 1; },
      [](auto& o) { o.frame.ds = sim::radio::Ds::kFrom; },
      [](auto& o) { o.frame.address3.value ^= 1; },
      [](auto& o) { o.access_point->value ^= 1; },
      [](auto& o) { o.access_point.reset(); },
      [](auto& o) { o.lost.destination.value ^= 1; },
      [](auto& o) { o.why = hal::Verdict::kNoRoute; },
      [](auto& o) {
        o.frame.payload = std::make_shared<const hal::Bytes>(hal::Bytes{1, 2, 2});
      },
      [](auto& o) { o.receiver.value ^= 1; },
      [](auto& o) { o.verdict = hal::Verdict::kCollision; },
      [](auto& o) { nudge(o.power); },
      [](auto& o) { nudge(o.body.x); },
      [](auto& o) { nudge(o.body.y); },
      [](auto& o) { nudge(o.body.theta); },
      [](auto& o) { nudge(o.body.tilt); },
  };
}

std::vector<Mutation> event_mutations() {
  return {
      [](auto& o) { o.swap = true; },
      [](auto& o) { o.event.agent.value ^= 1; },
      [](auto& o) { o.event.time += 1ns; },
      [](auto& o) { o.event.readings[0].channel ^= 1; },
      [](auto& o) { nudge(o.event.readings[0].values[1]); },
      [](auto& o) { o.arrived.message.source.value ^= 1; },
      [](auto& o) { o.arrived.message.destination.value ^= 1; },
      [](auto& o) { o.arrived.message.id ^= 1; },
      [](auto& o) { o.arrived.message.topic = "hemp"; },
      [](auto& o) { o.arrived.message.payload[0] ^= 1; },
      [](auto& o) { o.due.timer ^= 1; },
      [](auto& o) { o.notice.message ^= 1; },
      [](auto& o) { o.notice.fate = hal::Fate::kNoRoute; },
      [](auto& o) { o.event.routes[0].removed = true; },
      [](auto& o) { o.event.neighbours[0].id.value ^= 1; },
      [](auto& o) { nudge(o.event.neighbours[0].rssi_dbm); },
      [](auto& o) { o.event.lost_neighbours[0].value ^= 1; },
  };
}

std::vector<Mutation> action_and_route_mutations() {
  return {
      [](auto& o) { o.actor.value ^= 1; },
      [](auto& o) { nudge(o.body_speed.twist.vx); },
      [](auto& o) { nudge(o.body_speed.twist.vy); },
      [](auto& o) { nudge(o.body_speed.twist.omega); },
      [](auto& o) { nudge(o.wheel_speeds.speeds[2]); },
      [](auto& o) { o.send.id ^= 1; },
      [](auto& o) { o.send.destination.value ^= 1; },
      [](auto& o) { o.send.topic = "hemp"; },
      [](auto& o) { o.send.payload[1] ^= 1; },
      [](auto& o) { o.invalidate.destination.value ^= 1; },
      [](auto& o) { o.invalidate.topic = "hemp"; },
      [](auto& o) { o.timer.timer ^= 1; },
      [](auto& o) { o.timer.at += 1ns; },
      [](auto& o) { o.radio.on = false; },
      [](auto& o) { o.state.name = "IDLF"; },
      [](auto& o) { o.line.level = hal::log::Level::kError; },
      [](auto& o) { o.line.text = "IDLF"; },
      [](auto& o) { o.failed.text = "IDLF"; },
      [](auto& o) { o.record.name = "IDLF"; },
      [](auto& o) { nudge(o.record.value); },
      [](auto& o) { o.record.at += 1ns; },
      [](auto& o) { o.route.removed = true; },
      [](auto& o) { o.route.route.topic = "hemp"; },
      [](auto& o) { o.route.route.destination.value ^= 1; },
      [](auto& o) { o.route.route.next_hop.value ^= 1; },
      [](auto& o) { o.route.route.path.hops ^= 1; },
      [](auto& o) { o.route.route.path.delay += 1ns; },
      [](auto& o) { nudge(o.route.route.path.min_snr_db); },
      [](auto& o) { nudge(o.route.route.path.energy); },
  };
}

TEST(FingerprintFeed, EqualObservationsGiveEqualFingerprints) {
  EXPECT_EQ(Observations().total(), Observations().total());
}

// Each mutation flips one bit, or the smallest step, of one ingredient, or swaps two events. All
// fingerprints must differ from the original and from each other.
TEST(FingerprintFeed, OneBitOfAnyIngredientChangesIt) {
  std::set<std::uint64_t> totals{Observations().total()};
  std::size_t expected = 1;
  for (const auto& mutations :
       {air_and_body_mutations(), event_mutations(), action_and_route_mutations()}) {
    for (std::size_t i = 0; i < mutations.size(); ++i) {
      Observations mutated;
      mutations[i](mutated);
      totals.insert(mutated.total());
      EXPECT_EQ(totals.size(), ++expected) << "mutation " << i;
    }
  }
}

std::uint64_t fingerprint_of(const Action& action) {
  FingerprintFeed feed;
  feed.on_action(Time{1s}, action);
  return feed.fingerprint().total();
}

std::uint64_t fingerprint_of(const Event::What& what) {
  FingerprintFeed feed;
  feed.on_event({.agent = AgentId{1},
                 .time = Time{1s},
                 .what = what,
                 .readings = {},
                 .routes = {},
                 .neighbours = {},
                 .lost_neighbours = {}});
  return feed.fingerprint().total();
}

TEST(FingerprintFeed, TheKindOfAnActionAndTheCauseOfAnEventCount) {
  std::set<std::uint64_t> totals;
  const std::vector<Action::What> kinds{
      exchange::DriveBody{},  exchange::DriveWheels{}, exchange::Send{},
      exchange::Invalidate{}, exchange::SetTimer{},    exchange::SetRadio{},
      exchange::SetState{},   exchange::Log{},         exchange::ControllerFailed{},
      exchange::Record{}};
  for (const Action::What& what : kinds) totals.insert(fingerprint_of({AgentId{1}, 0, what}));
  const std::vector<Event::What> causes{
      exchange::Start{},       exchange::MessageArrived{}, exchange::TimerDue{}, exchange::Notice{},
      exchange::LinkChanged{}, exchange::ControlDue{},     exchange::Stop{}};
  for (const Event::What& what : causes) totals.insert(fingerprint_of(what));
  EXPECT_EQ(totals.size(), kinds.size() + causes.size());
}

TEST(FingerprintFeed, HowTheRunWasComputedDoesNotCount) {
  // The index in a Step depends on how agents share processes.
  EXPECT_EQ(fingerprint_of({AgentId{1}, 0, exchange::Log{}}),
            fingerprint_of({AgentId{1}, 17, exchange::Log{}}));
}

}  // namespace
