#include "controllers/ros_base/ros_base.h"

#include <stdexcept>
#include <string>

#include "controllers/ros/ros_parameters.h"

namespace controllers {
namespace {

constexpr const char *kWaiting = "waiting", *kDriving = "driving", *kStopped = "stopped";

/// @throws std::invalid_argument
std::string frame_of(const char* parameter, const std::string& text) {
  if (!text.empty()) return text;
  throw std::invalid_argument(std::string(parameter) + ": is empty");
}

}  // namespace

RosBase::RosBase(hal::Robot& robot, const hal::Parameters& parameters)
    : robot_(robot),
      settings_{.interface = {},
                .domain = ros_domain(parameters["domain"]),
                .name_space = ros_namespace("namespace", parameters.text("namespace")),
                .odom_frame = frame_of("odom_frame", parameters.text("odom_frame")),
                .base_frame = frame_of("base_frame", parameters.text("base_frame")),
                .best_effort = parameters.flag("best_effort")},
      command_timeout_(hal::from_seconds(parameters["command_timeout"])) {}

void RosBase::start() {
  settings_.interface = robot_.air_interface();
  if (settings_.interface.empty()) throw std::runtime_error(kNoAirInterface);
  node_.emplace(settings_);
  enter(kWaiting);
}

void RosBase::step() {
  obey(node_->take_commands());
  (void)robot_.set_body_velocity(twist_);
  if (const auto odometry = robot_.odometry()) node_->publish(*odometry);
}

void RosBase::stop() {
  (void)robot_.set_body_velocity({});
  node_.reset();
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

}  // namespace controllers

BARAKA_CONTROLLER {
  return {
      .name = "ros_base",
      .wants = {.channels = {"odometry"}},
      .parameters =
          {{"command_timeout", "s", 0.5, 0.01, 60, "Without a command for so long it stops."},
           {"domain", "1", 0, 0, 232, "ROS_DOMAIN_ID of the nodes that it meets."},
           {.name = "namespace",
            .default_value = "",
            .meaning = "Of its topics but tf: r0 makes it /r0/cmd_vel and /r0/odom."},
           {.name = "odom_frame", .default_value = "odom", .meaning = "Frame it started in."},
           {.name = "base_frame", .default_value = "base_link", .meaning = "Frame of its body."},
           {.name = "best_effort",
            .default_value = false,
            .meaning = "Whether to read commands best-effort: lost ones are not sent again."}},
      .states = {"waiting", "driving", "stopped"},
      .records = {{"commands", "1", "Velocity commands that it has got."}},
      .make_for_robot = hal::make_for_robot<controllers::RosBase>};
}
