#include "hal/robot/drivers/sensor_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "hal/robot/drivers/iio_imu.h"
#include "hal/robot/drivers/power_supply.h"

namespace hal::robot::drivers {
namespace {

using files::config::Mapping;
using files::config::Option;
using node::devices::SensorDescription;

struct SensorDriverKind {
  std::string_view name;  ///< In the file: `driver: <name>`.
  std::string_view kind;  ///< Of the sensors that it can feed.
  /// @param sensor  that it feeds; null: not known.
  std::shared_ptr<const SensorChoice> (*read)(Mapping& in, const SensorDescription* sensor);
};

/// The one table of drivers of sensors.
constexpr std::array kSensorDrivers{
    SensorDriverKind{"power_supply", node::devices::Battery::kKind, read_power_supply},
    SensorDriverKind{"iio_imu", node::devices::ImuSensor::kKind, read_iio_imu},
};
constexpr std::array kNames{Option<std::size_t>{kSensorDrivers[0].name, 0},
                            Option<std::size_t>{kSensorDrivers[1].name, 1}};
static_assert(kNames.size() == kSensorDrivers.size());

/// Which of the robot's sensors; none: no such, which is noted.
std::optional<std::size_t> find_sensor(Mapping& in, const std::string& name,
                                       const std::vector<SensorDescription>& sensors) {
  const auto found = std::ranges::find_if(
      sensors, [&](const SensorDescription& sensor) { return mount_of(sensor).name == name; });
  if (found != sensors.end()) return static_cast<std::size_t>(found - sensors.begin());
  if (!name.empty()) in.mistake("name", fmt::format("the robot has no sensor '{}'", name));
  return std::nullopt;
}

}  // namespace

std::vector<DrivenSensor> read_driven_sensors(std::vector<Mapping> in,
                                              const std::vector<SensorDescription>& sensors) {
  std::vector<DrivenSensor> driven;
  for (Mapping& one : in) {
    const std::string name =
        one.text({"name", "Of one of the sensors in `robot.sensors`.", "battery"});
    const auto sensor = find_sensor(one, name, sensors);
    const auto driver = one.choice(
        {"driver",
         "power_supply: a battery's gauge in Linux's power supplies; iio_imu: gyroscopes and "
         "accelerometers of Linux's Industrial I/O.",
         "power_supply"},
        kNames);
    if (!driver) continue;
    const SensorDriverKind& kind = kSensorDrivers.at(*driver);
    auto choice = kind.read(one, sensor ? &sensors[*sensor] : nullptr);
    one.finish();
    if (!sensor) continue;
    const hal::Channel channel = node::devices::channel_of(sensors[*sensor]);
    if (channel.kind != kind.kind)
      one.mistake("driver", fmt::format("feeds a sensor of the kind {}, but '{}' is of the kind {}",
                                        kind.kind, name, channel.kind));
    if (std::ranges::find(driven, *sensor, &DrivenSensor::sensor) != driven.end())
      one.mistake("name", fmt::format("'{}' has a driver already", name));
    driven.push_back({*sensor, std::move(choice)});
  }
  return driven;
}

}  // namespace hal::robot::drivers
