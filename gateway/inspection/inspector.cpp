#include "gateway/inspection/inspector.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "gateway/inspection/channel_writer.h"
#include "gateway/inspection/inspection_endpoints.h"
#include "idl/ros/values.h"
#include "inspectPubSubTypes.h"

namespace gateway::inspection {
namespace {

using baraka_msgs::msg::dds_::ControllerState_PubSubType;
using baraka_msgs::msg::dds_::Frame_PubSubType;
using baraka_msgs::msg::dds_::LinkQuality_PubSubType;
using baraka_msgs::msg::dds_::MessageFate_PubSubType;
using baraka_msgs::msg::dds_::Route_PubSubType;
using baraka_msgs::msg::dds_::Value_PubSubType;
using geometry_msgs::msg::dds_::TransformStamped_;
using idl::ros::to_ros;
using idl::ros::to_ros_distance;
using idl::ros::to_transform;
using idl::ros::transform_between;
using nav_msgs::msg::dds_::Odometry_PubSubType;
using rosgraph_msgs::msg::dds_::Clock_PubSubType;
using sensor_msgs::msg::dds_::Range_PubSubType;
using tf2_msgs::msg::dds_::TFMessage_PubSubType;

constexpr std::size_t kTopics = 11;
constexpr const char* kWorld = "world";

// Samples kept for a slow reader.
constexpr int kFewSamples = 10;
constexpr int kManySamples = 500;  // for events, which come in bursts

std::string base_link(std::string_view agent) { return std::string(agent) + "/base_link"; }

}  // namespace

class Inspector::Implementation {
 public:
  Implementation(InspectionParticipant& inspection, const std::vector<InspectedRobot>& robots,
                 Stamps stamps);

  std::atomic<int>& readers(Topic topic) { return readers_[static_cast<std::size_t>(topic)]; }

  struct Robot {
    Robot(Implementation& all, domain::Participant& participant, const InspectedRobot& description);
    std::vector<std::string> range_frames;
    /// Only if the robot drives.
    std::optional<InspectionWriter<Odometry_PubSubType>> odometry;
    /// Only if the robot drives.
    std::optional<InspectionWriter<Range_PubSubType>> range;
    std::vector<InspectedRange> ranges;
    std::map<std::uint16_t, std::unique_ptr<ChannelWriter>> channels;  ///< By Channel::id.
  };

 private:
  void write_static(const std::vector<InspectedRobot>& robots);

  std::array<std::atomic<int>, kTopics> readers_{};
  std::atomic<int> static_readers_{0};  // not counted by has_readers(): nothing more is published
  domain::Participant& participant_;
  InspectionWriter<TFMessage_PubSubType> transforms_static_;

 public:
  std::optional<InspectionWriter<Clock_PubSubType>> clock;  ///< Only with Stamps::kSimulated.
  InspectionWriter<TFMessage_PubSubType> transforms;
  InspectionWriter<MessageFate_PubSubType> fates;
  InspectionWriter<Frame_PubSubType> frames;
  InspectionWriter<Route_PubSubType> routes;
  InspectionWriter<ControllerState_PubSubType> states;
  InspectionWriter<Value_PubSubType> values;
  InspectionWriter<LinkQuality_PubSubType> links;
  std::vector<std::unique_ptr<Robot>> robots;
};

Inspector::Implementation::Robot::Robot(Implementation& all, domain::Participant& participant,
                                        const InspectedRobot& description)
    : ranges(description.ranges) {
  if (description.drives) {
    odometry.emplace(participant, "rt/" + description.name + "/odom", kFewSamples,
                     all.readers(Topic::kOdometry));
    odometry->sample().header().frame_id(description.name + "/odom");
    odometry->sample().child_frame_id(base_link(description.name));
    range.emplace(participant, "rt/" + description.name + "/range",
                  kFewSamples * std::max(1, static_cast<int>(description.ranges.size())),
                  all.readers(Topic::kRange));
    range->sample().radiation_type(idl::ros::kInfrared);
  }
  for (const InspectedRange& sensor : ranges) {
    range_frames.push_back(description.name + "/" + sensor.name);
  }
  for (const hal::Channel& channel : description.channels) {
    auto writer = make_channel_writer(
        {participant, description.name, channel, all.readers(Topic::kChannels)});
    if (writer) channels[channel.id] = std::move(writer);
  }
}

Inspector::Implementation::Implementation(InspectionParticipant& inspection,
                                          const std::vector<InspectedRobot>& described,
                                          Stamps stamps)
    : participant_(inspection.participant()),
      transforms_static_(participant_, "rt/tf_static", 1, static_readers_, Keep::kForLatecomers),
      transforms(participant_, "rt/tf", kManySamples, readers(Topic::kTransforms)),
      fates(participant_, "rt/baraka/message_fates", kManySamples, readers(Topic::kFates)),
      frames(participant_, "rt/baraka/frames", kManySamples, readers(Topic::kFrames)),
      routes(participant_, "rt/baraka/routes", kManySamples, readers(Topic::kRoutes)),
      states(participant_, "rt/baraka/controller_states", kManySamples, readers(Topic::kStates)),
      values(participant_, "rt/baraka/values", kManySamples, readers(Topic::kValues)),
      links(participant_, "rt/baraka/link_quality", kManySamples, readers(Topic::kLinks)) {
  if (stamps == Stamps::kSimulated) {
    clock.emplace(participant_, "rt/clock", kFewSamples, readers(Topic::kClock));
  }
  for (const InspectedRobot& robot : described) {
    robots.push_back(std::make_unique<Robot>(*this, participant_, robot));
  }
  transforms.sample().transforms().resize(1);
  transforms.sample().transforms().front().header().frame_id(kWorld);
  write_static(described);
}

void Inspector::Implementation::write_static(const std::vector<InspectedRobot>& described) {
  auto& all = transforms_static_.sample().transforms();
  for (const InspectedRobot& robot : described) {
    if (robot.start) {
      all.push_back(transform_between(kWorld, robot.name + "/odom",
                                      {robot.start->x, robot.start->y, 0}, robot.start->theta));
    }
    for (const InspectedRange& sensor : robot.ranges) {
      all.push_back(transform_between(base_link(robot.name), robot.name + "/" + sensor.name,
                                      sensor.position, sensor.heading));
    }
    for (const hal::Channel& channel : robot.channels) {
      if (channel.frame != channel.name) continue;  // no frame of its own
      all.push_back(transform_between(base_link(robot.name), robot.name + "/" + channel.frame,
                                      channel.position, channel.heading));
    }
  }
  transforms_static_.write();
}

Inspector::Inspector(InspectionParticipant& participant, const std::vector<InspectedRobot>& robots,
                     Stamps stamps)
    : implementation_(std::make_unique<Implementation>(participant, robots, stamps)) {}

Inspector::~Inspector() = default;

bool Inspector::has_readers() const noexcept {
  for (std::size_t i = 0; i < kTopics; ++i) {
    if (has_readers(static_cast<Topic>(i))) return true;
  }
  return false;
}

bool Inspector::has_readers(Topic topic) const noexcept {
  return implementation_->readers(topic).load(std::memory_order_relaxed) > 0;
}

bool Inspector::has_readers(std::size_t robot, std::uint16_t channel) const {
  const auto& channels = implementation_->robots.at(robot)->channels;
  const auto found = channels.find(channel);
  return found != channels.end() && found->second->has_readers();
}

void Inspector::publish_clock(hal::Time now) {
  auto& writer = implementation_->clock;
  if (!writer || !writer->has_readers()) return;
  writer->sample().clock(to_ros(now));
  writer->write();
}

void Inspector::publish_transform(hal::Time at, std::string_view agent, const hal::Pose2& pose) {
  auto& writer = implementation_->transforms;
  if (!writer.has_readers()) return;
  TransformStamped_& stamped = writer.sample().transforms().front();
  stamped.header().stamp(to_ros(at));
  stamped.child_frame_id(base_link(agent));
  stamped.transform(to_transform({pose.x, pose.y, 0}, pose.theta));
  writer.write();
}

void Inspector::publish_odometry(hal::Time at, std::size_t robot, const hal::Pose2& pose,
                                 const hal::Twist2& twist) {
  auto& writer = implementation_->robots.at(robot)->odometry;
  if (!writer || !writer->has_readers()) return;
  auto& sample = writer->sample();
  sample.header().stamp(to_ros(at));
  sample.pose().pose(to_ros(pose));
  sample.twist().twist(to_ros(twist));
  writer->write();
}

void Inspector::publish_ranges(hal::Time at, std::size_t robot, std::span<const double> metres) {
  Implementation::Robot& of = *implementation_->robots.at(robot);
  if (!of.range || !of.range->has_readers()) return;
  auto& sample = of.range->sample();
  sample.header().stamp(to_ros(at));
  for (std::size_t i = 0; i < std::min(metres.size(), of.ranges.size()); ++i) {
    sample.header().frame_id(of.range_frames[i]);
    sample.field_of_view(static_cast<float>(of.ranges[i].field_of_view));
    sample.min_range(static_cast<float>(of.ranges[i].min_range));
    sample.max_range(static_cast<float>(of.ranges[i].max_range));
    sample.range(to_ros_distance(metres[i]));
    of.range->write();
  }
}

void Inspector::publish_channel(hal::Time at, std::size_t robot, std::uint16_t channel,
                                std::span<const double> values) {
  const auto& channels = implementation_->robots.at(robot)->channels;
  const auto found = channels.find(channel);
  if (found != channels.end() && found->second->has_readers()) found->second->publish(at, values);
}

void Inspector::publish_fate(hal::Time at, const MessageEnd& end) {
  auto& writer = implementation_->fates;
  if (!writer.has_readers()) return;
  auto& sample = writer.sample();
  sample.stamp(to_ros(at));
  sample.sender(std::string(end.sender));
  sample.id(end.id);
  sample.node(std::string(end.node));
  sample.fate(end.fate ? std::string(hal::to_string(*end.fate)) : "");
  sample.verdict(end.verdict ? std::string(hal::name(*end.verdict)) : "");
  writer.write();
}

void Inspector::publish_frame(hal::Time at, const FrameStart& frame) {
  auto& writer = implementation_->frames;
  if (!writer.has_readers()) return;
  auto& sample = writer.sample();
  sample.stamp(to_ros(at));
  sample.transmitter(std::string(frame.transmitter));
  sample.receiver(std::string(frame.receiver));
  sample.frame_type(std::string(frame.type));
  sample.sequence_number(frame.sequence);
  sample.retry(frame.retry);
  sample.bits(frame.bits);
  sample.airtime(to_ros(frame.airtime));
  sample.skipped(frame.skipped);
  sample.rate(frame.rate);
  sample.modulation(std::string(frame.modulation));
  sample.mcs(static_cast<std::int16_t>(frame.mcs));
  sample.streams(static_cast<std::uint16_t>(frame.streams));
  sample.width(static_cast<std::uint16_t>(frame.width_mhz));
  sample.guard_interval(static_cast<std::uint16_t>(frame.guard_ns));
  sample.access_category(std::string(frame.access_category));
  sample.ampdu(frame.ampdu);
  writer.write();
}

void Inspector::publish_route(hal::Time at, const RouteEntry& entry) {
  auto& writer = implementation_->routes;
  if (!writer.has_readers()) return;
  const hal::Route& route = entry.change.route;
  auto& sample = writer.sample();
  sample.stamp(to_ros(at));
  sample.agent(std::string(entry.agent));
  sample.message_class(route.topic);
  sample.destination(std::string(entry.destination));
  sample.next_hop(std::string(entry.next_hop));
  sample.removed(entry.change.removed);
  sample.hops(route.path.hops);
  sample.delay(to_ros(route.path.delay));
  sample.min_snr_db(route.path.min_snr_db);
  sample.energy(route.path.energy);
  writer.write();
}

void Inspector::publish_state(hal::Time at, std::string_view agent, std::string_view state) {
  auto& writer = implementation_->states;
  if (!writer.has_readers()) return;
  writer.sample().stamp(to_ros(at));
  writer.sample().agent(std::string(agent));
  writer.sample().state(std::string(state));
  writer.write();
}

void Inspector::publish_value(hal::Time at, std::string_view agent, std::string_view name,
                              double value) {
  auto& writer = implementation_->values;
  if (!writer.has_readers()) return;
  writer.sample().stamp(to_ros(at));
  writer.sample().agent(std::string(agent));
  writer.sample().name(std::string(name));
  writer.sample().value(value);
  writer.write();
}

void Inspector::publish_link(hal::Time at, const Link& link) {
  auto& writer = implementation_->links;
  if (!writer.has_readers()) return;
  auto& sample = writer.sample();
  sample.stamp(to_ros(at));
  sample.receiver(std::string(link.receiver));
  sample.transmitter(std::string(link.transmitter));
  sample.rssi_dbm(link.rssi_dbm);
  sample.delivered(link.delivered);
  sample.lost(link.lost);
  writer.write();
}

}  // namespace gateway::inspection
