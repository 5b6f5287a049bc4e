#include "gateway/inspection/channel_writer.h"

#include <cstring>
#include <vector>

#include "gateway/inspection/inspection_endpoints.h"
#include "idl/ros/sensors.h"
#include "inspectPubSubTypes.h"

namespace gateway::inspection {
namespace {

constexpr int kChannelSamples = 10;  // kept for a slow reader

/// The DDS type of a message. A kind whose message is missing here does not compile.
template <class Message>
struct DdsType;
template <>
struct DdsType<geometry_msgs::msg::dds_::PoseStamped_> {
  using Type = geometry_msgs::msg::dds_::PoseStamped_PubSubType;
};
template <>
struct DdsType<sensor_msgs::msg::dds_::BatteryState_> {
  using Type = sensor_msgs::msg::dds_::BatteryState_PubSubType;
};
template <>
struct DdsType<sensor_msgs::msg::dds_::Imu_> {
  using Type = sensor_msgs::msg::dds_::Imu_PubSubType;
};
template <>
struct DdsType<sensor_msgs::msg::dds_::LaserScan_> {
  using Type = sensor_msgs::msg::dds_::LaserScan_PubSubType;
};
template <>
struct DdsType<sensor_msgs::msg::dds_::Range_> {
  using Type = sensor_msgs::msg::dds_::Range_PubSubType;
};
template <>
struct DdsType<std_msgs::msg::dds_::Bool_> {
  using Type = std_msgs::msg::dds_::Bool_PubSubType;
};

/// @tparam Kind  a kind of sensor from idl/ros/sensors.h
template <class Kind>
class KindWriter final : public ChannelWriter {
 public:
  explicit KindWriter(const ChannelTopic& topic)
      : writer_(topic.participant, "rt/" + topic.agent + "/" + topic.channel.name, kChannelSamples,
                topic.readers),
        length_(topic.channel.length),
        period_(topic.channel.period) {
    Kind::describe(writer_.sample(), topic.agent, topic.channel);
  }

  bool has_readers() const noexcept override { return writer_.has_readers(); }

  void publish(hal::Time at, std::span<const double> values) override {
    if (values.size() != length_ || values.size() < Kind::kValues) return;
    if (is_same_measurement(at, values)) return;
    shown_.assign(values.begin(), values.end());
    shown_at_ = at;
    Kind::measure(writer_.sample(), at, values);
    writer_.write();
  }

 private:
  /// Whether the values are those published last, which the channel holds until the sensor has new
  /// ones. Compared bit by bit, because a value may be NaN.
  bool is_same_measurement(hal::Time at, std::span<const double> values) const {
    return shown_.size() == values.size() && at < shown_at_ + period_ &&
           std::memcmp(shown_.data(), values.data(), values.size_bytes()) == 0;
  }

  InspectionWriter<typename DdsType<typename Kind::Message>::Type> writer_;
  std::size_t length_;
  hal::Duration period_;
  std::vector<double> shown_;
  hal::Time shown_at_{};
};

}  // namespace

std::unique_ptr<ChannelWriter> make_channel_writer(const ChannelTopic& topic) {
  std::unique_ptr<ChannelWriter> made;
  idl::ros::for_kind(topic.channel.kind, [&](auto kind) {
    made = std::make_unique<KindWriter<decltype(kind)>>(topic);
  });
  return made;
}

}  // namespace gateway::inspection
