#include <fmt/core.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>

#include "hal/robot/agent/robot_file.h"

/// The drivers of a ROBOT.yaml by hand: one command a line on standard input, one answer a line.
///
///   drive VX VY OMEGA | keep | stop | stop_and_wait SECONDS | state | infrared | wheels | sensors
///   | quit
namespace {

using namespace hal;
using namespace hal::robot::agent;
using namespace hal::robot::drivers;
using namespace hal::robot::platform;

double age(BootTime stamp) { return hal::to_seconds(hal::Duration{BootClock::now() - stamp}); }

std::string error(const hal::Error& e) {
  return fmt::format("error {} {}", static_cast<int>(e.code), e.message);
}

std::string done(const hal::Result<void>& result) { return result ? "ok" : error(result.error()); }

/// @tparam Driver  WheelDriver or InfraredDriver.
template <class Driver>
std::string condition(const Driver& driver) {
  const DeviceCounts counts = driver.counts();
  return fmt::format("{} connections {} failures {} bad_answers {} late {} trouble {}",
                     driver.connected() ? "connected" : "disconnected", counts.connections,
                     counts.failures, counts.bad_answers, counts.late_refresh, driver.trouble());
}

std::string state(const WheelDriver& wheels) {
  const auto state = wheels.state();
  if (!state) return error(state.error());
  const auto& [pose, twist, stamp] = *state;
  return fmt::format("{} {} {} {} {} {} {}", pose.x, pose.y, pose.theta, twist.vx, twist.vy,
                     twist.omega, age(stamp));
}

std::string infrared(const InfraredDriver& sensors) {
  const auto readings = sensors.latest();
  if (!readings) return error(readings.error());
  return fmt::format("{} | {} | {}", fmt::join(readings->metres, " "),
                     fmt::join(readings->volts, " "), age(readings->stamp));
}

/// The next word; "nan" and "inf" are numbers too.
double number(std::istringstream& words) {
  std::string word;
  words >> word;
  return std::strtod(word.c_str(), nullptr);
}

std::string obey(const std::string& line, WheelDriver* wheels, InfraredDriver* sensors) {
  std::istringstream words(line);
  std::string command;
  words >> command;
  if (command == "drive") {
    const double vx = number(words);
    const double vy = number(words);
    // Limited as DriveGuard does it.
    const hal::Twist2 twist =
        limited({vx, vy, number(words)}, wheels->kinematics(), wheels->speed_limits()).twist;
    return done(wheels->drive(twist, BootClock::now()));
  }
  if (command == "keep") {
    wheels->keep(BootClock::now());
    return "ok";
  }
  if (command == "stop") {
    wheels->stop();
    return "ok";
  }
  if (command == "stop_and_wait") {
    return done(wheels->stop_and_wait(hal::from_seconds(number(words))));
  }
  if (command == "state") return state(*wheels);
  if (command == "wheels") return condition(*wheels);
  if (command == "sensors") return condition(*sensors);
  if (command == "infrared") return infrared(*sensors);
  return "unknown command";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: driver_probe ROBOT.yaml [KEY=VALUE …]\n");
    return 2;
  }
  try {
    const RobotFile file = RobotFile::load(argv[1], {argv + 2, argv + argc});
    const std::unique_ptr<WheelDriver> wheels = make_wheels(file);
    const std::unique_ptr<InfraredDriver> sensors = make_infrared(file);
    for (std::string line; std::getline(std::cin, line) && line != "quit";) {
      fmt::print("{}\n", obey(line, wheels.get(), sensors.get()));
      std::fflush(stdout);
    }
    return 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
  }
}
