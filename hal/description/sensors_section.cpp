#include "hal/description/sensors_section.h"

#include <array>
#include <set>
#include <string>
#include <utility>

#include "hal/description/battery_section.h"
#include "hal/description/bumper_section.h"
#include "hal/description/fields.h"
#include "hal/description/imu_section.h"
#include "hal/description/pose_section.h"
#include "hal/description/scan_section.h"
#include "hal/description/sonar_section.h"

namespace hal::description {
namespace {

using devices::SensorDescription;

constexpr std::size_t kKinds = std::variant_size_v<SensorDescription>;

template <std::size_t... kIndex>
constexpr auto kind_options(std::index_sequence<kIndex...>) {
  return std::array<Option<std::size_t>, kKinds>{
      Option<std::size_t>{std::variant_alternative_t<kIndex, SensorDescription>::kKind, kIndex}...};
}

/// A sensor of the kind with that index, as it is without a file.
template <std::size_t... kIndex>
SensorDescription of_kind(std::size_t kind, std::index_sequence<kIndex...>) {
  constexpr std::array kMake{+[]() -> SensorDescription {
    return std::variant_alternative_t<kIndex, SensorDescription>{};
  }...};
  return kMake.at(kind)();
}

constexpr auto kAll = std::make_index_sequence<kKinds>{};

std::string kinds() {
  std::string all;
  for (const Option<std::size_t>& option : kind_options(kAll))
    all += (all.empty() ? "" : ", ") + std::string(option.name);
  return all;
}

}  // namespace

std::vector<SensorDescription> read_sensors(Mapping& in) {
  std::vector<SensorDescription> sensors;
  std::set<std::string> names;
  for (Mapping& one : in.mappings(
           {"sensors",
            "Further sensors, each a channel of its own. `{add: [sensors], remove: [names]}` "
            "changes "
            "the list of an included file.",
            "[{kind: scan, position: [0 m, 0 m, 20 cm], min_range: 12 cm, max_range: 3.5 m}]"})) {
    const std::optional<std::size_t> kind =
        one.choice({"kind", "Of the sensor: " + kinds() + ".", "scan"}, kind_options(kAll));
    if (!kind) continue;
    SensorDescription sensor = of_kind(*kind, kAll);
    std::visit([&](auto& description) { read(one, description); }, sensor);
    if (!names.insert(mount_of(sensor).name).second)
      one.mistake("name", "'" + mount_of(sensor).name + "' is the name of another sensor, too");
    if (std::holds_alternative<devices::Battery>(sensor) && battery_of(sensors) != nullptr)
      one.mistake("kind", "there is another battery: an agent has one at most");
    sensors.push_back(std::move(sensor));
    one.finish();
  }
  return sensors;
}

void write_sensors(Writer& out, const std::vector<SensorDescription>& sensors) {
  if (sensors.empty()) return;
  out.open_list("sensors");
  for (const SensorDescription& sensor : sensors) {
    out.open_item();
    std::visit(
        [&](const auto& description) {
          out.text("kind", std::string(description.kKind));
          write(out, description);
        },
        sensor);
    out.close();
  }
  out.close();
}

}  // namespace hal::description
