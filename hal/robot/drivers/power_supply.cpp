#include "hal/robot/drivers/power_supply.h"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <variant>

#include "hal/robot/drivers/attributes.h"
#include "hal/robot/drivers/polled_sensor.h"

namespace hal::robot::drivers {
namespace {

using namespace std::chrono_literals;

class PowerSupply {
 public:
  PowerSupply(std::filesystem::path folder, double capacity)
      : folder_(std::move(folder)), capacity_(capacity) {}

  /// Charge 0..1, volts, amperes, joules now and when full.
  Result<std::vector<double>> measure() const {
    const auto percent = read_attribute(folder_ / "capacity");
    if (!percent) return tl::unexpected<Error>(percent.error());
    const auto microvolts = read_attribute(folder_ / "voltage_now");
    if (!microvolts) return tl::unexpected<Error>(microvolts.error());
    double amperes = std::numeric_limits<double>::quiet_NaN();
    if (has_attribute(folder_ / "current_now")) {
      const auto microamperes = read_attribute(folder_ / "current_now");
      if (!microamperes) return tl::unexpected<Error>(microamperes.error());
      amperes = std::abs(*microamperes) * 1e-6;
    }
    const double charge = *percent / 100;
    const auto energy = energies();
    if (!energy) return tl::unexpected<Error>(energy.error());
    const auto [now, full] = energy->value_or(std::pair{charge * capacity_, capacity_});
    return std::vector{charge, *microvolts * 1e-6, amperes, now, full};
  }

 private:
  /// J now and when full; nullopt: the gauge does not measure energy.
  Result<std::optional<std::pair<double, double>>> energies() const {
    constexpr double kJoules = 3600e-6;  // J per uWh
    if (!has_attribute(folder_ / "energy_now") || !has_attribute(folder_ / "energy_full"))
      return std::nullopt;
    const auto now = read_attribute(folder_ / "energy_now");
    if (!now) return tl::unexpected<Error>(now.error());
    const auto full = read_attribute(folder_ / "energy_full");
    if (!full) return tl::unexpected<Error>(full.error());
    return std::pair{*now * kJoules, *full * kJoules};
  }

  std::filesystem::path folder_;
  double capacity_;  ///< J
};

}  // namespace

std::unique_ptr<SensorDriver> make_power_supply(const PowerSupplySettings& settings) {
  return std::make_unique<PolledSensor<PowerSupply>>(
      PowerSupply(settings.folder, settings.capacity), settings.times);
}

std::shared_ptr<const SensorChoice> power_supply_keys(
    files::description::Fields& io, const node::devices::SensorDescription* sensor) {
  PowerSupplySettings settings;
  const auto* const battery =
      sensor == nullptr ? nullptr : std::get_if<node::devices::Battery>(sensor);
  if (battery != nullptr) settings.capacity = battery->capacity;
  std::string folder;
  io.needed_text({"folder", "Folder of the device in sysfs.", "/sys/class/power_supply/BAT0"},
                 folder);
  settings.folder = std::move(folder);
  settings.times = {1s, 150ms, 5s};
  times_keys(io, settings.times, 60);
  return std::make_shared<ChosenSensor<PowerSupplySettings>>(std::move(settings),
                                                             make_power_supply);
}

}  // namespace hal::robot::drivers
