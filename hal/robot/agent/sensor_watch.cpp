#include "hal/robot/agent/sensor_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hal/types/log.h"

namespace hal::robot::agent {
namespace {

bool contains(const std::vector<SilentDevice>& devices, const std::string& name) {
  return std::ranges::find(devices, name, &SilentDevice::name) != devices.end();
}

}  // namespace

std::string SensorWatch::look(Time now, const std::vector<SilentDevice>& silent) {
  if (!std::exchange(looked_, true)) {
    for (const SilentDevice& device : silent) never_heard_.insert(device.name);
  }
  std::erase_if(never_heard_, [&](const std::string& name) { return !contains(silent, name); });
  std::erase_if(lost_, [&](const std::string& name) {
    const bool is_back = !contains(silent, name);
    if (is_back) log::info(now, file_.name, "{}: back", name);
    return is_back;
  });
  for (const SilentDevice& device : silent) {
    if (never_heard_.contains(device.name) || !lost_.insert(device.name).second) continue;
    log::warning(now, file_.name, "{}: lost ({}){}", device.name, device.because,
                 consequence(device));
  }
  const auto stopping = std::ranges::find_if(
      silent, [this](const SilentDevice& device) { return stops_wheels(device); });
  return stopping == silent.end() ? std::string{}
                                  : fmt::format("no {}: {}", stopping->name, stopping->because);
}

bool SensorWatch::stops_wheels(const SilentDevice& device) const {
  return device.wanted && file_.on_lost_sensor == OnLostSensor::kStop;
}

std::string SensorWatch::consequence(const SilentDevice& device) const {
  const bool has_wheels = file_.wheels != nullptr;
  if (!has_wheels || !device.wanted) return {};
  return stops_wheels(device) ? "; the wheels stand until it is back"
                              : "; on_lost_sensor is 'ignore': the wheels may turn";
}

}  // namespace hal::robot::agent
