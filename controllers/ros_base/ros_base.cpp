#include "controllers/ros_base/ros_base.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "controllers/ros/ros_parameters.h"
#include "controllers/ros_base/base_topics.h"

namespace controllers {
namespace {

constexpr const char *kWaiting = "waiting", *kDriving = "driving", *kStopped = "stopped";

}  // namespace

RosBase::RosBase(hal::Robot& robot, const hal::Parameters& parameters)
    : robot_(robot),
      settings_(base_settings(parameters)),
      command_timeout_(hal::from_seconds(parameters["command_timeout"])) {}

void RosBase::start() {
  const std::string interface(robot_.air_interface());
  if (interface.empty()) throw std::runtime_error(kNoAirInterface);
  const BaseSettings settings = offered();
  node_.emplace(interface, settings);
  publications_.emplace(robot_, settings, *node_);
  publications_->announce();
  enter(kWaiting);
}

void RosBase::step() {
  obey(node_->take_commands());
  (void)robot_.set_body_velocity(twist_);
  publications_->publish({state_, commands_});
}

void RosBase::stop() {
  (void)robot_.set_body_velocity({});
  publications_.reset();
  node_.reset();
}

BaseSettings RosBase::offered() const {
  BaseSettings settings = settings_of_agent(settings_, robot_.name());
  const auto channels = robot_.channels();
  for (const BaseTopic& topic : base_topics()) {
    const bool is_possible =
        topic.channel.empty() ||
        std::ranges::find(channels, topic.channel, &hal::Channel::name) != channels.end();
    if (!is_possible) settings.topics.erase(std::string(topic.key));
  }
  return settings;
}

void RosBase::obey(const RosNode::Commands& commands) {
  if (commands.senseless > 0 && !complained_) {
    complained_ = true;
    robot_.log(hal::log::Level::kWarning, "a command has a value that is not finite: dropped");
  }
  if (commands.last) {
    commanded_ = robot_.now();
    twist_ = *commands.last;
    commands_ += commands.count;
    robot_.record("commands", static_cast<double>(commands_));
    enter(kDriving);
  } else if (commanded_ && robot_.now() - *commanded_ >= command_timeout_) {
    twist_ = {};
    enter(kStopped);
  }
}

void RosBase::enter(const char* state) {
  if (state == state_) return;
  state_ = state;
  robot_.state(state);
}

namespace {

hal::ParameterSpec diagonal(const char* name, const char* meaning) {
  return {.name = name,
          .unit = "1",
          .default_value = std::vector<double>(6, 0.0),
          .low = 0,
          .high = 1e9,
          .meaning = meaning};
}

std::vector<hal::ParameterSpec> base_parameters() {
  return {
      {"command_timeout", "s", 0.5, 0.01, 60, "Without a command for so long it stops."},
      {"domain", "1", 0, 0, 232, "ROS_DOMAIN_ID of the nodes that it meets."},
      {.name = "namespace",
       .default_value = "",
       .meaning = "Of its node and of topics without a leading slash: r0 makes it /r0/cmd_vel and "
                  "/r0/odom; {} is the agent's name."},
      {.name = "topics",
       .default_value = default_topics(),
       .meaning = "What it offers, as far as the robot has the device.",
       .choices = topic_keys()},
      {.name = "best_effort_topics",
       .default_value = std::vector<std::string>{"scan", "clock"},
       .meaning = "Topics whose lost messages are not sent again.",
       .choices = topic_keys()},
      {.name = "remap",
       .default_value = std::vector<std::string>{},
       .meaning = "Other names of topics, as ROS 2 writes them: scan:=front/scan, /tf:=tf."},
      {.name = "odom_frame", .default_value = "odom", .meaning = "Frame it started in."},
      {.name = "base_frame",
       .default_value = "base_footprint",
       .meaning = "Frame of its body on the ground, in which base_link is."},
      {.name = "frame_prefix",
       .default_value = "",
       .meaning = "In front of the names of all frames: r0/; {} is the agent's name."},
      {.name = "use_stamped_vel",
       .default_value = false,
       .meaning = "Whether commands are TwistStamped instead of Twist."},
      {.name = "best_effort",
       .default_value = false,
       .meaning = "Whether to read commands best-effort: lost ones are not sent again."},
      {.name = "use_sim_time",
       .default_value = false,
       .meaning = "Whether messages are stamped with the time of the run instead of the clock of "
                  "the process."},
      {.name = "publish_clock",
       .default_value = false,
       .meaning = "Whether to publish the time of the run on /clock, for one robot of a domain."},
      diagonal("pose_covariance_diagonal",
               "Variances in odom of x, y, z [m^2], roll, pitch, yaw [rad^2]; 0: not known."),
      diagonal("twist_covariance_diagonal", "The same of the velocities, per second squared."),
  };
}

std::vector<hal::ParameterMistake> judged(const hal::Parameters& parameters) {
  const bool has_clock = parameters.flag("publish_clock") ||
                         std::ranges::count(parameters.texts("topics"), "clock") > 0;
  if (!has_clock || parameters.flag("use_sim_time")) return {};
  return {{"publish_clock", "/clock is published, but use_sim_time is false: stamps are not its",
           true}};
}

}  // namespace
}  // namespace controllers

BARAKA_CONTROLLER {
  return {.name = "ros_base",
          .wants = {.channels = {"odometry"}, .optional = {"scan", "imu", "battery", "bumper"}},
          .parameters = controllers::base_parameters(),
          .judge = controllers::judged,
          .states = {"waiting", "driving", "stopped"},
          .records = {{"commands", "1", "Velocity commands that it has got."}},
          .make_for_robot = hal::make_for_robot<controllers::RosBase>};
}
