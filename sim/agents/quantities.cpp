#include "sim/agents/quantities.h"

#include <cmath>
#include <set>
#include <utility>
#include <variant>

#include "hal/node/devices/wheel_drive.h"
#include "hal/types/math.h"
#include "sim/agents/simulated_mote.h"
#include "sim/agents/simulated_robot.h"
#include "sim/radio/mac/mac_sap.h"

namespace sim::agents {
namespace {

using View = const AgentView&;
using Value = std::optional<double>;

bool always(const AgentConfig&, std::size_t) { return true; }
bool with_body(const AgentConfig& agent, std::size_t) { return has_body(agent); }
bool robot_only(const AgentConfig& agent, std::size_t) { return is_robot(agent); }

bool has_wheel(const AgentConfig& agent, std::size_t number) {
  const auto* robot = std::get_if<hal::node::devices::RobotDescription>(&agent.body);
  return robot != nullptr && number < hal::node::devices::WheelDrive(robot->wheels).wheel_count();
}

const BodyState& body_of(View view) { return view.scene.body(view.agent.config().id, view.now); }

Value speed(View view, std::size_t) {
  const hal::Vec3 v = view.positions.velocity(view.agent.config().id, view.now);
  return std::sqrt(v.x * v.x + v.y * v.y);
}

Value turn_rate(View view, std::size_t) {
  return view.scene.world().velocity(view.agent.config().id).angular.z;
}

Value clearance(View view, std::size_t) {
  const double clearance = body_of(view).clearance;
  return std::isfinite(clearance) ? Value{clearance} : std::nullopt;
}

/// Difference between the robot's pose by odometry, in the world frame, and its true pose.
hal::Pose2 odometry_error(View view) {
  const AgentConfig& config = view.agent.config();
  const hal::Pose2 own = static_cast<const SimulatedRobot&>(view.agent).reckoned(view.now);
  const double c = hal::math::cos(config.pose.theta);
  const double s = hal::math::sin(config.pose.theta);
  const BodyState& is = body_of(view);
  return {config.pose.x + c * own.x - s * own.y - is.x,
          config.pose.y + s * own.x + c * own.y - is.y, config.pose.theta + own.theta - is.theta};
}

Value odometry_distance(View view, std::size_t) {
  const hal::Pose2 error = odometry_error(view);
  return std::sqrt(error.x * error.x + error.y * error.y);
}

Value odometry_angle(View view, std::size_t) {
  constexpr double kTurn = 2 * 3.14159265358979323846;
  return std::remainder(odometry_error(view).theta, kTurn);
}

Value wheel_angle(View view, std::size_t number) {
  return view.scene.world().wheel_angles(view.agent.config().id)[number];
}

/// Reads a value of a body that is present, else nullopt.
template <auto kRead>
Value of_present(View view, std::size_t number) {
  return view.agent.is_present() ? Value{kRead(view, number)} : std::nullopt;
}

bool has_battery(const AgentConfig& agent, std::size_t) {
  return hal::node::devices::battery_of(sensors_of(agent)) != nullptr;
}

std::vector<Quantity> body_quantities() {
  return {
      {"agents", "x", "m", "x of the origin of the body, world frame", false, always,
       of_present<[](View view, std::size_t) -> Value { return body_of(view).x; }>},
      {"agents", "y", "m", "y of the origin of the body, world frame", false, always,
       of_present<[](View view, std::size_t) -> Value { return body_of(view).y; }>},
      {"agents", "yaw", "rad", "heading, world frame", false, with_body,
       of_present<[](View view, std::size_t) -> Value { return body_of(view).theta; }>},
      {"agents", "tilt", "rad", "angle between the body's z axis and the vertical", false,
       with_body, of_present<[](View view, std::size_t) -> Value { return body_of(view).tilt; }>},
      {"agents", "speed", "m/s", "true horizontal speed", false, always, of_present<speed>},
      {"agents", "turn_rate", "rad/s", "true turning rate", false, with_body,
       of_present<turn_rate>},
      {"agents", "clearance", "m",
       "distance from the centre to the nearest surface of a wall; absent without walls", false,
       with_body, of_present<clearance>},
      {"agents", "odometry_error", "m",
       "distance between the true position of a robot and the one that its odometry gives", false,
       robot_only, of_present<odometry_distance>},
      {"agents", "odometry_yaw_error", "rad", "heading by odometry minus true heading, -pi to pi",
       false, robot_only, of_present<odometry_angle>},
      {"agents", "wheel_speed", "rad/s",
       "angular speed of a driven wheel, in the order of the robot's file; mean since the previous "
       "sample",
       true, has_wheel, of_present<wheel_angle>, true},
      {"agents", "energy", "J",
       "energy drawn so far from its battery by computer, radio and motors, including losses in "
       "the battery; never more than it contained; absent without a battery",
       false, has_battery,
       [](View view, std::size_t) -> Value { return view.agent.supply()->battery().drawn(); }},
      {"agents", "load", "J",
       "energy that computer, radio and motors have demanded so far, even while the battery was "
       "empty; absent without a battery",
       false, has_battery,
       [](View view, std::size_t) -> Value { return view.agent.supply()->load(); }},
  };
}

std::vector<Quantity> radio_quantities() {
  return {
      {"radio", "queue", "1", "frames that are queued or being sent", false, always,
       [](View view, std::size_t) -> Value { return static_cast<double>(view.mac.waiting()); }},
      {"radio", "on", "1", "1: the radio is on, 0: off", false, always,
       [](View view, std::size_t) -> Value { return view.mac.radio_on() ? 1 : 0; }},
      {"radio", "transmit_share", "1",
       "share of the time since the previous sample in which the radio transmitted", true, always,
       [](View view, std::size_t) -> Value {
         return hal::to_seconds(view.mac.use().transmitting);
       }},
      {"radio", "receive_share", "1",
       "share of that time in which the medium was busy because of others", true, always,
       [](View view, std::size_t) -> Value { return hal::to_seconds(view.mac.use().receiving); }},
      {"radio", "idle_share", "1", "share of that time in which the medium was idle", true, always,
       [](View view, std::size_t) -> Value { return hal::to_seconds(view.mac.use().listening); }},
      {"radio", "off_share", "1", "share of that time in which the radio was off", true, always,
       [](View view, std::size_t) -> Value { return hal::to_seconds(view.mac.use().off); }},
  };
}

Value destinations(View view, std::size_t) {
  std::set<std::pair<std::string, hal::AgentId>> known;
  for (const hal::Route& route : view.agent.core().router().routes())
    known.emplace(route.topic, route.destination);
  return static_cast<double>(known.size());
}

std::vector<Quantity> routing_quantities() {
  return {
      {"routing", "neighbours", "1",
       "agents from which its router knows that it receives frames directly", false, always,
       [](View view, std::size_t) -> Value {
         return static_cast<double>(view.agent.core().router().neighbours().size());
       }},
      {"routing", "routes", "1", "entries of its routing tables, one per next hop", false, always,
       [](View view, std::size_t) -> Value {
         return static_cast<double>(view.agent.core().router().routes().size());
       }},
      {"routing", "destinations", "1", "pairs of topic and agent to which it has a route", false,
       always, destinations},
      {"routing", "malformed_frames", "1", "frames so far that its router could not parse", false,
       always,
       [](View view, std::size_t) -> Value {
         return static_cast<double>(view.agent.core().router().malformed_frames());
       }},
  };
}

}  // namespace

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> all = [] {
    std::vector<Quantity> sum = body_quantities();
    for (const auto& part : {radio_quantities(), routing_quantities()}) {
      sum.insert(sum.end(), part.begin(), part.end());
    }
    return sum;
  }();
  return all;
}

}  // namespace sim::agents
