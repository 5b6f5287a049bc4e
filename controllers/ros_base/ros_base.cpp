#include "controllers/ros_base/ros_base.h"

#include <cctype>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

namespace controllers {
namespace {

constexpr const char *kWaiting = "waiting", *kDriving = "driving", *kStopped = "stopped";

/// A part of a name between two slashes (ROS 2 design, "Topic and Service name mapping to DDS").
bool is_token(std::string_view token) {
  if (token.empty() || std::isdigit(static_cast<unsigned char>(token.front())) != 0) return false;
  for (const char c : token) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_') return false;
  }
  return true;
}

/// @throws std::invalid_argument
std::string name_space_of(const std::string& text) {
  for (std::size_t begin = 0; begin <= text.size() && !text.empty();) {
    const std::size_t end = std::min(text.find('/', begin), text.size());
    if (!is_token(std::string_view(text).substr(begin, end - begin))) {
      throw std::invalid_argument("namespace: '" + text +
                                  "' must be words of letters, digits and '_' with '/' between "
                                  "them, such as fleet/r0");
    }
    begin = end + 1;
  }
  return text;
}

/// @throws std::invalid_argument
int domain_of(double number) {
  if (number == std::floor(number)) return static_cast<int>(number);
  throw std::invalid_argument("domain: must be a whole number, not " + std::to_string(number));
}

/// @throws std::invalid_argument
std::string frame_of(const char* parameter, const std::string& text) {
  if (!text.empty()) return text;
  throw std::invalid_argument(std::string(parameter) + ": is empty");
}

}  // namespace

RosBase::RosBase(hal::Robot& robot, const hal::Parameters& parameters)
    : robot_(robot),
      settings_{.interface = {},
                .domain = domain_of(parameters["domain"]),
                .name_space = name_space_of(parameters.text("namespace")),
                .odom_frame = frame_of("odom_frame", parameters.text("odom_frame")),
                .base_frame = frame_of("base_frame", parameters.text("base_frame")),
                .best_effort = parameters.flag("best_effort")},
      command_timeout_(hal::from_seconds(parameters["command_timeout"])) {}

void RosBase::start() {
  settings_.interface = robot_.air_interface();
  if (settings_.interface.empty()) {
    throw std::runtime_error(
        "there is no network interface for it: a scenario gives it one by `network:` of its group "
        "and `controller: {inside: true}`, an agent's file by `controller: {air_interface: NAME}`");
  }
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
