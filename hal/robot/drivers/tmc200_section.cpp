#include <fmt/format.h>

#include <algorithm>

#include "hal/robot/drivers/tmc200.h"

namespace hal::robot::drivers {
namespace {

using namespace std::chrono_literals;
using files::description::Fields;

void motor_keys(Fields& io, Tmc200Settings::Motor& motor) {
  io.needed_count({"encoder_lines", "Lines of the encoder per turn of the motor shaft.", "500"}, 1,
                  25'000, motor.encoder_lines);
  io.needed({"gear", "Gear ratio: turns of the motor per turn of the wheel.", "16"}, "1",
            {1e-2, 1e4}, motor.gear);
  io.needed({"max_speed", "Speed of the motor shaft at the controller's full scale.", "3600 rpm"},
            "rad/s", {1, 2'000}, motor.max_speed);
  io.flag({"inverted", "Whether a motor's positive direction turns its wheel backwards.", "true"},
          motor.inverted);
}

/// Checks that there are three motors, none faster than the controller's full scale.
void check_motor(Fields& io, const Tmc200Settings& settings,
                 const node::devices::RobotDescription& robot) {
  const auto& wheels = robot.wheels;
  const auto driven = std::ranges::count_if(wheels, &node::devices::Wheel::is_driven);
  if ((driven != 3 || wheels.size() != 3) && !wheels.empty()) {
    io.mistake(
        "driver",
        fmt::format("a TMC200 drives 3 motors, but the robot has {} wheels, {} of them driven",
                    wheels.size(), driven));
  }
  const double reached = settings.motor.max_speed / settings.motor.gear;
  double wanted = 0;
  for (const auto& wheel : robot.wheels) wanted = std::max(wanted, wheel.max_speed);
  if (reached > 0 && reached < wanted) {
    io.mistake("motor", fmt::format("turns the wheels at {:.2f} rad/s at most, but the robot's "
                                    "wheels are said to reach {:.2f} rad/s",
                                    reached, wanted));
  }
}

Tmc200Settings tmc200_keys(Fields& io, const node::devices::RobotDescription& robot) {
  Tmc200Settings settings;
  io.needed_text({"device", "Device file of the serial line.", "/dev/ttyUSB0"}, settings.device);
  io.inside({"motor",
             "The motors: all three are of the same type and connected in the order of the robot's "
             "wheels."},
            [&](Fields& motor) { motor_keys(motor, settings.motor); });
  settings.cut_off = 200ms;
  io.duration({"cut_off",
               "Time without a command after which the motor controller stops the motors: a "
               "multiple of 10 ms, at least twice `period`.",
               "200 ms"},
              {0.01, 2.55}, settings.cut_off);
  if (settings.cut_off % 10ms != 0ns) {
    io.mistake("cut_off", "must be a multiple of 10 ms, which is what the controller counts in");
  }
  settings.times = {40ms, 150ms, 500ms};
  times_keys(io, settings.times, 1);
  if (2 * settings.times.period > settings.cut_off) {
    io.mistake("period",
               "must be at most half of cut_off: one lost command must not stop the "
               "motors");
  }
  check_motor(io, settings, robot);
  return settings;
}

}  // namespace

std::shared_ptr<const DriverChoice<WheelDriver>> tmc200_wheels_keys(
    Fields& io, const node::devices::RobotDescription& robot) {
  return std::make_shared<ChosenDriver<WheelDriver, Tmc200Settings>>(tmc200_keys(io, robot),
                                                                     make_tmc200_wheels);
}

}  // namespace hal::robot::drivers
