#include <array>

#include "hal/robot/agent/robot_file_sections.h"

namespace hal::robot::agent {
namespace {

using files::config::Mapping;
using files::config::Option;

constexpr std::array kOnLostSensor = {Option<OnLostSensor>{"stop", OnLostSensor::kStop},
                                      Option<OnLostSensor>{"ignore", OnLostSensor::kIgnore}};

}  // namespace

void read_devices(Mapping& in, RobotFile& file) {
  file.wheels = drivers::read_wheels(in.mapping({"wheels", "The robot's motors."}), *file.robot);
  if (in.has("infrared"))
    file.infrared = drivers::read_infrared(
        in.mapping({"infrared", "The robot's infrared sensors."}), *file.robot);
  file.sensors = drivers::read_driven_sensors(
      in.mappings(
          {"sensors", "Which drivers feed which sensors of the robot; others are not there.",
           "[{name: battery, driver: power_supply, folder: /sys/class/power_supply/BAT0}]"}),
      file.robot->sensors);
  file.on_lost_sensor = in.choice(
      {"on_lost_sensor",
       "Whether the wheels stop while a sensor that the controller wants is silent.", "stop"},
      kOnLostSensor, file.on_lost_sensor);
  Mapping limits = in.mapping({"limits", "Of the velocity, whatever a controller commands."});
  file.limits.linear = limits.number({"linear", "Largest speed.", "0.6 m/s"}, "m/s",
                                     {0, files::config::kUnlimited}, file.limits.linear);
  file.limits.angular = limits.number({"angular", "Largest rate of turn.", "1.5 rad/s"}, "rad/s",
                                      {0, files::config::kUnlimited}, file.limits.angular);
  limits.finish();
}

}  // namespace hal::robot::agent
