#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "hal/hardware/robot_file_sections.h"
#include "hal/types/math.h"

namespace hal::hardware {
namespace {

using namespace std::chrono_literals;
using config::Mapping;
using config::Option;

/// The Robotino stops after this long without a command (Festo, "Robotino REST API",
/// wiki.openrobotino.org/Rest_api.html); half of it leaves room for one that is lost.
constexpr double kRobotinoPeriod = 0.1;  // s

enum class WheelsDriver : std::uint8_t { kNone, kRobotinoRest, kTmc200 };
constexpr std::array kWheelsDrivers = {
    Option<WheelsDriver>{"none", WheelsDriver::kNone},
    Option<WheelsDriver>{"robotino_rest", WheelsDriver::kRobotinoRest},
    Option<WheelsDriver>{"tmc200", WheelsDriver::kTmc200}};

enum class InfraredKind : std::uint8_t { kNone, kRobotinoRest, kIio };
constexpr std::array kInfraredKinds = {
    Option<InfraredKind>{"none", InfraredKind::kNone},
    Option<InfraredKind>{"robotino_rest", InfraredKind::kRobotinoRest},
    Option<InfraredKind>{"iio", InfraredKind::kIio}};

constexpr std::array kOnLostSensor = {Option<OnLostSensor>{"stop", OnLostSensor::kStop},
                                      Option<OnLostSensor>{"ignore", OnLostSensor::kIgnore}};

constexpr std::array kReads = {Option<bool>{"metres", false}, Option<bool>{"volts", true}};

DeviceTimes read_times(Mapping& in, DeviceTimes times, double longest_period) {
  times.period =
      in.duration({"period", "Between two commands to, or questions of, the device.", "50 ms"},
                  {1e-3, longest_period}, times.period);
  times.timeout = in.duration({"timeout", "How long to wait for an answer.", "150 ms"}, {1e-3, 10},
                              times.timeout);
  times.stale_after =
      in.duration({"stale_after", "Older readings are not used; longer than `period`.", "500 ms"},
                  {1e-3, 60}, times.stale_after);
  if (times.stale_after <= times.period) {
    in.mistake("stale_after", "must be longer than period: no reading would ever be fresh");
  }
  return times;
}

RobotinoSettings read_robotino(Mapping& in) {
  RobotinoSettings settings;
  settings.host = in.text({"host", "Name or address of the robot.", "192.168.0.1"});
  settings.port = static_cast<std::uint16_t>(
      in.integer({"port", "Of its HTTP server.", "80"}, 1, 0xffff, settings.port));
  settings.session =
      in.text({"session", "`sid` of the requests; none of & # ? / % and blanks.", "baraka"},
              settings.session);
  const auto is_plain = [](char c) {
    return std::string_view("&#?/% ").find(c) == std::string::npos;
  };
  if (!std::all_of(settings.session.begin(), settings.session.end(), is_plain)) {
    in.mistake("session",
               fmt::format("'{}' must not contain any of & # ? / % and blanks", settings.session));
  }
  settings.times = read_times(in, {50ms, 150ms, 500ms}, kRobotinoPeriod);
  return settings;
}

Tmc200Settings::Motor read_motor(Mapping in) {
  Tmc200Settings::Motor motor;
  motor.encoder_lines = static_cast<int>(in.integer(
      {"encoder_lines", "Of the encoder, per turn of the motor shaft.", "500"}, 1, 25'000));
  motor.gear =
      in.number({"gear", "Turns of the motor per turn of the wheel.", "16"}, "1", {1e-2, 1e4});
  motor.max_speed =
      in.number({"max_speed", "Of the motor shaft: the controller's full scale.", "3600 rpm"},
                "rad/s", {1, 2'000});
  motor.inverted = in.flag(
      {"inverted", "Whether the motors turn against the wheels' positive direction.", "true"},
      false);
  in.finish();
  return motor;
}

/// The controller drives three motors and cannot turn them faster than its full scale.
void check_motor(Mapping& in, const Tmc200Settings& settings, const RobotFile& file) {
  const auto& wheels = file.robot->wheels;
  const auto driven = std::ranges::count_if(wheels, &devices::Wheel::is_driven);
  if ((driven != 3 || wheels.size() != 3) && !wheels.empty()) {
    in.mistake(
        "driver",
        fmt::format("a TMC200 drives 3 motors, but the robot has {} wheels, {} of them driven",
                    wheels.size(), driven));
  }
  const double reached = settings.motor.max_speed / settings.motor.gear;
  double wanted = 0;
  for (const auto& wheel : file.robot->wheels) wanted = std::max(wanted, wheel.max_speed);
  if (reached > 0 && reached < wanted) {
    in.mistake("motor", fmt::format("turns the wheels at {:.2f} rad/s at most, but the robot's "
                                    "wheels are said to reach {:.2f} rad/s",
                                    reached, wanted));
  }
}

Tmc200Settings read_tmc200(Mapping& in, const RobotFile& file) {
  Tmc200Settings settings;
  settings.device = in.text({"device", "The serial line.", "/dev/ttyUSB0"});
  settings.motor =
      read_motor(in.mapping({"motor", "All three are alike, in the order of the robot's wheels."}));
  settings.cut_off = in.duration({"cut_off",
                                  "The controller stops the motors after this silence: a multiple "
                                  "of 10 ms, at least twice `period`.",
                                  "200 ms"},
                                 {0.01, 2.55}, 200ms);
  if (settings.cut_off % 10ms != 0ns) {
    in.mistake("cut_off", "must be a multiple of 10 ms, which is what the controller counts in");
  }
  settings.times = read_times(in, {40ms, 150ms, 500ms}, 1);
  if (2 * settings.times.period > settings.cut_off) {
    in.mistake("period",
               "must be at most half of cut_off: one lost command must not stop the "
               "motors");
  }
  check_motor(in, settings, file);
  return settings;
}

void read_wheels(Mapping in, RobotFile& file) {
  const auto driver = in.choice(
      {"driver",
       "A Festo Robotino's REST interface, a Fraunhofer TMC200 motor controller, or none.",
       "robotino_rest"},
      kWheelsDrivers);
  if (driver == WheelsDriver::kRobotinoRest) file.wheels = read_robotino(in);
  if (driver == WheelsDriver::kTmc200) file.wheels = read_tmc200(in, file);
  if (driver) in.finish();  // else every key would seem to be wrong
}

bool is_voltage_channel(std::string_view name) {
  constexpr std::string_view kName = "voltage";
  return name.starts_with(kName) && name.size() > kName.size() &&
         std::all_of(name.begin() + kName.size(), name.end(),
                     [](char c) { return c >= '0' && c <= '9'; });
}

IioSettings read_iio(Mapping& in, const RobotFile& file) {
  IioSettings settings;
  settings.folder = in.text({"folder", "Of the converter in sysfs (Linux Industrial I/O).",
                             "'/sys/bus/iio/devices/iio:device0'"});
  for (const config::Scalar& channel :
       in.texts({"channels", "One per infrared sensor of the robot.",
                 "[voltage0, voltage1, voltage2, voltage3, voltage4, voltage5]",
                 config::kMustBeGiven})) {
    settings.channels.push_back(channel.text);
    if (is_voltage_channel(channel.text)) continue;
    in.mistake("channels",
               fmt::format("'{}' is not a voltage channel, e.g. 'voltage0'", channel.text));
  }
  if (settings.channels.size() != file.robot->infrared.size()) {
    in.mistake("channels", fmt::format("names {} channels, but the robot has {} infrared sensors",
                                       settings.channels.size(), file.robot->infrared.size()));
  }
  settings.times = read_times(in, {40ms, 150ms, 500ms}, 1);
  return settings;
}

void read_infrared(Mapping in, RobotFile& file) {
  const auto driver = in.choice({"driver",
                                 "A Festo Robotino's REST interface, an analog-to-digital "
                                 "converter of Linux's Industrial I/O, or none.",
                                 "robotino_rest"},
                                kInfraredKinds);
  if (driver == InfraredKind::kRobotinoRest) {
    RobotinoSettings settings = read_robotino(in);
    settings.in_volts =
        in.choice({"reads", "What the array gives; firmware differs.", "metres"}, kReads, false);
    settings.clockwise =
        in.flag({"clockwise",
                 "Whether sensor 1 looks to the right of sensor 0 instead of to its left.", "true"},
                false);
    file.infrared = settings;
  }
  if (driver == InfraredKind::kIio) file.infrared = read_iio(in, file);
  if (driver && driver != InfraredKind::kNone && file.robot->infrared.empty()) {
    in.mistake("driver", "the robot has no infrared sensors");
  }
  if (driver) in.finish();
}

}  // namespace

void read_devices(Mapping& in, RobotFile& file) {
  read_wheels(in.mapping({"wheels", "The robot's motors."}), file);
  if (in.has("infrared"))
    read_infrared(in.mapping({"infrared", "The robot's infrared sensors."}), file);
  file.on_lost_sensor = in.choice(
      {"on_lost_sensor",
       "Whether the wheels stop while a sensor that the controller wants is silent.", "stop"},
      kOnLostSensor, file.on_lost_sensor);
  Mapping limits = in.mapping({"limits", "Of the velocity, whatever a controller commands."});
  file.limits.linear = limits.number({"linear", "Largest speed.", "0.6 m/s"}, "m/s",
                                     {0, config::kUnlimited}, file.limits.linear);
  file.limits.angular = limits.number({"angular", "Largest rate of turn.", "1.5 rad/s"}, "rad/s",
                                      {0, config::kUnlimited}, file.limits.angular);
  limits.finish();
}

}  // namespace hal::hardware
