#pragma once

#include <span>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "hal/node/devices/battery.h"
#include "hal/node/devices/bumper.h"
#include "hal/node/devices/imu.h"
#include "hal/node/devices/pose_sensor.h"
#include "hal/node/devices/scan.h"
#include "hal/node/devices/sonar.h"
#include "hal/node/devices/value_name.h"
#include "hal/types/channel.h"

namespace hal::node::devices {

/// Every kind of sensor that `sensors:` of a robot file may list. The header of a kind has
///
///   struct Bumper                   its settings, with its kKind, its mount and describe(), the
///                                   channel; kValues, if its values have names; kIsQuiet, if its
///                                   readings are recorded unless the file says otherwise
///   keys_of(Fields& io, Bumper& c)  its keys, as hal/files/description/fields.h has them; a
///                                   template, for this folder does not see that file. name_key()
///                                   and keys_of() of the mount are in mount_keys.h beside it.
///
/// They are simulated in sim/sensing.
using SensorDescription = std::variant<ScanSensor, PoseSensor, Bumper, ImuSensor, Battery, Sonar>;

/// Calls `on_kind` with the std::type_identity of the sensor of that kind, if there is one.
template <class OnKind>
void for_kind(std::string_view kind, const OnKind& on_kind) {
  const auto try_one = [&]<class One>(std::type_identity<One> type) {
    if (One::kKind == kind) on_kind(type);
  };
  [&]<class... All>(std::type_identity<std::variant<All...>> /*type*/) {
    (try_one(std::type_identity<All>{}), ...);
  }(std::type_identity<SensorDescription>{});
}

/// Names of the values of a reading, by the kind of its channel; empty: they have none.
inline std::span<const ValueName> value_names(std::string_view kind) {
  std::span<const ValueName> names;
  for_kind(kind, [&]<class One>(std::type_identity<One> /*type*/) {
    if constexpr (requires { One::kValues; }) names = One::kValues;
  });
  return names;
}

/// Whether readings of a kind are equal for most of the time.
inline bool is_quiet(std::string_view kind) {
  bool is_quiet = false;
  for_kind(kind, [&]<class One>(std::type_identity<One> /*type*/) {
    if constexpr (requires { One::kIsQuiet; }) is_quiet = One::kIsQuiet;
  });
  return is_quiet;
}

inline Channel channel_of(const SensorDescription& sensor) {
  return std::visit([](const auto& one) { return one.describe(); }, sensor);
}

inline const Mount& mount_of(const SensorDescription& sensor) {
  return std::visit([](const auto& one) -> const Mount& { return one.mount; }, sensor);
}

/// The battery among the sensors; null: the agent has none and never runs out of energy.
inline const Battery* battery_of(const std::vector<SensorDescription>& sensors) {
  for (const SensorDescription& sensor : sensors)
    if (const auto* battery = std::get_if<Battery>(&sensor)) return battery;
  return nullptr;
}

}  // namespace hal::node::devices
