#include <limits>

#include "hal/dds/inspection/channel_writers.h"
#include "hal/dds/inspection/typed_channel_writer.h"

namespace hal::dds {
namespace {

class BatteryWriter final : public TypedWriter<sensor_msgs::msg::dds_::BatteryState_PubSubType> {
 public:
  explicit BatteryWriter(const ChannelTopic& topic) : TypedWriter(topic) {
    constexpr std::uint8_t kDischarging = 2;  // POWER_SUPPLY_STATUS_DISCHARGING
    constexpr float kNotMeasured = std::numeric_limits<float>::quiet_NaN();
    auto& state = sample();
    state.header().frame_id(topic.agent + "/base_link");
    state.temperature(kNotMeasured);
    state.charge(kNotMeasured);
    state.capacity(kNotMeasured);
    state.design_capacity(kNotMeasured);
    state.power_supply_status(kDischarging);
    state.present(true);
  }

 private:
  /// sensor_msgs/BatteryState.msg: the current is negative when discharging.
  void fill(Time at, std::span<const double> values) override {
    sample().header().stamp(to_ros(at));
    sample().percentage(static_cast<float>(values[0]));
    sample().voltage(static_cast<float>(values[1]));
    sample().current(static_cast<float>(-values[2]));
  }
};

}  // namespace

std::unique_ptr<ChannelWriter> make_battery_writer(const ChannelTopic& topic) {
  return std::make_unique<BatteryWriter>(topic);
}

}  // namespace hal::dds
