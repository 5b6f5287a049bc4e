#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hal/config/mapping.h"
#include "hal/devices/robot_description.h"
#include "hal/exchange/session.h"
#include "hal/hardware/infrared.h"
#include "hal/hardware/localisation.h"
#include "hal/hardware/speed_limits.h"
#include "hal/hardware/wheels.h"
#include "hal/routing/routing_config.h"
#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"
#include "hal/types/time.h"

namespace hal::hardware {

/// The UDP radio. Interface and port must be the same network and port on all agents.
struct RadioSettings {
  std::string interface;  ///< E.g. "wlan0".
  std::string address;    ///< One of the interface's, dotted; empty: its first one.
  std::uint16_t port = 7300;
  double bit_rate = 1e6;  ///< bit/s, > 0; nominal, for the delay statistics of routes
  double power = 0.1;     ///< W, >= 0; of the transmitter, for their energy
  bool operator==(const RadioSettings&) const = default;
};

/// What a driver may assume of its device: how long it waits for an answer, how often it asks, and
/// which age of a reading is too old: the channel is lost then.
struct DeviceTimes {
  Duration period{};       ///< > 0
  Duration timeout{};      ///< > 0
  Duration stale_after{};  ///< > period
  bool operator==(const DeviceTimes&) const = default;
};

/// Festo Robotino 3 or 4 over its REST interface (wiki.openrobotino.org/Rest_api.html).
struct RobotinoSettings {
  std::string host;  ///< Name or address.
  std::uint16_t port = 80;
  std::string session = "baraka";  ///< `sid` of the requests.
  DeviceTimes times;               ///< Period <= 100 ms: the robot stops after 200 ms of silence.
  // Infrared only. Firmware differs, so the file says what the array gives.
  bool in_volts = false;   ///< Volts instead of metres.
  bool clockwise = false;  ///< Sensor i looks along -40 deg * i instead of 40 deg * i.
  bool operator==(const RobotinoSettings&) const = default;
};

/// Fraunhofer AiS TMC200 triple motor controller on a serial line, 57600 8N1.
struct Tmc200Settings {
  struct Motor {
    int encoder_lines = 0;  ///< Per turn of the motor shaft, > 0.
    double gear = 1;        ///< Turns of the motor per turn of the wheel, > 0.
    double max_speed = 0;   ///< rad/s of the motor shaft, > 0: the controller's full scale.
    bool inverted = false;  ///< Wired so that it turns against the wheel's positive direction.
    bool operator==(const Motor&) const = default;
  };
  std::string device;  ///< E.g. "/dev/ttyUSB0".
  Motor motor;         ///< All three are alike, in the order of the robot's wheels.
  Duration cut_off{};  ///< The controller stops the motors after this silence; 10 ms .. 2.55 s.
  DeviceTimes times;   ///< Period <= cut_off / 2.
  bool operator==(const Tmc200Settings&) const = default;
};

/// Sensors on an analog-to-digital converter of Linux's Industrial I/O subsystem.
struct IioSettings {
  std::filesystem::path folder;       ///< E.g. "/sys/bus/iio/devices/iio:device0".
  std::vector<std::string> channels;  ///< E.g. "voltage0", one per sensor of the robot.
  DeviceTimes times;
  bool operator==(const IioSettings&) const = default;
};

/// Pose from a DDS topic of geometry_msgs/PoseStamped.
struct PoseTopicSettings {
  std::string topic;       ///< As in ROS 2, e.g. "/mocap/r0/pose".
  Duration stale_after{};  ///< An older fix is no fix.
  bool operator==(const PoseTopicSettings&) const = default;
};

/// How the agent knows where it and the others are.
struct LocalisationSettings {
  /// None: the agent has no channel "localisation".
  std::variant<std::monostate, PoseTopicSettings, Pose2> source;
  double range = 300;         ///< m: landmarks farther away are not reported.
  std::vector<Landmark> map;  ///< By address.
  bool operator==(const LocalisationSettings&) const = default;
};

/// What happens to the wheels while a channel that the controller asked for is lost.
enum class OnLostSensor : std::uint8_t {
  kStop,    ///< They stand.
  kIgnore,  ///< They obey: the controller is told and has to know what to do.
};

/// Places of values, "file:line:column", for mistakes that only this computer can find.
struct RadioPlaces {
  std::string interface, address, port;
};

/// Everything ROBOT.yaml says.
struct RobotFile {
  std::string name;
  AgentId address;
  AgentKind kind = AgentKind::kMote;
  std::string program;  ///< Controller this agent is for; empty: any.
  std::vector<exchange::ParameterText> parameters;
  std::uint64_t seed = 1;
  Duration control_period{100'000'000};
  Duration command_timeout{500'000'000};
  RadioSettings radio;
  RadioPlaces radio_places;
  routing::RoutingConfig routing;
  LocalisationSettings localisation;

  // Robots only.
  std::optional<devices::RobotDescription> robot;
  SpeedLimits limits;
  OnLostSensor on_lost_sensor = OnLostSensor::kStop;
  std::variant<std::monostate, RobotinoSettings, Tmc200Settings> wheels;
  std::variant<std::monostate, RobotinoSettings, IioSettings> infrared;

  std::vector<std::string> warnings;  ///< What is allowed and hardly meant, a line each.

  /// Reads the top level of a file; notes mistakes there.
  static RobotFile read(config::Mapping in);

  /// Reads and checks a file.
  /// @param overrides  "dotted.path=value", as of `baraka run --set`.
  /// @throws config::ConfigErrors with every mistake, "file:line:column: key: what is wrong".
  static RobotFile load(const std::filesystem::path& file,
                        const std::vector<std::string>& overrides = {});
};

/// The drivers that a file asks for, their threads started; null: the file asks for none. A device
/// that does not answer is no error: the driver goes on trying.
std::unique_ptr<WheelDriver> make_wheels(const RobotFile& file);
std::unique_ptr<InfraredDriver> make_infrared(const RobotFile& file);

/// The pose of a static agent; null for the other drivers, which need the program's help.
std::unique_ptr<PoseSource> make_static_pose(const RobotFile& file);

}  // namespace hal::hardware
