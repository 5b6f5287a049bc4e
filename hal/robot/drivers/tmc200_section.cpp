#include <fmt/format.h>

#include <algorithm>

#include "hal/robot/drivers/tmc200.h"

namespace hal::robot::drivers {
namespace {

using namespace std::chrono_literals;
using files::config::Mapping;

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
void check_motor(Mapping& in, const Tmc200Settings& settings,
                 const node::devices::RobotDescription& robot) {
  const auto& wheels = robot.wheels;
  const auto driven = std::ranges::count_if(wheels, &node::devices::Wheel::is_driven);
  if ((driven != 3 || wheels.size() != 3) && !wheels.empty()) {
    in.mistake(
        "driver",
        fmt::format("a TMC200 drives 3 motors, but the robot has {} wheels, {} of them driven",
                    wheels.size(), driven));
  }
  const double reached = settings.motor.max_speed / settings.motor.gear;
  double wanted = 0;
  for (const auto& wheel : robot.wheels) wanted = std::max(wanted, wheel.max_speed);
  if (reached > 0 && reached < wanted) {
    in.mistake("motor", fmt::format("turns the wheels at {:.2f} rad/s at most, but the robot's "
                                    "wheels are said to reach {:.2f} rad/s",
                                    reached, wanted));
  }
}

Tmc200Settings read_tmc200(Mapping& in, const node::devices::RobotDescription& robot) {
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
  check_motor(in, settings, robot);
  return settings;
}

}  // namespace

std::shared_ptr<const DriverChoice<WheelDriver>> read_tmc200_wheels(
    Mapping& in, const node::devices::RobotDescription& robot) {
  return std::make_shared<ChosenDriver<WheelDriver, Tmc200Settings>>(read_tmc200(in, robot),
                                                                     make_tmc200_wheels);
}

}  // namespace hal::robot::drivers
