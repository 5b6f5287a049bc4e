#include "sim/agents/fingerprint_feed.h"

#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "sim/radio/frame.h"

namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Time;
using hal::node::exchange::Action;
using hal::node::exchange::Event;
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
  Action action;
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
             .cause = hal::node::exchange::Cause::kMessage,
             .readings = {{.channel = 3, .values = {0.25, 0.5}}},
             .message = hal::Message{AgentId{2}, AgentId{1}, 9, "help", {4}},
             .timer = 1,
             .noticed = 2,
             .fate = hal::Fate::kFailed,
             .routes = {{{"help", AgentId{4}, AgentId{3}, {2, 1ms, 20.0, 0.1}}, false}},
             .neighbours = {{AgentId{3}, Time{1s}, -60}},
             .lost_neighbours = {AgentId{5}}};
    action = {.agent = AgentId{1},
              .event = 0,
              .kind = hal::node::exchange::ActionKind::kSend,
              .twist = {0.1, 0.2, 0.3},
              .wheel_speeds = {1, 2, 3},
              .message_id = 4,
              .destination = AgentId{6},
              .topic = "help",
              .payload = {9, 8},
              .timer = 2,
              .at = Time{3s},
              .radio_on = true,
              .text = "IDLE",
              .level = hal::log::Level::kInfo};
    route = {{"help", AgentId{4}, AgentId{3}, {2, 1ms, 20.0, 0.1}}, false};
  }

  std::uint64_t total() const {
    FingerprintFeed feed;
    feed.on_frame_start(at, frame);
    feed.on_reception(at, frame, receiver, verdict, power);
    feed.on_association(at, AgentId{1}, access_point);
    feed.on_relay_lost(at, AgentId{1}, lost, why);
    feed.on_body(at, AgentId{1}, body);
    Event other = event;
    other.timer = 99;
    feed.on_event(swap ? other : event);
    feed.on_event(swap ? event : other);
    feed.on_action(at, action);
    feed.on_route_change(at, AgentId{1}, route);
    return feed.fingerprint().total();
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
      [](auto& o) { o.event.cause = hal::node::exchange::Cause::kNotice; },
      [](auto& o) { o.event.readings[0].channel ^= 1; },
      [](auto& o) { nudge(o.event.readings[0].values[1]); },
      [](auto& o) { o.event.message->source.value ^= 1; },
      [](auto& o) { o.event.message->destination.value ^= 1; },
      [](auto& o) { o.event.message->id ^= 1; },
      [](auto& o) { o.event.message->topic = "hemp"; },
      [](auto& o) { o.event.message->payload[0] ^= 1; },
      [](auto& o) { o.event.timer ^= 1; },
      [](auto& o) { o.event.noticed ^= 1; },
      [](auto& o) { o.event.fate = hal::Fate::kNoRoute; },
      [](auto& o) { o.event.routes[0].removed = true; },
      [](auto& o) { o.event.neighbours[0].id.value ^= 1; },
      [](auto& o) { nudge(o.event.neighbours[0].rssi_dbm); },
      [](auto& o) { o.event.lost_neighbours[0].value ^= 1; },
  };
}

std::vector<Mutation> action_and_route_mutations() {
  return {
      [](auto& o) { o.action.agent.value ^= 1; },
      [](auto& o) { o.action.kind = hal::node::exchange::ActionKind::kTimer; },
      [](auto& o) { nudge(o.action.twist.vx); },
      [](auto& o) { nudge(o.action.twist.vy); },
      [](auto& o) { nudge(o.action.twist.omega); },
      [](auto& o) { nudge(o.action.wheel_speeds[2]); },
      [](auto& o) { o.action.message_id ^= 1; },
      [](auto& o) { o.action.destination.value ^= 1; },
      [](auto& o) { o.action.topic = "hemp"; },
      [](auto& o) { o.action.payload[1] ^= 1; },
      [](auto& o) { o.action.timer ^= 1; },
      [](auto& o) { o.action.at += 1ns; },
      [](auto& o) { o.action.radio_on = false; },
      [](auto& o) { o.action.text = "IDLF"; },
      [](auto& o) { o.action.level = hal::log::Level::kError; },
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

TEST(FingerprintFeed, OneBitOfARecordedValueChangesItAndOfNothingElse) {
  Observations sends, records, other;
  nudge(sends.action.value);
  EXPECT_EQ(sends.total(), Observations().total()) << "it belongs to the other kind of action";
  records.action.kind = other.action.kind = hal::node::exchange::ActionKind::kRecord;
  nudge(other.action.value);
  EXPECT_NE(records.total(), other.total());
}

TEST(FingerprintFeed, HowTheRunWasComputedDoesNotCount) {
  Observations one, two;
  two.action.event = 17;  // index in a Step, which depends on how agents share processes
  EXPECT_EQ(one.total(), two.total());
}

}  // namespace
