#include "hal/files/description/sensors_section.h"

#include <array>
#include <string>
#include <utility>

#include "hal/files/description/mount_keys.h"

namespace hal::files::description {
namespace {

using node::devices::Battery;
using node::devices::SensorDescription;

const auto kKinds = kinds_of<SensorDescription>([](const auto& sensor) { return sensor.kKind; });

std::string meaning_of_kind() {
  std::string all;
  for (const auto& one : kKinds) {
    all += all.empty() ? "" : ", ";
    all += one.name;
  }
  return "Kind of sensor: " + all + ".";
}

/// @param all  the sensors so far, including this one.
void check(Fields& io, const SensorDescription& sensor, const std::vector<SensorDescription>& all) {
  const std::string& name = mount_of(sensor).name;
  const auto is_called_so = [&](const auto& other) { return mount_of(other).name == name; };
  if (std::ranges::count_if(all, is_called_so) > 1)
    io.mistake("name", "'" + name + "' is the name of another sensor, too");
  if (std::holds_alternative<Battery>(sensor) && battery_of(all) != &std::get<Battery>(sensor))
    io.mistake("kind", "there is another battery: an agent has one at most");
}

}  // namespace

void sensor_keys(Fields& io, std::vector<SensorDescription>& sensors) {
  const std::string meaning = meaning_of_kind();
  io.list_if_any<SensorDescription>(
      {"sensors",
       "Further sensors, each with a channel of its own. `{add: [sensors], remove: [names]}` "
       "changes the list of an included file.",
       "[{kind: scan, position: [0 m, 0 m, 20 cm], min_range: 12 cm, max_range: 3.5 m}]"},
      sensors, [&](Fields& one, SensorDescription& sensor) {
        one.kinds({"kind", meaning, "scan"}, kKinds, sensor,
                  [](Fields& keys, SensorDescription& any) {
                    std::visit([&keys](auto& c) { keys_of(keys, c); }, any);
                  });
        check(one, sensor, sensors);
      });
}

}  // namespace hal::files::description
