#include <array>

#include "hal/robot/agent/robot_file_sections.h"

namespace hal::robot::agent {
namespace {

using files::config::kUnlimited;
using files::config::Option;
using files::description::Fields;

constexpr std::array kOnLostSensor = {Option<OnLostSensor>{"stop", OnLostSensor::kStop},
                                      Option<OnLostSensor>{"ignore", OnLostSensor::kIgnore}};

void limit_keys(Fields& io, drivers::SpeedLimits& c) {
  io.number({"linear", "Largest speed, in any direction.", "0.6 m/s"}, "m/s", {0, kUnlimited},
            c.linear);
  io.number({"angular", "Largest turning rate, in either direction.", "1.5 rad/s"}, "rad/s",
            {0, kUnlimited}, c.angular);
}

}  // namespace

void device_keys(Fields& io, RobotFile& file) {
  io.inside({"wheels", "The robot's motors."},
            [&](Fields& wheels) { file.wheels = drivers::wheels_keys(wheels, *file.robot); });
  io.inside_given(
      {"infrared", "The robot's infrared range sensors."}, false,
      [&](Fields& infrared) { file.infrared = drivers::infrared_keys(infrared, *file.robot); });
  file.sensors = drivers::driven_sensors_key(io, file.robot->sensors);
  io.choice({"on_lost_sensor",
             "Whether the wheels stop while a sensor that the controller uses sends no readings.",
             "stop"},
            kOnLostSensor, file.on_lost_sensor);
  io.inside({"limits", "Limits on the velocities that a controller commands."},
            [&](Fields& limits) { limit_keys(limits, file.limits); });
}

}  // namespace hal::robot::agent
