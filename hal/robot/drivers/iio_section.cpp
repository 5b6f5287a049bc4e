#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "hal/robot/drivers/iio.h"

namespace hal::robot::drivers {
namespace {

using namespace std::chrono_literals;
using files::config::Mapping;

bool is_voltage_channel(std::string_view name) {
  constexpr std::string_view kName = "voltage";
  return name.starts_with(kName) && name.size() > kName.size() &&
         std::all_of(name.begin() + kName.size(), name.end(),
                     [](char c) { return c >= '0' && c <= '9'; });
}

IioSettings read_iio(Mapping& in, const node::devices::RobotDescription& robot) {
  IioSettings settings;
  settings.folder = in.text({"folder", "Of the converter in sysfs (Linux Industrial I/O).",
                             "'/sys/bus/iio/devices/iio:device0'"});
  for (const files::config::Scalar& channel :
       in.texts({"channels", "One per infrared sensor of the robot.",
                 "[voltage0, voltage1, voltage2, voltage3, voltage4, voltage5]",
                 files::config::kMustBeGiven})) {
    settings.channels.push_back(channel.text);
    if (is_voltage_channel(channel.text)) continue;
    in.mistake("channels",
               fmt::format("'{}' is not a voltage channel, e.g. 'voltage0'", channel.text));
  }
  if (settings.channels.size() != robot.infrared.size()) {
    in.mistake("channels", fmt::format("names {} channels, but the robot has {} infrared sensors",
                                       settings.channels.size(), robot.infrared.size()));
  }
  settings.times = read_times(in, {40ms, 150ms, 500ms}, 1);
  return settings;
}

}  // namespace

std::shared_ptr<const DriverChoice<InfraredDriver>> read_iio_infrared(
    Mapping& in, const node::devices::RobotDescription& robot) {
  return std::make_shared<ChosenDriver<InfraredDriver, IioSettings>>(read_iio(in, robot),
                                                                     make_iio_infrared);
}

}  // namespace hal::robot::drivers
