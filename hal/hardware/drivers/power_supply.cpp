#include "hal/hardware/drivers/power_supply.h"

#include <cmath>
#include <limits>

#include "hal/hardware/drivers/attributes.h"
#include "hal/hardware/drivers/polled_sensor.h"

namespace hal::hardware {
namespace {

using namespace std::chrono_literals;

class PowerSupply {
 public:
  explicit PowerSupply(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Charge, volts, amperes.
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
    return std::vector{*percent / 100, *microvolts * 1e-6, amperes};
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace

std::unique_ptr<SensorDriver> make_power_supply(const PowerSupplySettings& settings) {
  return std::make_unique<PolledSensor<PowerSupply>>(PowerSupply(settings.folder), settings.times);
}

std::shared_ptr<const SensorChoice> read_power_supply(config::Mapping& in) {
  PowerSupplySettings settings;
  settings.folder = in.text({"folder", "Of the device in sysfs.", "/sys/class/power_supply/BAT0"});
  settings.times = read_times(in, {1s, 150ms, 5s}, 60);
  return std::make_shared<ChosenSensor<PowerSupplySettings>>(std::move(settings),
                                                             make_power_supply);
}

}  // namespace hal::hardware
