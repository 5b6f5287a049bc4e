#include <cmath>
#include <limits>

#include "hal/dds/inspection/channel_writers.h"
#include "hal/dds/inspection/typed_channel_writer.h"

namespace hal::dds {
namespace {

class SonarWriter final : public TypedWriter<sensor_msgs::msg::dds_::Range_PubSubType> {
 public:
  explicit SonarWriter(const ChannelTopic& topic) : TypedWriter(topic) {
    const Channel& channel = topic.channel;
    if (channel.headings.empty()) return;
    constexpr std::uint8_t kUltrasound = 0;
    sample().header().frame_id(topic.agent + "/" + channel.frame);
    sample().radiation_type(kUltrasound);
    sample().field_of_view(static_cast<float>(channel.headings.back() - channel.headings.front()));
    sample().min_range(static_cast<float>(channel.low));
    sample().max_range(static_cast<float>(channel.high));
  }

 private:
  /// ROS REP 117: +infinity for nothing within reach, -infinity for too near.
  void fill(Time at, std::span<const double> values) override {
    sample().header().stamp(to_ros(at));
    sample().range(std::isnan(values[0]) ? std::numeric_limits<float>::infinity()
                                         : static_cast<float>(values[0]));
  }
};

}  // namespace

std::unique_ptr<ChannelWriter> make_sonar_writer(const ChannelTopic& topic) {
  return std::make_unique<SonarWriter>(topic);
}

}  // namespace hal::dds
