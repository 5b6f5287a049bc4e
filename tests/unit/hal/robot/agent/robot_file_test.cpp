#include "hal/robot/agent/robot_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "hal/robot/drivers/iio.h"
#include "hal/robot/drivers/power_supply.h"
#include "hal/robot/drivers/robotino.h"
#include "hal/robot/drivers/tmc200.h"
#include "hal/types/math.h"
#include "tests/unit/hal/files/config/files.h"

namespace hal::robot::agent {
namespace {

using namespace std::chrono_literals;
using files::config::Lines;

const std::filesystem::path kHardware = std::filesystem::path(CONFIG_DIR) / "hardware";
const std::string kRobertino = (std::filesystem::path(CONFIG_DIR) / "robots/robertino.yaml");

/// @throws std::bad_cast  of another driver
template <class Settings, class Driver>
const Settings& settings_of(const std::shared_ptr<const drivers::DriverChoice<Driver>>& choice) {
  return dynamic_cast<const drivers::ChosenDriver<Driver, Settings>&>(*choice).settings();
}

class RobotFileTest : public files::config::Files {
 protected:
  /// The mistakes in a file, without its name.
  Lines mistakes(const std::string& text) const {
    const auto file = write("robot.yaml", text);
    Lines lines = messages([&] { (void)RobotFile::load(file); });
    for (std::string& line : lines) {
      if (line.starts_with("robot.yaml:")) line.erase(0, std::string("robot.yaml:").size());
    }
    return lines;
  }
  /// Those of a robot whose devices are given.
  Lines device_mistakes(const std::string& devices) const {
    return mistakes(
        "version: 1\nagent: {name: r0, address: 1, kind: robot}\n"
        "radio: {interface: eth0}\nrobot: {include: " +
        kRobertino + "}\n" + devices);
  }
};

TEST_F(RobotFileTest, TakesItsOwnAmongTheStaticRoutes) {
  const auto file = write("robot.yaml", R"(
version: 1
agent: {name: m1, address: 2, kind: mote}
radio: {interface: eth0}
localisation:
  driver: none
  map: [{name: m0, address: 1, x: 0 m, y: 0 m}, {name: m2, address: 3, x: 9 m, y: 0 m}]
routing: {algorithm: static, routes: [{path: [m0, m1, m2]}, {at: m0, to: m2}]}
)");
  const std::vector<node::routing::StaticRoute> expected{{AgentId{1}, AgentId{1}, 1},
                                                         {AgentId{3}, AgentId{3}, 1}};
  EXPECT_EQ(RobotFile::load(file).routing.statics.routes, expected);
}

TEST_F(RobotFileTest, GivesTopicsAndRoutingTheirPriorities) {
  const auto file = write("robot.yaml", R"(
version: 1
agent: {name: m1, address: 2, kind: mote}
radio: {interface: eth0}
localisation: {driver: none}
routing: {control_priority: 6}
priorities: {alarm: voice, images: 2}
)");
  const node::routing::RoutingConfig routing = RobotFile::load(file).routing;
  EXPECT_EQ(routing.control_priority, Priority{6});
  EXPECT_EQ(routing.priorities, (std::map<std::string, Priority, std::less<>>{
                                    {"alarm", Priority::kVoice}, {"images", Priority{2}}}));
}

TEST_F(RobotFileTest, KnowsTheNamesOfStaticRoutesFromItsMap) {
  EXPECT_EQ(mistakes("version: 1\nagent: {name: m1, address: 2, kind: mote}\n"
                     "radio: {interface: eth0}\nlocalisation: {driver: none}\n"
                     "routing: {algorithm: static, routes: [{to: m2}]}\n"),
            (Lines{"5:44: routing.routes.to: unknown agent 'm2'"}));
}

TEST(HardwareExamples, OfARobotinoSayWhatTheirCommentsSay) {
  const RobotFile file = RobotFile::load(kHardware / "robotino.yaml");
  EXPECT_EQ(file.name, "r0");
  EXPECT_EQ(file.address, AgentId{26});
  EXPECT_EQ(file.kind, AgentKind::kRobot);
  EXPECT_EQ(file.program, "help_robot");
  ASSERT_EQ(file.parameters.size(), 1U);
  EXPECT_EQ(file.parameters[0].value, "0.5 m/s");
  EXPECT_TRUE(file.parameters[0].place.ends_with("robotino.yaml:9:23")) << file.parameters[0].place;
  EXPECT_EQ(file.radio, (RadioSettings{"wlan0", "", 7300, 6e6, 0.1}));
  EXPECT_EQ(file.robot->infrared.size(), 9U);
  EXPECT_EQ(file.limits, (hal::robot::drivers::SpeedLimits{0.6, 1.5}));
  const auto& wheels = settings_of<drivers::RobotinoSettings>(file.wheels);
  EXPECT_EQ(wheels.host, "192.168.0.1");
  EXPECT_EQ(wheels.times, (hal::robot::drivers::DeviceTimes{50ms, 150ms, 500ms}));
  EXPECT_EQ(std::get<PoseTopicSettings>(file.localisation.source),
            (PoseTopicSettings{"/mocap/r0/pose", 500ms}));
  EXPECT_EQ(file.localisation.map[1], (Landmark{AgentId{2}, "m1", {5, 0}}));
  EXPECT_EQ(make_static_pose(file), nullptr);
}

TEST(HardwareExamples, OfATmc200SayWhatTheirCommentsSay) {
  const RobotFile file = RobotFile::load(kHardware / "tmc200.yaml");
  const auto& wheels = settings_of<drivers::Tmc200Settings>(file.wheels);
  EXPECT_EQ(wheels.motor.encoder_lines, 500);
  EXPECT_NEAR(wheels.motor.max_speed, 120 * math::kPi, 1e-9);
  EXPECT_EQ(wheels.cut_off, 200ms);
  const auto& infrared = settings_of<drivers::IioSettings>(file.infrared);
  EXPECT_EQ(infrared.folder, "/sys/bus/iio/devices/iio:device0");
  EXPECT_EQ(infrared.channels.size(), 6U);
}

TEST(HardwareExamples, OfAMoteNeedNoBodyAndKnowTheirPlace) {
  const RobotFile file = RobotFile::load(kHardware / "mote.yaml");
  EXPECT_EQ(file.kind, AgentKind::kMote);
  EXPECT_FALSE(file.robot);
  EXPECT_EQ(make_wheels(file), nullptr);
  EXPECT_EQ(make_infrared(file), nullptr);
  const auto source = make_static_pose(file);
  ASSERT_NE(source, nullptr);
  EXPECT_EQ(source->pose()->pose, (Pose2{5, 0, 0}));
}

TEST(HardwareExamples, LetTheControllerOpenSocketsWhereTheySay) {
  EXPECT_EQ(RobotFile::load(kHardware / "robotino.yaml").air_interface, "");
  const RobotFile file =
      RobotFile::load(kHardware / "robotino.yaml", {"controller.air_interface=wlan7"});
  EXPECT_EQ(file.air_interface, "wlan7");
  EXPECT_TRUE(file.air_interface_place.starts_with("--set")) << file.air_interface_place;
}

TEST_F(RobotFileTest, EmptyFilesLackEverything) {
  EXPECT_EQ(mistakes("{}\n"),
            (Lines{
                "1:1: agent.address: is missing: a whole number, 1 .. 65533, e.g. 26",
                "1:1: agent.kind: is missing: one of robot, mote",
                "1:1: agent.name: is missing: text, e.g. r0",
                "1:1: radio.interface: is missing: text, e.g. wlan0",
                "1:1: version: is missing: a whole number, 1",
            }));
}

TEST_F(RobotFileTest, EveryMistakeIsNamedAtOnce) {
  EXPECT_EQ(mistakes("version: 2\n"
                     "agent: {name: 0r, address: 65535, kind: car}\n"
                     "control_period: 1 s\n"
                     "command_timeout: 500 ms\n"
                     "radio: {interfce: eth0, port: 0, power: 1 m}\n"
                     "limits: {linear: 1 m/s}\n"
                     "localisation:\n"
                     "  driver: none\n"
                     "  topic: /pose\n"
                     "  map:\n"
                     "    - {name: m0, address: 1, x: 0 m, y: 0 m}\n"
                     "    - {name: m1, address: 1, x: 0 m, y: 0}\n"
                     "sped: 1\n"),
            (Lines{
                "1:10: version: 2 is above the limit of 1",
                "2:15: agent.name: '0r' must be letters, digits, '_' and '-' after a letter",
                "2:28: agent.address: 65535 is above the limit of 65533",
                "2:41: agent.kind: 'car' is not one of robot, mote",
                "4:18: command_timeout: must not be shorter than control_period: the wheels would "
                "stop between "
                "commands",
                "5:8: radio.interface: is missing: text, e.g. wlan0",
                "5:9: radio.interfce: is not a known key; did you mean 'interface'? Known here: "
                "interface, address, port, bit_rate, power",
                "5:31: radio.port: 0 is below the limit of 1",
                "5:41: radio.power: '1 m' must be written in W, e.g. '1 W'",
                "6:1: limits: a mote has none",
                "9:3: localisation.topic: only driver 'pose_topic' has one",
                "12:27: localisation.map.address: the address 1 is taken by 'm0'",
                "12:41: localisation.map.y: '0' must be written in m, e.g. '0 m'",
                "13:1: sped: is not a known key; did you mean 'seed'? Known here: version, agent, "
                "controller, seed, control_period, command_timeout, radio, routing, "
                "priorities, localisation",
            }));
}

TEST_F(RobotFileTest, DriversFeedSensorsThatTheRobotHasEachOneOfItsKind) {
  const std::string robot =
      "version: 1\nagent: {name: r0, address: 1, kind: robot}\nradio: {interface: eth0}\n"
      "robot: {include: " +
      kRobertino +
      ", sensors: [{kind: battery, capacity: 1 kJ, full_voltage: 12 V}, {kind: bumper}, "
      "{kind: imu}]}\nwheels: {driver: none}\nlimits: {linear: 1 m/s, angular: 1 rad/s}\n"
      "sensors:\n";
  const RobotFile file = RobotFile::load(
      write("good.yaml", robot + "  - {name: imu, driver: iio_imu, folder: /a, period: 10 ms}\n"
                                 "  - {name: battery, driver: power_supply, folder: /b}\n"));
  ASSERT_EQ(file.sensors.size(), 2U);
  EXPECT_EQ(file.sensors[0].sensor, 2U);
  const std::vector<Channel> channels = sensor_channels(file);
  ASSERT_EQ(channels.size(), 2U);
  EXPECT_EQ(channels[0].name, "imu");
  EXPECT_EQ(channels[0].id, 18);
  EXPECT_EQ(channels[0].period, 10ms);
  EXPECT_EQ(channels[1].name, "battery");
  EXPECT_EQ(channels[1].id, 16);
  // A gauge that knows a share only is told what the whole is.
  const auto* const gauge =
      dynamic_cast<const drivers::ChosenSensor<drivers::PowerSupplySettings>*>(
          file.sensors[1].driver.get());
  ASSERT_NE(gauge, nullptr);
  EXPECT_EQ(gauge->settings().capacity, 1000);

  EXPECT_EQ(mistakes(robot + "  - {name: sonar, driver: iio_imu, folder: /a}\n"
                             "  - {name: bumper, driver: power_supply, folder: /b}\n"
                             "  - {name: imu, driver: iio_imu, folder: /a}\n"
                             "  - {name: imu, driver: iio_imu, folder: /a}\n"
                             "  - {name: battery, driver: coin}\n"),
            (Lines{
                "8:12: sensors.name: the robot has no sensor 'sonar'",
                "9:28: sensors.driver: feeds a sensor of the kind battery, but 'bumper' is of the "
                "kind bumper",
                "11:12: sensors.name: 'imu' has a driver already",
                "12:29: sensors.driver: 'coin' is not one of power_supply, iio_imu",
            }));
}

TEST_F(RobotFileTest, DevicesMustKeepTheirOwnRules) {
  EXPECT_EQ(
      device_mistakes("wheels: {driver: robotino_rest, host: r, period: 150 ms, session: a&b}\n"
                      "infrared: {driver: iio, folder: /x, channels: [voltage0, 1]}\n"),
      (Lines{
          "5:50: wheels.period: 150 ms is above the limit of 0.1 s",
          "5:67: wheels.session: 'a&b' must not contain any of & # ? / % and blanks",
          "6:47: infrared.channels: '1' is not a voltage channel, e.g. 'voltage0'",
          "6:47: infrared.channels: names 2 channels, but the robot has 6 infrared sensors",
      }));
  EXPECT_EQ(
      device_mistakes("wheels:\n"
                      "  driver: tmc200\n"
                      "  device: /dev/ttyS0\n"
                      "  motor: {encoder_lines: 500, gear: 32, max_speed: 3600 rpm}\n"
                      "  cut_off: 55 ms\n"
                      "  period: 40 ms\n"
                      "  stale_after: 40 ms\n"),
      (Lines{
          "8:10: wheels.motor: turns the wheels at 11.78 rad/s at most, but the robot's wheels are "
          "said to reach 23.56 rad/s",
          "9:12: wheels.cut_off: must be a multiple of 10 ms, which is what the controller counts "
          "in",
          "10:11: wheels.period: must be at most half of cut_off: one lost command must not stop "
          "the "
          "motors",
          "11:16: wheels.stale_after: must be longer than period: no reading would ever be fresh",
      }));
}

TEST_F(RobotFileTest, ALostSensorStopsTheWheelsUnlessTheFileSaysOtherwise) {
  const auto rule_of = [](const std::vector<std::string>& overrides) {
    return RobotFile::load(kHardware / "robotino.yaml", overrides).on_lost_sensor;
  };
  EXPECT_EQ(rule_of({}), OnLostSensor::kStop);
  EXPECT_EQ(rule_of({"on_lost_sensor=stop"}), OnLostSensor::kStop);
  EXPECT_EQ(rule_of({"on_lost_sensor=ignore"}), OnLostSensor::kIgnore);
  EXPECT_EQ(device_mistakes("wheels: {driver: none}\non_lost_sensor: halt\n"),
            (Lines{"6:17: on_lost_sensor: 'halt' is not one of stop, ignore"}));
  EXPECT_EQ(mistakes("version: 1\nagent: {name: m0, address: 1, kind: mote}\n"
                     "radio: {interface: lo}\non_lost_sensor: stop\n"),
            (Lines{"4:1: on_lost_sensor: a mote has none"}));
}

TEST_F(RobotFileTest, UnknownDriversAreNamedWithTheirLikes) {
  EXPECT_EQ(device_mistakes("wheels: {driver: robotino, host: r}\n"),
            (Lines{"5:18: wheels.driver: 'robotino' is not one of none, robotino_rest, tmc200"}));
  EXPECT_EQ(device_mistakes(""),
            (Lines{"1:1: wheels.driver: is missing: one of none, robotino_rest, tmc200"}));
}

TEST_F(RobotFileTest, OverridesReachEveryKey) {
  const RobotFile file = RobotFile::load(
      kHardware / "robotino.yaml", {"wheels.port=8080", "radio.interface=lo", "agent.name=r7"});
  EXPECT_EQ(settings_of<hal::robot::drivers::RobotinoSettings>(file.wheels).port, 8080);
  EXPECT_EQ(file.radio.interface, "lo");
  EXPECT_EQ(file.name, "r7");
}

}  // namespace
}  // namespace hal::robot::agent
