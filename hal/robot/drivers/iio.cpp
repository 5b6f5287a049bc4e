#include "hal/robot/drivers/iio.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>

#include "hal/robot/drivers/attributes.h"
#include "hal/robot/drivers/threaded_infrared.h"

namespace hal::robot::drivers {
namespace {

namespace fs = std::filesystem;

class IioInfrared final : public InfraredDevice {
 public:
  IioInfrared(const IioSettings& settings, const node::devices::RobotDescription& robot)
      : settings_(settings), sensors_(robot.infrared) {}

  Result<void> connect() override;
  Result<InfraredReadings> measure() override;

 private:
  struct Channel {
    fs::path raw;
    double scale = 0;   ///< mV
    double offset = 0;  ///< counts
  };

  Result<Channel> find(const std::string& name) const;
  fs::path attribute(const std::string& name, const std::string& what) const;

  IioSettings settings_;
  std::vector<node::devices::InfraredSensor> sensors_;
  std::vector<Channel> channels_;
};

Result<void> IioInfrared::connect() {
  channels_.clear();
  for (const std::string& name : settings_.channels) {
    const auto channel = find(name);
    if (!channel) return tl::unexpected<Error>(channel.error());
    channels_.push_back(*channel);
  }
  return {};
}

Result<InfraredReadings> IioInfrared::measure() {
  InfraredReadings readings;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const auto raw = read_attribute(channels_[i].raw);
    if (!raw) return tl::unexpected<Error>(raw.error());
    const double volts = (*raw + channels_[i].offset) * channels_[i].scale / 1000;
    readings.volts.push_back(volts);
    readings.metres.push_back(sensors_[i].curve.metres(volts));
  }
  return readings;
}

Result<IioInfrared::Channel> IioInfrared::find(const std::string& name) const {
  Channel channel{.raw = settings_.folder / ("in_" + name + "_raw")};
  const auto scale = read_attribute(attribute(name, "scale"));
  if (!scale) return tl::unexpected<Error>(scale.error());
  channel.scale = *scale;
  const fs::path offset_file = attribute(name, "offset");
  if (!has_attribute(offset_file)) return channel;
  const auto offset = read_attribute(offset_file);
  if (!offset) return tl::unexpected<Error>(offset.error());
  channel.offset = *offset;
  return channel;
}

/// A channel's own attribute or, if there is none, the common attribute of its type.
fs::path IioInfrared::attribute(const std::string& name, const std::string& what) const {
  fs::path own = settings_.folder / fmt::format("in_{}_{}", name, what);
  if (has_attribute(own)) return own;
  const std::string type = name.substr(0, name.find_first_of("0123456789"));
  return settings_.folder / fmt::format("in_{}_{}", type, what);
}

}  // namespace

std::unique_ptr<InfraredDriver> make_iio_infrared(const IioSettings& settings,
                                                  const DrivenRobot& robot) {
  return std::make_unique<ThreadedInfrared>(
      std::make_unique<IioInfrared>(settings, robot.description), settings.times);
}

}  // namespace hal::robot::drivers
