#include "controllers/ros_operator/ros_operator.h"

#include <stdexcept>
#include <string>
#include <vector>

#include "controllers/ros/ros_parameters.h"

namespace controllers {
namespace {

constexpr hal::TimerId kNext = 1;

/// @throws std::invalid_argument
std::vector<std::string> robots_of(const hal::Parameters& parameters) {
  std::vector<std::string> robots = parameters.texts("robots");
  for (const std::string& robot : robots) ros_namespace("robots", robot);
  if (robots.empty()) robots.emplace_back();  // one robot without a namespace
  return robots;
}

}  // namespace

RosOperator::RosOperator(hal::RealWorldObject& self, const hal::Parameters& parameters)
    : self_(self),
      settings_{.interface = {},
                .domain = ros_domain(parameters["domain"]),
                .robots = robots_of(parameters)},
      twist_{parameters["forward"], parameters["left"], parameters["turn"]},
      period_(hal::from_seconds(1 / parameters["rate"])) {}

void RosOperator::start() {
  settings_.interface = self_.air_interface();
  if (settings_.interface.empty()) throw std::runtime_error(kNoAirInterface);
  node_.emplace(settings_);
  timer(kNext);
}

void RosOperator::timer(hal::TimerId) {
  node_->command(twist_);
  ++sent_;
  (void)self_.set_timer(kNext, self_.now() + period_);
}

void RosOperator::step() {
  if (sent_ > told_sent_) self_.record("commands", static_cast<double>(sent_));
  told_sent_ = sent_;
  const std::uint64_t heard = node_->heard();
  if (heard > told_heard_) self_.record("odometry", static_cast<double>(heard));
  told_heard_ = heard;
}

}  // namespace controllers

BARAKA_CONTROLLER {
  return {.name = "ros_operator",
          .parameters = {{.name = "robots",
                          .default_value = std::vector<std::string>{},
                          .meaning = "Namespaces of the robots that it drives: r0 for /r0/cmd_vel. "
                                     "None: one robot, by /cmd_vel."},
                         {"forward", "m/s", 0.2, -10, 10, "Commanded speed ahead."},
                         {"left", "m/s", 0, -10, 10, "Commanded speed to the left."},
                         {"turn", "rad/s", 0, -10, 10, "Commanded turning rate, to the left."},
                         {"rate", "Hz", 10, 0.1, 1000, "Commands per second to each robot."},
                         {"domain", "1", 0, 0, 232, "ROS_DOMAIN_ID of the robots."}},
          .records = {{"commands", "1", "Velocity commands that it has sent to each robot."},
                      {"odometry", "1", "Messages of odometry that it has got, of all robots."}},
          .make_for_mote = hal::make_for_mote<controllers::RosOperator>,
          .make_for_robot = hal::make_for_robot<controllers::RosOperator>};
}
