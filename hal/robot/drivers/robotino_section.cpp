#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "hal/robot/drivers/robotino.h"

namespace hal::robot::drivers {
namespace {

using namespace std::chrono_literals;
using files::config::Mapping;
using files::config::Option;

/// The Robotino stops after this long without a command (Festo, "Robotino REST API",
/// wiki.openrobotino.org/Rest_api.html); half of it leaves room for one that is lost.
constexpr double kRobotinoPeriod = 0.1;  // s

constexpr std::array kReads = {Option<bool>{"metres", false}, Option<bool>{"volts", true}};

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

}  // namespace

std::shared_ptr<const DriverChoice<WheelDriver>> read_robotino_wheels(
    Mapping& in, const node::devices::RobotDescription&) {
  return std::make_shared<ChosenDriver<WheelDriver, RobotinoSettings>>(read_robotino(in),
                                                                       make_robotino_wheels);
}

std::shared_ptr<const DriverChoice<InfraredDriver>> read_robotino_infrared(
    Mapping& in, const node::devices::RobotDescription&) {
  RobotinoSettings settings = read_robotino(in);
  settings.in_volts =
      in.choice({"reads", "What the array gives; firmware differs.", "metres"}, kReads, false);
  settings.clockwise =
      in.flag({"clockwise",
               "Whether sensor 1 looks to the right of sensor 0 instead of to its left.", "true"},
              false);
  return std::make_shared<ChosenDriver<InfraredDriver, RobotinoSettings>>(std::move(settings),
                                                                          make_robotino_infrared);
}

}  // namespace hal::robot::drivers
