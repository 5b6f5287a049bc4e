#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hal/files/description/fields.h"
#include "hal/node/devices/robot_description.h"
#include "hal/node/exchange/session.h"
#include "hal/node/routing/routing_config.h"
#include "hal/robot/agent/localisation.h"
#include "hal/robot/drivers/drivers.h"
#include "hal/robot/drivers/sensor_choice.h"
#include "hal/robot/drivers/speed_limits.h"
#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"
#include "hal/types/time.h"

namespace hal::robot::agent {

/// The UDP radio. All agents must use the same network and port.
struct RadioSettings {
  std::string interface;  ///< E.g. "wlan0".
  std::string address;    ///< An address of the interface, dotted; empty: its first one.
  std::uint16_t port = 7300;
  double bit_rate = 1e6;  ///< bit/s, > 0; nominal, for the delay statistics of routes
  double power = 0.1;     ///< W, >= 0; of the transmitter, for their energy
  bool operator==(const RadioSettings&) const = default;
};

/// Pose from a DDS topic of geometry_msgs/PoseStamped.
struct PoseTopicSettings {
  std::string topic;       ///< As in ROS 2, e.g. "/mocap/r0/pose".
  Duration stale_after{};  ///< Maximum age of a fix.
  bool operator==(const PoseTopicSettings&) const = default;
};

/// How the agent knows its own position and those of others.
struct LocalisationSettings {
  /// monostate: the agent has no channel "localisation".
  std::variant<std::monostate, PoseTopicSettings, Pose2> source;
  double range = 300;         ///< m; landmarks farther away are not reported.
  std::vector<Landmark> map;  ///< By address.
  bool operator==(const LocalisationSettings&) const = default;
};

/// What happens to the wheels while a channel that the controller requires is lost.
enum class OnLostSensor : std::uint8_t {
  kStop,    ///< The wheels stop.
  kIgnore,  ///< The wheels obey commands: the controller is notified and must react.
};

/// Places of values, "file:line:column", for mistakes that only this computer can detect.
struct RadioPlaces {
  std::string interface, address, port;
};

/// The contents of ROBOT.yaml.
struct RobotFile {
  std::string name;
  AgentId address;
  AgentKind kind = AgentKind::kMote;
  std::string program;  ///< Controller for which this agent is intended; empty: any.
  std::vector<node::exchange::ParameterText> parameters;
  std::string air_interface;  ///< Interface on which the controller may open sockets; empty: none.
  /// "file:line:column", for mistakes that only this computer can detect.
  std::string air_interface_place;
  std::uint64_t seed = 1;
  Duration control_period{100'000'000};
  Duration command_timeout{500'000'000};
  RadioSettings radio;
  RadioPlaces radio_places;
  node::routing::RoutingConfig routing;
  LocalisationSettings localisation;

  // Robots only.
  std::optional<node::devices::RobotDescription> robot;
  drivers::SpeedLimits limits;
  OnLostSensor on_lost_sensor = OnLostSensor::kStop;
  std::shared_ptr<const drivers::DriverChoice<drivers::WheelDriver>> wheels;  ///< Null: no driver.
  /// Null: no driver.
  std::shared_ptr<const drivers::DriverChoice<drivers::InfraredDriver>> infrared;

  std::vector<drivers::DrivenSensor> sensors;  ///< Sensors of the robot that have a driver.

  std::vector<std::string> warnings;  ///< What is permitted but probably unintended, a line each.

  /// Reads the top level of a file and records mistakes there.
  static RobotFile read(files::config::Mapping in);

  /// Reads and checks a file.
  /// @param overrides  "dotted.path=value", as of `baraka run --set`.
  /// @throws config::ConfigErrors with every mistake, "file:line:column: key: what is wrong".
  static RobotFile load(const std::filesystem::path& file,
                        const std::vector<std::string>& overrides = {});
};

/// Describes its keys. Such files are never written.
void keys_of(files::description::Fields& io, RobotFile& file);

/// The drivers that a file selects, with their threads started; null: the file selects none. A
/// device that does not answer is not an error: the driver keeps trying.
std::unique_ptr<drivers::WheelDriver> make_wheels(const RobotFile& file);
std::unique_ptr<drivers::InfraredDriver> make_infrared(const RobotFile& file);
/// In the order of `file.sensors`.
std::vector<std::unique_ptr<drivers::SensorDriver>> make_sensors(const RobotFile& file);

/// The channels of `file.sensors`, in their order.
std::vector<Channel> sensor_channels(const RobotFile& file);

/// The pose of a static agent; null for the other drivers, which the program must provide.
std::unique_ptr<PoseSource> make_static_pose(const RobotFile& file);

}  // namespace hal::robot::agent
