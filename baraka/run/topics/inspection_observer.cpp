#include "baraka/run/topics/inspection_observer.h"

#include <algorithm>
#include <variant>

#include "gateway/inspection/inspected_ranges.h"
#include "gateway/inspection/inspected_readings.h"
#include "hal/node/devices/channels.h"
#include "hal/types/check.h"
#include "results/record/frame_ppdu.h"
#include "sim/air/air_summary.h"
#include "sim/radio/mac/frame.h"

namespace baraka::run::topics {
namespace {

using namespace std::chrono_literals;
using hal::node::devices::RobotDescription;

// Shortest simulated time between two samples.
constexpr hal::Duration kClockPeriod = 10ms;
constexpr hal::Duration kFramePeriod = 10ms;
constexpr hal::Duration kLinkPeriod = 1s;  // of one link
constexpr hal::Duration kAirPeriod = 1s;
constexpr hal::Duration kStandingPosePeriod = 1s;  // of an agent that does not move

gateway::inspection::InspectedRobot describe(const sim::agents::AgentConfig& agent) {
  gateway::inspection::InspectedRobot described{
      .name = agent.name,
      .drives = false,
      .start = std::nullopt,
      .ranges = {},
      .channels = hal::node::devices::sensor_channels(sim::agents::sensors_of(agent))};
  if (const auto* robot = std::get_if<RobotDescription>(&agent.body)) {
    described.drives = true;
    described.start = agent.pose;
    described.ranges = gateway::inspection::inspected_ranges(robot->infrared);
  }
  return described;
}

}  // namespace

InspectionObserver::InspectionObserver(const sim::agents::SimulationConfig& config)
    : config_(config), markers_(config) {
  for (const auto& agent : config.agents) agents_[agent.id].name = agent.name;
}

void InspectionObserver::start(gateway::inspection::InspectionParticipant& participant) {
  std::vector<gateway::inspection::InspectedRobot> robots;
  for (const sim::agents::AgentConfig& agent : config_.agents) {
    gateway::inspection::InspectedRobot described = describe(agent);
    if (!described.drives && described.channels.empty()) continue;
    agents_[agent.id].robot = robots.size();
    robots.push_back(std::move(described));
  }
  inspector_ = std::make_unique<gateway::inspection::Inspector>(participant, robots);
  markers_.start(participant);
  const bool has_network = std::ranges::any_of(
      config_.agents, [](const auto& agent) { return agent.network.has_value(); });
  if (has_network) air_ = std::make_unique<gateway::inspection::AirInspector>(participant);
}

std::string_view InspectionObserver::name(hal::AgentId agent) const {
  if (agent == hal::kEveryone) return "everyone";
  if (agent == hal::kNeighbours) return "neighbours";
  const auto found = agents_.find(agent);
  return found == agents_.end() ? std::string_view() : found->second.name;
}

void InspectionObserver::show_clock(hal::Time at) {
  if (!is_read(Topic::kClock) || at < clock_shown_ + kClockPeriod) return;
  clock_shown_ = at;
  inspector_->publish_clock(at);
}

void InspectionObserver::on_body(hal::Time at, hal::AgentId id,
                                 const sim::agents::BodyState& body) {
  show_clock(at);
  const hal::Pose2 pose{body.x, body.y, body.theta};
  markers_.on_body(at, id, pose);
  if (!is_read(Topic::kTransforms)) return;
  Agent& agent = agents_.at(id);
  if (pose == agent.shown && at < agent.shown_at + kStandingPosePeriod) return;
  agent.shown = pose;
  agent.shown_at = at;
  inspector_->publish_transform(at, agent.name, pose);
}

bool InspectionObserver::observes_readings() const {
  return is_read(Topic::kRange) || is_read(Topic::kOdometry) || is_read(Topic::kChannels);
}

bool InspectionObserver::observes(hal::AgentId agent, const hal::Channel& channel) const {
  const auto topic = gateway::inspection::topic_of(channel);
  if (!topic || !is_read(*topic)) return false;
  return topic != Topic::kChannels || inspector_->has_readers(agents_.at(agent).robot, channel.id);
}

void InspectionObserver::on_reading(hal::Time at, hal::AgentId agent, const hal::Channel& channel,
                                    std::span<const double> values) {
  gateway::inspection::publish_reading(*inspector_, at, agents_.at(agent).robot, channel, values);
}

void InspectionObserver::show_air(hal::Time at) {
  if (!air_ || ledger_ == nullptr || at < air_shown_ + kAirPeriod || !air_->has_readers()) return;
  air_shown_ = at;
  for (const sim::air::TopicUse& use : sim::air::topics_of(*ledger_))
    air_->publish(at,
                  gateway::inspection::AirInspector::TopicUse{.topic = use.topic,
                                                              .samples = use.samples,
                                                              .delivered = use.delivered,
                                                              .first_try = use.first_try,
                                                              .latency_median = use.latency_median,
                                                              .latency_p99 = use.latency_p99,
                                                              .airtime = use.airtime,
                                                              .share = use.share});
  for (const sim::air::KindUse& use : sim::air::kinds_of(*ledger_))
    air_->publish(
        at, gateway::inspection::AirInspector::KindUse{.purpose = sim::air::name(use.kind.purpose),
                                                       .kind = sim::air::what_text(use.kind),
                                                       .port = use.kind.port,
                                                       .frames = use.frames,
                                                       .retries = use.retries,
                                                       .submessages = use.submessages,
                                                       .bits = use.bits,
                                                       .airtime = use.airtime,
                                                       .share = use.share});
}

void InspectionObserver::on_frame_start(hal::Time at, const sim::radio::Frame& frame) {
  show_air(at);
  if (!is_read(Topic::kFrames)) return;
  if (at < frame_shown_ + kFramePeriod) {
    ++frames_skipped_;
    return;
  }
  const results::record::FramePpdu ppdu(frame);
  inspector_->publish_frame(at, {.transmitter = name(frame.transmitter),
                                 .receiver = name(frame.receiver),
                                 .type = sim::radio::name(frame.type),
                                 .sequence = frame.sequence,
                                 .retry = frame.retry,
                                 .bits = frame.air_length,
                                 .airtime = frame.airtime,
                                 .skipped = frames_skipped_,
                                 .rate = frame.mode != nullptr ? frame.mode->rate().value : 0,
                                 .modulation = ppdu.modulation.value_or(""),
                                 .mcs = ppdu.mcs.value_or(-1),
                                 .streams = ppdu.streams.value_or(0),
                                 .width_mhz = ppdu.width_mhz.value_or(0),
                                 .guard_ns = ppdu.guard_ns.value_or(0),
                                 .access_category = ppdu.category.value_or(""),
                                 .ampdu = frame.ampdu});
  frame_shown_ = at;
  frames_skipped_ = 0;
}

void InspectionObserver::on_reception(hal::Time at, const sim::radio::Frame& frame,
                                      hal::AgentId receiver, hal::Verdict verdict,
                                      double rssi_dbm) {
  if (!is_read(Topic::kLinks)) return;
  Heard& heard = links_[{receiver, frame.transmitter}];
  ++(verdict == hal::Verdict::kDelivered ? heard.delivered : heard.lost);
  if (at < heard.shown_at + kLinkPeriod) return;
  inspector_->publish_link(at, {.receiver = name(receiver),
                                .transmitter = name(frame.transmitter),
                                .rssi_dbm = rssi_dbm,
                                .delivered = heard.delivered,
                                .lost = heard.lost});
  heard = {.shown_at = at};
}

void InspectionObserver::on_fate(hal::Time at, hal::AgentId sender, hal::MessageId id,
                                 hal::Fate fate) {
  if (!is_read(Topic::kFates)) return;
  inspector_->publish_fate(at, {.sender = name(sender),
                                .id = id,
                                .node = name(sender),
                                .fate = fate,
                                .verdict = std::nullopt});
}

void InspectionObserver::on_message_end(hal::Time at, hal::AgentId at_node, hal::AgentId sender,
                                        hal::MessageId id, hal::Verdict verdict) {
  if (!is_read(Topic::kFates)) return;
  inspector_->publish_fate(at, {.sender = name(sender),
                                .id = id,
                                .node = name(at_node),
                                .fate = std::nullopt,
                                .verdict = verdict});
}

void InspectionObserver::on_route_change(hal::Time at, hal::AgentId agent,
                                         const hal::RouteChange& change) {
  if (!is_read(Topic::kRoutes)) return;
  inspector_->publish_route(at, {.agent = name(agent),
                                 .destination = name(change.route.destination),
                                 .next_hop = name(change.route.next_hop),
                                 .change = change});
}

void InspectionObserver::on_state(hal::Time at, hal::AgentId agent, std::string_view state) {
  if (!is_read(Topic::kStates)) return;
  inspector_->publish_state(at, name(agent), state);
}

void InspectionObserver::on_record(hal::Time at, hal::AgentId agent, std::string_view what,
                                   double value) {
  if (!is_read(Topic::kValues)) return;
  inspector_->publish_value(at, name(agent), what, value);
}

}  // namespace baraka::run::topics
