#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "hal/robot/drivers/robotino.h"

namespace hal::robot::drivers {
namespace {

using namespace std::chrono_literals;
using files::config::Option;
using files::description::Fields;

/// The Robotino stops after this long without a command (Festo, "Robotino REST API",
/// wiki.openrobotino.org/Rest_api.html); half of that time tolerates the loss of one command.
constexpr double kRobotinoPeriod = 0.1;  // s

constexpr std::array kReads = {Option<bool>{"metres", false}, Option<bool>{"volts", true}};

RobotinoSettings robotino_keys(Fields& io) {
  RobotinoSettings settings;
  io.needed_text({"host", "Host name or IP address of the robot.", "192.168.0.1"}, settings.host);
  io.count({"port", "TCP port of its HTTP server.", "80"}, 1, 0xffff, settings.port);
  io.text({"session", "Value of `sid` in the requests; must not contain & # ? / % or blanks.",
           "baraka"},
          settings.session);
  const auto is_plain = [](char c) {
    return std::string_view("&#?/% ").find(c) == std::string::npos;
  };
  if (!std::all_of(settings.session.begin(), settings.session.end(), is_plain)) {
    io.mistake("session",
               fmt::format("'{}' must not contain any of & # ? / % and blanks", settings.session));
  }
  settings.times = {50ms, 150ms, 500ms};
  times_keys(io, settings.times, kRobotinoPeriod);
  return settings;
}

}  // namespace

std::shared_ptr<const DriverChoice<WheelDriver>> robotino_wheels_keys(
    Fields& io, const node::devices::RobotDescription&) {
  return std::make_shared<ChosenDriver<WheelDriver, RobotinoSettings>>(robotino_keys(io),
                                                                       make_robotino_wheels);
}

std::shared_ptr<const DriverChoice<InfraredDriver>> robotino_infrared_keys(
    Fields& io, const node::devices::RobotDescription&) {
  RobotinoSettings settings = robotino_keys(io);
  io.choice({"reads", "Unit of the values that the robot reports, which depends on its firmware.",
             "metres"},
            kReads, settings.in_volts);
  io.flag(
      {"clockwise",
       "Whether sensor 1 is to the right of sensor 0, that is clockwise, instead of to its left.",
       "true"},
      settings.clockwise);
  return std::make_shared<ChosenDriver<InfraredDriver, RobotinoSettings>>(std::move(settings),
                                                                          make_robotino_infrared);
}

}  // namespace hal::robot::drivers
