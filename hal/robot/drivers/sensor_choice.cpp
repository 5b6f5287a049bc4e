#include "hal/robot/drivers/sensor_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "hal/robot/drivers/iio_imu.h"
#include "hal/robot/drivers/power_supply.h"

namespace hal::robot::drivers {
namespace {

using files::description::Fields;
using node::devices::SensorDescription;

struct SensorDriverKind {
  std::string_view name;  ///< As in the file: `driver: <name>`.
  std::string_view kind;  ///< Kind of sensor that it can feed.
  /// @param sensor  that it feeds; null: unknown.
  std::shared_ptr<const SensorChoice> (*keys)(Fields& io, const SensorDescription* sensor);
};

/// All drivers of sensors.
constexpr std::array kSensorDrivers{
    SensorDriverKind{"power_supply", node::devices::Battery::kKind, power_supply_keys},
    SensorDriverKind{"iio_imu", node::devices::ImuSensor::kKind, iio_imu_keys},
};

std::vector<std::string> names_of_drivers() {
  std::vector<std::string> names;
  names.reserve(kSensorDrivers.size());
  for (const SensorDriverKind& one : kSensorDrivers) names.emplace_back(one.name);
  return names;
}

/// A driver and the name of the sensor that it feeds.
struct NamedDriver {
  std::string sensor;
  std::string_view kind;  ///< Kind of sensor that it can feed.
  std::shared_ptr<const SensorChoice> driver;
};

/// Index of the sensor with this name; nullopt: the robot has none.
std::optional<std::size_t> index_of(const std::string& name,
                                    const std::vector<SensorDescription>& sensors) {
  const auto found = std::ranges::find_if(
      sensors, [&](const SensorDescription& sensor) { return mount_of(sensor).name == name; });
  if (found == sensors.end()) return std::nullopt;
  return static_cast<std::size_t>(found - sensors.begin());
}

/// @param driven  the sensors that have a driver so far.
void check(Fields& io, const NamedDriver& one, const std::vector<SensorDescription>& sensors,
           const std::vector<DrivenSensor>& driven) {
  const auto sensor = index_of(one.sensor, sensors);
  if (!sensor && !one.sensor.empty())
    io.mistake("name", fmt::format("the robot has no sensor '{}'", one.sensor));
  if (!sensor || !one.driver) return;
  const hal::Channel channel = node::devices::channel_of(sensors[*sensor]);
  if (channel.kind != one.kind)
    io.mistake("driver", fmt::format("feeds a sensor of the kind {}, but '{}' is of the kind {}",
                                     one.kind, one.sensor, channel.kind));
  if (std::ranges::find(driven, *sensor, &DrivenSensor::sensor) != driven.end())
    io.mistake("name", fmt::format("'{}' has a driver already", one.sensor));
}

void keys_of(Fields& io, NamedDriver& c, const std::vector<SensorDescription>& sensors) {
  io.needed_text({"name", "Name of one of the sensors in `robot.sensors`.", "battery"}, c.sensor);
  const auto sensor = index_of(c.sensor, sensors);
  io.kind({"driver",
           "power_supply: battery gauge in Linux's power supply class; iio_imu: gyroscopes and "
           "accelerometers of Linux's Industrial I/O.",
           "power_supply"},
          names_of_drivers(), [&](Fields& keys, std::size_t kind) {
            c.kind = kSensorDrivers.at(kind).kind;
            c.driver = kSensorDrivers.at(kind).keys(keys, sensor ? &sensors[*sensor] : nullptr);
          });
}

}  // namespace

std::vector<DrivenSensor> driven_sensors_key(Fields& io,
                                             const std::vector<SensorDescription>& sensors) {
  std::vector<DrivenSensor> driven;
  std::vector<NamedDriver> named;
  io.list<NamedDriver>(
      {"sensors", "Drivers of the sensors of `robot.sensors`; those without a driver are absent.",
       "[{name: battery, driver: power_supply, folder: /sys/class/power_supply/BAT0}]"},
      named, [&](Fields& one, NamedDriver& driver) {
        keys_of(one, driver, sensors);
        check(one, driver, sensors, driven);
        const auto sensor = index_of(driver.sensor, sensors);
        if (sensor && driver.driver) driven.push_back({*sensor, driver.driver});
      });
  return driven;
}

}  // namespace hal::robot::drivers
