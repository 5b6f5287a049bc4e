#include "hal/robot/drivers/iio_imu.h"

#include <fmt/format.h>

#include "hal/robot/drivers/attributes.h"
#include "hal/robot/drivers/polled_sensor.h"

namespace hal::robot::drivers {
namespace {

using namespace std::chrono_literals;

class IioImu {
 public:
  explicit IioImu(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Angular rates x, y, z, then accelerations x, y, z.
  Result<std::vector<double>> measure() const {
    std::vector<double> values;
    for (const char* quantity : {"anglvel", "accel"}) {
      for (const char axis : {'x', 'y', 'z'}) {
        const auto value = component(quantity, axis);
        if (!value) return tl::unexpected<Error>(value.error());
        values.push_back(*value);
      }
    }
    return values;
  }

 private:
  Result<double> component(const char* quantity, char axis) const {
    const auto raw = read_attribute(folder_ / fmt::format("in_{}_{}_raw", quantity, axis));
    if (!raw) return tl::unexpected<Error>(raw.error());
    const std::filesystem::path own = folder_ / fmt::format("in_{}_{}_scale", quantity, axis);
    const auto scale =
        read_attribute(has_attribute(own) ? own : folder_ / fmt::format("in_{}_scale", quantity));
    if (!scale) return tl::unexpected<Error>(scale.error());
    return *raw * *scale;
  }

  std::filesystem::path folder_;
};

}  // namespace

std::unique_ptr<SensorDriver> make_iio_imu(const IioImuSettings& settings) {
  return std::make_unique<PolledSensor<IioImu>>(IioImu(settings.folder), settings.times);
}

std::shared_ptr<const SensorChoice> iio_imu_keys(files::description::Fields& io,
                                                 const node::devices::SensorDescription*) {
  IioImuSettings settings;
  std::string folder;
  io.needed_text({"folder", "Folder of the device in sysfs (Linux Industrial I/O).",
                  "'/sys/bus/iio/devices/iio:device1'"},
                 folder);
  settings.folder = std::move(folder);
  settings.times = {20ms, 150ms, 500ms};
  times_keys(io, settings.times, 1);
  return std::make_shared<ChosenSensor<IioImuSettings>>(std::move(settings), make_iio_imu);
}

}  // namespace hal::robot::drivers
