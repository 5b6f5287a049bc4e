#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "hal/robot/drivers/iio.h"

namespace hal::robot::drivers {
namespace {

using namespace std::chrono_literals;
using files::description::Fields;

bool is_voltage_channel(std::string_view name) {
  constexpr std::string_view kName = "voltage";
  return name.starts_with(kName) && name.size() > kName.size() &&
         std::all_of(name.begin() + kName.size(), name.end(),
                     [](char c) { return c >= '0' && c <= '9'; });
}

IioSettings iio_keys(Fields& io, const node::devices::RobotDescription& robot) {
  IioSettings settings;
  std::string folder;
  io.needed_text({"folder", "Folder of the converter in sysfs (Linux Industrial I/O).",
                  "'/sys/bus/iio/devices/iio:device0'"},
                 folder);
  settings.folder = std::move(folder);
  io.texts(
      {"channels",
       "Channels of the converter, one for each infrared sensor of the robot, in that order.",
       "[voltage0, voltage1, voltage2, voltage3, voltage4, voltage5]", files::config::kMustBeGiven},
      settings.channels);
  for (const std::string& channel : settings.channels) {
    if (!is_voltage_channel(channel))
      io.mistake("channels",
                 fmt::format("'{}' is not a voltage channel, e.g. 'voltage0'", channel));
  }
  if (settings.channels.size() != robot.infrared.size()) {
    io.mistake("channels", fmt::format("names {} channels, but the robot has {} infrared sensors",
                                       settings.channels.size(), robot.infrared.size()));
  }
  settings.times = {40ms, 150ms, 500ms};
  times_keys(io, settings.times, 1);
  return settings;
}

}  // namespace

std::shared_ptr<const DriverChoice<InfraredDriver>> iio_infrared_keys(
    Fields& io, const node::devices::RobotDescription& robot) {
  return std::make_shared<ChosenDriver<InfraredDriver, IioSettings>>(iio_keys(io, robot),
                                                                     make_iio_infrared);
}

}  // namespace hal::robot::drivers
